#include "framework/build/couplings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "framework/build/backlash.h"
#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/configuration/assemble.h"
#include "framework/dynamics/model/marker_motion.h"
#include "framework/scene/error.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

// ---- joints before they are complete ----

/// The ends of a relation, and the index of each point among them.
class Ends {
 public:
  Ends(const Scene& scene, const SceneJoint& j, Markers& markers) : scene_(scene), place_(j.place), points_(points_of(j)) {
    for (const PointRef* p : points_) ends_.marker[at(ends_.n++)] = markers.marker(*p, turned(j, *p) ? Holds::direction : Holds::point);
  }
  const JointEnds& markers() const { return ends_; }
  int place(const PointRef& ref, bool of_point) const {
    const auto found = std::ranges::find_if(
        points_, [&](const PointRef* p) { return p->body == ref.body && (p->body != "ground" || p->point == ref.point); });
    if (of_point && (*found)->point != ref.point)
      throw SceneError(
          scene_.file, place_,
          "measures " + quoted(ref.body) + " at two of its points, " + quoted((*found)->point) + " and " + quoted(ref.point) +
              "; a relation uses one point of each body: weld a light body at the other point, or measure from the same point");
    return static_cast<int>(found - points_.begin());
  }

 private:
  static bool turned(const SceneJoint& j, const PointRef& p) {
    return std::ranges::any_of(j.coupling->terms, [&](const SceneTerm& t) {
      return t.kind == SceneTerm::angle ? t.a.body == p.body || t.b.body == p.body
                                        : t.kind == SceneTerm::displacement && t.a.body == p.body;
    });
  }
  const Scene& scene_;
  const Place& place_;
  std::vector<const PointRef*> points_;
  JointEnds ends_{{}, 0};
};

Relation of_terms(const Scene& scene, const SceneJoint& j, Markers& markers) {
  const std::vector<SceneTerm>& terms = j.coupling->terms;
  if (terms.size() < 2 || terms.size() > most_terms) throw SceneError(scene.file, j.place, "a differential has two or three terms");
  const Ends ends(scene, j, markers);
  std::vector<Coordinate> coordinates;
  for (const SceneTerm& t : terms) {
    constexpr Coordinate::Kind kinds[] = {Coordinate::angle, Coordinate::displacement, Coordinate::distance};
    if (t.ratio == 0) throw SceneError(scene.file, j.place, "a term's ratio must not be 0; leave the term out");
    const bool of_point = t.kind != SceneTerm::angle;
    coordinates.push_back({kinds[t.kind], ends.place(t.a, of_point), ends.place(t.b, of_point), t.ratio});
  }
  return relation(terms.front().kind == SceneTerm::angle, ends.markers(), std::move(coordinates));
}

PointRef frame_of(const SceneJoint& j) { return j.c.value_or(PointRef{"ground", "", j.place}); }

// For shafts or a shaft and a slide, with the cage or frame c as reference of both: ends a, b, c.
constexpr int shaft = 0, follower = 1, frame = 2;
Relation on_a_frame(const Scene& scene, const SceneJoint& j, Markers& markers) {
  const bool slides = j.kind == JointKind::screw || (j.kind == JointKind::cam && !j.coupling->swings);
  const JointEnds ends{{markers.marker(j.a, Holds::direction), markers.marker(j.b, slides ? Holds::point : Holds::direction),
                        markers.marker(frame_of(j), Holds::direction)},
                       3};
  const Coordinate::Kind moves = slides ? Coordinate::displacement : Coordinate::angle;
  if (j.kind == JointKind::cam) {  // over the cam's angle in the frame's axes, whatever the direction of the lift there
    const double direction = markers.marker_at(frame_of(j), Holds::direction).angle;
    TimeLaw curve = [of = j.coupling->curve.at, direction](double angle) { return of(angle + direction); };
    return relation(!slides, ends, {{Coordinate::angle, frame, shaft, 0}, {moves, frame, follower, 1}}, std::move(curve));
  }
  if (j.kind == JointKind::screw) {
    if (j.coupling->lead == 0) throw SceneError(scene.file, j.place, "lead must not be 0: the nut would be fixed; use prismatic or weld");
    return relation(false, ends,
                    {{moves, frame, follower, 1}, {Coordinate::angle, frame, shaft, -j.coupling->lead / (2 * std::numbers::pi)}});
  }
  if (j.ratio == 0) throw SceneError(scene.file, j.place, "ratio must not be 0: the first shaft would be fixed to the cage; use weld");
  return relation(true, ends, {{Coordinate::angle, frame, shaft, 1}, {Coordinate::angle, frame, follower, j.ratio}});
}

