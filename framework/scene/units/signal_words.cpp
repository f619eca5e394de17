#include "framework/scene/units/signal_words.h"

#include <algorithm>
#include <initializer_list>

#include "framework/scene/joint_words.h"
#include "framework/scene/units/expression.h"

namespace pintle {

namespace {

using What = SignalWord::What;

class SignalWordsOf {
 public:
  explicit SignalWordsOf(const Scene& scene) : scene_(scene) {}

  std::map<std::string, SignalWord, std::less<>> all() {
    for (const SceneBody& b : scene_.bodies) add(b);
    for (const SceneJoint& j : scene_.joints) add(j);
    for (const SceneContact& c : scene_.contacts) contact(c.name, c.friction.has_value(), c.a, c.b);
    for (const SceneDriver& d : scene_.drivers) add(d);
    for (const SceneLoad& l : scene_.loads) add(l);
    for (std::size_t i = 0; i < scene_.states.size(); ++i)
      put(scene_.states[i].name, What::state, of(scene_.states[i].unit), {}, {}, static_cast<int>(i));
    for (std::size_t i = 0; i < scene_.outputs.size(); ++i)
      put(scene_.outputs[i].name, What::output, of(scene_.outputs[i].unit), {}, {}, static_cast<int>(i));
    return std::move(words_);
  }

 private:
  static Dimension of(const std::string& unit) { return unit.empty() ? dimension::number : read_quantity(unit).dimension; }

  void put(const std::string& name, What what, const Dimension& d, PointRef a = {}, PointRef b = {}, int index = 0) {
    words_.try_emplace(name, SignalWord{what, d, std::move(a), std::move(b), index});
  }
  void column(const std::string& name, const Dimension& d) { put(name, What::column, d); }
  // Also under its column heading: "pin.fx on crank".
  void wrench(const std::string& name, bool force, bool couple, std::initializer_list<const PointRef*> on) {
    const auto part = [&](const char* of, const Dimension& d) {
      column(name + of, d);
      for (const PointRef* p : on) column(name + of + " on " + p->body, d);
    };
    if (force) part(".fx", dimension::force), part(".fy", dimension::force);
    if (couple) part(".torque", dimension::torque);
  }
  void power(const std::string& name, std::string text) {
    put(name + ".power", What::work_rate, product(dimension::force, dimension::speed));
    words_.find(name + ".power")->second.text = std::move(text);
  }
  // Motion of b minus that of a.
  static std::string relative(const PointRef& a, const PointRef& b, const char* motion) {
    const auto of = [&](const PointRef& p) { return p.body + (p.point.empty() ? "" : "." + p.point) + motion; };
    if (a.body == "ground") return of(b);
    return b.body == "ground" ? "(-" + of(a) + ")" : "(" + of(b) + " - " + of(a) + ")";
  }
  // Power of a force on b and its opposite on a.
  void power_of_force(const std::string& name, const PointRef& a, const PointRef& b) {
    power(name, name + ".fx*" + relative(a, b, ".vx") + " + " + name + ".fy*" + relative(a, b, ".vy"));
  }
  void contact(const std::string& name, bool rubs, const PointRef& a, const PointRef& b) {
    for (const char* place : {".ex", ".ey", ".x", ".y"}) column(name + place, dimension::length);
    column(name + ".depth", dimension::length);
    for (const char* speed : {".rate", ".sliding"}) column(name + speed, dimension::speed);
    column(name + ".normal", dimension::force);
    if (rubs) column(name + ".friction", dimension::force), bristles(name);
    column(name + ".pressure", dimension::stress), column(name + ".half angle", dimension::angle);
    wrench(name, true, false, {&a, &b});
  }
  void bristles(const std::string& name) { column(name + ".bristle", dimension::length), column(name + ".dwell", dimension::number); }
  void twist(const std::string& name, const PointRef& a, const PointRef& b) {
    put(name + ".angle", What::relative_angle, dimension::angle, a, b);
    put(name + ".speed", What::relative_speed, dimension::angular_speed, a, b);
  }
  void line(const std::string& name, const PointRef& a, const PointRef& b) {
    put(name + ".length", What::length, dimension::length, a, b);
    put(name + ".rate", What::length_rate, dimension::speed, a, b);
  }
  void place(const std::string& name, const PointRef& at) {
    put(name + ".x", What::x, dimension::length, at);
    put(name + ".y", What::y, dimension::length, at);
    put(name + ".vx", What::vx, dimension::speed, at);
    put(name + ".vy", What::vy, dimension::speed, at);
    for (const char* a : {".ax", ".ay"}) column(name + a, dimension::acceleration);
  }

