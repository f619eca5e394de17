#include "framework/scene/units/range.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pintle {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range all{-infinity, infinity}, unity{1, 1}, nothing{0, 0};

bool is_nothing(const Range& r) { return r.lo == 0 && r.hi == 0; }
Range sound(double lo, double hi) { return {std::isnan(lo) ? -infinity : lo, std::isnan(hi) ? infinity : hi}; }

Range operator-(const Range& a) { return {-a.hi, -a.lo}; }
Range operator+(const Range& a, const Range& b) { return sound(a.lo + b.lo, a.hi + b.hi); }
Range operator-(const Range& a, const Range& b) { return a + -b; }

Range operator*(const Range& a, const Range& b) {
  if (is_nothing(a) || is_nothing(b)) return nothing;
  const auto product = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; };
  const auto [lo, hi] = std::minmax({product(a.lo, b.lo), product(a.lo, b.hi), product(a.hi, b.lo), product(a.hi, b.hi)});
  return sound(lo, hi);
}
Range inverse(const Range& a) { return a.holds(0) ? all : Range{1 / a.hi, 1 / a.lo}; }
Range operator/(const Range& a, const Range& b) { return is_nothing(a) ? nothing : a * inverse(b); }

Range square(const Range& a) {
  const double x = a.lo * a.lo, y = a.hi * a.hi;
  return {a.holds(0) ? 0 : std::min(x, y), std::max(x, y)};
}

// For a non-decreasing function.
template <class F>
Range rising(F f, const Range& x) {
  return sound(f(x.lo), f(x.hi));
}
template <class F>
Range falling(F f, const Range& x) {
  return sound(f(x.hi), f(x.lo));
}

bool passes(const Range& x, double phase) {  // a point phase + 2π k
  constexpr double turn = 2 * std::numbers::pi;
  return std::floor((x.hi - phase) / turn) >= std::ceil((x.lo - phase) / turn);
}
Range cosine(const Range& x) {
  if (!std::isfinite(x.lo) || !std::isfinite(x.hi)) return {-1, 1};
  const auto [lo, hi] = std::minmax({std::cos(x.lo), std::cos(x.hi)});
  return {passes(x, std::numbers::pi) ? -1 : lo, passes(x, 0) ? 1 : hi};
}
Range sine(const Range& x) { return cosine(x - Range{std::numbers::pi / 2, std::numbers::pi / 2}); }

// f(x(t)) from the ranges of f and f′; a constant x has no rate, even where f′ is infinite.
RangeJet chain(const RangeJet& x, const Range& f, const Range& slope) { return {f, is_nothing(x.rate) ? nothing : slope * x.rate}; }

RangeJet logarithm(const RangeJet& x) {
  return chain(x, rising([](double v) { return v > 0 ? std::log(v) : -infinity; }, x.value), x.value.lo > 0 ? inverse(x.value) : all);
}
RangeJet exponential(const RangeJet& x) {
  const Range f = rising([](double v) { return std::exp(v); }, x.value);
  return chain(x, f, f);
}

Range whole_power(const Range& x, double n) {
  if (n < 0) return inverse(whole_power(x, -n));
  const double a = std::pow(x.lo, n), b = std::pow(x.hi, n);
  const bool even = std::fmod(n, 2) == 0;
  return sound(even && x.holds(0) ? 0 : std::min(a, b), std::max(a, b));
}

RangeJet raised(const RangeJet& x, const RangeJet& n) {
  if (n.value.width() > 0 || !is_nothing(n.rate)) {
    const RangeJet l = logarithm(x);
    return exponential({n.value * l.value, n.rate * l.value + n.value * l.rate});
  }
  const double p = n.value.lo;
  if (p == 0) return {unity, nothing};
  if (p == std::floor(p)) return chain(x, whole_power(x.value, p), p == 1 ? unity : Range{p, p} * whole_power(x.value, p - 1));
  const Range base{std::max(x.value.lo, 0.0), std::max(x.value.hi, 0.0)};
  const auto power = [&](double e) {
    const auto f = [e](double v) { return std::pow(v, e); };
    return e > 0 ? rising(f, base) : falling(f, base);
  };
  return chain(x, power(p), Range{p, p} * power(p - 1));
}

RangeJet direction(const RangeJet& y, const RangeJet& x) {
  const Range r2 = square(x.value) + square(y.value);
  const Range rate = (x.value * y.rate - y.value * x.rate) / r2;
  if (x.value.lo <= 0 && y.value.holds(0)) return {{-std::numbers::pi, std::numbers::pi}, rate};  // the angle may jump by a turn
  const auto [lo, hi] = std::minmax({std::atan2(y.value.lo, x.value.lo), std::atan2(y.value.lo, x.value.hi),
                                     std::atan2(y.value.hi, x.value.lo), std::atan2(y.value.hi, x.value.hi)});
  return {{lo, hi}, rate};
}

