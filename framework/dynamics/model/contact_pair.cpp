#include "framework/dynamics/model/contact_pair.h"

#include <algorithm>
#include <cmath>

#include "framework/common/result_columns.h"
#include "framework/dynamics/model/massless_boundary.h"

namespace pintle {

using Eigen::Vector2d;

MovingPoint moving_point(const MarkerMotion& m) { return {m.r, m.v, m.w, m.angle}; }

double contact_size(const ContactPair& pair, double mechanism) {
  double out = mechanism;
  if (pair.flank)
    for (const double radius : pitch_radii(*pair.flank))
      if (radius != 0) out = std::min(out, std::abs(radius));
  for (const Piece* piece : {&pair.gap.a, &pair.gap.b})
    if (const double radius = least_radius(*piece); radius > 0) out = std::min(out, radius);
  return out;
}

double fine_length(const ContactPair& pair, double mechanism) {
  constexpr double part = 1e-2;
  if (pair.flank) return pair.flank->half;
  return pair.gap.hollow() ? pair.gap.clearance() : part * contact_size(pair, mechanism);
}

Margin margin(const ContactPair& pair, const Gap& gap, const MovingPoint& a, const MovingPoint& b) {
  Margin out{std::numeric_limits<double>::infinity(), 0, -1};
  const std::array<PlaceOn, 2> place = places(pair.gap, gap, a, b);
  const std::array<const Piece*, 2> pieces{&pair.gap.a, &pair.gap.b};
  const auto size = [](const Piece& p) { return p.straight || p.curve ? p.half : std::abs(p.radius); };
  for (std::size_t i = 0; i < 2; ++i) {
    const Piece& piece = *pieces[i];
    if (std::isinf(piece.half)) continue;
    const double length = piece.half * (piece.straight || piece.curve ? 1 : std::max(size(piece), size(*pieces[1 - i])));
    for (const int side : {-1, 1}) {
      const std::size_t k = 2 * i + (side > 0);
      const double left = (pair.extent[k] - side * place[i].at) * length;
      if (left < out.value) out = {left, -side * place[i].rate * length, static_cast<int>(k)};
    }
  }
  return out;
}

Approach approach_of(const ContactPair& pair, double depth, double rate, double latched) {
  return {depth, rate, pair.follows ? std::max(latched, rate) : latched};
}

const Coulomb* dry_friction(const ContactPair& pair) {
  return pair.friction && !is_held(pair) ? std::get_if<Coulomb>(&*pair.friction) : nullptr;
}

namespace {

FrictionForce friction_of(const ContactPair& pair, double slip, double normal, const DryFriction& dry, const double* x) {
  if (has_bristles(pair)) {
    const BristleForce bristles = bend(*pair.friction, slip, x);
    return {bristles.force * normal, bristles.d_speed * normal, bristles.force};
  }
  const auto* coulomb = std::get_if<Coulomb>(&*pair.friction);
  if (!coulomb) return evaluate(*pair.friction, slip, normal);
  if (dry.direction == 0 || dry.direction == DryFriction::given) return {.force = dry.force};
  if (dry.direction == DryFriction::undecided) return {};
  return evaluate(*coulomb, slip, normal, dry.direction);
}

}  // namespace

double sliding_speed(const ContactPair& pair, const Gap& gap) {
  return pair.sliding == Sliding::material ? gap.material_slip : gap.geometric_slip;
}

bool has_bristles(const ContactPair& pair) {
  return pair.friction && !is_held(pair) && !is_rigid(pair) && bristle_states(*pair.friction) > 0;
}

std::vector<InternalState> internal_states(const FrictionLaw& law) {
  const auto& [bristle, dwell] = column::bristle;
  std::vector<InternalState> all{{bristle.name, bristle.unit, breakaway_deflection(law)}, {dwell.name, dwell.unit, 1}};
  all.resize(static_cast<std::size_t>(bristle_states(law)));
  return all;
}

// Slip bends the bristles even without a normal force.
ContactEffect evaluate(const ContactPair& pair, const MarkerMotion& a, const MarkerMotion& b, double impact_rate, const DryFriction& dry,
                       const double* x) {
  ContactEffect out;
  if (pair.profiles && impact_rate <= 0) return out;
  out.gap = gap_between(pair, moving_point(a), moving_point(b));
  if (impact_rate <= 0 || is_held(pair)) return out;
  if (pair.massless) {
    if (out.gap.depth > 0) press_massless(pair, moving_point(a), moving_point(b), impact_rate, out);
    return out;
  }
  const double slip = sliding_speed(pair, out.gap);
  if (is_rigid(pair)) {
    out.normal.force = dry.load;
  } else {
    if (has_bristles(pair)) out.x_rate = bend(*pair.friction, slip, x).rate;
    if (out.gap.depth <= 0 && !begins_with_jump(pair.normal)) return out;
    out.normal = evaluate(pair.normal, approach_of(pair, out.gap.depth, out.gap.rate, impact_rate));
    if (pair.follows && out.gap.rate > impact_rate) out.normal.d_rate = viscous_damping(pair.normal);
  }
  Vector2d force = -out.normal.force * out.gap.n;
  if (pair.friction && (out.normal.force > 0 || is_rigid(pair))) {
    const FrictionForce law = friction_of(pair, slip, out.normal.force, dry, x);
    out.friction = law.force, out.d_slip = law.d_speed, out.d_normal = law.d_normal;
    const bool slides = !dry_friction(pair) || std::abs(dry.direction) == 1 || dry.direction == DryFriction::given;
    if (slides) out.friction_loss = -out.friction * slip;
    force += out.friction * perp(out.gap.n);
  }
  const double couple = cross(out.gap.n, force);
  out.on_a << force, pair.gap.a.radius * couple;
  out.on_b << -force, pair.gap.b.radius * couple;
  if (!pair.profiles) return out;
  const double pressed = out.gap.across * out.normal.force;
  out.on_a[2] += cross(out.gap.arm_a, force) - (pair.gap.a.straight ? pressed : 0);
  out.on_b[2] -= cross(out.gap.arm_b, force) + (pair.gap.b.straight ? pressed : 0);
  return out;
}

std::array<Wrench, 2> unit_friction(const ContactPair& pair, const Gap& gap) {
  const Vector2d t = perp(gap.n);
  return {Wrench(t.x(), t.y(), pair.gap.a.radius + cross(gap.arm_a, t)), Wrench(-t.x(), -t.y(), pair.gap.b.radius - cross(gap.arm_b, t))};
}

std::array<Wrench, 2> unit_normal(const ContactPair& pair, const Gap& gap) {
  const Vector2d& n = gap.n;
  return {Wrench(-n.x(), -n.y(), -cross(gap.arm_a, n) - (pair.gap.a.straight ? gap.across : 0)),
          Wrench(n.x(), n.y(), cross(gap.arm_b, n) - (pair.gap.b.straight ? gap.across : 0))};
}

void add_friction(const ContactPair& pair, double force, ContactEffect& effect) {
  const std::array<Wrench, 2> unit = unit_friction(pair, effect.gap);
  effect.friction += force;
  effect.on_a += force * unit[0];
  effect.on_b += force * unit[1];
}

void add_normal(const ContactPair& pair, double force, ContactEffect& effect) {
  const std::array<Wrench, 2> unit = unit_normal(pair, effect.gap);
  effect.normal.force += force;
  effect.on_a += force * unit[0];
  effect.on_b += force * unit[1];
}

namespace {

// Velocity of a's middle relative to b's, and the part of its rate due only to the rotation of the bodies.
Vector2d speed_of_middles(const Gap& gap, const MarkerMotion& a, const MarkerMotion& b) {
  return a.v + a.w * perp(gap.arm_a) - b.v - b.w * perp(gap.arm_b);
}
Vector2d inwards(const Gap& gap, const MarkerMotion& a, const MarkerMotion& b) { return b.w * b.w * gap.arm_b - a.w * a.w * gap.arm_a; }
double of_markers(const std::array<Wrench, 2>& unit, const MarkerMotion& a, const MarkerMotion& b) {
  return unit[0].head<2>().dot(a.a0) + unit[0][2] * a.alpha0 + unit[1].head<2>().dot(b.a0) + unit[1][2] * b.alpha0;
}

}  // namespace

double slip_acceleration(const ContactPair& pair, const Gap& gap, const MarkerMotion& a, const MarkerMotion& b) {
  return of_markers(unit_friction(pair, gap), a, b) + inwards(gap, a, b).dot(perp(gap.n)) -
         gap.turning * speed_of_middles(gap, a, b).dot(gap.n);
}

// d/dt of −n·v − s w, where w is the spin of the straight piece and s = e·Zn; on curves the contact points also move along them.
double opening_acceleration(const ContactPair& pair, const Gap& gap, const MarkerMotion& a, const MarkerMotion& b) {
  if (pair.flank) return of_markers(unit_normal(pair, gap), a, b) - closing_acceleration(*pair.flank, moving_point(a), moving_point(b));
  const double sideways = speed_of_middles(gap, a, b).dot(perp(gap.n));
  const double spin = pair.gap.a.straight ? a.w : pair.gap.b.straight ? b.w : 0;
  const double out = of_markers(unit_normal(pair, gap), a, b) - inwards(gap, a, b).dot(gap.n) - gap.turning * sideways -
                     spin * (sideways - gap.turning * gap.e.dot(gap.n));
  if (!pair.gap.curved()) return out;
  const Rolling r = rolling(pair.gap, gap);
  return out + (a.w - spin) * r.on_a.of(sideways, a.w, b.w) - (b.w - spin) * r.on_b.of(sideways, a.w, b.w);
}

namespace {

using Row = Eigen::Matrix<double, 1, 6>;  // derivatives with respect to the poses of the two middles, or to their rates

Row in_poses(const Rolling::Part& part, const Vector2d& t) {
  return (Row() << part.across * t.transpose(), part.a, -part.across * t.transpose(), part.b).finished();
}

// How the gap depends on the middles of the pieces, each with its own v: docs/theory/contact.md.
struct GapRows {
  Row n_p, s_p;                                // dn = Zn · n_p dp; derivative of `across`
  Row on_a = Row::Zero(), on_b = Row::Zero();  // how far the contact points move along their curves
  Row depth_p, rate_p, rate_v, slip_p, slip_v;
};

GapRows rows_of(const ContactPair& pair, const Gap& gap, const Vector2d& v, double w_a, double w_b) {
  const Piece &a = pair.gap.a, &b = pair.gap.b;
  const Vector2d &n = gap.n, t = perp(n);
  const double s = gap.across;
  const double spin = a.straight ? w_a : b.straight ? w_b : 0;  // of the straight piece; n rotates with it
  const bool curved = pair.gap.curved();
  const double curving = a.straight || b.straight || curved ? 0 : 1 / n.dot(gap.e);     // rotation of n per displacement across e
  const double across = v.dot(t), along = v.dot(n), turning = curving * across + spin;  // turning: rate of rotation of n

  const auto between = [](const Vector2d& d) { return (Row() << d.transpose(), 0, -d.transpose(), 0).finished(); };
  GapRows out;
  out.n_p = between(curving * t);
  out.n_p[2] += a.straight, out.n_p[5] += b.straight;
  if (curved) {
    const Rolling r = rolling(pair.gap, gap);
    out.n_p = in_poses(r.turning, t), out.on_a = in_poses(r.on_a, t), out.on_b = in_poses(r.on_b, t);
  }
  out.depth_p = between(n) + s * out.n_p, out.s_p = between(t) - n.dot(gap.e) * out.n_p;
  if (curved) out.s_p += out.on_a - out.on_b;
  out.rate_v = between(n);
  out.rate_v[2] += s * a.straight, out.rate_v[5] += s * b.straight;
  out.rate_p = across * out.n_p + spin * (a.straight || b.straight ? out.s_p : Row::Zero());
  if (curved) out.rate_p += w_b * out.on_b - w_a * out.on_a;
  out.slip_v = between(t), out.slip_p = -along * out.n_p;
  if (pair.sliding == Sliding::material) {
    out.slip_v[2] += a.radius, out.slip_v[5] += b.radius;
  } else {  // arcs: depth · turning
    out.slip_v *= gap.depth * curving;
    out.slip_p = turning * out.depth_p + gap.depth * curving * out.slip_p - gap.depth * curving * turning * between(n);
  }
  return out;
}

WrenchTangent at_middles(const ContactPair& pair, const ContactEffect& now, const GapRows& of) {
  const Piece &a = pair.gap.a, &b = pair.gap.b;
  const Vector2d &n = now.gap.n, t = perp(n);
  const double N = now.normal.force, T = now.friction, s = now.gap.across;
  const Row N_p = now.normal.d_depth * of.depth_p + now.normal.d_rate * of.rate_p, N_v = now.normal.d_rate * of.rate_v;
  Row T_p = Row::Zero(), T_v = Row::Zero();
  if (pair.friction) {
    T_p = now.d_slip * of.slip_p + now.d_normal * N_p;
    T_v = now.d_slip * of.slip_v + now.d_normal * N_v;
  }

  WrenchTangent out(2);
  const auto place = [&](auto& to, const Row& dN, const Row& dT, const Row& dn, const Row& ds) {
    const Eigen::Matrix<double, 2, 6> force = t * dT - n * dN - (N * t + T * n) * dn;
    to.template topRows<2>() = force;
    to.template middleRows<2>(3) = -force;
    to.row(2) = a.radius * dT - a.straight * (s * dN + N * ds);
    to.row(5) = b.radius * dT - b.straight * (s * dN + N * ds);
  };
  place(out.pose, N_p, T_p, of.n_p, of.s_p);
  out.pose.row(2) += N * of.on_a, out.pose.row(5) -= N * of.on_b;
  place(out.rate, N_v, T_v, Row::Zero(), Row::Zero());
  return out;
}

// Converts derivatives at the middles into derivatives at the carrying points, which carry the middles on arms d: dp = dr + Zd dθ, dṗ = dv
// + Zd dw − d w dθ.
template <class Matrix>
void by_carriers(const std::array<Vector2d, 2>& arm, const std::array<double, 2>& w, Matrix& pose, Matrix& rate) {
  for (int j = 0; j < 2; ++j) {
    const Vector2d &d = arm[static_cast<std::size_t>(j)], side = perp(d);
    const auto r = Eigen::seqN(3 * j, 2);
    const int angle = 3 * j + 2;
    pose.col(angle) += pose(Eigen::all, r) * side - w[static_cast<std::size_t>(j)] * rate(Eigen::all, r) * d;
    rate.col(angle) += rate(Eigen::all, r) * side;
  }
}

// The same for wrenches, which at the carrying points gain the moment d × F.
void move_to_carriers(const std::array<Vector2d, 2>& arm, const std::array<double, 2>& w, const Vector2d& force, WrenchTangent& tangent) {
  by_carriers(arm, w, tangent.pose, tangent.rate);
  for (int i = 0; i < 2; ++i) {
    const Vector2d& d = arm[static_cast<std::size_t>(i)];
    for (auto* of : {&tangent.pose, &tangent.rate}) of->row(3 * i + 2) += d.x() * of->row(3 * i + 1) - d.y() * of->row(3 * i);
    tangent.pose(3 * i + 2, 3 * i + 2) -= (i == 0 ? 1 : -1) * d.dot(force);
  }
}

}  // namespace

WrenchTangent wrench_tangent(const ContactPair& pair, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b) {
  if (now.normal.force == 0) return WrenchTangent(2);
  if (pair.flank) return wrench_tangent(*pair.flank, now.normal, moving_point(a), moving_point(b));
  if (pair.massless) return massless_tangent(pair, now, moving_point(a), moving_point(b));
  const Gap& gap = now.gap;
  WrenchTangent out = at_middles(pair, now, rows_of(pair, gap, speed_of_middles(gap, a, b), a.w, b.w));
  if (pair.profiles) move_to_carriers({gap.arm_a, gap.arm_b}, {a.w, b.w}, now.on_a.head<2>(), out);
  return out;
}

InternalTangent internal_tangent(const ContactPair& pair, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b,
                                 const double* x) {
  const Gap& gap = now.gap;
  const BristleForce law = bend(*pair.friction, sliding_speed(pair, gap), x);
  GapRows of = rows_of(pair, gap, speed_of_middles(gap, a, b), a.w, b.w);
  if (pair.profiles) by_carriers<Row>({gap.arm_a, gap.arm_b}, {a.w, b.w}, of.slip_p, of.slip_v);
  const std::array<Wrench, 2> unit = unit_friction(pair, gap);
  InternalTangent out(2, bristle_states(*pair.friction));
  for (Eigen::Index i = 0; i < out.n(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.wrench.col(i) << now.normal.force * law.d_state[k] * unit[0], now.normal.force * law.d_state[k] * unit[1];
    out.g_pose.row(i) = law.rate_d_speed[k] * of.slip_p;
    out.g_rate.row(i) = law.rate_d_speed[k] * of.slip_v;
    for (Eigen::Index j = 0; j < out.n(); ++j) out.g_x(i, j) = law.rate_d_state[k][static_cast<std::size_t>(j)];
  }
  return out;
}

}  // namespace pintle
