// Scenes exported by the program as units for co-simulation, and stepped by an importer of the tests' own (importer.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "framework/analysis/simulate/simulation.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/fmi/importer.h"
#include "tests/refusal.h"
#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;
using fmu_importer::Instance;
using fmu_importer::Step;
using fmu_importer::Unit;

const fs::path examples = fs::path(PINTLE_SOURCE_DIR) / "examples";

// An arm of 2 kg that a torque turns, which the importer gives. Where it passes −1 rad upwards a brake bites for good, and it ends above 0.2 rad.
const std::string arm = R"(
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
  static Exported example(const std::string& name) { return {name, contents(examples / name)}; }

  const Ended& end() const { return end_; }
  fs::path scene() const { return folder_.path() / name_; }
  fs::path file() const { return folder_.path() / "out.fmu"; }
  const Unit& unit() {
    if (!unit_) unit_ = std::make_unique<Unit>(file());
    return *unit_;
  }

 private:
  Folder folder_;
  std::string name_;
  Ended end_;
  std::unique_ptr<Unit> unit_;
};

/// The same scene in this process: what a run of it finds.
struct Reference {
  explicit Reference(const fs::path& file, const pintle::Overrides& set = {})
      : scene(pintle::with_pieces(pintle::read_scene(file, set))), model(pintle::build(scene)), assembly(pintle::assemble(scene, model)) {}
  pintle::Run run() const { return pintle::simulate(scene, model, assembly); }
  pintle::Scene scene;
  pintle::Model model;
  pintle::Assembly assembly;
};

double last_of(const pintle::Run& run, const std::string& column) { return run.trajectory.column(column).back(); }

