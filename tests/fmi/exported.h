#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/fmi/importer.h"
#include "tests/unit/program.h"

/// Scenes that the program has exported, their runs in this process, and an importer's way through a unit.
namespace pintle_test {

inline const std::filesystem::path examples_folder = std::filesystem::path(PINTLE_SOURCE_DIR) / "examples";

// An arm of 2 kg that a torque turns, which the importer gives. Where it passes −1 rad upwards a brake bites for good, and it ends above 0.2 rad.
inline const std::string led_arm = R"(
title: Arm & <torque>
gravity: [0, -9.81 m/s^2]
parameters: {mass: 2 kg, half: 0.3 m, reach: 2*half}
bodies: {arm: {rigid: {mass: mass, inertia: 0.06 kg m^2, center: [half, 0]}, points: {O: [0, 0], tip: [reach, 0]}}}
joints: {pivot: {revolute: [ground, arm.O]}}
states:
  torque: {rate: 0 N m/s, start: 0 N m}
  brake: {rate: 0 N m s/s, start: 0 N m s}
forces:
  servo: {torque: torque, on: arm}
  drag: {torque: -brake*arm.speed, on: arm}
outputs: {power: servo.torque*arm.speed}
events:
  passed: {when: arm.angle > -1 rad, do: {set: {brake: 0.5 N m s}}}
  ended: {when: arm.angle > 0.2 rad, do: {stop: it is high enough}}
start: {arm: {angle: -90 deg}}
run: {until: 2 s, tolerance: 1e-10}
)";

/// A unit made by the command line, from a scene of its own folder.
class Exported {
 public:
  Exported(const std::string& name, const std::string& scene, const Words& extra = {}) : name_(name) {
    folder_.write(name, scene);
    Words words{PINTLE_PROGRAM, "fmu", (folder_.path() / name).string(), "-o", file().string()};
    words.insert(words.end(), extra.begin(), extra.end());
    end_ = run(folder_.path() / "log", words);
  }
  static Exported example(const std::string& name) { return {name, contents(examples_folder / name)}; }

  const Ended& end() const { return end_; }
  std::filesystem::path scene() const { return folder_.path() / name_; }
  std::filesystem::path file() const { return folder_.path() / "out.fmu"; }
  const fmu_importer::Unit& unit() {
    if (!unit_) unit_ = std::make_unique<fmu_importer::Unit>(file());
    return *unit_;
  }

 private:
  Folder folder_;
  std::string name_;
  Ended end_;
  std::unique_ptr<fmu_importer::Unit> unit_;
};

/// The same scene in this process: what a run of it finds.
struct Reference {
  explicit Reference(const std::filesystem::path& file, const pintle::Overrides& set = {})
      : scene(pintle::with_pieces(pintle::read_scene(file, set))), model(pintle::build(scene)), assembly(pintle::assemble(scene, model)) {}
  pintle::Run run() const { return pintle::simulate(scene, model, assembly); }
  pintle::Scene scene;
  pintle::Model model;
  pintle::Assembly assembly;
};

inline double last_of(const pintle::Run& run, const std::string& column) { return run.trajectory.column(column).back(); }

/// Steps to `until` and handles events as the standard says.
struct Course {
  std::vector<double> events;
  bool terminated = false, failed = false;
  double end = 0;
};
inline Course follow(fmu_importer::Instance& instance, double until, double h, const std::function<void(double t)>& before = {},
                     double from = 0) {
  Course out;
  double t = from;
  bool at_point = true;  // of communication, not only at an event
  for (long k = std::lround(from / h); t < until; k += at_point) {
    if (before && at_point) before(t);
    const double next = std::min(until, static_cast<double>(k + 1) * h);
    const fmu_importer::Step step = instance.step(t, next - t);
    if (step.status > fmu_importer::warning) return out.failed = true, out;
    if (step.event) {
      out.events.push_back(step.last);
      bool over = false;
      if (instance.call("fmi3EnterEventMode") > 1 || instance.update(over) > 1 || instance.call("fmi3EnterStepMode") > 1)
        return out.failed = true, out;
    }
    t = step.early ? step.last : next;
    out.end = t;
    if (step.terminate) return out.terminated = true, out;
    at_point = !step.early;
  }
  return out;
}

}  // namespace pintle_test
