#include "framework/build/build.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "framework/bodies/body_store.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/mesh_file_warnings.h"
#include "framework/bodies/mechanism_body.h"
#include "framework/build/backlash.h"
#include "framework/build/clearance.h"
#include "framework/build/contacts.h"
#include "framework/build/choose_method.h"
#include "framework/build/couplings.h"
#include "framework/build/elastic_bodies.h"
#include "framework/build/events.h"
#include "framework/build/joints.h"
#include "framework/build/laws.h"
#include "framework/build/loads.h"
#include "framework/build/markers.h"
#include "framework/build/play.h"
#include "framework/build/shape_warnings.h"
#include "framework/build/signals.h"
#include "framework/common/index.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

/// Builds the model of a scene, part by part.
class Builder {
 public:
  Builder(const Scene& scene, bool preliminary, BodyStore* store)
      : scene_(scene), preliminary_(preliminary), store_(store), markers_(scene, elements_, model_), signals_(scene, markers_, model_) {}

  Model build() {
    model_.system.gravity = vector(scene_.gravity);
    if (scene_.bodies.empty()) throw SceneError(scene_.file, {0, "bodies"}, "there is no body; a scene needs at least one");
    model_.warnings = scene_.warnings;
    elastic_ = elastic_bodies(scene_, store_, preliminary_);
    model_.preliminary_run = elastic_.preliminary_run;
    elements_.resize(scene_.bodies.size());
    for (const SceneBody& b : scene_.bodies) add(b);
    for (const SceneJoint& j : scene_.joints) add(j);
    for (std::size_t i = 0; i < scene_.joints.size(); ++i)
      if (scene_.joints[i].play)
        add_play(scene_.joints[i], model_.order.joints[i]);
      else if (is_open(scene_.joints[i]))
        add_open_bearing(scene_.joints[i], model_.order.joints[i]);
    for (const SceneContact& c : scene_.contacts) add(c);
    for (const SceneDriver& d : scene_.drivers) add(d);
    for (const SceneLoad& l : scene_.loads) add(l);
    for (const SceneState& s : scene_.states) add(s);
    for (const SceneEvent& e : scene_.events) unique(e.name, "event", e.place);
    add_switches(scene_, model_);
    validate_starts();
    validate_output();
    record();
    keep_drawings();
    report_flexible(scene_, elements_, elastic_, model_);
    model_.system.length = size();
    complete_couplings(scene_, model_);
    model_.system.length = size();
    signals_.finish();
    allow_rounding(model_.system);
    for (const SceneJoint& j : scene_.joints)
      if (const std::string warning = j.clearance ? rounding_warning(scene_, j, model_.system.length) : ""; !warning.empty())
        model_.warnings.push_back(warning);
    model_.clearances = complete_clearances(scene_, model_.system, model_.warnings);
    number(model_.system);  // for code that uses the motion's own rates
    for (std::string& warning : contact_warnings(scene_, model_.system, model_.order, elements_))
      model_.warnings.push_back(std::move(warning));
    scheme();
    for (const SceneOutput& o : scene_.outputs) add(o);
    add_events(scene_, model_, signals_);
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

  /// A rigid body needs mass and inertia; a scene may leave them out where they have no effect.
  void validate_mass(const SceneBody& b) const {
    std::string missing;
    if (b.mass == 0) missing = "mass: 0.3 kg";
    if (b.inertia == 0) missing += (missing.empty() ? "" : ", and ") + std::string("inertia: 1e-4 kg m^2");
    if (!missing.empty())
      wrong(b.place, quoted(b.name) + " lacks mass properties that forces need; add for example " + missing +
                         " (only `pintle kinematics`, and `pintle statics` without gravity, do not need them)");
    if (!(b.mass > 0)) wrong(b.place, "mass must be above 0 kg");
    if (!(b.inertia > 0)) wrong(b.place, "inertia must be above 0 kg m^2");
  }

  void add(const SceneJoint& j) {
    unique(j.name, "joint", j.place);
    apart(j);
    if (j.play || is_open(j)) return model_.order.joints.push_back(-1);
    if (j.clearance) return add_contact(j);
    const Joint made = joint_of(scene_, j, markers_);
    model_.order.joints.push_back(static_cast<int>(model_.system.joints.size()));
    if (j.friction && rubs(j.friction->law)) model_.system.frictions.push_back(friction_of(scene_, j, model_.order.joints.back()));
    model_.system.joints.push_back(made);
    model_.system.joint_names.push_back(j.name);
  }

  /// Checks that its ends are on different bodies.
  void apart(const SceneJoint& j) const {
    markers_.two_bodies(j.a, j.b, j.place);
    if (j.coupling && !j.coupling->terms.empty()) {
      for (const SceneTerm& t : j.coupling->terms) markers_.two_bodies(t.a, t.b, j.place);
    } else if (word_of(j).third) {
      const PointRef frame = j.c.value_or(PointRef{"ground", "", j.place});
      markers_.two_bodies(j.a, frame, j.place), markers_.two_bodies(j.b, frame, j.place);
    }
  }

  /// Adds the contact, and the ideal joint.
  void add_play(const SceneJoint& j, int& order) {
    const Joint ideal = joint_of(scene_, j, markers_);
    order = static_cast<int>(model_.system.contacts.size());
    if (is_coupling(j)) {
      add(build_flanks(scene_, j, ideal), j.name);
    } else {
      const std::array<Profile, 2> profiles = profiles_of(scene_, j);
      add(contact_with_play(j), profiles[0], profiles[1], {markers_.marker(j.a, Holds::direction), markers_.marker(j.b, Holds::direction)});
    }
    write_force_of(j, order, true);
    if (j.kind == JointKind::distance && j.play->only != ScenePlay::both) return;  // a rope may start slack
    model_.system.loose.push_back(ideal);
    model_.system.loose_names.push_back(j.name);
  }

  /// Adds the pairs of the journal with the pieces of an open bearing, and the ideal joint.
  void add_open_bearing(const SceneJoint& j, int& order) {
    const std::array<Profile, 2> profiles = open_bearing(scene_, j);
    const bool b_bears = j.clearance->bearing == j.b.body;
    const PointRef &journal = b_bears ? j.a : j.b, &bearing = b_bears ? j.b : j.a;
    ContactPair like = contact_of(scene_, j);
    like.profiles = like.journal = true;
    like.a = markers_.marker(journal, Holds::direction), like.b = markers_.marker(bearing, Holds::direction);
    order = static_cast<int>(model_.system.contacts.size());
    SceneContact named;
    named.a = journal, named.b = bearing, named.place = j.clearance->place;
    add(build_pairs(scene_, named, profiles[0], profiles[1], like, order), j.name);
    write_force_of(j, order, b_bears);
    model_.system.loose.push_back(joint_of(scene_, j, markers_));
    model_.system.loose_names.push_back(j.name);
  }

  void add_contact(const SceneJoint& j) {
    ContactPair pair = contact_of(scene_, j);
    const bool b_bears = j.clearance->bearing == j.b.body;
    pair.a = markers_.marker(b_bears ? j.a : j.b);
    pair.b = markers_.marker(b_bears ? j.b : j.a);
    pair.massless = residual_flexibility(scene_, j, markers_.elements(markers_.body(j.a)), markers_.elements(markers_.body(j.b)));
    if (j.clearance->model == ClearanceModel::massless_link) {
      pair.link = static_cast<int>(model_.system.joints.size());
      model_.system.joints.push_back(Distance{pair.b, pair.a, pair.gap.clearance()});
      model_.system.joint_names.push_back(j.name);
    }
    model_.order.joints.push_back(static_cast<int>(model_.system.contacts.size()));
    model_.system.contacts.push_back(pair);
    model_.system.contact_names.push_back(j.name);
    write_force_of(j, model_.order.joints.back(), b_bears);
  }

  /// As for a joint without clearance, results give the force on the second body, or on the first if the second is the ground.
  /// @param first_is_a  the contact's a is on the joint's first body
  void write_force_of(const SceneJoint& j, int first_pair, bool first_is_a) {
    const bool on_first = j.b.body == "ground";
    for (std::size_t k = at(first_pair); k < model_.system.contacts.size(); ++k)
      model_.system.contacts[k].written_on_a = on_first == first_is_a;
  }

  void add(const SceneContact& c) {
    unique(c.name, "contact", c.place);
    markers_.two_bodies(c.a, c.b, c.place);
    const Profile &a = profile(c.a), &b = profile(c.b);
    model_.order.contacts.push_back(static_cast<int>(model_.system.contacts.size()));
    add(c, a, b, {markers_.carrier(carrier_of(scene_, c.a)), markers_.carrier(carrier_of(scene_, c.b))});
  }
  void add(const SceneContact& c, const Profile& a, const Profile& b, const std::array<int, 2>& markers) {
    add(build_contact(scene_, c, a, b, markers, static_cast<int>(model_.system.contacts.size())), c.name);
  }
  void add(BuiltContact made, const std::string& name) {
    auto& contacts = model_.system.contacts;
    contacts.insert(contacts.end(), made.pairs.begin(), made.pairs.end());
    model_.system.contact_names.insert(model_.system.contact_names.end(), made.pairs.size(), name);
    model_.contacts.push_back(std::move(made.words));
    std::ranges::move(made.warnings, std::back_inserter(model_.warnings));
  }

  const Profile& profile(const PointRef& ref) {
    const auto [known, is_new] = profiles_.try_emplace({ref.body, ref.point});
    if (!is_new) return known->second;
    known->second = profile_of(scene_, markers_, ref);
    model_.profiles.push_back({markers_.carrier(carrier_of(scene_, ref)), markers_.body(ref), solid(known->second), drawn(known->second)});
    return known->second;
  }

  void add(const SceneDriver& d) {
    unique(d.name, "driver", d.place);
    markers_.two_bodies(d.a, d.b, d.place);
    const Holds what = d.kind == DriverKind::angle ? Holds::direction : Holds::point;
    const int a = markers_.marker(d.a, what), b = markers_.marker(d.b, what);
    model_.order.drivers.push_back(static_cast<int>(model_.system.joints.size()));
    if (d.kind == DriverKind::angle) {
      model_.system.joints.push_back(AngleDriver{a, b, d.law.at});
    } else {
      if (!d.from_present && !(d.law.at(0).value > 0))
        wrong(d.place, "a driven distance must stay above 0; at t = 0 its law is " + number_text(d.law.at(0).value, 6) +
                           " m: write `present + …`, a longer one, or drive from a point further off");
      model_.system.joints.push_back(DistanceDriver{a, b, d.law.at});
    }
    model_.system.joint_names.push_back(d.name);
  }

  void add(const SceneLoad& l) {
    unique(l.name, "force", l.place);
    add_load(scene_, l, markers_, signals_, model_);
  }

  void add(const SceneState& s) {
    unique(s.name, "state", s.place);
    model_.system.states.push_back({s.name, s.unit, s.scale, s.start, signals_.begin(s.rate, s.place)});
  }

  void add(const SceneOutput& o) {
    unique(o.name, "output", o.place);
    model_.outputs.push_back(written_output(scene_, o, model_, signals_));
  }

  void validate_starts() {
    for (const StartBody& s : scene_.start_bodies)
      if (!markers_.bodies().count(s.body)) {
        std::vector<std::string> known;
        for (const auto& [name, i] : markers_.bodies()) known.push_back(name);
        wrong(s.place, "there is no body " + quoted(s.body) + "." + did_you_mean(s.body, known));
      }
    bend_starts();
    validate_start_journals(scene_, model_.system);
  }

  void bend_starts() {
    for (const StartBody& s : scene_.start_bodies) {
      if (s.deflection.empty() && s.modes.empty()) continue;
      const std::size_t b = static_cast<std::size_t>(markers_.bodies().at(s.body));
      if (!elements_[b] || !elements_[b]->body.flex)
        wrong(s.place, quoted(s.body) + " stays rigid and cannot start bent: its `modes` keep no shape; keep more");
      model_.bent.emplace_back(static_cast<int>(b), bent_start(scene_, *elements_[b], s));
    }
  }

  void record() {
    for (const PointRef& p : scene_.output.points)
      model_.points.push_back({p.point.empty() ? p.body : p.body + "." + p.point, markers_.recorded_at(p)});
    for (const PointRef& p : scene_.output.stress) {
      const int b = markers_.body(p);
      const MechanismBody* made = markers_.elements(b);
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
    constexpr double most = 1 / std::numeric_limits<double>::epsilon();  // the times of adjacent rows differ
    if (scene_.output.every > 0 && scene_.run.until / scene_.output.every > most)
      wrong(scene_.output.place, "`every` is less than the rounding of the times in the run; increase it, or decrease run.until");
    if (scene_.output.frames == 1) wrong(scene_.output.place, "one frame is not an animation; write 0, or at least 2");
  }

  static double size_of(const Joint& joint) {
    const auto size = [](const auto& j) {
      if constexpr (requires { j.length; })
        return j.length;
      else if constexpr (requires { j.radius_a; })
        return std::max(std::abs(j.radius_a), std::abs(j.radius_b));
      else if constexpr (requires { j.radius; })
        return std::abs(j.radius);
      else
        return 0.0;
    };
    return std::visit(size, joint);
  }

  // The largest arm of a body or distance between ground points: the scale for "small".
  double size() const {
    double length = 0;
    for (const Marker& m : model_.system.markers) length = std::max(length, m.x_BP.norm());
    for (const Joint& j : model_.system.joints) length = std::max(length, size_of(j));
    for (const ContactPair& c : model_.system.contacts)
      if (c.flank)
        for (const double radius : pitch_radii(*c.flank)) length = std::max(length, std::abs(radius));
      else if (!c.profiles || c.journal)
        length = std::max(length, bearing_radius(c.gap));
    for (const DrawnProfile& p : model_.profiles)
      if (p.body != ground || length == 0)
        for (const Vector2d& x : p.points) length = std::max(length, x.norm());
    if (length == 0)  // all points are at mass centres
      for (const Body& b : model_.system.bodies) length = std::max(length, b.x_BO.norm());
    return length > 0 ? length : 1;
  }

  void scheme() {
    const RunOptions& run = scene_.run;
    Scheme& s = model_.scheme;
    choose_method(scene_, model_.system, s);
    number(model_.system, !s.tableau || s.switch_below > 0);
    s.tolerance = run.tolerance;
    if (s.constraints == Constraints::partitioning && model_.system.n_rows() > 300)
      wrong(run.place, "partitioning uses dense matrices, for at most 300 constraint equations; this scene has " +
                           std::to_string(model_.system.n_rows()) + "; use constraints: projection");
    s.onset_cut = run.onset_cut.value_or(0);
    std::ranges::move(follow_laws(scene_, s), std::back_inserter(model_.warnings));
    if (s.fixed_step > 0) s.max_step = std::min(s.max_step, s.fixed_step);
    s.max_steps = run.max_steps;
  }

  const Scene& scene_;
  bool preliminary_;
  BodyStore* store_;
  Model model_;
  ElasticBodies elastic_;
  std::vector<std::optional<MechanismBody>> elements_;  ///< for bodies made of elements
  Markers markers_;
  SignalMaker signals_;
  std::map<std::pair<std::string, std::string>, Profile> profiles_;
  std::set<std::string> names_;
};

}  // namespace

Model build(const Scene& scene) { return Builder(scene, false, nullptr).build(); }
Model build(const Scene& scene, BodyStore& store) { return Builder(scene, false, &store).build(); }
Model build_with_preliminary_run(const Scene& scene) { return Builder(scene, true, nullptr).build(); }

}  // namespace pintle
