#include "framework/build/markers.h"

#include <algorithm>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/modal_basis.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/scene/error.h"
#include "framework/scene/joint_words.h"

namespace pintle {

using Eigen::Vector2d;

Markers::Markers(const Scene& scene, const std::vector<std::optional<MechanismBody>>& elements, Model& model)
    : scene_(scene), elements_(elements), model_(model) {
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) bodies_[scene.bodies[i].name] = static_cast<int>(i);
}

void Markers::wrong(const Place& place, const std::string& message) const { throw SceneError(scene_.file, place, message); }

int Markers::body(const PointRef& ref) const {
  if (ref.body == "ground") return ground;
  const auto found = bodies_.find(ref.body);
  if (found != bodies_.end()) return found->second;
  std::vector<std::string> known{"ground"};
  for (const SceneBody& b : scene_.bodies) known.push_back(b.name);
  wrong(ref.place, "there is no body " + quoted(ref.body) + "." + did_you_mean(ref.body, known));
}

const MechanismBody* Markers::elements(int body) const {
  if (body == ground || !elements_[static_cast<std::size_t>(body)]) return nullptr;
  return &*elements_[static_cast<std::size_t>(body)];
}

namespace {
/// A point at the mass centre is there exactly: the rounding of a difference must not become the size of the mechanism.
Marker without_rounding(Marker m, const Vector2d& x_BO) {
  if (m.x_BP.norm() <= 1e-14 * x_BO.norm()) m.x_BP.setZero();
  return m;
}
}  // namespace

Marker Markers::marker_at(const PointRef& ref, Holds what) const {
  const int b = body(ref);
  const Vector2d x_BO = b == ground ? Vector2d(0, 0) : model_.system.bodies[static_cast<std::size_t>(b)].x_BO;
  if (const MechanismBody* made = elements(b)) return without_rounding(marker_of(scene_, *made, b, ref, what == Holds::direction), x_BO);
  Vector2d at = Vector2d::Zero();
  double angle = 0;
  const auto& points = b == ground ? scene_.ground : scene_.bodies[static_cast<std::size_t>(b)].points;
  if (!ref.point.empty()) {
    const auto p = std::find_if(points.begin(), points.end(), [&](const ScenePoint& q) { return q.name == ref.point; });
    if (p == points.end()) {
      std::vector<std::string> known;
      for (const ScenePoint& q : points) known.push_back(q.name);
      wrong(ref.place, quoted(ref.body) + " has no point " + quoted(ref.point) + "." + did_you_mean(ref.point, known));
    }
    at = vector(p->at);
    angle = p->angle;
  }
  return without_rounding({b, at + x_BO, angle}, x_BO);
}

int Markers::index_of(const Marker& made, const std::string& point) {
  const bool flexible = made.shape.size() > 0;  // two points at one place may move differently
  const auto [known, is_new] = known_.try_emplace({made.body, made.x_BP.x(), made.x_BP.y(), made.angle, flexible ? point : ""},
                                                  static_cast<int>(model_.system.markers.size()));
  if (is_new) {
    model_.system.markers.push_back(made);
    if (made.body != ground) model_.outlines[static_cast<std::size_t>(made.body)].push_back(made.x_BP);
  }
  return known->second;
}

int Markers::marker(const PointRef& ref, Holds what) { return index_of(marker_at(ref, what), ref.point); }

int Markers::carrier(const PointRef& ref) {
  Marker made = marker_at(ref, Holds::direction);
  made.angle = 0;
  return index_of(made, ref.point);
}

Vector2d Markers::place(const PointRef& ref) const {
  const Marker m = marker_at(ref, Holds::point);
  return m.body == ground ? m.x_BP : m.x_BP - model_.system.bodies[static_cast<std::size_t>(m.body)].x_BO;
}

// With `stiffening: rotation` joints act on points of first order, so points at joints are recorded to first order; others include the
// second-order shortening due to bending.
Marker Markers::recorded_at(const PointRef& ref) const {
  Marker m = marker_at(ref, Holds::point);
  if (m.shape.size() == 0 || m.second[0].size() > 0) return m;
  const MechanismBody& b = *elements(m.body);
  const int port = port_of(b.elastic, ref.point);
  const auto holds = [&](const PointRef& held) { return held.body == ref.body && port_of(b.elastic, held.point) == port; };
  const auto joins = [&](const SceneJoint& j) { return std::ranges::any_of(points_of(j), [&](const PointRef* p) { return holds(*p); }); };
  const auto drives = [&](const SceneDriver& d) { return holds(d.a) || holds(d.b); };
  const bool joined = std::ranges::any_of(scene_.joints, joins) || std::ranges::any_of(scene_.drivers, drives);
  if (!joined && !b.second.empty()) m.second = b.second[static_cast<std::size_t>(port)];
  return m;
}

void Markers::two_bodies(const PointRef& a, const PointRef& b, const Place& place) const {
  if (body(a) == body(b)) wrong(place, "both ends are on " + quoted(a.body) + "; join two different bodies");
}

}  // namespace pintle
