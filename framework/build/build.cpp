#include "framework/build/build.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

#include "framework/bodies/body_store.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/mesh_file_warnings.h"
#include "framework/bodies/mechanism_body.h"
#include "framework/bodies/modal_basis.h"
#include "framework/build/clearance.h"
#include "framework/build/contacts.h"
#include "framework/build/play.h"
#include "framework/build/laws.h"
#include "framework/build/choose_method.h"
#include "framework/build/elastic_bodies.h"
#include "framework/build/shape_warnings.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

std::string suggestion(const std::string& word, const std::vector<std::string>& known) { return "." + did_you_mean(word, known); }

/// What is needed to turn names into markers.
class Builder {
 public:
  Builder(const Scene& scene, bool preliminary, BodyStore* store) : scene_(scene), preliminary_(preliminary), store_(store) {}

  Model build() {
    model_.system.gravity = vector(scene_.gravity);
    if (scene_.bodies.empty()) throw SceneError(scene_.file, {0, "bodies"}, "there is no body; a scene needs at least one");
    elastic_ = elastic_bodies(scene_, store_, preliminary_);
    model_.preliminary_run = elastic_.preliminary_run;
    elements_.resize(scene_.bodies.size());
    for (const SceneBody& b : scene_.bodies) add(b);
    for (const SceneJoint& j : scene_.joints) add(j);
    for (std::size_t i = 0; i < scene_.joints.size(); ++i)
      if (scene_.joints[i].play) add_play(scene_.joints[i], model_.order.joints[i]);
    for (const SceneContact& c : scene_.contacts) add(c);
    for (const SceneDriver& d : scene_.drivers) add(d);
    for (const SceneLoad& l : scene_.loads) add(l);
    validate_starts();
    validate_output();
    record();
    keep_drawings();
    report_flexible(scene_, elements_, elastic_, model_);
    model_.system.length = size();
    for (const SceneJoint& j : scene_.joints)
      if (const std::string warning = j.clearance ? rounding_warning(scene_, j, model_.system.length) : ""; !warning.empty())
        model_.warnings.push_back(warning);
    model_.clearances = complete_clearances(scene_, model_.system, model_.warnings);
    for (std::string& warning : contact_warnings(scene_, model_.system, model_.order, elements_))
      model_.warnings.push_back(std::move(warning));
    scheme();
    return std::move(model_);
  }

 private:
  [[noreturn]] void wrong(const Place& place, const std::string& message) const { throw SceneError(scene_.file, place, message); }

  void unique(const std::string& name, const char* what, const Place& place) {
    if (!names_.insert(name).second) wrong(place, quoted(name) + " names two things; give this " + what + " a name of its own");
  }

  void add(const SceneBody& b) {
    if (b.name == "ground") wrong(b.place, "\"ground\" is the fixed world; give the body another name");
    unique(b.name, "body", b.place);
    const std::size_t i = model_.system.bodies.size();
    index_[b.name] = static_cast<int>(i);
    std::vector<Vector2d> outline;
    if (b.elastic) {
      const std::optional<int> chosen = elastic_.choices[i] ? std::optional<int>(elastic_.choices[i]->count) : std::nullopt;
      Reduction reduction =
          store_ ? store_->reduction(scene_, *elastic_.meshed[i], chosen) : reduction_of(scene_, *elastic_.meshed[i], chosen);
      const MechanismBody& made = elements_[i].emplace(mechanism_body(scene_, std::move(*elastic_.meshed[i]), std::move(reduction)));
      model_.system.bodies.push_back(made.body);
      model_.warnings.insert(model_.warnings.end(), made.warnings.begin(), made.warnings.end());
      for (const Port& p : made.elastic.model.ports) outline.push_back(p.x - made.centre);
    } else {
      validate_mass(b);
      model_.system.bodies.push_back({b.name, b.mass, b.inertia, -vector(b.center)});
      for (const ScenePoint& p : b.points) outline.push_back(vector(p.at) - vector(b.center));
    }
    model_.outlines.push_back(std::move(outline));
  }

  /// A rigid body moves by its mass and inertia; a scene may leave them out where nothing asks for them.
  void validate_mass(const SceneBody& b) const {
    std::string missing;
    if (b.mass == 0) missing = "mass: 0.3 kg";
    if (b.inertia == 0) missing += (missing.empty() ? "" : ", and ") + std::string("inertia: 1e-4 kg m^2");
    if (!missing.empty())
      wrong(b.place, quoted(b.name) + " lacks what forces act on; add for example " + missing +
                         " (only `pintle kinematics` does without, and `pintle statics` without gravity)");
    if (!(b.mass > 0)) wrong(b.place, "mass must be above 0 kg");
    if (!(b.inertia > 0)) wrong(b.place, "inertia must be above 0 kg m^2");
  }