// ---- at the start ----

/// Completes one joint from the motion of its markers.
class Settling {
 public:
  Settling(const Scene& scene, const System& system, const Eigen::VectorXd& y)
      : scene_(scene), system_(system), motion_(system.markers.size()) {
    for (std::size_t i = 0; i < motion_.size(); ++i) {
      const MovingPoint p = moving_point(system, static_cast<int>(i), y);
      motion_[i].r = p.r;
      motion_[i].angle = p.angle;
      motion_[i].u = {std::cos(p.angle), std::sin(p.angle)};
    }
  }

  void complete(const SceneJoint& j, Joint& made) const {
    if (auto* rod = std::get_if<Distance>(&made)) {
      rod->length += open(made) + rod->length;
      if (!(rod->length > 0)) wrong(j.place, "length must stay above 0; at the start `present` is " + length(rod->length - j.length));
    } else if (auto* gear = std::get_if<Gear>(&made)) {
      mesh(j, made, *gear, 0);
    } else if (auto* disc = std::get_if<RollsOnDisc>(&made)) {
      mesh(j, made, *disc, 1);
    } else if (auto* rack = std::get_if<Rack>(&made)) {
      mesh(j, made, *rack, 0);
    } else if (auto* wheel = std::get_if<RollsOnLine>(&made)) {
      mesh(j, made, *wheel, 1);
    } else if (auto* related = std::get_if<Relation>(&made)) {
      if (related->curve && !std::isfinite(open(made)))
        wrong(j.place, "its table does not cover the cam's angle at the start, " + angle(input(*related)) +
                           "; lengthen the table, or turn the cam by `start`");
      related->constant += open(made);
    }
  }
  void complete(const SceneDriver& d, Joint& made) const {
    TimeLaw& law = *driver_law(made);
    const double present = open(made) + law(0).value;
    if (d.kind == DriverKind::distance && !(present + law(0).value > 0))
      wrong(d.place, "a driven distance must stay above 0; at t = 0 it is " + number_text(present + law(0).value, 6) +
                         " m: drive from a point further off, or by a law that adds more");
    law = [present, added = law](double t) {
      const Jet jet = added(t);
      return Jet{present + jet.value, jet.rate, jet.accel};
    };
  }
  /// Pulleys of one belt lie in one plane. Each span begins at one of them.
  void keep_apart(const SceneLoad& l, const BeltSpan& one, const BeltSpan& other) const {
    const double apart = (motion_[at(one.a)].r - motion_[at(other.a)].r).norm(), a = std::abs(one.radius_a), b = std::abs(other.radius_a);
    if (!(apart > a + b)) overlap(l.place, apart, a, b);
  }
  /// Constant for each span: stiffness over its length.
  void complete(const SceneBelt& belt, BeltSpan& span) const {
    const MarkerMotion &a = motion_[at(span.a)], &b = motion_[at(span.b)];
    const double delta = span.radius_b - span.radius_a, apart = (b.r - a.r).norm();
    const double span_length = std::sqrt(apart * apart - delta * delta);
    span.turn = std::atan2(b.r.y() - a.r.y(), b.r.x() - a.r.x()) - std::atan2(delta, span_length);
    span.k = belt.stiffness / span_length;
    span.c = belt.damping / span_length;
    span.loose = elongation(span, a, b).value - belt.pretension / span.k;
  }

 private:
  [[noreturn]] void wrong(const Place& place, const std::string& message) const { throw SceneError(scene_.file, place, message); }
  /// Row `row` of the joint is the no-slip condition.
  template <class Wheels>
  void mesh(const SceneJoint& j, const Joint& made, Wheels& wheels, int row) const {
    fit(j, wheels);
    wheels.phase += open(made, row);
  }
  [[noreturn]] void overlap(const Place& place, double apart, double a, double b) const {
    wrong(place, "two of its pulleys are " + length(apart) + " apart at the start, but radii of " + length(a) + " and " + length(b) +
                     " need more than " + length(a + b) + "; correct radii or points");
  }
  static std::string length(double x) { return number_text(1e3 * x, 7) + " mm"; }
  static std::string angle(double x) { return number_text(x * 180 / std::numbers::pi, 7) + " deg"; }

