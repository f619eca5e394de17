#include "framework/configuration/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include <Eigen/Geometry>

#include "framework/configuration/named_place.h"
#include "framework/configuration/row_space.h"
#include "framework/dynamics/model/marker_motion.h"
#include "framework/integration/events/impact_log.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

std::string overlap_words(const ContactPair& pair, double depth) {
  std::ostringstream s;
  s.precision(4);
  s << "the two surfaces overlap by " << depth << " m at the start, "
    << (is_rigid(pair) ? "which is impossible for rigid bodies; move a body with `start` or `pose`"
                       : "more than a tenth of their smallest radius; move a body with `start` or `pose`")
    << (pair.profiles ? ", or put the material on the other side" : "");
  return s.str();
}

/// Largest depth of points of `line` inside a closed outline; 0 if none is inside [m].
double deepest_inside(const std::vector<Eigen::Vector2d>& outline, const std::vector<Eigen::Vector2d>& line) {
  double out = 0;
  for (const Eigen::Vector2d& p : line) {
    bool inside = false;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0, before = outline.size() - 1; i < outline.size(); before = i++) {
      const Eigen::Vector2d from = outline[before] - p, to = outline[i] - p, along = to - from;
      if ((from.y() > 0) != (to.y() > 0) && from.x() - from.y() * along.x() / along.y() > 0) inside = !inside;
      const double length = along.squaredNorm(), part = length > 0 ? std::clamp(-from.dot(along) / length, 0.0, 1.0) : 0;
      nearest = std::min(nearest, (from + part * along).norm());
    }
    if (inside) out = std::max(out, nearest);
  }
  return out;
}

/// Rejects outlines that overlap so deeply that the piece through which they entered is unknown.
void require_outside(const Scene& scene, const Model& model, const State& start) {
  const auto placed = [&](const DrawnProfile& profile) {
    std::vector<Eigen::Vector2d> out;
    const MovingPoint carrier = moving_point(model.system, profile.marker, start.y);
    for (const Eigen::Vector2d& p : profile.points) out.emplace_back(carrier.r + Eigen::Rotation2D(carrier.angle) * p);
    return out;
  };
  std::map<std::pair<std::string, std::string>, std::size_t> index;  // contacts have added them in this order
  const auto of = [&](const PointRef& ref) { return model.profiles[index.try_emplace({ref.body, ref.point}, index.size()).first->second]; };
  for (const SceneContact& c : scene.contacts) {
    const DrawnProfile a = of(c.a), b = of(c.b);
    const auto on_a = placed(a), on_b = placed(b);
    const double depth = std::max(a.solid ? deepest_inside(on_a, on_b) : 0, b.solid ? deepest_inside(on_b, on_a) : 0);
    for (std::size_t k = 0; k < model.system.contacts.size(); ++k) {
      const ContactPair& pair = model.system.contacts[k];
      if (model.system.contact_names[k] != c.name) continue;
      if (depth > deepest_valid * std::min(contact_size(pair, model.system.length), pair.deepest))
        throw AssemblyError(scene.file, c.place, overlap_words(pair, depth));
    }
  }
}

}  // namespace

void require_apart(const Scene& scene, const Model& model, const State& start) {
  constexpr double rounding = 1e-9;  // relative to the mechanism's length
  const System& system = model.system;
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& pair = system.contacts[c];
    if (!(pair.profiles || is_rigid(pair)) || !(onset_of(system, static_cast<int>(c), start).value > 0)) continue;
    const double depth = gap_of(system, static_cast<int>(c), start).value;
    if (!(depth > (is_rigid(pair) ? rounding * system.length : deepest_valid * contact_size(pair, system.length)))) continue;
    throw AssemblyError(scene.file, named_place(scene, system.contact_names[c]), overlap_words(pair, depth));
  }
  require_outside(scene, model, start);
}

}  // namespace pintle
