#include "app/survey.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pintle {

namespace {

bool stands_still(Part part) { return part == Part::guide || part == Part::hatch || part == Part::trace; }

/// Takes in points as far as they are within a share of the box's size beside it.
void extend(Eigen::AlignedBox2d& world, const std::vector<Eigen::Vector2d>& points, double share) {
  Eigen::AlignedBox2d reach = world;
  const double margin = share * std::max(world.sizes().maxCoeff(), 1e-9);
  reach.min().array() -= margin;
  reach.max().array() += margin;
  for (const Eigen::Vector2d& r : points) world.extend(Eigen::Vector2d(r.cwiseMax(reach.min()).cwiseMin(reach.max())));
}

}  // namespace

void Survey::add(const Drawing& drawing) {
  const bool whole = around_.empty();
  for (const DrawnLine& line : drawing.lines) {
    const bool still = stands_still(line.part);
    if (!whole && (line.part == Part::trace || drawing.owners.at(static_cast<std::size_t>(line.owner)) != around_)) continue;
    for (const Eigen::Vector2d& r : line.points) {
      if (!whole || !still)
        moving_.extend(r);
      else
        (line.part == Part::trace ? paths_ : fixed_).push_back(r);
    }
  }
  for (const DrawnBody& body : drawing.bodies)
    if (whole || body.name == around_)
      for (Eigen::Index i = 0; i < body.points.cols(); ++i) moving_.extend(Eigen::Vector2d(body.points.col(i)));

  double force = 0;
  for (const DrawnForce& f : drawing.forces) {
    force = std::max(force, f.force.norm());
    largest_couple_ = std::max(largest_couple_, std::abs(f.couple));
  }
  largest_forces_.push_back(force);
  if (field_.empty()) return;
  const FieldRange now = range_of(drawing, field_);
  range_.least = std::min(range_.least, now.least);
  range_.greatest = std::max(range_.greatest, now.greatest);
}

Eigen::AlignedBox2d Survey::world() const {
  if (moving_.isEmpty() && !around_.empty()) throw std::runtime_error("--around " + around_ + ": nothing of that name is drawn");
  Eigen::AlignedBox2d world = moving_;
  if (world.isEmpty())
    for (const Eigen::Vector2d& r : fixed_) world.extend(r);
  if (world.isEmpty()) throw std::runtime_error("there is nothing to draw");
  extend(world, fixed_, 0.12);  // a long wall is cut
  extend(world, paths_, 0.6);
  return world;
}

double Survey::usual_force() const {
  std::vector<double> sorted = largest_forces_;
  std::ranges::sort(sorted);
  if (sorted.empty()) return 0;
  const double usual = sorted[static_cast<std::size_t>(0.9 * static_cast<double>(sorted.size() - 1))];
  return usual > 0 ? usual : sorted.back();
}

}  // namespace pintle
