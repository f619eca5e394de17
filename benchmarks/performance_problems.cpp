#include <algorithm>
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "benchmarks/performance.h"
#include "framework/build/build.h"
#include "tests/oracles/four_bar.h"
#include "tests/oracles/runge_kutta.h"
#include "tests/oracles/slider_crank_clearance.h"
#include "tests/scenes/mechanisms.h"

namespace performance {

using namespace pintle;
using pintle_scenes::SliderCrank;

namespace {

double last(const Run& run, const std::string& column) { return run.trajectory.column(column).back(); }

std::vector<double> decades(int from, int to) {
  std::vector<double> out;
  for (int k = from; k <= to; ++k) out.push_back(std::pow(10.0, -k));
  return out;
}

/// Error of an angle and its rate: the larger of Δangle [rad] and Δrate over `fastest`.
double turn_error(const Run& run, const std::string& body, double angle, double speed, double fastest) {
  return std::max(std::abs(last(run, body + ".angle [rad]") - angle), std::abs(last(run, body + ".speed [rad/s]") - speed) / fastest);
}

Problem ideal_slider_crank(bool quick) {
  SliderCrank o;
  o.clearance = 0, o.until = quick ? 0.1 : 1, o.outputs = 1;
  const pintle_oracle::Params params = pintle_scenes::oracle(o);
  const pintle_oracle::Ideal end = pintle_oracle::ideal_at(params, o.until, 1e-14), check = pintle_oracle::ideal_at(params, o.until, 1e-13);
  Problem p;
  p.name = "ideal", p.title = "Slider-crank, ideal joints";
  p.text = printed(
      "The paper's rigid slider-crank (Ebrahimi, Salahshoor and Moradi 2017, Table 1), crank free at 150 rad/s from its "
      "dead centre, %g s, gravity. Error: of the crank's angle [rad], or of its speed over 150 rad/s if that is larger, at "
      "the end. Reference: the one-degree-of-freedom oracle (tests/oracles/slider_crank_ideal.cpp) at a tolerance of 1e-14; at 1e-13 it "
      "differs by %.0e rad.",
      o.until, std::abs(end.angle - check.angle));
  Start& start = p.starts.emplace_back();
  start.scene = [o](double tolerance) {
    SliderCrank s = o;
    s.tolerance = tolerance;
    return scene(s);
  };
  start.error = [end](const Run& run) { return turn_error(run, "crank", end.angle, end.speed, 150); };
  start.by_hand = [params, end, until = o.until](double tolerance) {
    const pintle_oracle::Ideal at = pintle_oracle::ideal_at(params, until, tolerance);
    return Judged{std::max(std::abs(at.angle - end.angle), std::abs(at.speed - end.speed) / 150)};
  };
  p.tolerances = decades(4, 10);
  return p;
}

/// The clearance oracle's run; adds its impacts to `impacts` and raises `warning` to the uncertainty of its final angle [rad].
Start clearance_start(double speed, int& impacts, double& warning) {
  SliderCrank o;
  o.clearance = 5e-4, o.restitution = 0.9, o.until = 0.02, o.outputs = 1, o.speed = speed;
  pintle_oracle::Params params = pintle_scenes::oracle(o);
  params.stiffness = 6.61e10;
  const auto by_hand = [params, until = o.until](double tolerance, pintle_oracle::State& state) {
    pintle_oracle::Options options;
    options.tolerance = tolerance;
    state = pintle_oracle::start(params);
    return pintle_oracle::simulate(params, options, until, state);
  };
  pintle_oracle::State end, check;
  impacts += by_hand(1e-13, end).impacts;
  by_hand(1e-12, check);
  warning = std::max(warning, std::abs(end.y[0] - check.y[0]));
  Start start;
  start.scene = [o](double tolerance) {
    SliderCrank q = o;
    q.tolerance = tolerance;
    Scene s = scene(q);
    s.joints[2].clearance->normal.stiffness = 6.61e10;
    return s;
  };
  start.error = [end](const Run& run) { return turn_error(run, "crank", end.y[0], end.y[3], 150); };
  start.by_hand = [by_hand, end](double tolerance) {
    pintle_oracle::State at;
    const long evaluations = by_hand(tolerance, at).evaluations;
    return Judged{std::max(std::abs(at.y[0] - end.y[0]), std::abs(at.y[3] - end.y[3]) / 150), evaluations};
  };
  return start;
}

Problem clearance_slider_crank() {
  constexpr int starts = 8;
  int impacts = 0;
  double warning = 0;
  Problem p;
  for (int i = 0; i < starts; ++i) p.starts.push_back(clearance_start(150 + 0.5 * (i - 0.5 * (starts - 1)), impacts, warning));
  p.name = "clearance", p.title = "Slider-crank, clearance";
  p.text = printed(
      "The same with a clearance of 0.5 mm at the gudgeon pin, K = 6.61e10 N/m^1.5, e = 0.9, no friction, journal in the "
      "middle at the start, 0.02 s with some %d impacts: short of chaos. From %d speeds, 0.5 rad/s apart about 150: after impacts the "
      "error of one run at one tolerance may fall by a factor of ten by luck, so times are means and errors root mean squares over them. "
      "Error as before. References: the oracle with the contact (tests/oracles/slider_crank_clearance.cpp) at 1e-13; at 1e-12 it "
      "differs by %.0e rad at most.",
      impacts / starts, starts, warning);
  p.tolerances = decades(4, 11);
  return p;
}

Problem andrews() {
  std::ifstream file(PINTLE_SOURCE_DIR "/tests/data/andrews.json");
  const auto data = nlohmann::json::parse(file);
  std::vector<double> q;
  for (const auto& x : data["high_precision_t0.03"]["q"]) q.push_back(std::stod(x.get<std::string>()));
  Problem p;
  p.name = "andrews", p.title = "Andrews' squeezing mechanism";
  p.text =
      "Seven bodies, ten pins, 0.03 s (Schiehlen's handbook; Hairer and Wanner II). Error: the largest of the seven published "
      "angles', relative. Reference: 34-digit quadrature of the energy (tests/data/andrews.json), which agrees with the solution "
      "published by the test set for initial value problems.";
  Start& start = p.starts.emplace_back();
  start.scene = [](double tolerance) {
    Scene s = pintle_scenes::andrews();
    s.run.tolerance = tolerance, s.output.every = s.run.until;
    return s;
  };
  start.error = [q](const Run& run) {
    const auto k = [&](int i) { return last(run, "K" + std::to_string(i) + ".angle [rad]"); };
    const std::vector<double> ours{k(1), k(2) - k(1), k(3), k(4) - k(5), k(5), k(6) - k(7), k(7)};
    double worst = 0;
    for (std::size_t i = 0; i < q.size(); ++i) worst = std::max(worst, std::abs(ours[i] / q[i] - 1));
    return worst;
  };
  p.tolerances = decades(4, 10);
  return p;
}

/// Crank angle and rate of a four-bar under a torque: the oracle's torque is linear in the acceleration.
pintle_oracle::Vec<2> four_bar_end(const pintle_oracle::FourBar& bar, const pintle_oracle::LinkMass (&links)[3], double until,
                                   double torque, double tolerance, long& evaluations) {
  const auto rate = [&](const pintle_oracle::Vec<2>& y, pintle_oracle::Vec<2>& dy) {
    const double at_rest = pintle_oracle::crank_torque(bar, {y[0], y[1], 0}, links, 9.81);
    const double at_one = pintle_oracle::crank_torque(bar, {y[0], y[1], 1}, links, 9.81);
    dy = {y[1], (torque - at_rest) / (at_one - at_rest)};
    ++evaluations;
  };
  return pintle_oracle::integrate_tightly<2>(rate, {0.6, 0.0}, until, tolerance, {1.0, 10.0});
}

Problem four_bar(bool quick) {
  static constexpr pintle_oracle::LinkMass links[3]{{1.0, 0.004}, {2.5, 0.06, 0.4}, {1.8, 0.03}};
  constexpr pintle_oracle::FourBar bar{0.6, 0.2, 0.55, 0.4};
  const double until = quick ? 0.5 : 3, torque = 6;
  long unused = 0;
  const auto end = four_bar_end(bar, links, until, torque, 1e-14, unused), check = four_bar_end(bar, links, until, torque, 1e-13, unused);
  Problem p;
  p.name = "four_bar", p.title = "Four-bar under a torque";
  p.text = printed(
      "Crank 0.2 m, coupler 0.55 m, rocker 0.4 m on 0.6 m, from rest under a torque of %g N m and gravity, %g s, in which the "
      "crank turns %.1f times. Error: of the crank's angle [rad], or of its speed over %.0f rad/s if that is larger, at the end. "
      "Reference: the one-degree-of-freedom equation from the oracle's kinematics and virtual power (tests/oracles/four_bar.cpp) at 1e-14; "
      "at 1e-13 it differs by %.0e rad. That model is written for clarity: an acceleration takes it two evaluations of the torque.",
      torque, until, (end[0] - 0.6) / (2 * paper::pi), std::abs(end[1]), std::abs(end[0] - check[0]));
  Start& start = p.starts.emplace_back();
  start.scene = [=](double tolerance) {
    Scene s = pintle_scenes::four_bar(bar, links, 9.81, 0.6, 0, 0);
    s.drivers.clear();
    s.start_bodies = {pintle_scenes::start_angle("crank", 0.6, 0)};
    s.loads = {pintle_scenes::torque("drive", "crank", pintle_scenes::law(torque))};
    s.run.until = until, s.run.tolerance = tolerance, s.output.every = until;
    return s;
  };
  start.error = [end](const Run& run) { return turn_error(run, "crank", end[0], end[1], std::abs(end[1])); };
  start.by_hand = [=](double tolerance) {
    long evaluations = 0;
    const auto at = four_bar_end(bar, links, until, torque, tolerance, evaluations);
    return Judged{std::max(std::abs(at[0] - end[0]), std::abs(at[1] - end[1]) / std::abs(end[1])), evaluations};
  };
  p.tolerances = decades(4, 10);
  return p;
}

Problem flexible_slider_crank(bool quick) {
  const double until = quick ? 0.002 : 0.02;
  struct End {
    double angle, speed, x, y;
  };
  const auto end_of = [](const Run& run) {
    return End{last(run, "crank.angle [rad]"), last(run, "crank.speed [rad/s]"), last(run, "coupler.B.x [m]"),
               last(run, "coupler.B.y [m]")};
  };
  const auto difference = [](const End& a, const End& b) {
    return std::max({std::abs(a.angle - b.angle), std::abs(a.speed - b.speed) / 150, std::hypot(a.x - b.x, a.y - b.y) / 0.12});
  };
  const auto reference = [&](const char* method, double tolerance) {
    Scene s = flexible(until, 8, 0);
    s.run.method = method, s.run.tolerance = tolerance;
    const Model model = build(s);
    const Run run = simulate(s, model, assemble(s, model));
    if (run.status != Status::finished) throw std::runtime_error("the flexible reference failed: " + run.reason);
    return end_of(run);
  };
  const End end = reference("dopri5", quick ? 1e-11 : 1e-13), check = reference("rkf45", quick ? 1e-11 : 1e-13);
  Problem p;
  p.name = "flexible", p.title = "Slider-crank, flexible coupler of 8 modes";
  p.text = printed(
      "The ideal slider-crank with its coupler a steel beam of 10 mm, 20 Euler elements, 8 shapes in the frame of its chord, "
      "undamped, starting straight, %g s. Error: the largest of the crank's angle [rad], its speed over 150 rad/s, and the place "
      "of the coupler's end over its length. Reference: Dormand-Prince at 1e-13; Fehlberg at 1e-13 differs from it by %.0e. That both "
      "stand "
      "on the same equations is why these are judged elsewhere (tests/scenes/mechanisms/oracle_test.cpp, paper_flexible_test.cpp).",
      until, difference(end, check));
  Start& start = p.starts.emplace_back();
  start.scene = [until](double tolerance) {
    Scene s = flexible(until, 8, 0);
    s.run.tolerance = tolerance;
    return s;
  };
  start.error = [=](const Run& run) { return difference(end_of(run), end); };
  p.tolerances = decades(4, 10);
  return p;
}

}  // namespace

Scene flexible(double until, int shapes, double clearance) {
  SliderCrank o;
  o.clearance = clearance, o.restitution = 0.9, o.until = until, o.outputs = 1;
  Scene s = scene(o);
  s.run.method = RunOptions{}.method, s.run.tolerance = RunOptions{}.tolerance, s.run.constraints = RunOptions{}.constraints;
  SceneBeam beam;
  beam.through = {"A", "B"};
  beam.section = CircleSection{0.01};
  beam.theory = BeamTheory::euler, beam.rotary = false;
  beam.material.material = {Isotropic{207e9, 0.3}, 0.21 / (paper::pi / 4 * 0.01 * 0.01 * 0.12)};
  beam.elements = 20;
  SceneElastic& elastic = s.bodies[1].elastic.emplace();
  elastic.shape = beam;
  elastic.modes.emplace();
  elastic.modes->frame = SceneModes::Frame::chord;
  elastic.modes->keep.count = shapes;
  s.output.points = {pintle_scenes::ref("coupler.B")};
  return s;
}

std::vector<Problem> problems(bool quick) {
  std::vector<Problem> all{ideal_slider_crank(quick), clearance_slider_crank(), andrews(), four_bar(quick), flexible_slider_crank(quick)};
  if (quick)
    for (Problem& p : all) p.tolerances = {1e-5, 1e-7};
  return all;
}

}  // namespace performance