  void add(const SceneBody& b) {
    const PointRef body{b.name, "", b.place};
    place(b.name, body);
    put(b.name + ".angle", What::angle, dimension::angle, body);
    put(b.name + ".speed", What::speed, dimension::angular_speed, body);
    column(b.name + ".alpha", {0, 0, -2, 1});
    const bool bends = b.elastic && b.elastic->modes;
    if (bends) modes(b);
    for (const ScenePoint& p : b.points) {
      const PointRef at{b.name, p.name, p.place};
      const std::string name = b.name + "." + p.name;
      place(name, at);
      if (!bends) continue;
      put(name + ".ux", What::ux, dimension::length, at);
      put(name + ".uy", What::uy, dimension::length, at);
      column(name + ".turn", dimension::angle);
      for (const char* force : {".N", ".V"}) column(name + force, dimension::force);
      column(name + ".M", dimension::torque);
      for (const char* stress : {".stress", ".sx", ".sy", ".txy", ".von Mises"}) column(name + stress, dimension::stress);
    }
  }
  // Only `build` knows the number of modes; 40 more than the scene's count are accepted.
  void modes(const SceneBody& b) {
    const int most = 40 + b.elastic->modes->keep.count.value_or(0);
    for (int i = 1; i <= most; ++i) column(b.name + ".mode " + std::to_string(i), {1, 0.5, 0, 0});
  }
  void add(const SceneJoint& j) {
    twist(j.name, j.a, j.b);
    const JointWord& word = word_of(j);
    if (word.guides) put(j.name + ".travel", What::travel, dimension::length, j.a, j.b);
    for (const char* effort : word.efforts) column(j.name + effort, dimension::force);
    if (j.coupling && j.play) column(j.name + ".travel", dimension::length);
    if (j.clearance || j.play) {
      contact(j.name, true, j.a, j.b);
      const bool one_place = j.clearance && !is_open(j);
      if (one_place && !(j.clearance->friction && j.clearance->friction->sliding == SlidingSpeed::geometric))
        power(j.name, j.name + ".friction*" + j.name + ".sliding - " + j.name + ".normal*" + j.name + ".rate");
      return;
    }
    wrench(j.name, true, word.has_couple(), {&j.a, &j.b});
    power(j.name, j.friction ? j.name + ".friction*" + j.name + ".sliding" : "");
    if (!j.friction) return;
    bristles(j.name);
    column(j.name + ".sliding", dimension::speed);
    for (const char* force : {".load", ".friction"}) column(j.name + force, dimension::force);
  }
  void add(const SceneDriver& d) {
    const bool on_b = d.b.body != "ground";  // results give the effort on the second body, unless it is the ground
    if (d.kind == DriverKind::angle) {
      twist(d.name, d.a, d.b), wrench(d.name, false, true, {&d.a, &d.b});
      return power(d.name, (on_b ? "" : "-") + d.name + ".torque*" + d.name + ".speed");
    }
    line(d.name, d.a, d.b), wrench(d.name, true, false, {&d.a, &d.b});
    on_b ? power_of_force(d.name, d.a, d.b) : power_of_force(d.name, d.b, d.a);
  }
  void add(const SceneLoad& l) {
    if (const auto* s = std::get_if<SceneSpring>(&l.what)) line(l.name, s->a, s->b);
    if (const auto* m = std::get_if<SceneMaxwell>(&l.what)) line(l.name, m->a, m->b);
    const auto* torsion = std::get_if<SceneTorsionSpring>(&l.what);
    if (torsion) {
      put(l.name + ".angle", What::relative_angle, dimension::angle, torsion->a, torsion->b);
      put(l.name + ".rate", What::relative_speed, dimension::angular_speed, torsion->a, torsion->b);
    }
    if (const auto* belt = std::get_if<SceneBelt>(&l.what)) {
      for (std::size_t i = 1; i <= belt->pulleys.size(); ++i) {
        const std::string span = l.name + " " + std::to_string(i);
        wrench(span, true, true, {&belt->pulleys[i % belt->pulleys.size()]}), column(span + ".tension", dimension::force);
      }
      return;
    }
    if (std::holds_alternative<SceneMaxwell>(l.what)) column(l.name + ".damper length", dimension::length);
    const auto* torque = std::get_if<SceneTorque>(&l.what);
    const auto* force = std::get_if<SceneForce>(&l.what);
    const PointRef none{"ground", "", {}};
    const auto [a, b] = ends_of(l, none);
    wrench(l.name, !torsion && !torque, torsion || torque, {b});
    if (torsion) return power(l.name, l.name + ".torque*" + l.name + ".rate");
    if (force || !torque) return power_of_force(l.name, *a, *b);
    if (!turns_apart(*a) && !turns_apart(*b)) power(l.name, l.name + ".torque*" + relative({a->body, "", {}}, {b->body, "", {}}, ".speed"));
  }
  // For a force: the ground and its point.
  static std::pair<const PointRef*, const PointRef*> ends_of(const SceneLoad& l, const PointRef& ground) {
    if (const auto* force = std::get_if<SceneForce>(&l.what)) return {&ground, &force->at};
    if (const auto* torque = std::get_if<SceneTorque>(&l.what)) return {&torque->a, &torque->b};
    if (const auto* spring = std::get_if<SceneSpring>(&l.what)) return {&spring->a, &spring->b};
    if (const auto* torsion = std::get_if<SceneTorsionSpring>(&l.what)) return {&torsion->a, &torsion->b};
    const auto& maxwell = std::get<SceneMaxwell>(l.what);
    return {&maxwell.a, &maxwell.b};
  }
  // On a flexible body, a point may rotate differently from the axes.
  bool turns_apart(const PointRef& on) const {
    const auto body = std::ranges::find(scene_.bodies, on.body, &SceneBody::name);
    return body != scene_.bodies.end() && body->elastic && body->elastic->modes && !on.point.empty();
  }

  const Scene& scene_;
  std::map<std::string, SignalWord, std::less<>> words_;
};

}  // namespace

std::map<std::string, SignalWord, std::less<>> signal_words(const Scene& scene) { return SignalWordsOf(scene).all(); }

SignalNames signal_names(const std::map<std::string, SignalWord, std::less<>>& words, SignalUse use) {
  constexpr const char* feedback =
      "depends on the accelerations, which depend on the forces (algebraic feedback), so only outputs and conditions of events may "
      "name it: use positions, speeds, lengths or states here";
  constexpr const char* no_work =
      "is 0 at all times: an ideal joint or coupling does no work; use the power of a driver, force or spring, or of a joint with friction";
  SignalNames out;
  for (const auto& [name, word] : words) {
    SignalName& known = out[name] = {word.dimension, ""};
    if (word.what == What::work_rate && word.text.empty()) known.refused = no_work;
    if (use == SignalUse::written) {
      known.stands_for = word.text;
      continue;
    }
    if (word.what == What::work_rate && !word.text.empty()) known.refused = feedback;
    if (word.what == What::column) known.refused = feedback;
    if (word.what == What::output)
      known.refused = "is an output, which only outputs and conditions of events may name: write its expression here";
  }
  return out;
}

}  // namespace pintle
