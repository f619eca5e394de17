#pragma once

#include "framework/integration/explicit/stages.h"
#include "tests/contracts/scheme_cases.h"

namespace pintle::scheme_cases {

/// The step of length `span` from the start of a case. @returns whether it could be taken
inline bool first_step(const Case& k, double span, Stages& stages, Step& step, Equations& eq) {
  step.to.state = k.start;
  step.to.dy.setZero(k.system.n_y());
  if (!stages.project(k.system, step.to, eq)) return false;
  step.from = step.to;
  return stages.attempt(k.system, span, step, eq);
}

}  // namespace pintle::scheme_cases