  int body(const PointRef& ref) const {
    if (ref.body == "ground") return ground;
    const auto found = index_.find(ref.body);
    if (found != index_.end()) return found->second;
    std::vector<std::string> known{"ground"};
    for (const SceneBody& b : scene_.bodies) known.push_back(b.name);
    wrong(ref.place, "there is no body " + quoted(ref.body) + suggestion(ref.body, known));
  }

  /// What takes hold of a direction needs one: on bodies of elements not every point has it.
  enum class Holds { point, direction };

  Marker marker_at(const PointRef& ref, Holds what) const {
    const int b = body(ref);
    if (b != ground && elements_[static_cast<std::size_t>(b)])
      return marker_of(scene_, *elements_[static_cast<std::size_t>(b)], b, ref, what == Holds::direction);
    Vector2d at = Vector2d::Zero();
    double angle = 0;
    const auto& points = b == ground ? scene_.ground : scene_.bodies[static_cast<std::size_t>(b)].points;
    if (!ref.point.empty()) {
      const auto p = std::find_if(points.begin(), points.end(), [&](const ScenePoint& q) { return q.name == ref.point; });
      if (p == points.end()) {
        std::vector<std::string> known;
        for (const ScenePoint& q : points) known.push_back(q.name);
        wrong(ref.place, quoted(ref.body) + " has no point " + quoted(ref.point) + suggestion(ref.point, known));
      }
      at = vector(p->at);
      angle = p->angle;
    }
    if (b != ground) at += model_.system.bodies[static_cast<std::size_t>(b)].x_BO;
    return {b, at, angle};
  }

  int marker(const PointRef& ref, Holds what = Holds::point) {
    const Marker made = marker_at(ref, what);
    const bool flexible = made.shape.size() > 0;  // two points of one place may move differently
    const auto [known, is_new] = markers_.try_emplace({made.body, made.x_BP.x(), made.x_BP.y(), made.angle, flexible ? ref.point : ""},
                                                      static_cast<int>(model_.system.markers.size()));
    if (is_new) {
      model_.system.markers.push_back(made);
      if (made.body != ground) model_.outlines[static_cast<std::size_t>(made.body)].push_back(made.x_BP);
    }
    return known->second;
  }

  void two_bodies(const PointRef& a, const PointRef& b, const Place& place) const {
    if (body(a) == body(b)) wrong(place, "both ends are on " + quoted(a.body) + "; join two different bodies");
  }

  void add(const SceneJoint& j) {
    unique(j.name, "joint", j.place);
    two_bodies(j.a, j.b, j.place);
    const JointWord& word = word_of(j);
    const PointRef c = cage_of(j);
    if (word.third) two_bodies(j.a, c, j.place), two_bodies(j.b, c, j.place);
    if (j.clearance) return add_contact(j);
    if (j.play) return model_.order.joints.push_back(-1);
    const Joint made = joint_of(j);
    model_.order.joints.push_back(static_cast<int>(model_.system.joints.size()));
    if (j.friction && rubs(j.friction->law)) add_friction(j);
    model_.system.joints.push_back(made);
    model_.system.joint_names.push_back(j.name);
  }

  Joint joint_of(const SceneJoint& j) {
    const JointWord& word = word_of(j);
    const bool turns = word.clamps || word.turns;
    const int a = marker(j.a, turns || word.guides ? Holds::direction : Holds::point);
    const int b = marker(j.b, turns ? Holds::direction : Holds::point);
    switch (j.kind) {
      case JointKind::revolute: return Revolute{a, b};
      case JointKind::slot: return Slot{a, b};
      case JointKind::prismatic: return Prismatic{a, b, nearest_turn(j)};
      case JointKind::weld: return Weld{a, b, nearest_turn(j)};
      case JointKind::distance:
        if (!(j.length > 0)) wrong(j.place, "length must be above 0; for two points that coincide use revolute");
        return Distance{a, b, j.length};
      case JointKind::differential: break;
    }
    if (j.ratio == 0) wrong(j.place, "ratio must not be 0: the first shaft would be fixed to the cage; use weld");
    const PointRef c = cage_of(j);
    return Differential{a, b, marker(c, Holds::direction), j.ratio,
                        drawn_angle(j.a) + j.ratio * drawn_angle(j.b) - (1 + j.ratio) * drawn_angle(c)};
  }
  static PointRef cage_of(const SceneJoint& j) { return j.c.value_or(PointRef{"ground", "", j.place}); }

