#include "contact/gap.h"

#include <cmath>

#include "contact/curve_gap.h"
#include "contact/plane.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

bool off_its_point(const Piece& piece) { return piece.centre.x() != 0 || piece.centre.y() != 0; }

PlaceOn place(const Piece& piece, const Gap& gap, const Vector2d& normal, const MovingPoint& by) {
  if (piece.straight) return {-gap.across / piece.half, (gap.n.dot(gap.e) * gap.turning - gap.sideways) / piece.half};
  return place_on_arc(piece, gap, normal, by);
}

}  // namespace

PlaceOn place_on_arc(const Piece& piece, const Gap& gap, const Vector2d& normal, const MovingPoint& by) {
  if (std::isinf(piece.half)) return {};
  constexpr double turn = 6.283185307179586;
  const double per = (piece.radius < 0 ? -1 : 1) / piece.half;
  return {per * std::remainder(std::atan2(normal.y(), normal.x()) - by.angle - piece.normal, turn), per * (gap.turning - by.w)};
}

namespace {

// Below this eccentricity its square is not a normal number, and n would not be a unit vector [m].
constexpr double concentric = 1e-140;

// Between two arcs, with out.e known.
void between_arcs(const PiecePair& pair, const Vector2d& e_rate, double w_a, double w_b, Gap& out) {
  const double distance = out.e.norm(), side = pair.hollow() ? 1 : -1;
  const bool has_direction = !(distance < concentric);
  if (has_direction) out.n = side * out.e / distance;
  out.depth = side * distance - pair.clearance();
  out.sideways = e_rate.y() * out.n.x() - e_rate.x() * out.n.y();
  out.rate = e_rate.x() * out.n.x() + e_rate.y() * out.n.y();
  out.material_slip = out.sideways + w_a * pair.a.radius + w_b * pair.b.radius;
  if (!has_direction) return;
  out.turning = side * (out.sideways / distance);
  out.geometric_slip = out.depth * out.turning;
}

void along_a_line(const PiecePair& pair, const Vector2d& e_rate, const MovingPoint& a, const MovingPoint& b, Gap& out) {
  const bool of_a = pair.a.straight;
  const double towards = of_a ? a.angle + pair.a.normal : b.angle + pair.b.normal;
  out.n = (of_a ? 1 : -1) * Vector2d(std::cos(towards), std::sin(towards));
  const Vector2d t = perp(out.n);
  out.depth = pair.a.radius + pair.b.radius + out.n.dot(out.e);
  out.turning = of_a ? a.w : b.w;
  out.across = out.e.dot(t);
  out.sideways = e_rate.dot(t);
  out.rate = e_rate.dot(out.n) + out.across * out.turning;
  out.material_slip = out.sideways + a.w * pair.a.radius + b.w * pair.b.radius;
}

}  // namespace

double least_radius(const Piece& piece) { return piece.curve ? piece.curve->least_radius() : std::abs(piece.radius); }

Gap evaluate(const PiecePair& pair, const MovingPoint& a, const MovingPoint& b) {
  if (pair.curved()) return evaluate_curves(pair, a, b);
  Gap out;
  out.e = a.r - b.r;
  Vector2d e_rate = a.v - b.v;
  if (off_its_point(pair.a)) {
    out.arm_a = turned(a.angle, pair.a.centre);
    out.e += out.arm_a, e_rate += a.w * perp(out.arm_a);
  }
  if (off_its_point(pair.b)) {
    out.arm_b = turned(b.angle, pair.b.centre);
    out.e -= out.arm_b, e_rate -= b.w * perp(out.arm_b);
  }
  if (pair.a.straight || pair.b.straight)
    along_a_line(pair, e_rate, a, b, out);
  else
    between_arcs(pair, e_rate, a.w, b.w, out);
  return out;
}

Vector2d touched(const Piece& piece, const Vector2d& middle, const Vector2d& normal, double across) {
  return middle + piece.radius * normal - (piece.straight ? across : 0) * perp(normal);
}

std::array<PlaceOn, 2> places(const PiecePair& pair, const Gap& gap, const MovingPoint& a, const MovingPoint& b) {
  if (pair.curved()) return places_on_curves(pair, gap, a, b);
  return {place(pair.a, gap, gap.n, a), place(pair.b, gap, -gap.n, b)};
}

}  // namespace pintle