  double open(const Joint& joint, int row = 0) const {
    ConstraintRows rows;
    std::array<ConstraintRows::Block, most_ends> L;
    evaluate_pose(joint, motion_.data(), 0, rows, L.data());
    return rows.C[row];
  }
  /// The angle that is the argument of a cam's curve.
  double input(const Relation& j) const {
    const int of = j.ends.marker[shaft], against = j.ends.marker[frame];
    return motion_[at(of)].angle - motion_[at(against)].angle + system_.markers[at(against)].angle;
  }

  /// Computes radii from teeth, and checks that wheels touch or pulleys are apart.
  void fit(const SceneJoint& j, Gear& gear) const {
    const double apart = (motion_[at(gear.b)].r - motion_[at(gear.a)].r).norm(), sum = std::abs(gear.radius_a + gear.radius_b);
    const double a = gear.radius_a, b = std::abs(gear.radius_b);
    if (j.kind == JointKind::belt) {
      if (!(apart > a + b)) overlap(j.place, apart, a, b);
      return;
    }
    if (!(sum > 0)) wrong(j.place, "a wheel cannot run inside another of the same size; leave out inside, or use a revolute or a weld");
    if (j.coupling->teeth[0] > 0) {
      if (!(apart > 0)) wrong(j.place, "the centres of its wheels coincide at the start, so their radii are undetermined; write radii");
      gear.radius_a *= apart / sum;
      gear.radius_b *= apart / sum;
      return;
    }
    if (std::abs(apart - sum) <= played(j) * std::max(a, b)) return;
    const double other = gear.radius_b > 0 ? std::abs(a - b) : a + b;
    wrong(j.place, "the centres are " + length(apart) + " apart at the start, but radii of " + length(a) + " and " + length(b) +
                       (gear.radius_b > 0 ? "" : ", one inside the other,") + " need " + length(sum) + "; correct radii or points" +
                       (std::abs(apart - other) <= played(j) * std::max(a, b)
                            ? gear.radius_b > 0 ? ", or write inside: true" : ", or leave out inside"
                            : ""));
  }
  /// Determines the side of the line, and checks that the wheel touches it.
  void fit(const SceneJoint& j, Rack& rack) const {
    const MarkerMotion &a = motion_[at(rack.a)], &b = motion_[at(rack.b)];
    const double height = perp(a.u).dot(b.r - a.r);
    if (std::abs(std::abs(height) - rack.radius) > played(j) * rack.radius)
      wrong(j.place, "the wheel's centre is " + length(std::abs(height)) + " off the line at the start, but its radius is " +
                         length(rack.radius) + "; correct the radius or the points, or turn the direction of the line");
    if (height < 0) rack.radius = -rack.radius;
  }
  /// Allowed error of a drawn centre, relative to the radius: assembly brings rolling discs into contact; other joints hold gears.
  static double played(const SceneJoint& j) { return j.kind == JointKind::rolling ? 0.05 : 1e-3; }

  const Scene& scene_;
  const System& system_;
  std::vector<MarkerMotion> motion_;
};

/// Whether a joint with clearance has teeth, with backlash.
bool meshes(const Joint& loose) { return std::holds_alternative<Gear>(loose) || std::holds_alternative<Rack>(loose); }

/// The system with only the joints that position the bodies: without `joints`, couplings with clearance, forces and what these need.
System without(const System& system, const std::vector<int>& joints) {
  System rest;
  rest.gravity = system.gravity;
  rest.length = system.length;
  rest.bodies = system.bodies;
  rest.markers = system.markers;
  rest.contacts = system.contacts;
  rest.contact_names = system.contact_names;
  for (std::size_t k = 0; k < system.loose.size(); ++k)
    if (!meshes(system.loose[k])) rest.loose.push_back(system.loose[k]), rest.loose_names.push_back(system.loose_names[k]);
  const auto before = [&](int joint) { return static_cast<int>(std::ranges::count_if(joints, [&](int k) { return k < joint; })); };
  for (ContactPair& pair : rest.contacts)
    if (pair.link >= 0) pair.link -= before(pair.link);
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    if (std::ranges::find(joints, static_cast<int>(k)) != joints.end()) continue;
    rest.joints.push_back(system.joints[k]);
    rest.joint_names.push_back(system.joint_names[k]);
  }
  number(rest);
  return rest;
}

}  // namespace

