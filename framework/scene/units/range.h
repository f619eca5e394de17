#pragma once

#include "framework/scene/units/formula.h"

namespace pintle {

/// Bounds of all values of a quantity over a time interval: lo ≤ x ≤ hi, possibly infinite and not always tight.
struct Range {
  double lo = 0, hi = 0;
  double width() const { return hi - lo; }
  bool holds(double x) const { return lo <= x && x <= hi; }
};
Range hull(const Range&, const Range&);

/// The same for a formula's value and its first time derivative.
struct RangeJet {
  Range value, rate;
};

/// The rules of `apply` (jet.h) for intervals. Where a function jumps or has no derivative, the rate is unbounded; at a kink, the rate
/// includes both sides.
RangeJet apply(Op, const RangeJet&);
RangeJet apply(Op, const RangeJet&, const RangeJet&);
RangeJet choose(const RangeJet& condition, const RangeJet& then, const RangeJet& otherwise);

}  // namespace pintle
