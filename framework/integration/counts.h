#pragma once

#include "framework/common/members.h"

namespace pintle {

/// Cost of an integration so far.
struct Counts {
  long steps = 0, rejected = 0, events = 0, evaluations = 0, factorizations = 0, partitions = 0;
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(steps, rejected, events, evaluations, factorizations, partitions));
  }
};

}  // namespace pintle