  void add_friction(const SceneJoint& j) {
    const SceneJointFriction& f = *j.friction;
    const FrictionLaw law = friction_law(scene_, f.law);
    if (!word_of(j).friction || !std::holds_alternative<Coulomb>(law))
      wrong(j.place, "friction in a joint is Coulomb's, and in a revolute, prismatic or slot joint");
    if ((j.kind == JointKind::revolute && !(f.radius > 0)) || !(f.preload >= 0)) wrong(j.place, "friction needs the pin's radius, above 0");
    model_.system.frictions.push_back({model_.order.joints.back(), std::get<Coulomb>(law), f.radius, f.length, f.preload});
  }

  /// The contact that it is, and the joint that it would be.
  void add_play(const SceneJoint& j, int& order) {
    for (const PointRef* p : points_of(j)) reject_elements(*p);
    const Joint ideal = joint_of(j);
    const std::array<Profile, 2> profiles = profiles_of(scene_, j);
    order = static_cast<int>(model_.system.contacts.size());
    add(contact_with_play(j), profiles[0], profiles[1], {marker(j.a, Holds::direction), marker(j.b, Holds::direction)});
    if (j.kind == JointKind::distance && j.play->only != ScenePlay::both) return;  // a rope may start slack
    model_.system.loose.push_back(ideal);
    model_.system.loose_names.push_back(j.name);
  }

  /// A point's direction where its body's rough pose and start put it.
  double drawn_angle(const PointRef& ref) const {
    const int b = body(ref);
    double angle = marker_at(ref, Holds::direction).angle;
    if (b == ground) return angle;
    angle += scene_.bodies[static_cast<std::size_t>(b)].angle;
    for (const StartBody& s : scene_.start_bodies)
      if (s.body == ref.body && s.angle) angle += *s.angle - scene_.bodies[static_cast<std::size_t>(b)].angle;
    return angle;
  }

  /// The joint's angle with the whole turns that its bodies' rough poses show.
  double nearest_turn(const SceneJoint& j) const {
    constexpr double turn = 2 * std::numbers::pi;
    return j.angle + turn * std::round((drawn_angle(j.b) - drawn_angle(j.a) - j.angle) / turn);
  }

  void add_contact(const SceneJoint& j) {
    ContactPair pair = contact_of(scene_, j);
    const bool b_bears = j.clearance->bearing == j.b.body;
    pair.a = marker(b_bears ? j.a : j.b);
    pair.b = marker(b_bears ? j.b : j.a);
    if (j.clearance->model == ClearanceModel::massless_link) {
      pair.link = static_cast<int>(model_.system.joints.size());
      model_.system.joints.push_back(Distance{pair.b, pair.a, pair.gap.clearance()});
      model_.system.joint_names.push_back(j.name);
    }
    model_.order.joints.push_back(static_cast<int>(model_.system.contacts.size()));
    model_.system.contacts.push_back(pair);
    model_.system.contact_names.push_back(j.name);
  }

  void add(const SceneContact& c) {
    unique(c.name, "contact", c.place);
    two_bodies(c.a, c.b, c.place);
    const Profile &a = profile(c.a), &b = profile(c.b);
    add(c, a, b, {profile_marker(c.a), profile_marker(c.b)});
  }
  void add(const SceneContact& c, const Profile& a, const Profile& b, const std::array<int, 2>& markers) {
    auto& contacts = model_.system.contacts;
    BuiltContact made = build_contact(scene_, c, a, b, markers, static_cast<int>(contacts.size()));
    contacts.insert(contacts.end(), made.pairs.begin(), made.pairs.end());
    model_.system.contact_names.insert(model_.system.contact_names.end(), made.pairs.size(), c.name);
    model_.contacts.push_back(std::move(made.words));
    if (!made.warning.empty()) model_.warnings.push_back(std::move(made.warning));
  }

