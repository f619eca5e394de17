#include "framework/configuration/unsound_laws.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/model/joints.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/mechanism/result_tables.h"
#include "framework/scene/units/signal_law.h"

namespace pintle {

namespace {

std::string place_of_law(const Scene& scene, const Place& place) {
  const std::string file = place.file.empty() ? scene.file : place.file;
  return " (" + file + (place.line > 0 ? ":" + std::to_string(place.line) : "") + ")";
}

// Names a table by its file: its complete text, which starts with {"table": "map.csv", is too long.
std::string shown(const Law& law) {
  constexpr std::string_view table = "{\"table\": \"";
  if (!law.text.starts_with(table)) return "law " + law.text;
  return "law by the table " + law.text.substr(table.size(), law.text.find('"', table.size()) - table.size());
}

std::string seen(const Law& law, const std::vector<double>& in) {
  std::string out;
  for (std::size_t k = 0; k < in.size(); ++k) out += (k == 0 ? ", where " : ", ") + law.signals[k] + " = " + number_text(in[k]);
  return out;
}

// Calls f(its owner's name and place, the law, its index in the system) for each law of signals.
template <class F>
void each_law(const Scene& scene, const Model& model, F f) {
  const auto take = [&](const auto& owner, const Law& law, int index) {
    if (index >= 0) f(owner.name, owner.place, law, index);
  };
  for (std::size_t i = 0; i < scene.loads.size() && i < model.order.loads.size(); ++i) {
    const SceneLoad& load = scene.loads[i];
    const auto* sized = std::get_if<SizedForce>(&model.system.forces[at(model.order.loads[i])]);
    if (!sized) continue;
    const auto* force = std::get_if<SceneForce>(&load.what);
    const auto* torque = std::get_if<SceneTorque>(&load.what);
    const auto* spring = std::get_if<SceneSpring>(&load.what);
    const auto* torsion = std::get_if<SceneTorsionSpring>(&load.what);
    const Law& law = force ? force->x : torque ? torque->law : spring ? *spring->law : *torsion->law;
    take(load, law, sized->size);
    if (force) take(load, force->y, sized->other);
  }
  for (std::size_t i = 0; i < scene.states.size() && i < model.system.states.size(); ++i)
    take(scene.states[i], scene.states[i].rate, model.system.states[i].rate);
}

class LawsAt {
 public:
  LawsAt(const Scene& scene, const Model& model, const State& start, const State& now)
      : scene_(scene), system_(model.system), start_(start), now_(now) {
    each_law(scene, model,
             [this](const std::string& name, const Place& place, const Law& from, int law) { check(name, place, from, law); });
  }
  std::string found;

 private:
  void check(const std::string& name, const Place& place, const Law& from, int law) {
    constexpr double steep = 1e6;
    if (!found.empty()) return;
    const SignalLaw& of = system_.laws[at(law)];
    const double value = law_at(system_, of, now_.t, now_.y), before = law_at(system_, of, start_.t, start_.y);
    const bool grown = std::isfinite(value) && std::abs(value) > steep * std::abs(before) && before != 0;
    std::vector<double> in;
    for (const int k : of.in) in.push_back(signal_at(system_, system_.signals[at(k)], now_.y));
    const std::string steep_over = std::isfinite(value) && !grown ? infinite_slope(from, of, in) : "";
    if (std::isfinite(value) && !grown && steep_over.empty()) return;
    const bool left = !beyond_its_table(of.of, now_.t, in.data(), Outside::rejected).empty();
    found = "the " + shown(from) + " of " + quoted(name) + place_of_law(scene_, place) + " " +
            (left                 ? "leaves its table"
             : grown              ? "has reached " + number_text(value)
             : steep_over.empty() ? "is not a finite number"
                                  : "has no finite slope over " + steep_over) +
            " at t = " + number_text(now_.t, 9) + " s" +
            (grown ? seen(from, in) + ": it seems to grow without bound; keep it finite, for example with max(…)"
                   : seen_by_law(from, of.of, now_.t, in));
  }
  std::string infinite_slope(const Law& from, const SignalLaw& of, const std::vector<double>& in) const {
    std::array<double, most_law_inputs> slope{};
    of.of(now_.t, in.data(), slope.data());
    for (std::size_t k = 0; k < in.size(); ++k)
      if (!std::isfinite(slope[k])) return from.signals[k];
    return "";
  }

