#pragma once

#include <vector>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <Eigen/Core>

#include "meshes/mesh.h"

namespace pintle {

using Colour = Eigen::Vector3d;  // red, green, blue in 0 … 1
using Eigen::Vector2d;

/// From blue, the least, to red, the greatest. @param share  clamped to 0 … 1
Colour field_colour(double share);

/// Filled flat shapes in pixels, a layer above the other.
class Canvas {
 public:
  Canvas() { colours_->SetNumberOfComponents(3); }

  void fill(const std::vector<Vector2d>& outline, const Colour& colour);

  /// Cells, those of second order in straight pieces.
  /// @param colours  one for all, or one a point and linear between them
  void fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const std::vector<Colour>& colours);

  /// The sides that belong to one cell alone. Points that coincide count as one.
  void stroke_outline(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, double width, const Colour& colour);

  /// A line with round corners and ends.
  void stroke(const std::vector<Vector2d>& line, bool closed, double width, const Colour& colour);

  void disc(const Vector2d& centre, double radius, const Colour& colour);

  void arrow(const Vector2d& from, const Vector2d& to, double width, const Colour& colour);

  /// What follows lies over what came before.
  void next_layer() { layer_ += 1; }

  vtkSmartPointer<vtkActor> actor() const;

  double layer() const { return layer_; }

 private:
  vtkIdType corner(const Vector2d& at, const Colour& colour);

  double layer_ = 0;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> shapes_;
  vtkNew<vtkUnsignedCharArray> colours_;  // one a point
};

}  // namespace pintle
