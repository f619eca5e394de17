#include "framework/scene/units/jet.h"

#include <cmath>
#include <limits>

namespace pintle {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// f(x(t)) from f, f′, f″ at x. A constant x has no rates, even where f′ is infinite.
Jet chain(const Jet& x, double f, double f1, double f2) {
  if (x.rate == 0 && x.accel == 0) return {f, 0, 0};
  const double curved = x.rate == 0 ? 0 : f2 * x.rate * x.rate;
  const double straight = x.accel == 0 ? 0 : f1 * x.accel;
  return {f, x.rate == 0 ? 0 : f1 * x.rate, curved + straight};
}

Jet times(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate, a.accel * b.value + 2 * a.rate * b.rate + a.value * b.accel};
}

Jet over(const Jet& a, const Jet& b) {
  const double q = a.value / b.value;
  const double q1 = (a.rate - q * b.rate) / b.value;
  return {q, q1, (a.accel - 2 * q1 * b.rate - q * b.accel) / b.value};
}

Jet logarithm(const Jet& x) { return chain(x, std::log(x.value), 1 / x.value, -1 / (x.value * x.value)); }

Jet exponential(const Jet& x) {
  const double f = std::exp(x.value);
  return chain(x, f, f, f);
}

Jet raised(const Jet& x, const Jet& n) {
  if (n.rate != 0 || n.accel != 0) return exponential(times(n, logarithm(x)));
  const double p = n.value, f = std::pow(x.value, p);
  // x⁰ and x¹ have a zero second derivative, also at x = 0.
  const double f1 = p == 0 ? 0 : p * std::pow(x.value, p - 1);
  const double f2 = p == 0 || p == 1 ? 0 : p * (p - 1) * std::pow(x.value, p - 2);
  return chain(x, f, f1, f2);
}

Jet direction(const Jet& y, const Jet& x) {
  const double r2 = x.value * x.value + y.value * y.value;
  const double swept = x.value * y.rate - y.value * x.rate;
  const double swept1 = x.value * y.accel - y.value * x.accel;
  const double rate = swept / r2;
  return {std::atan2(y.value, x.value), rate, (swept1 - 2 * rate * (x.value * x.rate + y.value * y.rate)) / r2};
}

Jet smooth(const Jet& x) {
  const double s = x.value;
  if (s <= 0) return {0, 0, 0};
  if (s >= 1) return {1, 0, 0};
  const double u = 1 - s;
  return chain(x, s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * u * u, 60 * s * u * (1 - 2 * s));
}

Jet truth(bool yes) { return {yes ? 1.0 : 0.0, 0, 0}; }

}  // namespace

Jet apply(Op op, const Jet& x) {
  const double v = x.value;
  switch (op) {
    case Op::negate: return {-v, -x.rate, -x.accel};
    case Op::sin: return chain(x, std::sin(v), std::cos(v), -std::sin(v));
    case Op::cos: return chain(x, std::cos(v), -std::sin(v), -std::cos(v));
    case Op::tan: {
      const double f = std::tan(v), f1 = 1 + f * f;
      return chain(x, f, f1, 2 * f * f1);
    }
    case Op::asin: {
      const double f1 = 1 / std::sqrt(1 - v * v);
      return chain(x, std::asin(v), f1, v * f1 * f1 * f1);
    }
    case Op::acos: {
      const double f1 = 1 / std::sqrt(1 - v * v);
      return chain(x, std::acos(v), -f1, -v * f1 * f1 * f1);
    }
    case Op::atan: {
      const double f1 = 1 / (1 + v * v);
      return chain(x, std::atan(v), f1, -2 * v * f1 * f1);
    }
    case Op::sqrt: {
      const double f = std::sqrt(v);
      return chain(x, f, 0.5 / f, -0.25 / (f * v));
    }
    case Op::exp: return exponential(x);
    case Op::log: return logarithm(x);
    case Op::abs: return v < 0 ? Jet{-v, -x.rate, -x.accel} : x;
    case Op::smooth: return smooth(x);
    default: return {nan, nan, nan};
  }
}

Jet apply(Op op, const Jet& a, const Jet& b) {
  switch (op) {
    case Op::add: return {a.value + b.value, a.rate + b.rate, a.accel + b.accel};
    case Op::subtract: return {a.value - b.value, a.rate - b.rate, a.accel - b.accel};
    case Op::multiply: return times(a, b);
    case Op::divide: return over(a, b);
    case Op::power: return raised(a, b);
    case Op::atan2: return direction(a, b);
    case Op::min: return b.value < a.value ? b : a;
    case Op::max: return b.value > a.value ? b : a;
    case Op::less: return truth(a.value < b.value);
    case Op::greater: return truth(a.value > b.value);
    case Op::at_most: return truth(a.value <= b.value);
    case Op::at_least: return truth(a.value >= b.value);
    case Op::equal: return truth(a.value == b.value);
    case Op::unequal: return truth(a.value != b.value);
    case Op::both: return truth(a.value != 0 && b.value != 0);
    case Op::either: return truth(a.value != 0 || b.value != 0);
    default: return {nan, nan, nan};
  }
}

}  // namespace pintle
