#pragma once

// Runs that go on from a saved step.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/build/build.h"
#include "framework/integration/integrator.h"

namespace pintle_scenes {

/// From every `stride`th step, saved, the run comes to the same end to the last bit.
/// @param events  that the run must meet at least: with fewer it shows little
inline void expect_same_end_from_steps(const pintle::Scene& s, std::size_t stride, int events) {
  const pintle::Model model = pintle::build(s);
  const pintle::State start = pintle::assemble(s, model).start;
  pintle::Integrator run(model.system, model.scheme, start);
  std::vector<std::string> saved{run.save()};
  while (run.state().t < s.run.until) {
    ASSERT_TRUE(run.advance(s.run.until)) << run.failure();
    saved.push_back(run.save());
  }
  ASSERT_GE(run.counts().events, events) << "few events, no exam";
  for (std::size_t k = 0; k < saved.size(); k += stride) {
    pintle::Integrator next(model.system, model.scheme, start);
    next.load(saved[k]);
    while (next.state().t < s.run.until) ASSERT_TRUE(next.advance(s.run.until)) << next.failure();
    ASSERT_EQ(next.save(), saved.back()) << "from step " << k;
  }
}

}  // namespace pintle_scenes