  /// Of the axes that a body's profiles are given in.
  int profile_marker(const PointRef& ref) {
    reject_elements(ref);
    return marker({ref.body, "", ref.place});
  }
  void reject_elements(const PointRef& ref) const {
    const int b = body(ref);
    if (b != ground && elements_[static_cast<std::size_t>(b)])
      wrong(ref.place, quoted(ref.body) +
                           " is made of elements, the surface of which no contact follows yet; put the profile on a rigid body "
                           "and weld that to a point of it");
  }
  const Profile& profile(const PointRef& ref) {
    const auto [known, is_new] = profiles_.try_emplace({ref.body, ref.point});
    if (!is_new) return known->second;
    const int b = body(ref);
    known->second = profile_of(scene_, ref);
    const Vector2d origin = b == ground ? Vector2d(0, 0) : model_.system.bodies[static_cast<std::size_t>(b)].x_BO;
    DrawnProfile& made = model_.profiles.emplace_back(DrawnProfile{b, solid(known->second), drawn(known->second)});
    for (Vector2d& x : made.points) x += origin;
    return known->second;
  }

  void add(const SceneDriver& d) {
    unique(d.name, "driver", d.place);
    two_bodies(d.a, d.b, d.place);
    const Holds what = d.kind == DriverKind::angle ? Holds::direction : Holds::point;
    const int a = marker(d.a, what), b = marker(d.b, what);
    model_.order.drivers.push_back(static_cast<int>(model_.system.joints.size()));
    if (d.kind == DriverKind::angle) {
      model_.system.joints.push_back(AngleDriver{a, b, d.law.at});
    } else {
      if (!(d.law.at(0).value > 0)) wrong(d.place, "a driven distance must stay above 0; at t = 0 it is not");
      model_.system.joints.push_back(DistanceDriver{a, b, d.law.at});
    }
    model_.system.joint_names.push_back(d.name);
  }

  void add(const SceneLoad& l) {
    unique(l.name, "force", l.place);
    auto& forces = model_.system.forces;
    model_.order.loads.push_back(static_cast<int>(forces.size()));
    if (const auto* f = std::get_if<SceneForce>(&l.what)) {
      if (body(f->at) == ground) wrong(f->at.place, "a force on the ground moves nothing; name a body's point");
      const int b = marker(f->at, f->follows ? Holds::direction : Holds::point);
      forces.push_back(PointForce{marker({"ground", "", f->at.place}), b, f->x.at, f->y.at, f->follows});
    } else if (const auto* q = std::get_if<SceneTorque>(&l.what)) {
      two_bodies(q->a, q->b, l.place);
      const int a = marker(q->a, Holds::direction);
      forces.push_back(Torque{a, marker(q->b, Holds::direction), q->law.at});
    } else if (const auto* s = std::get_if<SceneSpring>(&l.what)) {
      two_bodies(s->a, s->b, l.place);
      const int a = marker(s->a);
      forces.push_back(Spring{a, marker(s->b), s->stiffness, s->damping, s->free_length});
    } else if (const auto* r = std::get_if<SceneTorsionSpring>(&l.what)) {
      two_bodies(r->a, r->b, l.place);
      const int a = marker(r->a, Holds::direction);
      forces.push_back(TorsionSpring{a, marker(r->b, Holds::direction), r->stiffness, r->damping, r->free_angle});
    } else {
      const auto& m = std::get<SceneMaxwell>(l.what);
      two_bodies(m.a, m.b, l.place);
      const int a = marker(m.a);
      forces.push_back(Maxwell{a, marker(m.b), m.stiffness, m.damping});
    }
    model_.system.force_names.push_back(l.name);
  }

  void validate_starts() {
    for (const StartBody& s : scene_.start_bodies)
      if (!index_.count(s.body)) {
        std::vector<std::string> known;
        for (const auto& [name, i] : index_) known.push_back(name);
        wrong(s.place, "there is no body " + quoted(s.body) + suggestion(s.body, known));
      }
    bend_starts();
    validate_start_journals(scene_, model_.system);
  }

  void bend_starts() {
    for (const StartBody& s : scene_.start_bodies) {
      if (s.deflection.empty() && s.modes.empty()) continue;
      const std::size_t b = static_cast<std::size_t>(index_.at(s.body));
      if (!elements_[b] || !elements_[b]->body.flex)
        wrong(s.place, quoted(s.body) + " stays rigid and cannot start bent: its `modes` keep no shape; keep more");
      model_.bent.emplace_back(static_cast<int>(b), bent_start(scene_, *elements_[b], s));
    }
  }