RangeJet smooth(const RangeJet& x) {
  const auto f = [](double v) {
    const double s = std::clamp(v, 0.0, 1.0);
    return s * s * s * (10 + s * (6 * s - 15));
  };
  const auto slope = [](double v) {
    const double s = std::clamp(v, 0.0, 1.0);
    return 30 * s * s * (1 - s) * (1 - s);
  };
  const auto [lo, hi] = std::minmax({slope(x.value.lo), slope(x.value.hi)});  // list: minmax of two returns references
  return chain(x, rising(f, x.value), {lo, x.value.holds(0.5) ? slope(0.5) : hi});
}

RangeJet truth(bool surely, bool surely_not) { return {{surely ? 1.0 : 0.0, surely_not ? 0.0 : 1.0}, nothing}; }
bool is_true(const RangeJet& x) { return !x.value.holds(0); }
bool is_false(const RangeJet& x) { return is_nothing(x.value); }

RangeJet lesser(const RangeJet& a, const RangeJet& b) {
  if (a.value.hi <= b.value.lo) return a;
  if (b.value.hi <= a.value.lo) return b;
  return {{std::min(a.value.lo, b.value.lo), std::min(a.value.hi, b.value.hi)}, hull(a.rate, b.rate)};
}
RangeJet negated(const RangeJet& x) { return {-x.value, -x.rate}; }
RangeJet magnitude(const RangeJet& x) {
  const Range& v = x.value;
  return {{std::max({0.0, v.lo, -v.hi}), std::max(-v.lo, v.hi)}, negated(lesser(x, negated(x))).rate};
}

}  // namespace

Range hull(const Range& a, const Range& b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }

RangeJet apply(Op op, const RangeJet& x) {
  const Range& v = x.value;
  const Range inside{std::max(v.lo, -1.0), std::min(v.hi, 1.0)};
  const auto steep = [&] {
    return v.lo > -1 && v.hi < 1 ? inverse(rising([](double u) { return std::sqrt(u); }, unity - square(v))) : Range{1, infinity};
  };
  switch (op) {
    case Op::negate: return negated(x);
    case Op::sin: return chain(x, sine(v), cosine(v));
    case Op::cos: return chain(x, cosine(v), -sine(v));
    case Op::tan: {
      if (passes({2 * v.lo, 2 * v.hi}, std::numbers::pi)) return {all, all};
      const Range f = rising([](double u) { return std::tan(u); }, v);
      return chain(x, f, unity + square(f));
    }
    case Op::asin: return chain(x, rising([](double u) { return std::asin(u); }, inside), steep());
    case Op::acos: return chain(x, falling([](double u) { return std::acos(u); }, inside), -steep());
    case Op::atan: return chain(x, rising([](double u) { return std::atan(u); }, v), inverse(unity + square(v)));
    case Op::sqrt: {
      const Range f = rising([](double u) { return std::sqrt(std::max(u, 0.0)); }, v);
      return chain(x, f, f.lo > 0 ? Range{0.5, 0.5} * inverse(f) : Range{0.5 / f.hi, infinity});
    }
    case Op::exp: return exponential(x);
    case Op::log: return logarithm(x);
    case Op::abs: return magnitude(x);
    case Op::smooth: return smooth(x);
    default: return {all, all};
  }
}

RangeJet apply(Op op, const RangeJet& a, const RangeJet& b) {
  const Range &x = a.value, &y = b.value;
  switch (op) {
    case Op::add: return {x + y, a.rate + b.rate};
    case Op::subtract: return {x - y, a.rate - b.rate};
    case Op::multiply: return {x * y, a.rate * y + x * b.rate};
    case Op::divide: {
      const Range q = x / y;
      return {q, (a.rate - q * b.rate) / y};
    }
    case Op::power: return raised(a, b);
    case Op::atan2: return direction(a, b);
    case Op::min: return lesser(a, b);
    case Op::max: return negated(lesser(negated(a), negated(b)));
    case Op::less: return truth(x.hi < y.lo, x.lo >= y.hi);
    case Op::greater: return truth(x.lo > y.hi, x.hi <= y.lo);
    case Op::at_most: return truth(x.hi <= y.lo, x.lo > y.hi);
    case Op::at_least: return truth(x.lo >= y.hi, x.hi < y.lo);
    case Op::equal: return truth(x.width() == 0 && y.width() == 0 && x.lo == y.lo, x.hi < y.lo || x.lo > y.hi);
    case Op::unequal: return truth(x.hi < y.lo || x.lo > y.hi, x.width() == 0 && y.width() == 0 && x.lo == y.lo);
    case Op::both: return truth(is_true(a) && is_true(b), is_false(a) || is_false(b));
    case Op::either: return truth(is_true(a) || is_true(b), is_false(a) && is_false(b));
    default: return {all, all};
  }
}

RangeJet choose(const RangeJet& condition, const RangeJet& then, const RangeJet& otherwise) {
  if (is_true(condition)) return then;
  if (is_false(condition)) return otherwise;
  return {hull(then.value, otherwise.value), hull(then.rate, otherwise.rate)};
}

}  // namespace pintle
