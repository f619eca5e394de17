#include "framework/analysis/cost/simpler.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "framework/build/choose_method.h"
#include "framework/common/index.h"
#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/internal.h"

namespace pintle {

namespace {

using Eigen::Index;

/// Keeps the first n shapes of a body, none for a rigid one.
void keep_shapes(System& system, int body, int n) {
  std::optional<FlexInertia>& flex = system.bodies[at(body)].flex;
  const auto square = [&](Eigen::MatrixXd& m) { m = m.topLeftCorner(n, n).eval(); };
  const auto head = [&](auto& v) { v = v.head(n).eval(); };
  if (n == 0) flex.reset();
  if (flex) {
    flex->S = flex->S.leftCols(n).eval();
    head(flex->j), head(flex->h), head(flex->omega), head(flex->zeta);
    square(flex->G);
    if (flex->second)
      for (Eigen::MatrixXd* m : {&flex->second->S[0], &flex->second->S[1], &flex->second->j, &flex->second->h}) square(*m);
  }
  for (Marker& m : system.markers) {
    if (m.body != body) continue;
    m.shape = n > 0 ? m.shape.leftCols(n).eval() : Eigen::Matrix2Xd();
    m.slope = n > 0 ? m.slope.head(n).eval() : Eigen::RowVectorXd();
    for (Eigen::MatrixXd& second : m.second)
      if (second.size() > 0) second = second.topLeftCorner(n, n).eval();
  }
}

void drop_stiffening(System& system, int body) {
  system.bodies[at(body)].flex->second.reset();
  for (Marker& m : system.markers)
    if (m.body == body) m.second = {};
}

/// Removes the joint that is a clearance's massless link.
void drop_link(System& system, ContactPair& pair) {
  const int link = std::exchange(pair.link, -1);
  forget_switch(system, Switch::joint, link);
  system.joints.erase(system.joints.begin() + link);
  system.joint_names.erase(system.joint_names.begin() + link);
  for (ContactPair& c : system.contacts)
    if (c.link > link) --c.link;
  for (JointFriction& f : system.frictions)
    if (f.joint > link) --f.joint;
}

/// The clearance as an ideal pin.
void close_gap(System& system, int contact) {
  ContactPair& pair = system.contacts[at(contact)];
  if (is_held(pair)) drop_link(system, pair);
  system.joints.emplace_back(Revolute{pair.a, pair.b});
  system.joint_names.push_back(system.contact_names[at(contact)]);
  forget_switch(system, Switch::contact, contact);
  system.contacts.erase(system.contacts.begin() + contact);
  system.contact_names.erase(system.contact_names.begin() + contact);
}

State start_of(const System& from, const State& start, const System& to) {
  State out;
  out.t = start.t;
  out.y.setZero(to.n_y());
  begin_switches(to, out.y);
  for (const Index level : {0, 1}) {  // coordinates, speeds
    const Index a = level * from.n(), b = level * to.n();
    out.y.segment(b, to.n_rigid()) = start.y.segment(a, from.n_rigid());
    for (std::size_t i = 0; i < to.bodies.size(); ++i)
      out.y.segment(b + to.eta_begin[i], to.bodies[i].modes()) = start.y.segment(a + from.eta_begin[i], to.bodies[i].modes());
  }
  relax_internal_states(to, out.t, out.y);
  out.impact_rate.assign(to.contacts.size(), 0.0);
  return out;
}

class Maker {
 public:
  Maker(const Scene& scene, const Model& model, const State& start) : scene_(scene), model_(model), start_(start) {
    for (int b = 0; b < static_cast<int>(model.system.bodies.size()); ++b)
      if (model.system.bodies[at(b)].modes() > 0) flexible_.push_back(b);
    gaps_.resize(at(n_clearances(model.system)));
    std::iota(gaps_.begin(), gaps_.end(), 0);
  }

