#include "framework/scene/units/signal_words.h"

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
    for (const SceneContact& c : scene_.contacts) contact(c.name, c.friction.has_value());
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
  void wrench(const std::string& name, bool force, bool couple) {
    if (force) column(name + ".fx", dimension::force), column(name + ".fy", dimension::force);
    if (couple) column(name + ".torque", dimension::torque);
  }
  void contact(const std::string& name, bool rubs) {
    for (const char* place : {".ex", ".ey", ".x", ".y"}) column(name + place, dimension::length);
    column(name + ".depth", dimension::length);
    for (const char* speed : {".rate", ".sliding"}) column(name + speed, dimension::speed);
    column(name + ".normal", dimension::force);
    if (rubs) column(name + ".friction", dimension::force), bristles(name);
    column(name + ".pressure", dimension::stress), column(name + ".half angle", dimension::angle);
    wrench(name, true, false);
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
  void add(const SceneJoint& j) {
    twist(j.name, j.a, j.b);
    if (j.kind == JointKind::prismatic || j.kind == JointKind::slot) put(j.name + ".travel", What::travel, dimension::length, j.a, j.b);
    if (j.coupling || j.kind == JointKind::differential) column(j.name + ".force", dimension::force);
    if (j.coupling && j.play) column(j.name + ".travel", dimension::length);
    if (j.clearance || j.play) return contact(j.name, true);
    wrench(j.name, true, true);
    if (j.kind == JointKind::rolling) column(j.name + ".normal", dimension::force);
    if (!j.friction) return;
    bristles(j.name);
    column(j.name + ".sliding", dimension::speed);
    for (const char* force : {".load", ".friction"}) column(j.name + force, dimension::force);
  }
  void add(const SceneDriver& d) {
    if (d.kind == DriverKind::angle) return twist(d.name, d.a, d.b), wrench(d.name, false, true);
    line(d.name, d.a, d.b), wrench(d.name, true, false);
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
        wrench(span, true, true), column(span + ".tension", dimension::force);
      }
      return;
    }
    if (std::holds_alternative<SceneMaxwell>(l.what)) column(l.name + ".damper length", dimension::length);
    const bool turns = torsion || std::holds_alternative<SceneTorque>(l.what);
    wrench(l.name, !turns, turns);
  }

  const Scene& scene_;
  std::map<std::string, SignalWord, std::less<>> words_;
};

}  // namespace

std::map<std::string, SignalWord, std::less<>> signal_words(const Scene& scene) { return SignalWordsOf(scene).all(); }

SignalNames signal_names(const std::map<std::string, SignalWord, std::less<>>& words, SignalUse use) {
  SignalNames out;
  for (const auto& [name, word] : words) {
    SignalName& known = out[name] = {word.dimension, ""};
    if (use == SignalUse::written) continue;
    if (word.what == What::column)
      known.refused =
          "follows from the accelerations, which follow from what acts (algebraic feedback), so only outputs and conditions of events may "
          "name it: take places, "
          "speeds, lengths or states here";
    if (word.what == What::output)
      known.refused = "is an output, which nothing that acts on the motion may name: write its expression here";
  }
  return out;
}

}  // namespace pintle