/// Steps to `until` and handles events as the standard says.
struct Course {
  std::vector<double> events;
  bool terminated = false, failed = false;
  double end = 0;
};
Course follow(Instance& instance, double until, double h, const std::function<void(double t)>& before = {}, double from = 0) {
  Course out;
  double t = from;
  bool at_point = true;  // of communication, not only at an event
  for (long k = std::lround(from / h); t < until; k += at_point) {
    if (before && at_point) before(t);
    const double next = std::min(until, static_cast<double>(k + 1) * h);
    const Step step = instance.step(t, next - t);
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

std::vector<double> touches_and_partings(const pintle::Run& run) {
  std::vector<double> out;
  for (const pintle::Impact& impact : run.impacts)
    for (const double t : {impact.begin, impact.end})
      if (!std::isnan(t)) out.push_back(t);
  std::ranges::sort(out);
  return out;
}

bool is_identifier(const std::string& s) {
  return !s.empty() && !std::isdigit(static_cast<unsigned char>(s[0])) &&
         std::ranges::all_of(s, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
}

// What section 2.4 of the standard asks of modelDescription.xml, as far as a unit of this kind uses it.
TEST(Fmu, DescribesItselfAsTheStandardAsks) {
  Exported made("arm.yaml", arm);
  ASSERT_EQ(made.end().code, 0) << made.end().complained;
  const Unit& unit = made.unit();
  const fmu_importer::Element& root = unit.description();
  EXPECT_EQ(root.name, "fmiModelDescription");
  EXPECT_EQ(root.attributes.at("fmiVersion"), "3.0");
  EXPECT_EQ(root.attributes.at("modelName"), "Arm & <torque>");
  EXPECT_FALSE(unit.token().empty());
  const std::vector<std::string> order{"CoSimulation",      "UnitDefinitions", "LogCategories",
                                       "DefaultExperiment", "ModelVariables",  "ModelStructure"};
  ASSERT_EQ(root.children.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(root.children[i].name, order[i]);
  const auto& kind = root.child("CoSimulation")->attributes;
  EXPECT_TRUE(is_identifier(kind.at("modelIdentifier")));
  EXPECT_EQ(kind.at("hasEventMode"), "true");
  EXPECT_EQ(kind.at("canHandleVariableCommunicationStepSize"), "true");

  std::map<std::string, std::map<std::string, std::string>> units;
  for (const auto& u : root.child("UnitDefinitions")->children)
    EXPECT_TRUE(units.emplace(u.attributes.at("name"), u.children.empty() ? std::map<std::string, std::string>{} : u.children[0].attributes)
                    .second);
  EXPECT_EQ(units.at("N m"), (std::map<std::string, std::string>{{"kg", "1"}, {"m", "2"}, {"s", "-2"}}));
  EXPECT_EQ(units.at("rad/s"), (std::map<std::string, std::string>{{"rad", "1"}, {"s", "-1"}}));

  std::vector<std::string> names, references, outputs;
  int independent = 0;
  for (const auto& v : unit.variables()) {
    names.push_back(v.at("name")), references.push_back(v.at("valueReference"));
    const std::string causality = v.at("causality"), variability = v.at("variability"), initial = v.at("initial");
    EXPECT_TRUE(v.at("unit").empty() || units.contains(v.at("unit"))) << v.at("name");
    const bool starts = causality == "parameter" || causality == "input";
    EXPECT_EQ(!v.at("start").empty(), starts) << v.at("name")
                                              << ": a start value where initial is exact or the variable an input, and only there";
    if (causality == "independent") ++independent;
    EXPECT_EQ(initial.empty(), causality == "independent" || causality == "input") << v.at("name");
    EXPECT_TRUE(causality != "parameter" || (variability == "fixed" && initial == "exact")) << v.at("name");
    EXPECT_TRUE(v.type == "Float64" || variability == "discrete") << v.at("name");
    if (causality == "output") outputs.push_back(v.at("valueReference"));
  }
  EXPECT_EQ(independent, 1);
  for (auto* list : {&names, &references}) {
    std::ranges::sort(*list);
    EXPECT_TRUE(std::ranges::adjacent_find(*list) == list->end());
  }
  for (const char* list : {"Output", "InitialUnknown"}) {
    std::vector<std::string> said;
    for (const auto& e : root.child("ModelStructure")->children)
      if (e.name == list) said.push_back(e.attributes.at("valueReference"));
    EXPECT_EQ(said, outputs) << list << ": all outputs, here calculated at the start";
  }
  EXPECT_EQ(unit.variable("torque").at("causality"), "input");
  EXPECT_EQ(unit.variable("brake").at("causality"), "local") << "the scene's own event sets it";
  EXPECT_EQ(unit.variable("power").at("causality"), "output");
  EXPECT_EQ(unit.variable("arm.angle").at("causality"), "local");
  EXPECT_EQ(unit.variable("mass").at("start"), "2");
  EXPECT_EQ(unit.variable("passed.happened").type, "Int32");
  EXPECT_TRUE(fs::exists(unit.folder() / "resources/scene/arm.yaml"));
  EXPECT_TRUE(fs::exists(unit.folder() / "documentation/index.html"));
}

// Every function of the standard's table is there to be loaded.
TEST(Fmu, HasEveryFunctionOfTheStandard) {
  Exported made("arm.yaml", arm);
  for (const char* name : {"GetVersion",
                           "SetDebugLogging",
                           "InstantiateModelExchange",
                           "InstantiateCoSimulation",
                           "InstantiateScheduledExecution",
                           "FreeInstance",
                           "EnterInitializationMode",
                           "ExitInitializationMode",
                           "EnterEventMode",
                           "Terminate",
                           "Reset",
                           "GetFloat32",
                           "GetFloat64",
                           "GetInt8",
                           "GetUInt8",
                           "GetInt16",
                           "GetUInt16",
                           "GetInt32",
                           "GetUInt32",
                           "GetInt64",
                           "GetUInt64",
                           "GetBoolean",
                           "GetString",
                           "GetBinary",
                           "GetClock",
                           "SetFloat32",
                           "SetFloat64",
                           "SetInt8",
                           "SetUInt8",
                           "SetInt16",
                           "SetUInt16",
                           "SetInt32",
                           "SetUInt32",
                           "SetInt64",
                           "SetUInt64",
                           "SetBoolean",
                           "SetString",
                           "SetBinary",
                           "SetClock",
                           "GetNumberOfVariableDependencies",
                           "GetVariableDependencies",
                           "GetFMUState",
                           "SetFMUState",
                           "FreeFMUState",
                           "SerializedFMUStateSize",
                           "SerializeFMUState",
                           "DeserializeFMUState",
                           "GetDirectionalDerivative",
                           "GetAdjointDerivative",
                           "EnterConfigurationMode",
                           "ExitConfigurationMode",
                           "GetIntervalDecimal",
                           "GetIntervalFraction",
                           "GetShiftDecimal",
                           "GetShiftFraction",
                           "SetIntervalDecimal",
                           "SetIntervalFraction",
                           "SetShiftDecimal",
                           "SetShiftFraction",
                           "EvaluateDiscreteStates",
                           "UpdateDiscreteStates",
                           "EnterContinuousTimeMode",
                           "CompletedIntegratorStep",
                           "SetTime",
                           "SetContinuousStates",
                           "GetContinuousStateDerivatives",
                           "GetEventIndicators",
                           "GetContinuousStates",
                           "GetNominalsOfContinuousStates",
                           "GetNumberOfEventIndicators",
                           "GetNumberOfContinuousStates",
                           "EnterStepMode",
                           "GetOutputDerivatives",
                           "DoStep",
                           "ActivateModelPartition"})
    EXPECT_NE(made.unit().function(std::string("fmi3") + name), nullptr) << name;
  EXPECT_STREQ(made.unit().function_as<const char*()>("fmi3GetVersion")(), "3.0");
}

// One step asked for, cut by the events alone: the integrator does what it does in a run, so that all is the same to the bit.
TEST(Fmu, AWornSliderCrankIsItsRunToTheBitEventsIncluded) {
  Exported made = Exported::example("slider_crank_clearance.yaml");
  ASSERT_EQ(made.end().code, 0) << made.end().complained;
  const Reference reference(made.scene());
  const pintle::Run run = reference.run();
  ASSERT_GE(run.impacts.size(), 4u);
  Instance instance(made.unit());
  ASSERT_TRUE(instance.start()) << instance.last_message();
  EXPECT_EQ(instance.count("gudgeon pin.contacts"), 0);
  const double until = reference.scene.run.until;
  const Course course = follow(instance, until, until);
  ASSERT_FALSE(course.failed) << instance.last_message();
  const std::vector<double> times = touches_and_partings(run);
  ASSERT_EQ(course.events.size(), times.size());
  // A step ends where the contact stores a 1e-12th of its impact's energy at the most: of a depth that stores by its 2.5th power a 1.6e-5th, and so of
  // the impact's time. events.csv says when the gap was zero.
  double longest = 0;
  for (const pintle::Impact& impact : run.impacts)
    if (!std::isnan(impact.end)) longest = std::max(longest, impact.end - impact.begin);
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(course.events[i], times[i], 2e-5 * longest) << i;
  EXPECT_EQ(instance.count("gudgeon pin.contacts"), static_cast<int>(run.impacts.size()));
  EXPECT_TRUE(instance.flag("gudgeon pin.touching"));
  for (const char* name : {"crank.angle", "crank.speed", "slider.x", "gudgeon pin.depth", "gudgeon pin.normal"}) {
    const auto& header = run.trajectory.header;
    const auto column = std::ranges::find_if(header, [&](const std::string& h) { return h.starts_with(std::string(name) + " ["); });
    ASSERT_NE(column, header.end());
    EXPECT_EQ(instance[name], last_of(run, *column)) << name;
  }
  EXPECT_EQ(instance.call("fmi3Terminate"), 0) << instance.last_message();
}

// Communication points end steps of the integrator, so that numbers are those of another run of the same tolerance. How far such runs lie apart
// is told by two runs of it and of a hundredth of it; ten times that is allowed.
TEST(Fmu, AWornSliderCrankAgreesWithItsRunAtAnyStep) {
  Exported made = Exported::example("slider_crank_clearance.yaml");
  const pintle::Run run = Reference(made.scene()).run(), finer = Reference(made.scene(), {{"run.tolerance", "1e-10"}}).run();
  const std::vector<double> times = touches_and_partings(run), finer_times = touches_and_partings(finer);
  ASSERT_EQ(times.size(), finer_times.size());
  double apart = 1e-12;
  for (std::size_t i = 0; i < times.size(); ++i) apart = std::max(apart, std::abs(times[i] - finer_times[i]));
  const double turned = std::max(1e-9, std::abs(last_of(run, "crank.angle [rad]") - last_of(finer, "crank.angle [rad]")));
  for (const double h : {1e-3, 7.3e-5}) {
    Instance instance(made.unit());
    ASSERT_TRUE(instance.start()) << instance.last_message();
    const Course course = follow(instance, 0.05, h);
    ASSERT_FALSE(course.failed) << instance.last_message();
    ASSERT_EQ(course.events.size(), finer_times.size());
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(course.events[i], finer_times[i], 10 * apart) << i;
    EXPECT_NEAR(instance["crank.angle"], last_of(finer, "crank.angle [rad]"), 10 * turned);
  }
  Instance without(made.unit(), {.event_mode = false, .early_return = false});
  ASSERT_TRUE(without.start()) << without.last_message();
  const Course course = follow(without, 0.05, 1e-3);
  ASSERT_FALSE(course.failed) << without.last_message();
  EXPECT_TRUE(course.events.empty());
  EXPECT_EQ(without.count("gudgeon pin.contacts"), static_cast<int>(finer.impacts.size()));
  EXPECT_NEAR(without["crank.angle"], last_of(finer, "crank.angle [rad]"), 10 * turned);
}

double controller(double angle, double speed) { return 5.886 - 40 * angle - 6 * speed; }

// J φ'' = τ − d φ' − m g r cos φ, about the pivot, where the torque τ is held for a millisecond: by classical Runge–Kutta steps of 10 µs, that err
// by some 1e-14. The unit's steps err by 1e-10 each, a thousand of them, and control makes errors less.
TEST(Fmu, AnArmIsLedByAControllerInTheImporter) {
  Exported made("arm.yaml", arm);
  Instance instance(made.unit());
  ASSERT_TRUE(instance.start()) << instance.last_message();
  std::vector<double> at;
  const Course course = follow(instance, 1, 1e-3, [&](double) {
    const double angle = instance["arm.angle"];
    at.push_back(angle);
    ASSERT_EQ(instance.set("torque", controller(angle, instance["arm.speed"])), 0) << instance.last_message();
  });
  ASSERT_FALSE(course.failed) << instance.last_message();
  const double J = 0.06 + 2 * 0.3 * 0.3, weight = 2 * 9.81 * 0.3, h = 1e-5;
  double phi = -M_PI / 2, omega = 0, drag = 0, passed = 0, worst = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    worst = std::max(worst, std::abs(phi - at[k]));
    const double torque = controller(phi, omega);
    for (int i = 0; i < 100; ++i) {
      const auto rate = [&](double p, double w) { return (torque - drag * w - weight * std::cos(p)) / J; };
      const auto step = [&](double d, double p, double w) {
        const double a1 = rate(p, w), w2 = w + d / 2 * a1, a2 = rate(p + d / 2 * w, w2), w3 = w + d / 2 * a2, a3 = rate(p + d / 2 * w2, w3),
                     w4 = w + d * a3, a4 = rate(p + d * w3, w4);
        return std::pair{p + d / 6 * (w + 2 * w2 + 2 * w3 + w4), w + d / 6 * (a1 + 2 * a2 + 2 * a3 + a4)};
      };
      auto [p, w] = step(h, phi, omega);
      if (drag == 0 && p > -1) {  // the brake bites within this step: where, by bisection
        double low = 0, high = h;
        while (high - low > 1e-18 && low != (low + high) / 2 && high != (low + high) / 2)
          (step((low + high) / 2, phi, omega).first > -1 ? high : low) = (low + high) / 2;
        std::tie(p, w) = step(high, phi, omega);
        passed = 1e-3 * static_cast<double>(k) + h * i + high;
        drag = 0.5;
        std::tie(p, w) = step(h - high, p, w);
      }
      phi = p, omega = w;
    }
  }
  ASSERT_EQ(at.size(), 1000u);
  EXPECT_LT(worst, 1e-6);
  ASSERT_EQ(course.events.size(), 1u);
  EXPECT_NEAR(course.events[0], passed, 1e-6);
  EXPECT_EQ(instance.count("passed.happened"), 1);
  EXPECT_EQ(instance["brake"], 0.5);
  EXPECT_EQ(instance["power"], instance["torque"] * instance["arm.speed"]);
}

/// The same as the importer does, by the library that Python steps scenes by.
TEST(Fmu, AControlledArmIsWhatTheLibraryStepsToTheBit) {
  Exported made("arm.yaml", arm);
  Instance instance(made.unit());
  ASSERT_TRUE(instance.start());
  const Reference of(made.scene());
  pintle::Simulation simulation(of.scene, of.model, of.assembly);
  const auto& header = pintle::trajectory_table(of.model).header;
  const auto place = [&](const char* name) { return static_cast<std::size_t>(std::ranges::find(header, name) - header.begin()); };
  simulation.advance(0);
  bool same = true;
  const Course course = follow(instance, 0.5, 1e-3, [&](double t) {
    const double next = static_cast<double>(std::lround(t / 1e-3) + 1) * 1e-3;
    const std::vector<double> row = simulation.now();
    same = same && row[place("arm.angle [rad]")] == instance["arm.angle"];
    const double torque = controller(row[place("arm.angle [rad]")], row[place("arm.speed [rad/s]")]);
    simulation.set(0, torque);
    simulation.advance(std::min(next, 0.5));
    instance.set("torque", torque);
  });
  ASSERT_FALSE(course.failed) << instance.last_message();
  EXPECT_TRUE(same);
}

TEST(Fmu, AnEventIsSeenInEventModeAndOneMayEndTheRun) {
  Exported made("arm.yaml", arm);
  const Reference of(made.scene(), {{"states.torque.start", "20 N m"}});
  const pintle::Run run = of.run();
  ASSERT_EQ(run.happenings.size(), 2u);
  Instance instance(made.unit());
  ASSERT_EQ(instance.set("torque", 20), 0);
  ASSERT_TRUE(instance.start()) << instance.last_message();
  Step step = instance.step(0, 2);
  EXPECT_TRUE(step.event && step.early && !step.terminate);
  EXPECT_EQ(step.last, run.happenings[0].t);
  EXPECT_EQ(instance.count("passed.happened"), 0) << "discrete values change in Event Mode";
  EXPECT_EQ(instance.call("fmi3EnterEventMode"), 0);
  bool over = false;
  EXPECT_EQ(instance.update(over), 0);
  EXPECT_FALSE(over);
  EXPECT_EQ(instance.count("passed.happened"), 1);
  EXPECT_EQ(instance.call("fmi3EnterStepMode"), 0);
  step = instance.step(step.last, 2 - step.last);
  EXPECT_TRUE(step.event && step.early && step.terminate);
  EXPECT_EQ(step.last, run.happenings[1].t);
  EXPECT_EQ(instance["arm.angle"], last_of(run, "arm.angle [rad]"));
  EXPECT_EQ(instance.step(step.last, 0.1).status, fmu_importer::error);
  EXPECT_TRUE(says(instance.last_message(), "it is high enough")) << instance.last_message();
  EXPECT_EQ(instance.call("fmi3Terminate"), 0);
}

TEST(Fmu, ResetAndRunAgainIsTheSameToTheBitAndSoAreTwoAtOnce) {
  Exported made = Exported::example("slider_crank_clearance.yaml");
  Instance one(made.unit()), other(made.unit());
  ASSERT_TRUE(one.start(0.01) && other.start(0.01));
  for (int k = 0; k < 10; ++k) {  // in turns
    ASSERT_FALSE(follow(one, 1e-3 * (k + 1), 1e-3, {}, 1e-3 * k).failed) << one.last_message();
    ASSERT_FALSE(follow(other, 1e-3 * (k + 1), 1e-3, {}, 1e-3 * k).failed) << other.last_message();
  }
  const double first = one["gudgeon pin.ex"];
  EXPECT_EQ(first, other["gudgeon pin.ex"]);
  ASSERT_EQ(one.call("fmi3Reset"), 0);
  ASSERT_EQ(one.set("clearance", 2e-5), 0);
  ASSERT_TRUE(one.start(0.01));
  ASSERT_FALSE(follow(one, 0.01, 1e-3).failed);
  EXPECT_NE(one["gudgeon pin.ex"], first) << "another clearance";
  ASSERT_EQ(one.call("fmi3Reset"), 0);
  ASSERT_TRUE(one.start(0.01));
  for (int k = 0; k < 10; ++k) ASSERT_FALSE(follow(one, 1e-3 * (k + 1), 1e-3, {}, 1e-3 * k).failed);
  EXPECT_EQ(one["gudgeon pin.ex"], first);
}

TEST(Fmu, ParametersAreThoseOfSet) {
  Exported made = Exported::example("slider_crank_clearance.yaml");
  const Reference of(made.scene(), {{"clearance", "0.02 mm"}, {"run.until", "5 ms"}});
  const pintle::Run run = of.run();
  Instance instance(made.unit());
  ASSERT_EQ(instance.set("clearance", 0.02e-3), 0);
  ASSERT_TRUE(instance.start(5e-3)) << instance.last_message();
  ASSERT_FALSE(follow(instance, 5e-3, 5e-3).failed) << instance.last_message();
  EXPECT_EQ(instance["crank.angle"], last_of(run, "crank.angle [rad]"));

  Exported bent("arm.yaml", arm);
  Instance arms(bent.unit());
  EXPECT_EQ(arms["reach"], 0.6);
  ASSERT_EQ(arms.set("half", 0.25), 0);
  EXPECT_EQ(arms["reach"], 0.5) << "written by half, it follows";
  ASSERT_TRUE(arms.start());
  EXPECT_EQ(arms.set("half", 0.3), fmu_importer::error);
  EXPECT_TRUE(says(arms.last_message(), "before fmi3ExitInitializationMode")) << arms.last_message();
}

TEST(Fmu, ItsStateIsGoneOnFromToTheBitInMemoryAndAsBytes) {
  Exported made = Exported::example("slider_crank_clearance.yaml");
  const Unit& unit = made.unit();
  Instance instance(unit), other(unit);
  ASSERT_TRUE(instance.start());
  ASSERT_FALSE(follow(instance, 0.01, 1e-3).failed);
  void* state = nullptr;
  ASSERT_EQ(unit.function_as<int(void*, void**)>("fmi3GetFMUState")(instance.handle(), &state), 0) << instance.last_message();
  std::size_t size = 0;
  ASSERT_EQ(unit.function_as<int(void*, void*, std::size_t*)>("fmi3SerializedFMUStateSize")(instance.handle(), state, &size), 0);
  std::vector<std::uint8_t> bytes(size);
  ASSERT_EQ(unit.function_as<int(void*, void*, std::uint8_t*, std::size_t)>("fmi3SerializeFMUState")(instance.handle(), state, bytes.data(),
                                                                                                     size),
            0);
  const auto goes_on = [](Instance& i) {
    EXPECT_FALSE(follow(i, 0.02, 1e-3, {}, 0.01).failed) << i.last_message();
    return std::tuple{i["crank.angle"], i["gudgeon pin.ex"], i.count("gudgeon pin.contacts")};
  };
  const auto first = goes_on(instance);
  ASSERT_EQ(unit.function_as<int(void*, void*)>("fmi3SetFMUState")(instance.handle(), state), 0) << instance.last_message();
  EXPECT_EQ(goes_on(instance), first);
  EXPECT_EQ(unit.function_as<int(void*, void**)>("fmi3FreeFMUState")(instance.handle(), &state), 0);
  EXPECT_EQ(state, nullptr);
  const auto read = unit.function_as<int(void*, const std::uint8_t*, std::size_t, void**)>("fmi3DeserializeFMUState");
  void* again = nullptr;
  ASSERT_EQ(read(other.handle(), bytes.data(), size, &again), 0) << other.last_message();
  ASSERT_EQ(unit.function_as<int(void*, void*)>("fmi3SetFMUState")(other.handle(), again), 0) << other.last_message();
  EXPECT_EQ(goes_on(other), first);
  unit.function_as<int(void*, void**)>("fmi3FreeFMUState")(other.handle(), &again);
  for (const std::size_t place : {std::size_t{0}, std::size_t{40}, size / 2, size - 1}) {
    std::vector<std::uint8_t> spoilt = bytes;
    spoilt[place] ^= 1;
    void* none = nullptr;
    EXPECT_EQ(read(other.handle(), spoilt.data(), size, &none), fmu_importer::error) << place;
    EXPECT_EQ(read(other.handle(), bytes.data(), place, &none), fmu_importer::error) << place;
    EXPECT_EQ(none, nullptr);
  }
}

TEST(Fmu, WrongCallsAreErrorsWithTheirReasons) {
  Exported made("arm.yaml", arm);
  const Unit& unit = made.unit();
  Instance stranger(unit, {.token = "another"}), lost(unit, {.resources = "/nowhere"});
  EXPECT_FALSE(stranger);
  EXPECT_TRUE(says(stranger.last_message(), "instantiationToken"));
  EXPECT_FALSE(lost);
  EXPECT_TRUE(says(lost.last_message(), "/nowhere")) << lost.last_message();

  Instance i(unit);
  const auto refused = [&](int status, const std::string& why) {
    EXPECT_EQ(status, fmu_importer::error) << why;
    EXPECT_TRUE(says(i.last_message(), why)) << i.last_message();
  };
  double x = 0;
  refused(i.get("arm.angle", x), "from Initialization Mode on");
  refused(i.step(0, 0.1).status, "in Step Mode");
  refused(i.call("fmi3ExitInitializationMode"), "in Initialization Mode");
  refused(i.call("fmi3Terminate"), "instantiated");
  refused(i.set("arm.angle", 1), "follows from the motion");
  refused(i.set("torque", std::nan("")), "finite");
  refused(i.set("time", 1), "follows from the motion");
  refused(i.enter_initialization(0, 0, 1), "starts at 0 s");
  refused(i.enter_initialization(0, 2), "tolerance");
  ASSERT_TRUE(i.start()) << i.last_message();
  refused(i.step(0, -0.1).status, "above 0");
  refused(i.step(0, INFINITY).status, "above 0");
  refused(i.step(0.5, 0.1).status, "but the instance is at 0 s");
  refused(i.step(0, 2.5).status, "stopTime");
  const std::uint32_t none = 100000, angle = unit.variable("arm.angle").reference();
  const auto get = unit.function_as<int(void*, const std::uint32_t*, std::size_t, double*, std::size_t)>("fmi3GetFloat64");
  refused(get(i.handle(), &none, 1, &x, 1), "value reference 100000");
  refused(get(i.handle(), &angle, 1, &x, 2), "2 values");
  refused(get(i.handle(), nullptr, 1, &x, 1), "NULL");
  EXPECT_EQ(get(i.handle(), nullptr, 0, nullptr, 0), 0);
  EXPECT_EQ(get(nullptr, &angle, 1, &x, 1), fmu_importer::error);
  refused(i.get("passed.happened", x), "no Float64");
  refused(unit.function_as<int(void*, const std::uint32_t*, std::size_t, std::int32_t*, std::size_t)>("fmi3GetInt32")(
              i.handle(), &angle, 1, reinterpret_cast<std::int32_t*>(&x), 1),
          "no Int32");
  refused(unit.function_as<int(void*, double)>("fmi3SetTime")(i.handle(), 1), "co-simulation");
  refused(unit.function_as<int(void*, void*)>("fmi3SetFMUState")(i.handle(), nullptr), "NULL");
  EXPECT_EQ(unit.function_as<int(void*, double, double, bool, bool*, bool*, bool*, double*)>("fmi3DoStep")(
                i.handle(), 0, 0.1, true, nullptr, nullptr, nullptr, nullptr),
            fmu_importer::error);
  const char* category = "noise";
  refused(unit.function_as<int(void*, bool, std::size_t, const char**)>("fmi3SetDebugLogging")(i.handle(), true, 1, &category), "category");
  EXPECT_EQ(i.step(0, 0.1).status, 0) << "and goes on: " << i.last_message();

  Instance plain(unit, {.event_mode = false});
  ASSERT_TRUE(plain.start());
  EXPECT_EQ(plain.call("fmi3EnterEventMode"), fmu_importer::error);
  EXPECT_TRUE(says(plain.last_message(), "eventModeUsed"));
  unit.function_as<void(void*)>("fmi3FreeInstance")(nullptr);

  Instance odd(unit);  // a parameter with which the scene cannot be: the reason, and it can be set again
  ASSERT_EQ(odd.set("mass", -1), 0);
  EXPECT_FALSE(odd.start());
  EXPECT_TRUE(says(odd.last_message(), "mass")) << odd.last_message();
  ASSERT_EQ(odd.call("fmi3Reset"), 0);
  EXPECT_TRUE(odd.start()) << odd.last_message();
}

TEST(Fmu, HoldsTheFilesOfItsSceneAndNoOthers) {
  const Folder folder;
  fs::create_directory(folder.path() / "scenes");
  fs::create_directory(folder.path() / "scenes/tables");
  folder.write("scenes/tables/push.csv", "0, 0\n1, 2\n2, 0\n");
  folder.write("scenes/other.csv", "0, 0\n1, 1\n");
  folder.write("outside.csv", "0, 0\n2, 2\n");
  folder.write("scenes/parts.yaml", "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}, points: {O: [0, 0]}}}\n");
  const std::string scene =
      "include: [parts.yaml]\njoints: {guide: {prismatic: [ground, block.O]}}\nforces: {push: {force: [{table: FILE, interpolation: "
      "linear}, 0], at: block.O}}\n"
      "run: {until: 1 s}\n";
  const auto with = [&](const std::string& file) {
    std::string text = scene;
    text.replace(text.find("FILE"), 4, file);
    return folder.write("scenes/block.yaml", text).string();
  };
  const std::string file = (folder.path() / "block.fmu").string(), log = (folder.path() / "log").string();
  const Ended made = run(log, {PINTLE_PROGRAM, "fmu", with("tables/push.csv"), "-o", file});
  ASSERT_EQ(made.code, 0) << made.complained;
  const std::string bits = contents(file);
  ASSERT_EQ(run(log, {PINTLE_PROGRAM, "fmu", with("tables/push.csv"), "-o", file}).code, 0);
  EXPECT_TRUE(contents(file) == bits) << "the same scene is the same file";
  {
    const Unit unit(file);
    fs::remove_all(folder.path() / "scenes");  // it stands alone
    EXPECT_TRUE(fs::exists(unit.folder() / "resources/scene/tables/push.csv"));
    EXPECT_TRUE(fs::exists(unit.folder() / "resources/scene/parts.yaml"));
    EXPECT_FALSE(fs::exists(unit.folder() / "resources/scene/other.csv"));
    Instance instance(unit);
    ASSERT_TRUE(instance.start()) << instance.last_message();
    ASSERT_EQ(instance.step(0, 1).status, 0) << instance.last_message();
    EXPECT_NEAR(instance["block.x"], 1.0 / 3, 1e-7) << "x'' = 2 t, for 1 s";
  }
  fs::create_directory(folder.path() / "scenes");
  folder.write("scenes/parts.yaml", "bodies: {block: {rigid: {mass: 1 kg, inertia: 1}, points: {O: [0, 0]}}}\n");
  const Ended refused = run(log, {PINTLE_PROGRAM, "fmu", with("../outside.csv"), "-o", file});
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(says(refused.complained, "outside.csv")) << refused.complained;
}

TEST(Fmu, TheCommandSaysWhatItMadeAndWhatIsWrong) {
  const Exported made("arm.yaml", arm);
  ASSERT_EQ(made.end().code, 0) << made.end().complained;
  expect_says(made.end().said, {"Arm & <torque>", "1: torque [N m]", "1: power [W]", "2: passed.happened, ended.happened",
                                "3: mass [kg], half [m], reach [m]", "arm.yaml", "out.fmu"});
  const Exported no_input("arm.yaml", arm, {"--input", "torqe"}), set_input("arm.yaml", arm, {"--input", "brake"}),
      no_output("arm.yaml", arm, {"--output", "arm.angel"}), no_scene("arm.yaml", "bodies: 3");
  EXPECT_EQ(no_input.end().code, 2);
  expect_says(no_input.end().complained, {"--input torqe", "Did you mean \"torque\"?"});
  expect_says(set_input.end().complained, {"--input brake", "an event of the scene sets this state"});
  expect_says(no_output.end().complained, {"--output arm.angel", "Did you mean \"arm.angle\"?"});
  EXPECT_EQ(no_scene.end().code, 2);
  EXPECT_FALSE(fs::exists(no_scene.file()));
  Exported chosen("arm.yaml", arm, {"--output", "arm.angle", "--output", "pivot.fx", "--set", "mass=3kg"});
  ASSERT_EQ(chosen.end().code, 0) << chosen.end().complained;
  EXPECT_EQ(chosen.unit().variable("arm.angle").at("causality"), "output");
  EXPECT_EQ(chosen.unit().variable("power").at("causality"), "local");
  EXPECT_EQ(chosen.unit().variable("mass").at("start"), "3");
  Instance instance(chosen.unit());
  EXPECT_TRUE(instance.start()) << instance.last_message();

  std::string named_time = arm;  // a name that the unit has already
  named_time.replace(named_time.find("torque: {rate"), 6, "time");
  named_time.replace(named_time.find("torque: torque"), 14, "torque: time");
  Exported other("arm.yaml", named_time);
  ASSERT_EQ(other.end().code, 0) << other.end().complained;
  Instance pushed(other.unit());
  ASSERT_EQ(pushed.set("time'", 20), 0);
  ASSERT_TRUE(pushed.start()) << pushed.last_message();
  ASSERT_LE(pushed.step(0, 0.01).status, fmu_importer::warning) << pushed.last_message();
  EXPECT_EQ(pushed["time"], 0.01);
  EXPECT_GT(pushed["arm.speed"], 0);
}

}  // namespace
