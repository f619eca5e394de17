#pragma once

#include "runge_kutta.h"

/// Pendulums hanging in gravity along −y, angles from straight down, counter-clockwise [rad].
namespace pintle_oracle {

/// A point mass on a massless rod, released from rest at `release`, |release| < π.
/// θ = 2 asin(k cd(ω₀ t; k)), k = sin(release/2), ω₀ = √(g/l).
struct Pendulum {
  double length = 1, gravity = 9.81, release = 1;  ///< [m], [m/s²], [rad]
};
struct Swing {
  double angle, rate, acceleration;
  double x, y;     ///< of the mass, pivot at the origin [m]
  double tension;  ///< of the rod over the mass [N/kg]
};
Swing evaluate(const Pendulum&, double t);
double period(const Pendulum&);

/// Length of the simple pendulum which swings like a body of that mass and inertia about its mass
/// centre, hung at the distance `centre` from it.
double equivalent_length(double mass, double inertia, double centre);

/// Two bodies in a chain: pivot, first body, pin at `length` of it, second body.
struct DoublePendulum {
  double gravity = 9.81;
  double mass[2] = {1, 1};     ///< [kg]
  double centre[2] = {1, 1};   ///< of mass, from the own upper pin [m]
  double inertia[2] = {0, 0};  ///< about the mass centres [kg m²]
  double length = 1;           ///< from pivot to pin [m]
};
/// (θ₁, θ₂, rates)
void rhs(const DoublePendulum&, const Vec<4>& y, Vec<4>& dy);
double energy(const DoublePendulum&, const Vec<4>& y);  ///< 0 if all hung at the pivot's height [J]
/// State at t, by tight integration.
Vec<4> evaluate(const DoublePendulum&, const Vec<4>& start, double t, double tolerance = 1e-13);

/// Complete elliptic integral K(k) of modulus k, and the Jacobi functions.
double elliptic_k(double k);
struct Jacobi {
  double sn, cn, dn;
};
Jacobi jacobi(double u, double k);

}  // namespace pintle_oracle
