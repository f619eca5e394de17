#pragma once

#include "framework/scene/units/formula.h"

namespace pintle {

/// All values that a quantity takes over an interval of time, or more: lo ≤ x ≤ hi, perhaps infinite.
struct Range {
  double lo = 0, hi = 0;
  double width() const { return hi - lo; }
  bool holds(double x) const { return lo <= x && x <= hi; }
};
Range hull(const Range&, const Range&);

/// The same of a formula's value and of its first derivative in time.
struct RangeJet {
  Range value, rate;
};

/// The rules of `apply` (jet.h) for whole intervals. Where a function jumps or has no derivative the rate is unbounded,
/// where it has a kink the rate is that of both sides.
RangeJet apply(Op, const RangeJet&);
RangeJet apply(Op, const RangeJet&, const RangeJet&);
RangeJet choose(const RangeJet& condition, const RangeJet& then, const RangeJet& otherwise);

}  // namespace pintle
