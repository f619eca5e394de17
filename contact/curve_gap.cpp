#include "contact/curve_gap.h"

#include <cmath>

#include "contact/plane.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

struct Sloping {
  double value, slope;
};
// The zero of a function that is positive at `low` and negative at `high`: Newton's steps, replaced by bisection where they leave the
// bracket.
template <class F>
double zero_between(const F& f, double low, double high) {
  double s = (low + high) / 2, step = high - low;
  for (int i = 0; i < 100; ++i) {
    const Sloping now = f(s);
    (now.value > 0 ? low : high) = s;
    const double newton = s - now.value / now.slope, before = step;
    const bool inside = std::isfinite(now.slope) && newton >= low && newton <= high && std::abs(newton - s) < std::abs(before) / 2;
    const double next = inside ? newton : (low + high) / 2;
    step = next - s;
    if (now.value == 0 || next == s || std::abs(step) <= 4e-16 * (std::abs(low) + std::abs(high))) return next;
    s = next;
  }
  return s;
}

// The parameter at which a function that decreases along the span is 0; beyond its bent part the span is straight and `f` linear.
template <class F>
double foot(const CurveSpan& span, const F& f) {
  const double low = span.first_bend(), high = span.last_bend();
  const Sloping first = f(low), last = f(high);
  const bool before = !(first.value > 0), after = !(last.value < 0);
  if (!before && !after) return zero_between(f, low, high);
  const bool back = before && after ? f((span.begin() + span.end()) / 2).value < 0 : before;
  const double end = back ? low : high, speed = span.at(end).speed;
  return end + (back ? first.value : last.value) / speed;
}

// Parameter nearest to a point (sign 1), or farthest from it (−1), where it touches a hollow arc about that point.
double foot_of(const CurveSpan& span, const Vector2d& point, double sign) {
  return foot(span, [&](double s) {
    const CurvePoint p = span.at(s);
    const Vector2d up = point - p.at;
    return Sloping{sign * p.along.dot(up), -sign * p.speed * (1 + p.curvature * up.dot(p.normal()))};
  });
}

struct Facing {
  double s;
  bool corner;  ///< all its directions are on one side: its end is touched as a corner
};
// Parameter at which its normal is m; only for round spans.
Facing foot_facing(const CurveSpan& span, const Vector2d& m) {
  const auto off = [&](double s) {
    const CurvePoint p = span.at(s);
    return Sloping{p.along.dot(m), -p.speed * p.curvature * p.normal().dot(m)};
  };
  const double low = span.first_bend(), high = span.last_bend();
  const bool before = !(off(low).value > 0), after = !(off(high).value < 0);
  if (!before && !after) {
    const double s = zero_between(off, low, high);
    return {s, span.at(s).curvature == 0};
  }
  const bool back = before && after ? off((span.begin() + span.end()) / 2).value < 0 : before;
  return {back ? low : high, true};
}

// The parameter of a at which it faces the round span b, in a's axes. These are rotated by `turn` relative to b's; `from` is a's origin in
// b's axes.
double foot_against(const CurveSpan& a, const CurveSpan& b, const Vector2d& from, double turn) {
  return foot(a, [&](double s) {
    const CurvePoint p = a.at(s);
    const Vector2d m = -turned(turn, p.normal());
    const Facing facing = foot_facing(b, m);
    const CurvePoint q = b.at(facing.s);
    const Vector2d up = turned(-turn, q.at - from) - p.at;
    const double round = facing.corner ? 0 : 1 / q.curvature;
    return Sloping{p.along.dot(up), -p.speed * (1 + p.curvature * (up.dot(p.normal()) + round))};
  });
}

OnCurve on(const CurveSpan& span, double s, const CurvePoint& p, bool corner) {
  const double half = (span.end() - span.begin()) / 2;
  return {corner ? std::numeric_limits<double>::infinity() : p.curvature, (s - span.begin()) / half - 1, 1 / (half * p.speed)};
}

struct Feet {
  double a = 0, b = 0;
  bool corner_a = false, corner_b = false;
};
Vector2d towards_the_line(const Piece& line, const MovingPoint& of, const MovingPoint& curve) {
  const double angle = of.angle + line.normal - curve.angle;
  return {-std::cos(angle), -std::sin(angle)};
}
// The parameter of the contact point on a curve, in its own axes, if the other piece is not a curve.
Facing foot_on(const CurveSpan& span, const MovingPoint& by, const Piece& other, const MovingPoint& of) {
  if (other.straight) return foot_facing(span, towards_the_line(other, of, by));
  const Vector2d centre = turned(-by.angle, of.r + turned(of.angle, other.centre) - by.r);
  return {foot_of(span, centre, is_hollow(other) ? -1 : 1), false};
}
Feet feet_of(const PiecePair& pair, const MovingPoint& a, const MovingPoint& b) {
  Feet out;
  if (pair.a.curve && pair.b.curve) {  // the round one is evaluated by direction
    const bool swapped = is_hollow(pair.b);
    const CurveSpan &first = swapped ? *pair.b.curve : *pair.a.curve, &second = swapped ? *pair.a.curve : *pair.b.curve;
    const MovingPoint &p = swapped ? b : a, &q = swapped ? a : b;
    const double turn = p.angle - q.angle;
    const double s = foot_against(first, second, turned(-q.angle, p.r - q.r), turn);
    const Facing facing = foot_facing(second, -turned(turn, first.at(s).normal()));
    out = swapped ? Feet{facing.s, s, facing.corner, false} : Feet{s, facing.s, false, facing.corner};
  } else {
    const bool of_a = pair.a.curve != nullptr;
    const Facing found = of_a ? foot_on(*pair.a.curve, a, pair.b, b) : foot_on(*pair.b.curve, b, pair.a, a);
    (of_a ? out.a : out.b) = found.s;
    (of_a ? out.corner_a : out.corner_b) = found.corner;
  }
  return out;
}

}  // namespace

