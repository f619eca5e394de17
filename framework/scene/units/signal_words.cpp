#include "framework/scene/units/signal_words.h"

#include <algorithm>
#include <initializer_list>
#include <span>
#include <string_view>

#include "framework/common/result_columns.h"
#include "framework/scene/joint_words.h"
#include "framework/scene/units/expression.h"

namespace pintle {

namespace {

using What = SignalWord::What;

// Read once: scenes have many columns of few units.
const Dimension& dimension_of_unit(const char* unit) {
  thread_local std::map<std::string_view, Dimension> known{{"-", dimension::number}};
  const auto [found, fresh] = known.try_emplace(unit);
  if (fresh) found->second = read_quantity(unit).dimension;
  return found->second;
}

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
  void put(const std::string& name, std::span<const Column> all, std::initializer_list<What> what, const PointRef& at) {
    for (std::size_t i = 0; i < all.size(); ++i) put(name + all[i].name, std::data(what)[i], dimension_of_unit(all[i].unit), at);
  }
  void columns(const std::string& name, std::span<const Column> all) {
    for (const Column& c : all) put(name + c.name, What::column, dimension_of_unit(c.unit));
  }
  // Also under its column heading: "pin.fx on crank".
  void wrench(const std::string& name, bool force, bool couple, std::initializer_list<const PointRef*> on) {
    const auto part = [&](const Column& c) {
      put(name + c.name, What::column, dimension_of_unit(c.unit));
      for (const PointRef* p : on) put(name + c.name + " on " + p->body, What::column, dimension_of_unit(c.unit));
    };
    if (force) std::ranges::for_each(column::force, part);
    if (couple) std::ranges::for_each(column::couple, part);
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
    for (const std::span<const Column> all : {std::span<const Column>(column::journal), std::span<const Column>(column::profiles)})
      columns(name, rubs ? all : all.first(all.size() - 1));  // the last is .friction
    columns(name, column::pressure);
    if (rubs) columns(name, column::bristle);
    wrench(name, true, false, {&a, &b});
  }
  void twist(const std::string& name, const PointRef& a, const PointRef& b) {
    put(name + ".angle", What::relative_angle, dimension::angle, a, b);
    put(name + ".speed", What::relative_speed, dimension::angular_speed, a, b);
  }
  void line(const std::string& name, const PointRef& a, const PointRef& b) {
    put(name + ".length", What::length, dimension::length, a, b);
    put(name + ".rate", What::length_rate, dimension::speed, a, b);
  }

  void axes_of(const std::string& name, const SceneBody& b) {
    const PointRef body{name, "", b.place};
    put(name, column::body_pose, {What::x, What::y, What::angle}, body);
    put(name, column::body_speed, {What::vx, What::vy, What::speed}, body);
    columns(name, column::body_acceleration);
    if (b.elastic && b.elastic->modes) modes(name, *b.elastic->modes);
  }
  void add(const SceneBody& b) {
    const auto* beam = b.elastic ? std::get_if<SceneBeam>(&b.elastic->shape) : nullptr;
    if (!beam || beam->pieces < 2) axes_of(b.name, b);
    for (int k = 1; beam && beam->pieces > 1 && k <= beam->pieces; ++k) axes_of(b.name + " " + std::to_string(k), b);
    const bool bends = b.elastic && b.elastic->modes;
    for (const ScenePoint& p : b.points) {
      const PointRef at{b.name, p.name, p.place};
      const std::string name = b.name + "." + p.name;
      put(name, column::point, {What::x, What::y, What::vx, What::vy, What::column, What::column}, at);
      if (!bends) continue;
      put(name, column::deformation, {What::ux, What::uy, What::column}, at);
      columns(name, column::beam_stress), columns(name, column::plane_stress);
    }
  }
  // Only `build` knows the number of modes; 40 more than the scene's count are accepted.
  void modes(const std::string& name, const SceneModes& of) {
    const int most = 40 + of.keep.count.value_or(0);
    for (int i = 1; i <= most; ++i)
      put(name + column::mode[0].name + std::to_string(i), What::column, dimension_of_unit(column::mode[0].unit));
  }
  void add(const SceneJoint& j) {
    twist(j.name, j.a, j.b);
    const JointWord& word = word_of(j);
    if (word.guides) put(j.name + ".travel", What::travel, dimension::length, j.a, j.b);
    for (const char* effort : efforts_of(j)) put(j.name + effort, What::column, dimension::force);
    if (j.coupling && j.play) columns(j.name, column::flank);
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
    columns(j.name, column::bristle), columns(j.name, column::joint_friction);
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
        wrench(span, true, true, {&belt->pulleys[i % belt->pulleys.size()]}), columns(span, column::tension);
      }
      return;
    }
    if (std::holds_alternative<SceneMaxwell>(l.what)) columns(l.name, column::damper_length);
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
    if (word.what == What::work_rate && word.text.empty()) known.not_allowed = no_work;
    if (use == SignalUse::written) {
      known.stands_for = word.text;
      continue;
    }
    if (word.what == What::work_rate && !word.text.empty()) known.not_allowed = feedback;
    if (word.what == What::column) known.not_allowed = feedback;
    if (word.what == What::output)
      known.not_allowed = "is an output, which only outputs and conditions of events may name: write its expression here";
  }
  return out;
}

}  // namespace pintle
