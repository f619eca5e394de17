// Units stepped by an importer of the tests' own (importer.h): their numbers, events and states.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

#include "framework/analysis/simulate/simulation.h"
#include "tests/fmi/exported.h"
#include "tests/refusal.h"

namespace {

using namespace pintle_test;
using fmu_importer::Instance;
using fmu_importer::Step;
using fmu_importer::Unit;

std::vector<double> touches_and_partings(const pintle::Run& run) {
  std::vector<double> out;
  for (const pintle::Impact& impact : run.impacts)
    for (const double t : {impact.begin, impact.end})
      if (!std::isnan(t)) out.push_back(t);
  std::ranges::sort(out);
  return out;
}

double controller(double angle, double speed) { return 5.886 - 40 * angle - 6 * speed; }

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

// J φ'' = τ − d φ' − m g r cos φ, about the pivot, where the torque τ is held for a millisecond: by classical Runge–Kutta steps of 10 µs, that err
// by some 1e-14. The unit's steps err by 1e-10 each, a thousand of them, and control makes errors less.
TEST(Fmu, AnArmIsLedByAControllerInTheImporter) {
  Exported made("arm.yaml", led_arm);
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
  Exported made("arm.yaml", led_arm);
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
  Exported made("arm.yaml", led_arm);
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

// Each in a thread of its own, made in another one.
TEST(Fmu, FourAtOnceInThreadsAreTheSameToTheBit) {
  Exported made = Exported::example("slider_crank_clearance.yaml");
  std::vector<std::unique_ptr<Instance>> instances;
  for (int i = 0; i < 4; ++i) instances.push_back(std::make_unique<Instance>(made.unit()));
  std::vector<double> found(instances.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < instances.size(); ++i)
    threads.emplace_back([&, i] {
      Instance& one = *instances[i];
      if (one.start(5e-3) && !follow(one, 5e-3, 1e-3).failed) found[i] = one["gudgeon pin.ex"];
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_NE(found[0], 0);
  for (const double ex : found) EXPECT_EQ(ex, found[0]);
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

  Exported bent("arm.yaml", led_arm);
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

}  // namespace