  std::vector<Simpler> all() {
    bodies(
        "rigid", [](System& s, int b) { keep_shapes(s, b, 0); }, [](const Body&) { return true; });
    bodies(
        "with half its shapes", [](System& s, int b) { keep_shapes(s, b, (s.bodies[at(b)].modes() + 1) / 2); },
        [](const Body& b) { return b.modes() > 1; });
    bodies("without stiffening", drop_stiffening, [](const Body& b) { return b.flex->second.has_value(); });
    each(
        gaps_, [&](int c) { return "\"" + model_.system.contact_names[at(c)] + "\" ideal"; }, "every clearance ideal", close_gap);
    if (!model_.system.frictions.empty() || std::any_of(model_.system.contacts.begin(), model_.system.contacts.end(),
                                                        [](const ContactPair& c) { return c.friction.has_value(); }))
      add("no friction", [](System& s) {
        for (ContactPair& c : s.contacts) c.friction.reset();
        s.frictions.clear();
      });
    loosen();
    return std::move(made_);
  }

 private:
  static constexpr std::size_t few = 3;

  /// The model's start; if links have become pins, the start of the model without these links, with journals in the middle of their
  /// bearings. Otherwise shapes would have to compensate for the length of a link, and would oscillate.
  State start_for(const System& simpler) const {
    System open = model_.system;
    for (std::size_t c = 0; c < open.contacts.size(); ++c)
      if (is_held(open.contacts[c]) && std::ranges::find(simpler.contact_names, open.contact_names[c]) == simpler.contact_names.end())
        drop_link(open, open.contacts[c]);
    if (open.joints.size() == model_.system.joints.size()) return start_of(model_.system, start_, simpler);
    number(open);
    try {
      return start_of(open, assemble(scene_, open).start, simpler);
    } catch (const AssemblyError&) {  // the model's own start is used, or its trial reports the reason
      return start_of(model_.system, start_, simpler);
    }
  }

  template <class Change>
  void add(const std::string& what, Change change, double tolerance = 0) {
    Simpler s{what, model_.system, model_.scheme, {}};
    change(s.system);
    s.scheme.events.clear();  // they refer to the model's own elements
    Scene scene;              // input for the choice of a method
    scene.file = scene_.file;
    scene.run = scene_.run;
    scene.start_bodies = scene_.start_bodies;
    if (tolerance > 0) scene.run.tolerance = s.scheme.tolerance = tolerance;
    s.scheme.tableau = s.scheme.fallback = nullptr;
    s.scheme.switch_below = 0;
    choose_method(scene, s.system, s.scheme);
    number(s.system, !s.scheme.tableau || s.scheme.switch_below > 0);
    s.start = start_for(s.system);
    made_.push_back(std::move(s));
  }

  /// Each one separately if there are few, and all together if there is more than one.
  template <class Name, class Change>
  void each(const std::vector<int>& of, Name name, const std::string& together, Change change) {
    if (of.size() <= few)
      for (const int i : of) add(name(i), [&](System& s) { change(s, i); });
    if (of.size() > 1)
      add(together, [&](System& s) {
        for (auto i = of.rbegin(); i != of.rend(); ++i) change(s, *i);  // backwards, so that earlier indices stay valid
      });
  }
  template <class Change, class Has>
  void bodies(const std::string& what, Change change, Has has) {
    std::vector<int> those;
    for (const int b : flexible_)
      if (has(model_.system.bodies[at(b)])) those.push_back(b);
    each(
        those, [&](int b) { return "\"" + model_.system.bodies[at(b)].name + "\" " + what; }, "every flexible body " + what, change);
  }
  void loosen() {
    constexpr double factor = 100, loosest = 1e-3;
    const double now = model_.scheme.tolerance, then = std::min(factor * now, loosest);
    if (then <= now) return;
    std::ostringstream what;
    what << "tolerance " << then << " instead of " << now;
    add(
        what.str(), [](System&) {}, then);
  }

  const Scene& scene_;
  const Model& model_;
  const State& start_;
  std::vector<int> flexible_, gaps_;
  std::vector<Simpler> made_;
};

}  // namespace

std::vector<Simpler> simpler_models(const Scene& scene, const Model& model, const State& start) { return Maker(scene, model, start).all(); }

}  // namespace pintle
