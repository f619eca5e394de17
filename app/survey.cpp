#include "app/survey.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/common/nearest.h"

namespace pintle {

namespace {

bool stands_still(Part part) { return part == Part::guide || part == Part::hatch || part == Part::trace; }

/// Extends the box to include points within a share of its size around it.
void extend(Eigen::AlignedBox2d& world, const std::vector<Eigen::Vector2d>& points, double share) {
  Eigen::AlignedBox2d reach = world;
  const double margin = share * std::max(world.sizes().maxCoeff(), 1e-9);
  reach.min().array() -= margin;
  reach.max().array() += margin;
  for (const Eigen::Vector2d& r : points) world.extend(Eigen::Vector2d(r.cwiseMax(reach.min()).cwiseMin(reach.max())));
}

/// Whether a surface surrounds the things in a box like a bowl: curved, around their middle, and small enough for them to be visible in it.
bool holds(const std::vector<Eigen::Vector2d>& surface, const Eigen::AlignedBox2d& things) {
  constexpr double largest = 20, bent = 0.1;  // relative to the things; to the length of its chord
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& r : surface) box.extend(r);
  if (!box.contains(things.center()) || box.sizes().maxCoeff() > largest * things.sizes().maxCoeff()) return false;
  const Eigen::Vector2d chord = surface.back() - surface.front();
  if (chord.norm() < 0.01 * box.sizes().maxCoeff()) return true;  // it is closed
  return std::ranges::any_of(surface, [&](const Eigen::Vector2d& r) {
    const Eigen::Vector2d d = r - surface.front();
    return std::abs(chord.x() * d.y() - chord.y() * d.x()) > bent * chord.squaredNorm();
  });
}

}  // namespace

void Survey::add(const Drawing& drawing) {
  const bool whole = around_.empty();
  if (owners_.empty()) {
    owners_ = drawing.owners;
    for (const DrawnLine& line : drawing.lines)
      if (whole && line.part == Part::guide && owners_.at(static_cast<std::size_t>(line.owner)) == "ground")
        surfaces_.push_back(line.points);
  }
  for (const DrawnLine& line : drawing.lines) {
    const bool still = stands_still(line.part);
    if (!still)
      for (const Eigen::Vector2d& r : line.points) all_.extend(r);
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

  for (const DrawnForce& f : drawing.forces)
    if (whole)
      forces_.push_back(f);
    else if (drawing.owners.at(static_cast<std::size_t>(f.owner)) == around_)
      places_.push_back(f.at);

  double force = 0;
  for (const DrawnForce& f : drawing.forces) {
    givers_.at(static_cast<std::size_t>(f.giver)) = true;
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
  Eigen::AlignedBox2d world = moving_;
  if (!around_.empty() && world.isEmpty()) {
    const bool known = std::ranges::find(owners_, around_) != owners_.end();
    if (!known) {
      std::vector<std::string> names;  // of two gears that one joint couples each has its name
      for (const std::string& owner : owners_)
        if (std::ranges::find(names, owner) == names.end()) names.push_back(owner);
      throw std::invalid_argument("--around " + around_ + ": nothing of that name is drawn." + did_you_mean(around_, names));
    }
    if (places_.empty())
      throw std::invalid_argument("--around " + around_ + ": it has no position in these frames; name a body or a joint that it acts on");
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(0.15 * (all_.isEmpty() ? 1 : all_.sizes().maxCoeff()));
    for (const Eigen::Vector2d& r : places_) world.extend(Eigen::Vector2d(r - reach)).extend(Eigen::Vector2d(r + reach));
  }
  if (world.isEmpty())
    for (const Eigen::Vector2d& r : fixed_) world.extend(r);
  if (world.isEmpty()) throw std::runtime_error("there is nothing to draw");
  for (const auto& surface : surfaces_)
    if (!moving_.isEmpty() && holds(surface, moving_))
      for (const Eigen::Vector2d& r : surface) world.extend(r);
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
