#include "framework/dynamics/model/joints.h"

#include <cmath>
#include <string_view>

namespace pintle {

namespace {

using Eigen::Vector2d;

// Rows shared by several joints. `row` is where they start.

void coincide(const MarkerMotion& a, const MarkerMotion& b, ConstraintRows& out) {
  out.C.head<2>() = b.r - a.r;
  out.La.row(0) << -1, 0, 0;
  out.La.row(1) << 0, -1, 0;
  out.Lb.row(0) << 1, 0, 0;
  out.Lb.row(1) << 0, 1, 0;
  out.kappa.head<2>().setZero();
}

// C = n·d with d = r_b − r_a;  Ċ = n·ḋ − w_a u·d
void ride_line(const MarkerMotion& a, const MarkerMotion& b, ConstraintRows& out) {
  const Vector2d n = perp(a.u), d = b.r - a.r;
  out.C[0] = n.dot(d);
  out.La.row(0) << -n.x(), -n.y(), -a.u.dot(d);
  out.Lb.row(0) << n.x(), n.y(), 0;
}
double ride_line_kappa(const MarkerMotion& a, const MarkerMotion& b) {
  const Vector2d d = b.r - a.r, dv = b.v - a.v;
  return -2 * a.w * a.u.dot(dv) - a.w * a.w * perp(a.u).dot(d);
}

void keep_angle(const MarkerMotion& a, const MarkerMotion& b, double angle, int row,
                ConstraintRows& out) {
  out.C[row] = b.angle - a.angle - angle;
  out.La.row(row) << 0, 0, -1;
  out.Lb.row(row) << 0, 0, 1;
  out.kappa[row] = 0;
}

// C = |d| − length;  Ċ = e·ḋ;  C̈ = e·d̈ + (|ḋ|² − (e·ḋ)²)/|d|
Vector2d direction(const MarkerMotion& a, const MarkerMotion& b) {
  const Vector2d d = b.r - a.r;
  const double length = d.norm();
  return length > 0 ? Vector2d(d / length) : Vector2d(1, 0);
}
void keep_length(const MarkerMotion& a, const MarkerMotion& b, double length, ConstraintRows& out) {
  const Vector2d e = direction(a, b);
  out.C[0] = (b.r - a.r).norm() - length;
  out.La.row(0) << -e.x(), -e.y(), 0;
  out.Lb.row(0) << e.x(), e.y(), 0;
}
double keep_length_kappa(const MarkerMotion& a, const MarkerMotion& b) {
  const double across = cross(direction(a, b), b.v - a.v), length = (b.r - a.r).norm();
  return length > 0 ? across * across / length : 0;
}

void pose(const Revolute&, const MarkerMotion& a, const MarkerMotion& b, double, ConstraintRows& out) {
  coincide(a, b, out);
}
void pose(const Slot&, const MarkerMotion& a, const MarkerMotion& b, double, ConstraintRows& out) {
  ride_line(a, b, out);
}
void pose(const Prismatic& j, const MarkerMotion& a, const MarkerMotion& b, double,
          ConstraintRows& out) {
  ride_line(a, b, out);
  keep_angle(a, b, j.angle, 1, out);
}
void pose(const Weld& j, const MarkerMotion& a, const MarkerMotion& b, double, ConstraintRows& out) {
  coincide(a, b, out);
  keep_angle(a, b, j.angle, 2, out);
}
void pose(const Distance& j, const MarkerMotion& a, const MarkerMotion& b, double,
          ConstraintRows& out) {
  keep_length(a, b, j.length, out);
}
void pose(const AngleDriver& j, const MarkerMotion& a, const MarkerMotion& b, double t,
          ConstraintRows& out) {
  keep_angle(a, b, j.law(t).value, 0, out);
}
void pose(const DistanceDriver& j, const MarkerMotion& a, const MarkerMotion& b, double t,
          ConstraintRows& out) {
  keep_length(a, b, j.law(t).value, out);
}

void speed(const Revolute&, const MarkerMotion&, const MarkerMotion&, double, ConstraintRows&) {}
void speed(const Slot&, const MarkerMotion& a, const MarkerMotion& b, double, ConstraintRows& out) {
  out.kappa[0] = ride_line_kappa(a, b);
}
void speed(const Prismatic&, const MarkerMotion& a, const MarkerMotion& b, double,
           ConstraintRows& out) {
  out.kappa[0] = ride_line_kappa(a, b);
}
void speed(const Weld&, const MarkerMotion&, const MarkerMotion&, double, ConstraintRows&) {}
void speed(const Distance&, const MarkerMotion& a, const MarkerMotion& b, double,
           ConstraintRows& out) {
  out.kappa[0] = keep_length_kappa(a, b);
}
void speed(const AngleDriver& j, const MarkerMotion&, const MarkerMotion&, double t,
           ConstraintRows& out) {
  const Jet law = j.law(t);
  out.Ct[0] = -law.rate;
  out.kappa[0] = -law.accel;
}
void speed(const DistanceDriver& j, const MarkerMotion& a, const MarkerMotion& b, double t,
           ConstraintRows& out) {
  const Jet law = j.law(t);
  out.Ct[0] = -law.rate;
  out.kappa[0] = keep_length_kappa(a, b) - law.accel;
}

}  // namespace

bool is_driver(const Joint& j) {
  return std::holds_alternative<AngleDriver>(j) || std::holds_alternative<DistanceDriver>(j);
}

const char* row_name(const Joint& j, int row) {
  if (std::holds_alternative<Revolute>(j) || std::holds_alternative<Weld>(j))
    return row == 0 ? "x" : row == 1 ? "y" : "angle";
  if (std::holds_alternative<Slot>(j) || std::holds_alternative<Prismatic>(j))
    return row == 0 ? "across" : "angle";
  return std::holds_alternative<AngleDriver>(j) ? "angle" : "length";
}

bool is_angle_row(const Joint& j, int row) {
  return std::string_view(row_name(j, row)) == "angle";
}

bool feels_angle(const Joint& j) {
  return !(std::holds_alternative<Revolute>(j) || std::holds_alternative<Distance>(j) || std::holds_alternative<DistanceDriver>(j));
}

void evaluate_pose(const Joint& j, const MarkerMotion& a, const MarkerMotion& b, double t,
                   ConstraintRows& out) {
  std::visit([&](const auto& k) { pose(k, a, b, t, out); }, j);
}

void evaluate_speed(const Joint& j, const MarkerMotion& a, const MarkerMotion& b, double t,
                    ConstraintRows& out) {
  std::visit([&](const auto& k) { speed(k, a, b, t, out); }, j);
}

}  // namespace pintle
