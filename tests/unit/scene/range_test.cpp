// The ranges of a function and of its rate over an interval hold all that the function does there, and little more where it is short.
#include "framework/scene/units/range.h"

#include <gtest/gtest.h>

#include <vector>

#include "framework/scene/units/jet.h"

namespace pintle::range_test {
namespace {

struct Function {
  Op op;
  std::vector<double> places;  ///< where it is smooth, and bends by 100 at the most
};
const Function of_one[]{{Op::negate, {-2, 0, 3}}, {Op::sin, {-4, 0, 1, 9}},   {Op::cos, {-4, 0, 1, 9}},
                        {Op::tan, {-1, 0, 1}},    {Op::asin, {-0.9, 0, 0.8}}, {Op::acos, {-0.9, 0.8}},
                        {Op::atan, {-5, 0, 5}},   {Op::sqrt, {0.2, 1, 50}},   {Op::exp, {-3, 0, 2}},
                        {Op::log, {0.2, 1, 30}},  {Op::abs, {-2, 0.5}},       {Op::smooth, {-1, 0.1, 0.25, 0.4, 0.6, 0.9, 2}}};
const Function of_two[]{{Op::add, {-2, 0.1, 3}},  {Op::subtract, {-2, 0.1, 3}}, {Op::multiply, {-2, 0.1, 3}}, {Op::divide, {-2, 0.5, 3}},
                        {Op::power, {0.5, 1, 2}}, {Op::atan2, {-2, 0.5, 3}},    {Op::min, {-2, 3}},           {Op::max, {-2, 3}}};

void expect_held(const Range& r, double x, double beyond) {
  EXPECT_LE(r.lo, x + 1e-12);
  EXPECT_GE(r.hi, x - 1e-12);
  EXPECT_GE(r.lo, x - beyond);
  EXPECT_LE(r.hi, x + beyond);
}

/// @param range, jet  of an interval of time, and of a time
template <class Ranges, class Jets>
void expect_held(const Function& f, Ranges range, Jets jet) {
  for (const double place : f.places)
    for (const double length : {1e-3, 1e-6}) {
      const RangeJet over = range(RangeJet{{place, place + length}, {1, 1}});
      for (const double part : {0.0, 0.3, 1.0}) {
        SCOPED_TRACE(testing::Message() << "function " << static_cast<int>(f.op) << " at " << place << ", over " << length);
        const Jet here = jet(Jet{place + part * length, 1, 0});
        expect_held(over.value, here.value, 100 * length + 1e-12);
        expect_held(over.rate, here.rate, 1000 * length + 1e-12);
      }
    }
}

TEST(Ranges, HoldEveryFunctionAndItsRateAndLittleMore) {
  for (const Function& f : of_one)
    expect_held(
        f, [&](const RangeJet& t) { return apply(f.op, t); }, [&](const Jet& t) { return apply(f.op, t); });
  for (const Function& f : of_two)
    expect_held(
        f, [&](const RangeJet& t) { return apply(f.op, t, apply(Op::multiply, t, t)); },
        [&](const Jet& t) { return apply(f.op, t, apply(Op::multiply, t, t)); });
}

}  // namespace
}  // namespace pintle::range_test