  /// Under `stiffening: rotation` joints hold points of first order, so that those are recorded where the joints are; others
  /// come nearer as the body bends.
  Marker recorded_at(const PointRef& ref) const {
    Marker m = marker_at(ref, Holds::point);
    if (m.shape.size() == 0 || m.second[0].size() > 0) return m;
    const MechanismBody& b = *elements_[static_cast<std::size_t>(m.body)];
    const int port = port_of(b.elastic, ref.point);
    const auto holds = [&](const PointRef& held) { return held.body == ref.body && port_of(b.elastic, held.point) == port; };
    const auto joins = [&](const SceneJoint& j) { return std::ranges::any_of(points_of(j), [&](const PointRef* p) { return holds(*p); }); };
    const auto drives = [&](const SceneDriver& d) { return holds(d.a) || holds(d.b); };
    const bool joined = std::ranges::any_of(scene_.joints, joins) || std::ranges::any_of(scene_.drivers, drives);
    if (!joined && !b.second.empty()) m.second = b.second[static_cast<std::size_t>(port)];
    return m;
  }

  void record() {
    for (const PointRef& p : scene_.output.points)
      model_.points.push_back({p.point.empty() ? p.body : p.body + "." + p.point, recorded_at(p)});
    for (const PointRef& p : scene_.output.stress) {
      const int b = body(p);
      const std::optional<MechanismBody> none;
      const auto& made = b == ground ? none : elements_[static_cast<std::size_t>(b)];
      if (!made || !made->body.flex)
        wrong(p.place, quoted(p.body) + " has no stress, " +
                           (made && made->elastic.scene->elastic->modes ? "its `modes` keep no shape; keep more"
                                                                        : "it is rigid; make it a beam or plate with `modes`"));
      model_.stresses.push_back({p.body + "." + p.point, b, stress_probe(scene_, made->elastic, made->modes, p)});
    }
    for (std::string& warning : stress_warnings(model_.system, model_.stresses, elements_)) model_.warnings.push_back(std::move(warning));
  }

  void keep_drawings() {
    if (scene_.output.frames < 2) return;
    for (const auto& made : elements_)
      if (made && made->body.flex) model_.drawings.emplace_back(made->elastic, made->modes, made->centre);
  }

  void validate_output() const {
    constexpr double most = 1e7;
    if (scene_.output.every > 0 && scene_.run.until / scene_.output.every > most)
      wrong(scene_.output.place, "`every` asks for more than ten million rows; make it longer, or run.until shorter");
    if (scene_.output.frames == 1) wrong(scene_.output.place, "one frame is no animation; ask for 0, or 2 and more");
  }

  // The largest arm of a body or distance between ground points: what "small" is measured by.
  double size() const {
    double length = 0;
    for (const Marker& m : model_.system.markers) length = std::max(length, m.x_BP.norm());
    for (const Joint& j : model_.system.joints)
      if (const auto* d = std::get_if<Distance>(&j)) length = std::max(length, d->length);
    for (const ContactPair& c : model_.system.contacts)
      if (!c.profiles) length = std::max(length, bearing_radius(c.gap));
    for (const DrawnProfile& p : model_.profiles)
      if (p.body != ground || length == 0)
        for (const Vector2d& x : p.points) length = std::max(length, x.norm());
    return length > 0 ? length : 1;
  }

  void scheme() {
    const RunOptions& run = scene_.run;
    Scheme& s = model_.scheme;
    choose_method(scene_, model_.system, s);
    number(model_.system, !s.tableau || s.switch_below > 0);
    s.tolerance = run.tolerance;
    if (s.constraints == Constraints::partitioning && model_.system.n_rows() > 300)
      wrong(run.place, "partitioning is dense and meant for up to 300 rows, this scene has " + std::to_string(model_.system.n_rows()) +
                           "; use constraints: projection");
    s.onset_cut = run.onset_cut.value_or(0);
    follow_laws(scene_, s);
    s.max_steps = run.max_steps;
  }

  const Scene& scene_;
  bool preliminary_;
  BodyStore* store_;
  Model model_;
  std::map<std::string, int> index_;
  ElasticBodies elastic_;
  std::vector<std::optional<MechanismBody>> elements_;  ///< of bodies made of elements
  std::map<std::tuple<int, double, double, double, std::string>, int> markers_;
  std::map<std::pair<std::string, std::string>, Profile> profiles_;
  std::set<std::string> names_;
};

}  // namespace

Model build(const Scene& scene) { return Builder(scene, false, nullptr).build(); }
Model build(const Scene& scene, BodyStore& store) { return Builder(scene, false, &store).build(); }
Model build_with_preliminary_run(const Scene& scene) { return Builder(scene, true, nullptr).build(); }

}  // namespace pintle