  const Scene& scene_;
  const System& system_;
  const State &start_, &now_;
};

}  // namespace

std::string seen_by_law(const Law& law, const SignalFunction& of, double t, const std::vector<double>& in) {
  const std::string beyond = beyond_its_table(of, t, in.data(), Outside::rejected);
  return seen(law, in) + (beyond.empty() ? ": keep it finite, for example with max(…) under a division or a root"
                                         : ": " + beyond + "; lengthen the table, or write outside: hold");
}

namespace {

bool has_begun(const std::vector<std::string>& warnings, const std::string& with) {
  return std::ranges::any_of(warnings, [&](const std::string& w) { return w.starts_with(with); });
}

/// What a driver that no event releases imposes: one coordinate and its rate, between two bodies or two markers.
struct DrivenCoordinate {
  bool angle;
  int a, b;  ///< bodies for an angle, markers for a distance
  const TimeLaw* law;
};

std::vector<DrivenCoordinate> driven_by_laws(const System& system) {
  std::vector<DrivenCoordinate> out;
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const TimeLaw* law = driver_law(system.joints[k]);
    const auto of_it = [&](const Switch& s) { return s.of == Switch::joint && s.index == static_cast<int>(k); };
    if (!law || std::ranges::any_of(system.switches, of_it)) continue;
    const JointEnds ends = ends_of(system.joints[k]);
    const bool angle = is_angle_row(system.joints[k], 0);
    const auto end = [&](std::size_t i) { return angle ? system.markers[at(ends.marker[i])].body : ends.marker[i]; };
    out.push_back({angle, end(0), end(1), law});
  }
  return out;
}

/// A signal at time t if a driver alone determines it, otherwise NaN. Angles continue from the start.
double driven_value(const System& system, const std::vector<DrivenCoordinate>& drivers, const MotionSignal& signal, const State& start,
                    double t) {
  using Kind = MotionSignal::Kind;
  const bool angle = signal.kind == Kind::angle || signal.kind == Kind::relative_angle,
             turn = signal.kind == Kind::speed || signal.kind == Kind::relative_speed;
  const bool length = signal.kind == Kind::length || signal.kind == Kind::length_rate;
  if (angle || turn || length)
    for (const DrivenCoordinate& driver : drivers) {
      if (driver.angle == length) continue;
      const auto end = [&](int marker) { return length ? marker : system.markers[at(marker)].body; };
      const int b = end(of_two(signal.kind) ? signal.b : signal.a), a = of_two(signal.kind) ? end(signal.a) : ground;
      const bool along = a == driver.a && b == driver.b, against = a == driver.b && b == driver.a;
      if (!along && !against) continue;
      const double sign = against && !length ? -1 : 1;
      const Jet now = (*driver.law)(t);
      if (turn || signal.kind == Kind::length_rate) return sign * now.rate;
      return signal_at(system, signal, start.y) + sign * (now.value - (*driver.law)(start.t).value);
    }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<std::string> tables_left(const Scene& scene, const Model& model, const State& start) {
  constexpr int looks = 2000;
  const System& system = model.system;
  const std::vector<DrivenCoordinate> drivers = driven_by_laws(system);
  std::vector<std::string> out;
  each_law(scene, model, [&](const std::string& name, const Place& place, const Law& from, int index) {
    const SignalLaw& law = system.laws[at(index)];
    std::vector<double> in;
    const auto say = [&](double t, const std::string& when) {
      const std::string held = beyond_its_table(law.of, t, in.data(), Outside::holds_unasked);
      const std::string rejected = beyond_its_table(law.of, t, in.data(), Outside::rejected);
      if (held.empty() && rejected.empty()) return false;
      out.push_back(
          "the " + shown(from) + " of " + quoted(name) + place_of_law(scene, place) + " leaves its table " + when + seen(from, in) + ": " +
          (held.empty()
               ? rejected + ", which ends the run there: lengthen the table, or write outside: hold"
               : held + ", and the value at the end of the table is used: lengthen the table, or write outside: hold or outside: refuse"));
      return true;
    };
    for (const int k : law.in) in.push_back(signal_at(system, system.signals[at(k)], start.y));
    if (in.empty() || say(start.t, "at the start") || !scene.has_run) return;
    for (int i = 1; i <= looks; ++i) {
      const double t = scene.run.until * i / looks;
      for (std::size_t k = 0; k < in.size(); ++k) in[k] = driven_value(system, drivers, system.signals[at(law.in[k])], start, t);
      if (!std::ranges::all_of(in, [](double x) { return std::isfinite(x); })) return;  // it depends on the motion
      if (say(t, "by t = " + number_text(t, 4) + " s, as its driver moves")) return;
    }
  });
  return out;
}

namespace {

void warn_of_tables(const Scene& scene, const Model& model, const State& state, std::vector<std::string>& warnings) {
  const System& system = model.system;
  if (system.laws.empty()) return;
  each_law(scene, model, [&](const std::string& name, const Place& place, const Law& from, int index) {
    const SignalLaw& law = system.laws[at(index)];
    std::vector<double> in;
    for (const int k : law.in) in.push_back(signal_at(system, system.signals[at(k)], state.y));
    const std::string beyond = beyond_its_table(law.of, state.t, in.data(), Outside::holds_unasked);
    if (beyond.empty()) return;
    const std::string subject = "the " + shown(from) + " of " + quoted(name) + place_of_law(scene, place) + " leaves its table";
    if (has_begun(warnings, subject)) return;
    warnings.push_back(subject + " at t = " + number_text(state.t, 6) + " s" + seen(from, in) + ": " + beyond +
                       ", and the value at the end of the table is used: lengthen the table, or write outside: hold or outside: refuse");
  });
}

}  // namespace

void warn_of_signals(const Scene& scene, const Model& model, const State& state, const Table& trajectory,
                     std::vector<std::string>& warnings) {
  warn_of_tables(scene, model, state, warnings);
  const std::size_t n = model.outputs.size();
  if (n == 0 || trajectory.rows() == 0) return;
  const double* row = trajectory.data.data() + trajectory.data.size() - trajectory.columns();
  const double* outputs = row + trajectory.columns() - n;
  for (std::size_t k = 0; k < n; ++k) {
    if (std::isfinite(outputs[k])) continue;
    const WrittenOutput& o = model.outputs[k];
    const auto from = std::ranges::find(scene.outputs, o.name, &SceneOutput::name);
    if (from == scene.outputs.end()) continue;
    const std::string subject = "the output " + quoted(o.name) + place_of_law(scene, from->place);
    if (has_begun(warnings, subject)) continue;
    std::vector<double> in;
    for (const WrittenOutput::Input& input : o.in) in.push_back(input_value(model, input, state, row, outputs));
    warnings.push_back(subject + " is not a finite number at t = " + number_text(state.t, 9) + " s" +
                       seen_by_law(from->law, o.of, state.t, in) + "; its column is empty there");
  }
}

std::string explain_signals(const Scene& scene, const Model& model, const State& start, const State& now) {
  if (model.system.laws.empty() || now.y.size() != model.system.n_y()) return "";
  constexpr double ahead = 1e-9;  // time step of an extrapolation, relative to the run
  std::string here = LawsAt(scene, model, start, now).found;
  if (!here.empty()) return here;
  const System& system = model.system;
  State next = now;
  const double dt = ahead * scene.run.until;
  next.t += dt;
  Equations eq(system);
  Eigen::VectorXd dy(system.n_y());
  if (evaluate(system, now, eq, dy) && dy.head(system.z_begin()).allFinite())
    next.y.head(system.z_begin()) += dt * dy.head(system.z_begin());
  else
    next.y.head(system.n()) += dt * now.y.segment(system.n(), system.n());
  return LawsAt(scene, model, start, next).found;
}

}  // namespace pintle