bool is_coupling(const SceneJoint& j) { return j.coupling || j.kind == JointKind::differential; }

Joint coupling_of(const Scene& scene, const SceneJoint& j, Markers& markers) {
  if (j.kind == JointKind::differential && j.coupling) return of_terms(scene, j, markers);
  if (word_of(j).third) return on_a_frame(scene, j, markers);
  const SceneCoupling& c = *j.coupling;
  const int a = markers.marker(j.a, Holds::direction), b = markers.marker(j.b, Holds::direction);
  if (c.radius > 0) return j.kind == JointKind::rack ? Joint{Rack{a, b, c.radius}} : Joint{RollsOnLine{{a, b, c.radius}}};
  constexpr double small = 1e-9;  // so that teeth do not affect the size of the mechanism before their radii are known
  const Pair sizes = c.teeth[0] > 0 ? Pair{small * c.teeth[0], small * c.teeth[1]} : c.radii;
  if (!(sizes[0] > 0 && sizes[1] > 0)) throw SceneError(scene.file, j.place, "the radii of its wheels must be above 0");
  const bool alike = c.inside || (j.kind == JointKind::belt && !c.crossed);  // both turn in the same direction
  const Gear gear{a, b, sizes[0], alike ? -sizes[1] : sizes[1]};
  return j.kind == JointKind::rolling ? Joint{RollsOnDisc{gear}} : Joint{gear};
}

std::vector<BeltSpan> spans_of(const Scene& scene, const SceneLoad& l, const SceneBelt& belt, Markers& markers) {
  const std::size_t n = belt.pulleys.size();
  if (n < 2 || belt.radii.size() != n || std::ranges::find(belt.radii, 0.0) != belt.radii.end() || !(belt.stiffness > 0))
    throw SceneError(scene.file, l.place, "a belt needs two pulleys or more, with a radius other than 0 each, and a stiffness above 0");
  std::vector<BeltSpan> out;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    markers.two_bodies(belt.pulleys[i], belt.pulleys[j], l.place);
    const int a = markers.marker(belt.pulleys[i], Holds::direction), b = markers.marker(belt.pulleys[j], Holds::direction);
    out.push_back({a, b, belt.radii[i], belt.radii[j], belt.stiffness, belt.damping});
  }
  return out;
}

void complete_couplings(const Scene& scene, Model& model) {
  System& system = model.system;
  std::vector<int> open;
  const auto each = [&](auto complete) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i)
      if (const SceneJoint& j = scene.joints[i]; !j.play && (is_coupling(j) || j.from_present)) complete(j, model.order.joints[i]);
    for (std::size_t i = 0; i < scene.drivers.size(); ++i)
      if (scene.drivers[i].from_present) complete(scene.drivers[i], model.order.drivers[i]);
  };
  each([&](const auto&, int joint) { open.push_back(joint); });
  const bool belts = std::ranges::any_of(scene.loads, [](const SceneLoad& l) { return std::holds_alternative<SceneBelt>(l.what); });
  if (open.empty() && !belts && std::ranges::none_of(system.loose, meshes)) return;
  const System rest = without(system, open);
  const Settling start(scene, rest, closed_pose(scene, rest, model.bent));
  each([&](const auto& named, int joint) { start.complete(named, system.joints[at(joint)]); });
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const SceneJoint& j = scene.joints[i];
    if (!j.play || !is_coupling(j)) continue;
    Joint& ideal = system.loose[at(std::ranges::find(system.loose_names, j.name) - system.loose_names.begin())];
    start.complete(j, ideal);
    complete_flanks(scene, j, ideal, at(model.order.joints[i]), system);
  }
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const auto* belt = std::get_if<SceneBelt>(&scene.loads[i].what);
    const auto span = [&](std::size_t k) -> BeltSpan& { return std::get<BeltSpan>(system.forces[at(model.order.loads[i]) + k]); };
    for (std::size_t k = 0; belt && k < belt->pulleys.size(); ++k) {
      for (std::size_t other = 0; other < k; ++other) start.keep_apart(scene.loads[i], span(k), span(other));
    }
    for (std::size_t k = 0; belt && k < belt->pulleys.size(); ++k) start.complete(*belt, span(k));
  }
}

}  // namespace pintle
