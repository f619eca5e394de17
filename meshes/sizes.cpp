#include "meshes/sizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace pintle {

using Eigen::Vector2d;

namespace {
// On an arc of the outline, cells are at most a twelfth of its full circle, but at least a fiftieth of the largest size, however sharp a
// fillet is.
constexpr double least_share = 0.02;
}  // namespace

double SizeField::at(double x, double y) const {
  double size = largest;
  for (const Source& s : sources) {
    const double dx = x - s.at.x(), dy = y - s.at.y(), room = (size - s.size) / growth;
    if (room <= 0) continue;
    const double d2 = dx * dx + dy * dy;
    if (d2 < room * room) size = s.size + growth * std::sqrt(d2);
  }
  return size;
}

double Contour::length() const {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += (points[(i + 1) % points.size()] - points[i]).norm();
  return sum;
}

double Contour::area() const {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2d p = points[i] - points[0], q = points[(i + 1) % points.size()] - points[0];
    sum += (p.x() * q.y() - p.y() * q.x()) / 2;
  }
  return std::abs(sum);
}

bool inside(const Contour& contour, const Vector2d& p) {
  bool in = false;
  const std::size_t n = contour.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d &a = contour.points[i], &b = contour.points[(i + 1) % n];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) in = !in;
  }
  return in;
}

void validate_count(double cells, double size) {
  if (cells <= most_cells) return;
  std::ostringstream text;
  text << "cells of size " << size << " would be about " << cells << ", more than " << most_cells << "; make `size` or `hole size` larger";
  throw std::invalid_argument(text.str());
}

SizeField size_field(const std::vector<Contour>& contours, double size, double hole_size) {
  SizeField field;
  double area = 0;
  for (std::size_t k = 0; k < contours.size(); ++k) area += (k == 0 ? 1 : -1) * contours[k].area();
  field.largest = size > 0 ? size : std::sqrt(area) / 10;
  validate_count(area / (field.largest * field.largest), field.largest);
  for (std::size_t k = 0; k < contours.size(); ++k) {
    const Contour& c = contours[k];
    if (k > 0 && hole_size > 0) validate_count(c.length() / hole_size / SizeField::growth, hole_size);
    const double of_hole = hole_size > 0 ? hole_size : c.length() / sides_round_hole;
    std::size_t last = c.points.size();  // the last source; points much nearer than a cell are skipped
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      double at = of_hole;
      if (k == 0) {
        if (!(c.curvature[i] * field.largest > 2 * std::numbers::pi / sides_round_arc)) continue;
        at = std::max(2 * std::numbers::pi / sides_round_arc / c.curvature[i], least_share * field.largest);
      }
      if (at >= field.largest) continue;
      if (last < c.points.size() && (c.points[i] - c.points[last]).norm() < at / 4 && at >= field.sources.back().size) continue;
      field.sources.push_back({c.points[i], at});
      last = i;
    }
  }
  return field;
}

}  // namespace pintle
