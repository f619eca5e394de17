// Saving an integrator and going on, by every scheme.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/scene/yaml/reader.h"
#include "tests/contracts/loose_crank.h"

namespace pintle::restart_test {
namespace {

using namespace scheme_cases;

void expect_same(const Integrator& a, const Integrator& b) {
  ASSERT_EQ(a.state().t, b.state().t);
  ASSERT_EQ(a.state().y, b.state().y);
  ASSERT_EQ(a.impacts().size(), b.impacts().size());
  for (std::size_t i = 0; i < a.impacts().size(); ++i) {
    ASSERT_EQ(a.impacts()[i].begin, b.impacts()[i].begin);
    ASSERT_EQ(a.impacts()[i].peak_force, b.impacts()[i].peak_force);
    ASSERT_EQ(a.impacts()[i].lost, b.impacts()[i].lost);
  }
  ASSERT_EQ(a.counts().evaluations, b.counts().evaluations);
}

Case of_example(const std::string& name) {
  const Scene scene = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/" + name);
  const Model model = build(scene);
  Case k = crank::make();
  k.system = model.system;
  number(k.system, true);
  k.start = assemble(scene, model).start;
  const VectorXd before = k.start.y;
  k.start.y.setZero(k.system.n_y());
  k.start.y.head(2 * k.system.n()) = before.head(2 * k.system.n());
  return k;
}

void goes_on_from_any_step(const Case& k, double until) {
  for (const char* tableau : {"dopri5", "rkf45", ""})
    for (const Constraints c : {Constraints::projection, Constraints::partitioning}) {
      const bool implicit = std::string(tableau).empty();
      if (implicit && c == Constraints::partitioning) continue;
      SCOPED_TRACE(std::string(tableau) + " " + std::to_string(static_cast<int>(c)));
      Integrator run = integrator(k, 1e-6, implicit ? nullptr : tableau, c);
      std::vector<std::string> saved;
      for (int i = 0; i < 800; ++i) {
        if (i % 80 == 7) saved.push_back(run.save());
        ASSERT_TRUE(run.advance(until)) << run.failure();
      }
      ASSERT_GE(run.impacts().size(), 2u) << "no impact, no exam";
      for (std::size_t s = 0; s < saved.size(); ++s) {
        Integrator next = integrator(k, 1e-6, implicit ? nullptr : tableau, c);
        next.load(saved[s]);
        EXPECT_EQ(next.save(), saved[s]);
        for (int i = 7 + 80 * static_cast<int>(s); i < 800; ++i) ASSERT_TRUE(next.advance(until)) << next.failure();
        expect_same(next, run);
      }
    }
}

TEST(Restart, FromAnyStepGoesOnBitForBitThroughImpacts) { goes_on_from_any_step(loose_crank(), 1); }
TEST(Restart, FromAnyStepGoesOnBitForBitFromPieceToPiece) { goes_on_from_any_step(of_example("box_and_ramp.yaml"), 100); }
TEST(Restart, FromAnyStepGoesOnBitForBitFromFlankToFlank) { goes_on_from_any_step(of_example("gear_backlash.yaml"), 100); }
TEST(Restart, FromAnyStepGoesOnBitForBitThroughStickAndSlip) { goes_on_from_any_step(of_example("stick_slip.yaml"), 100); }

// What `method: auto` takes may change with the length of the run and the rows asked for, which a restart may change.
TEST(Restart, GoesOnWithTheExplicitPairThatWasSaved) {
  const Case k = loose_crank();
  Integrator run = integrator(k, 1e-6, "dopri5"), next = integrator(k, 1e-6, "verner87");
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(run.advance(1));
  next.load(run.save());
  EXPECT_EQ(next.switched(), "dopri5 throughout, as in the saved run");
  for (int i = 0; i < 400; ++i) ASSERT_TRUE(run.advance(1) && next.advance(1));
  expect_same(next, run);
}

TEST(Restart, RefusesWhatIsNotWholeOrOfAnotherSystem) {
  const Case loose = loose_crank(), tight = crank::make();
  Integrator run = integrator(loose, 1e-6), other = integrator(tight, 1e-6);
  ASSERT_TRUE(run.advance(1));
  const std::string saved = run.save();
  EXPECT_THROW(run.load(saved.substr(0, saved.size() / 2)), std::invalid_argument);
  EXPECT_THROW(run.load(saved + "x"), std::invalid_argument);
  EXPECT_THROW(run.load(""), std::invalid_argument);
  EXPECT_THROW(other.load(saved), std::invalid_argument);
}

}  // namespace
}  // namespace pintle::restart_test