Gap evaluate_curves(const PiecePair& pair, const MovingPoint& a, const MovingPoint& b) {
  const Feet feet = feet_of(pair, a, b);
  Gap out;
  Vector2d normal_a = out.n, normal_b = out.n;
  const auto stand = [](const Piece& piece, const MovingPoint& by, double s, bool corner, Vector2d& arm, OnCurve& where, Vector2d& normal) {
    if (!piece.curve) {
      arm = turned(by.angle, piece.centre);
      normal = Vector2d(std::cos(by.angle + piece.normal), std::sin(by.angle + piece.normal));
      return;
    }
    const CurvePoint p = piece.curve->at(s);
    arm = turned(by.angle, p.at), normal = turned(by.angle, p.normal());
    where = on(*piece.curve, s, p, corner);
  };
  stand(pair.a, a, feet.a, feet.corner_a, out.arm_a, out.on_a, normal_a);
  stand(pair.b, b, feet.b, feet.corner_b, out.arm_b, out.on_b, normal_b);
  const bool by_a = pair.a.straight || (!pair.b.straight && pair.a.curve && !feet.corner_a);
  out.n = by_a ? normal_a : Vector2d(-normal_b);
  const Vector2d t = perp(out.n), e_rate = a.v + a.w * perp(out.arm_a) - b.v - b.w * perp(out.arm_b);
  out.e = a.r + out.arm_a - b.r - out.arm_b;
  out.depth = pair.a.radius + pair.b.radius + out.n.dot(out.e);
  out.sideways = e_rate.dot(t);
  out.rate = e_rate.dot(out.n);
  if (pair.a.straight || pair.b.straight) {
    out.across = out.e.dot(t);
    out.rate += out.across * (pair.a.straight ? a.w : b.w);
  }
  out.material_slip = out.sideways + a.w * pair.a.radius + b.w * pair.b.radius;
  out.turning = rolling(pair, out).turning.of(out.sideways, a.w, b.w);
  return out;
}

// docs/theory/contact.md, Curves
Rolling rolling(const PiecePair& pair, const Gap& gap) {
  const auto follows = [](const Piece& piece, const OnCurve& where) { return piece.curve && !std::isinf(where.curvature); };
  const bool a = follows(pair.a, gap.on_a), b = follows(pair.b, gap.on_b);
  const double k_a = a ? gap.on_a.curvature : 0, k_b = b ? gap.on_b.curvature : 0;
  Rolling out;
  if ((a || pair.a.straight) && (b || pair.b.straight)) {  // both rotate n, in proportion to their curvatures
    const double whole = k_a + k_b - gap.depth * k_a * k_b;
    out.turning = {-k_a * k_b / whole, k_b / whole, k_a / whole};
    if (a) out.on_a = {-k_b / whole, (gap.depth * k_b - 1) / whole, 1 / whole};
    if (b) out.on_b = {k_a / whole, -1 / whole, (1 - gap.depth * k_a) / whole};
    return out;
  }
  if (pair.a.straight || pair.b.straight) {  // a curve touched as a corner
    (pair.a.straight ? out.turning.a : out.turning.b) = 1;
    return out;
  }
  const double far = gap.n.dot(gap.e), k = a ? k_a : k_b, whole = 1 - k * far;  // a curve and a round piece
  out.turning.across = -k / whole;
  (a ? out.turning.a : out.turning.b) = 1 / whole;
  const double side = a ? 1 : -1;
  Rolling::Part& along = a ? out.on_a : out.on_b;
  along = {side * (far * out.turning.across - 1), side * far * out.turning.a, side * far * out.turning.b};
  return out;
}

std::array<PlaceOn, 2> places_on_curves(const PiecePair& pair, const Gap& gap, const MovingPoint& a, const MovingPoint& b) {
  const Rolling r = rolling(pair, gap);
  const double on_a = r.on_a.of(gap.sideways, a.w, b.w), on_b = r.on_b.of(gap.sideways, a.w, b.w);
  const auto place_of = [&](const Piece& piece, const OnCurve& where, double along, const Vector2d& normal, const MovingPoint& by) {
    if (piece.curve) return PlaceOn{where.at, where.per * along};
    if (piece.straight) {
      const double across = gap.sideways - gap.turning * gap.n.dot(gap.e) + on_a - on_b;
      return PlaceOn{-gap.across / piece.half, -across / piece.half};
    }
    return place_on_arc(piece, gap, normal, by);
  };
  return {place_of(pair.a, gap.on_a, on_a, gap.n, a), place_of(pair.b, gap.on_b, -on_b, -gap.n, b)};
}

}  // namespace pintle
