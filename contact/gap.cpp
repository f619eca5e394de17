#include "contact/gap.h"

#include <cmath>

namespace pintle {

namespace {

using Eigen::Vector2d;

Vector2d turned(double angle, const Vector2d& v) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}
Vector2d quarter_turn(const Vector2d& v) { return {-v.y(), v.x()}; }

// Place and velocity of a piece's middle.
void carry(const Piece& piece, const MovingPoint& by, Vector2d& arm, Vector2d& r, Vector2d& v) {
  r = by.r, v = by.v;
  if (piece.centre.x() == 0 && piece.centre.y() == 0) return;
  arm = turned(by.angle, piece.centre);
  r += arm, v += by.w * quarter_turn(arm);
}

PlaceOn place(const Piece& piece, const Gap& gap, const Vector2d& normal, const MovingPoint& by) {
  if (piece.straight) return {-gap.across / piece.half, (gap.n.dot(gap.e) * gap.turning - gap.sideways) / piece.half};
  if (std::isinf(piece.half)) return {};
  constexpr double turn = 6.283185307179586;
  const double per = (piece.radius < 0 ? -1 : 1) / piece.half;
  return {per * std::remainder(std::atan2(normal.y(), normal.x()) - by.angle - piece.normal, turn), per * (gap.turning - by.w)};
}

}  // namespace

Gap evaluate(const PiecePair& pair, const MovingPoint& a, const MovingPoint& b) {
  // Below this eccentricity its square is no longer a normal number, and n would not be unit [m].
  constexpr double concentric = 1e-140;

  Gap out;
  Vector2d r_a, r_b, v_a, v_b;
  carry(pair.a, a, out.arm_a, r_a, v_a);
  carry(pair.b, b, out.arm_b, r_b, v_b);
  out.e = r_a - r_b;
  const Vector2d e_rate = v_a - v_b;
  const bool straight = pair.a.straight || pair.b.straight;
  double distance = 0;
  if (straight) {
    const double towards = pair.a.straight ? a.angle + pair.a.normal : b.angle + pair.b.normal;
    out.n = pair.a.straight ? Vector2d(std::cos(towards), std::sin(towards)) : Vector2d(-std::cos(towards), -std::sin(towards));
    out.depth = pair.a.radius + pair.b.radius + out.n.dot(out.e);
  } else {
    distance = out.e.norm();
    const bool has_direction = !(distance < concentric);
    const double side = pair.hollow() ? 1 : -1;
    out.n = has_direction ? Vector2d(side * out.e / distance) : Vector2d::UnitX();
    out.depth = side * distance - pair.clearance();
  }

  const Vector2d t = quarter_turn(out.n);
  out.sideways = e_rate.dot(t);
  out.rate = e_rate.dot(out.n);
  out.material_slip = out.sideways + a.w * pair.a.radius + b.w * pair.b.radius;
  if (straight) {
    out.turning = pair.a.straight ? a.w : b.w;
    out.across = out.e.dot(t);
    out.rate += out.across * out.turning;
  } else if (!(distance < concentric)) {
    out.turning = (pair.hollow() ? 1 : -1) * (out.sideways / distance);
    out.geometric_slip = out.depth * out.turning;
  }
  return out;
}

std::array<PlaceOn, 2> places(const PiecePair& pair, const Gap& gap, const MovingPoint& a, const MovingPoint& b) {
  return {place(pair.a, gap, gap.n, a), place(pair.b, gap, -gap.n, b)};
}

}  // namespace pintle
