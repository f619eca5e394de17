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

/// From blue for the least value to red for the greatest. @param share  position in the range, clamped to 0 … 1
Colour field_colour(double share);

enum class Align { left, right };

/// A white picture to draw on, in pixels from its lower left corner; later drawings cover earlier ones. Drawn by cairo; it needs no
/// display.
class Canvas {
 public:
  /// @param letters  font size [px]
  Canvas(int width, int height, double letters);
  ~Canvas();
  Canvas(const Canvas&) = delete;

  void clear();

  void fill(const std::vector<Vector2d>& outline, const Colour& colour);

  /// Cells; the sides of second-order ones consist of straight pieces.
  void fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const Colour& colour);
  /// @param colours  one per point, with linear interpolation
  void fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, const std::vector<Colour>& colours);

  /// The sides that belong to a single cell. Coinciding points count as one.
  void stroke_outline(const Eigen::Matrix2Xd& points, const std::vector<Cells>&, double width, const Colour& colour);

  /// A line with round corners and ends.
  void stroke(const std::vector<Vector2d>& line, bool closed, double width, const Colour& colour);

  void disc(const Vector2d& centre, double radius, const Colour& colour);

  void arrow(const Vector2d& from, const Vector2d& to, double width, const Colour& colour);

  /// Three quarters of a circle with an arrowhead, for a couple.
  void turn(const Vector2d& centre, double radius, bool counter_clockwise, double width, const Colour& colour);

  /// Text with its baseline at y, to the right or left of x.
  void words(const std::string& text, double x, double y, Align, const Colour& colour);
  double width_of(const std::string& text) const;

  /// Blue, green, red and an unused byte for each pixel, top row first.
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
