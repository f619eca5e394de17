#pragma once

// Trades whose answer is known, and what tests of trades share.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "framework/study/tradeoff/refinement.h"

namespace pintle {

namespace fs = std::filesystem;

inline TradePoint point(double time, double error, double warning = 0) {
  TradePoint p;
  p.status = "finished", p.usable = true;
  p.time = time, p.error = error, p.warning = warning;
  return p;
}

inline double number_of(const Overrides& set, const std::string& path, double otherwise) {
  double x = otherwise;
  for (const auto& [name, text] : set)
    if (name == path) x = std::stod(text);
  return x;
}

inline FidelityAxis axis(const std::string& name, const std::string& path, const std::vector<std::string>& values) {
  FidelityAxis a{.name = name, .values = {}};
  for (const std::string& v : values) a.values.push_back({v, {{path, v}}});
  validate_axis(a);
  return a;
}

inline Outcome finished(std::vector<double> values, double seconds) {
  Outcome o;
  o.status = "finished";
  o.units.assign(values.size(), "N");
  o.values = std::move(values);
  o.run_seconds = seconds;
  o.counts.steps = 1;
  return o;
}

inline const std::vector<Measure> one{{"value", "value"}};

/// The value is 2 (1 + tolerance + h²/8), h = 1/elements; time is elements · tolerance^-0.2.
inline Outcome known(const Overrides& set, const std::vector<Measure>& m, const CaseLimits&) {
  const double t = number_of(set, "run.tolerance", 1e-8), n = number_of(set, "bodies.rod.beam.elements", 4);
  return finished(std::vector<double>(m.size(), 2 * (1 + t + 0.125 / (n * n))), n * std::pow(t, -0.2));
}

inline TradePlan known_plan() {
  TradePlan plan;
  plan.axes = {axis("tolerance", "run.tolerance", {"1e-6", "1e-2", "1e-4"}),
               axis("elements", "bodies.rod.beam.elements", {"1", "2", "4", "8"})};
  plan.repeats = 3;
  return plan;
}

/// A folder of its own, gone at the end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("pintle-tradeoff-" + std::to_string(std::random_device{}()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

inline void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

inline const std::string pendulum = R"(
gravity: [0, -9.81]
parameters: {half: 0.2 m}
bodies:
  rod: {rigid: {mass: 0.5 kg, inertia: 0.01 kg m^2}, points: {O: [-half, 0]}}
joints:
  hinge: {revolute: [ground, rod.O]}
start: {rod: {angle: 0 deg}}
run: {until: 1 s, tolerance: 1e-6, ledger bound: 0.1}
)";

inline CaseRunner runner(const CaseSource& source) {
  return [source](const Overrides& set, const std::vector<Measure>& m, const CaseLimits& l) { return run_case(source, set, m, l); };
}

}  // namespace pintle
