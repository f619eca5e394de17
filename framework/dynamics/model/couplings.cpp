#include "framework/dynamics/model/couplings.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "framework/common/index.h"
#include "framework/dynamics/model/joint_parts.h"

namespace pintle {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Block = ConstraintRows::Block;
using M = const MarkerMotion&;
using namespace joint_parts;

// ---- gears: r_a φ_a + r_b φ_b − s ψ, s = r_a + r_b, ψ̇ = n·ḋ/|d|, n = Ze ----

// A whole turn of the line of centres gives the same line, so C is the value of raw + 2π s k nearest to 0.
double nearest_to_zero(double raw, double s) {
  const double turn = 2 * std::numbers::pi * std::abs(s);
  return turn > 0 ? std::remainder(raw, turn) : raw;
}
double sum_of_radii(const Gear& j) {
  constexpr double rounding = 1e-12;
  const double s = j.radius_a + j.radius_b;
  return std::abs(s) > rounding * std::abs(j.radius_a) ? s : 0;
}
void mesh(const Gear& j, M a, M b, int row, ConstraintRows& out, Block* L) {
  const Vector2d d = b.r - a.r;
  const double s = sum_of_radii(j), length = d.norm();
  const Vector2d across = length > 0 ? Vector2d(s / length * perp(direction(a, b))) : Vector2d(0, 0);
  out.C[row] = nearest_to_zero(j.radius_a * a.angle + j.radius_b * b.angle - s * std::atan2(d.y(), d.x()) - j.phase, s);
  L[0].row(row) << across.x(), across.y(), j.radius_a;
  L[1].row(row) << -across.x(), -across.y(), j.radius_b;
}
double mesh_kappa(const Gear& j, M a, M b) {
  const Vector2d e = direction(a, b), v = b.v - a.v;
  const double length = (b.r - a.r).norm();
  return length > 0 ? 2 * sum_of_radii(j) * e.dot(v) * cross(e, v) / (length * length) : 0;
}
// The Hessian of C with respect to d.
Matrix2d mesh_curvature(const Gear& j, M a, M b) {
  const double length = (b.r - a.r).norm();
  if (length == 0) return Matrix2d::Zero();
  const Vector2d e = direction(a, b), n = perp(e);
  return sum_of_radii(j) / (length * length) * (e * n.transpose() + n * e.transpose());
}

// ---- racks: u·d + r (φ_b − φ_a) ----

void mesh(const Rack& j, M a, M b, int row, ConstraintRows& out, Block* L) {
  project(a, b, a.u, row, out, L);
  out.C[row] += j.radius * (b.angle - a.angle) - j.phase;
  L[0](row, 2) -= j.radius;
  L[1](row, 2) += j.radius;
}

double side(double radius) { return radius < 0 ? -1 : 1; }

// ---- relations ----

/// A coordinate between two markers, with its derivatives with respect to their poses.
struct Measured {
  double value;
  Vector3d on_a, on_b;
};
Measured measured(Coordinate::Kind kind, M a, M b) {
  const Vector2d d = b.r - a.r;
  if (kind == Coordinate::angle) return {b.angle - a.angle, {0, 0, -1}, {0, 0, 1}};
  if (kind == Coordinate::displacement) return {a.u.dot(d), {-a.u.x(), -a.u.y(), perp(a.u).dot(d)}, {a.u.x(), a.u.y(), 0}};
  const Vector2d e = direction(a, b);
  return {d.norm(), {-e.x(), -e.y(), 0}, {e.x(), e.y(), 0}};
}
double measured_kappa(Coordinate::Kind kind, M a, M b) {
  if (kind == Coordinate::angle) return 0;
  return kind == Coordinate::displacement ? project_kappa(a, b, a.u) : keep_length_kappa(a, b);
}
// Minus the Hessian of λ c.
void measured_tangent(const Coordinate& c, M a, M b, double lambda, WrenchTangent& out) {
  if (c.kind == Coordinate::displacement) project_tangent(a, b, a.u, lambda, out, c.a, c.b);
  if (c.kind != Coordinate::distance) return;
  const Matrix2d K = lambda * length_curvature(a, b);
  const Eigen::Index i = place_of(c.a), j = place_of(c.b);
  out.pose.block<2, 2>(i, i) -= K;
  out.pose.block<2, 2>(j, j) -= K;
  out.pose.block<2, 2>(i, j) += K;
  out.pose.block<2, 2>(j, i) += K;
}

M end(const Relation& j, const MarkerMotion* m, int i) { return m[j.ends.marker[at(i)]]; }
// The curve evaluated at the first coordinate.
Jet curve_now(const Relation& j, const MarkerMotion* m) {
  const Coordinate& c = j.coordinates.front();
  return j.curve ? j.curve(measured(c.kind, end(j, m, c.a), end(j, m, c.b)).value) : Jet{};
}

}  // namespace

void pose(const Gear& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) { mesh(j, m[j.a], m[j.b], 0, out, L); }
void speed(const Gear& j, const MarkerMotion* m, double, ConstraintRows& out) { out.kappa[0] = mesh_kappa(j, m[j.a], m[j.b]); }
void curve(const Gear& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  oppose(lambda[0] * mesh_curvature(j, m[j.a], m[j.b]), out.pose);
}

void pose(const Rack& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) { mesh(j, m[j.a], m[j.b], 0, out, L); }
void speed(const Rack& j, const MarkerMotion* m, double, ConstraintRows& out) { out.kappa[0] = project_kappa(m[j.a], m[j.b], m[j.a].u); }
void curve(const Rack& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  project_tangent(m[j.a], m[j.b], m[j.a].u, lambda[0], out);
}

