#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "meshes/mesh.h"

namespace pintle {

using Colour = Eigen::Vector3d;  // red, green, blue in 0 … 1
using Eigen::Vector2d;

/// From blue, the least, to red, the greatest. @param share  clamped to 0 … 1
Colour field_colour(double share);

enum class Align { left, right };

/// A white picture to draw on, in pixels from its lower left corner; what is drawn later lies above. Drawn by cairo, which canvas.cpp
/// alone knows; it needs no display.
class Canvas {
 public:
  /// @param letters  their size [px]
  Canvas(int width, int height, double letters);
  ~Canvas();
  Canvas(const Canvas&) = delete;

  void clear();

  void fill(const std::vector<Vector2d>& outline, const Colour& colour);

  /// Cells, those of second order in straight pieces.
  void fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const Colour& colour);
  /// @param colours  one a point and linear between them
  void fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const std::vector<Colour>& colours);

  /// The sides that belong to one cell alone. Points that coincide count as one.
  void stroke_outline(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, double width, const Colour& colour);

  /// A line with round corners and ends.
  void stroke(const std::vector<Vector2d>& line, bool closed, double width, const Colour& colour);

  void disc(const Vector2d& centre, double radius, const Colour& colour);

  void arrow(const Vector2d& from, const Vector2d& to, double width, const Colour& colour);

  /// Three quarters of a circle with a head, of a couple.
  void turn(const Vector2d& centre, double radius, bool counter_clockwise, double width, const Colour& colour);

  /// At the foot of its letters, to the right of x or to the left of it.
  void words(const std::string& text, double x, double y, Align, const Colour& colour);
  double width_of(const std::string& text) const;

  /// Blue, green, red and a byte of nothing for each pixel, rows from above.
  std::span<const unsigned char> pixels() const;
  /// @throws FileError
  void write_png(const std::filesystem::path&) const;

 private:
  struct Surface;
  void trace(const std::vector<Vector2d>& line, bool closed);
  void paint(const Colour& colour);

  int width_, height_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace pintle
