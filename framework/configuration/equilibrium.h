#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/configuration/assemble.h"
#include "framework/mechanism/trajectory.h"

namespace pintle {

/// How a mechanism at rest answers to a small push: the eigenvalues of its stiffness K = ∂r/∂q reduced to
/// the ways that the joints leave open, ZᵀKZ with the columns of Z a basis of the null space of Cq.
struct Stability {
  bool judged = false;  ///< false: more coordinates than are judged, or why_not
  std::string why_not = "too many coordinates";
  int freedoms = 0;                 ///< columns of Z
  int unstable = 0;                 ///< eigenvalues below zero: directions in which it falls away
  int neutral = 0;                  ///< eigenvalues that are zero to rounding: directions in which it stays where it is put
  bool circulatory = false;         ///< complex eigenvalues, of loads that follow: it may flutter, which statics cannot tell
  std::vector<std::string> moving;  ///< bodies that move most in each unstable, then each neutral direction
};

/// Where a mechanism rests: r(q, 0, 0, λ) = Cqᵀλ − f = 0 and C(q, t) = 0, drivers held and loads as they are at t.
struct Equilibrium {
  bool found = false;
  std::string reason;  ///< in words, when not found
  /// At rest there; contacts that press have the approach speed of the impact that would have come as deep.
  State state;
  Eigen::VectorXd lambda;  ///< joint forces; of redundant rows those of least norm
  int iterations = 0;
  std::string method;   ///< how it was found, in words
  double residual = 0;  ///< greatest force or couple left, over the greatest at work
  Stability stability;
  std::vector<std::string> warnings;
  Table table;  ///< one row, as `record` makes it: pose, joint forces, driving torques, contacts, loads
};

/// Of a mechanism at rest in equilibrium. @pre eq was evaluated at `state`, where the joint forces are λ
/// @param direction  a displacement along the most unstable direction, n, scaled to 1 at most; empty if there is none
Stability stability_of(const System&, const State&, const Equations&, const Eigen::VectorXd& lambda, Eigen::VectorXd* direction = nullptr);

/// Finds the equilibrium that the mechanism comes to from its assembled start, by Newton's method on the pose,
/// damped where a step would not lower the potential energy: with K + σM, σ → ∞, its path is that of the
/// mechanism with its masses in a fluid so thick that nothing swings, so what is found is stable unless the
/// start itself rests. Where loads follow and there is no potential, σ falls as the forces out of balance do.
/// A contact takes the elastic part k δⁿ of its law, its friction nothing, for nothing slides; neither do
/// dampers. Never throws for numerical reasons: `found` and `reason` say what happened.
/// @throws AssemblyError  rigid contacts
/// @param at  whose drivers and loads count [s]; the mechanism is led there from t = 0 along its drivers
Equilibrium find_equilibrium(const Scene&, const Model&, const Assembly&, double at = 0);

/// statics.csv and statics.json in `directory`.
/// @throws std::runtime_error  naming the path that cannot be written
void write_equilibrium(const std::filesystem::path& directory, const Scene&, const Model&, const Equilibrium&);
std::string equilibrium_json(const Scene&, const Model&, const Equilibrium&);

}  // namespace pintle