void pose(const RollsOnDisc& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) {
  keep_length(m[j.a], m[j.b], std::abs(j.radius_a + j.radius_b), 0, out, L);
  const double sign = side(j.radius_b);
  out.C[0] *= sign;
  L[0].row(0) *= sign;
  L[1].row(0) *= sign;
  mesh(j, m[j.a], m[j.b], 1, out, L);
}
void speed(const RollsOnDisc& j, const MarkerMotion* m, double, ConstraintRows& out) {
  out.kappa[0] = side(j.radius_b) * keep_length_kappa(m[j.a], m[j.b]);
  out.kappa[1] = mesh_kappa(j, m[j.a], m[j.b]);
}
void curve(const RollsOnDisc& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  oppose(side(j.radius_b) * lambda[0] * length_curvature(m[j.a], m[j.b]) + lambda[1] * mesh_curvature(j, m[j.a], m[j.b]), out.pose);
}

void pose(const RollsOnLine& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) {
  project(m[j.a], m[j.b], side(j.radius) * perp(m[j.a].u), 0, out, L);
  out.C[0] -= std::abs(j.radius);
  mesh(j, m[j.a], m[j.b], 1, out, L);
}
void speed(const RollsOnLine& j, const MarkerMotion* m, double, ConstraintRows& out) {
  out.kappa[0] = project_kappa(m[j.a], m[j.b], side(j.radius) * perp(m[j.a].u));
  out.kappa[1] = project_kappa(m[j.a], m[j.b], m[j.a].u);
}
void curve(const RollsOnLine& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  project_tangent(m[j.a], m[j.b], side(j.radius) * perp(m[j.a].u), lambda[0], out);
  project_tangent(m[j.a], m[j.b], m[j.a].u, lambda[1], out);
}

void pose(const Relation& j, const MarkerMotion* m, double, ConstraintRows& out, Block* L) {
  const Jet f = curve_now(j, m);
  out.C[0] = -f.value - j.constant;
  for (int i = 0; i < j.ends.n; ++i) L[i].row(0).setZero();
  for (const Coordinate& c : j.coordinates) {
    const Measured now = measured(c.kind, end(j, m, c.a), end(j, m, c.b));
    const double slope = c.ratio - (&c == &j.coordinates.front() ? f.rate : 0);
    out.C[0] += c.ratio * now.value;
    L[c.a].row(0) += slope * now.on_a;
    L[c.b].row(0) += slope * now.on_b;
  }
}
void speed(const Relation& j, const MarkerMotion* m, double, ConstraintRows& out) {
  const Jet f = curve_now(j, m);
  out.kappa[0] = 0;
  for (const Coordinate& c : j.coordinates) {
    const bool first = &c == &j.coordinates.front();
    M a = end(j, m, c.a), b = end(j, m, c.b);
    out.kappa[0] += (c.ratio - (first ? f.rate : 0)) * measured_kappa(c.kind, a, b);
    if (!first || !j.curve) continue;
    const Measured now = measured(c.kind, a, b);
    const double rate = now.on_a.dot(Vector3d(a.v.x(), a.v.y(), a.w)) + now.on_b.dot(Vector3d(b.v.x(), b.v.y(), b.w));
    out.kappa[0] -= f.accel * rate * rate;
  }
}
void curve(const Relation& j, const MarkerMotion* m, const double* lambda, WrenchTangent& out) {
  const Jet f = curve_now(j, m);
  for (const Coordinate& c : j.coordinates) {
    const bool first = &c == &j.coordinates.front();
    M a = end(j, m, c.a), b = end(j, m, c.b);
    measured_tangent(c, a, b, (c.ratio - (first ? f.rate : 0)) * lambda[0], out);
    if (!first || !j.curve) continue;
    const Measured now = measured(c.kind, a, b);  // + λ curve'' ∇c ∇cᵀ
    const double bend = lambda[0] * f.accel;
    const Eigen::Index p = place_of(c.a), q = place_of(c.b);
    out.pose.block<3, 3>(p, p) += bend * now.on_a * now.on_a.transpose();
    out.pose.block<3, 3>(p, q) += bend * now.on_a * now.on_b.transpose();
    out.pose.block<3, 3>(q, p) += bend * now.on_b * now.on_a.transpose();
    out.pose.block<3, 3>(q, q) += bend * now.on_b * now.on_b.transpose();
  }
}

Relation relation(bool of_angles, const JointEnds& ends, std::vector<Coordinate> coordinates, TimeLaw curve) {
  Relation out{ends, std::move(coordinates), std::move(curve)};
  JointProperties& of = out.properties;
  of = {.equations = {of_angles ? "angle" : "length"}, .force = false, .angles = false};
  if (!of_angles) of.efforts = {".force"};
  for (const Coordinate& c : out.coordinates) {
    const bool bends = (&c == &out.coordinates.front() && out.curve) || c.kind == Coordinate::distance;
    of.force = of.force || c.kind != Coordinate::angle;
    of.couple = of.couple || c.kind != Coordinate::distance;
    if (c.kind == Coordinate::displacement) of.directions[at(c.a)] = true;
    const auto answer = [&](int i, int k) { of.curvature.block[at(i)][at(k)] = true; };
    if (bends) answer(c.b, c.b);
    if (bends || c.kind == Coordinate::displacement) answer(c.a, c.a), answer(c.a, c.b), answer(c.b, c.a);
  }
  of.angles = of.couple;
  return out;
}

}  // namespace pintle
