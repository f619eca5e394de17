#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/configuration/assemble.h"
#include "framework/mechanism/result_tables.h"

namespace pintle {

/// Response of a mechanism at rest to a small disturbance: the eigenvalues of its stiffness K = ∂r/∂q reduced to the motions that the
/// joints allow, ZᵀKZ, where the columns of Z are a basis of the null space of Cq.
struct Stability {
  bool judged = false;  ///< false: too many coordinates, or see why_not
  std::string why_not = "too many coordinates";
  int dofs = 0;                     ///< columns of Z
  int unstable = 0;                 ///< negative eigenvalues: directions in which it moves away
  int neutral = 0;                  ///< eigenvalues that are zero to rounding: directions of neutral equilibrium
  bool circulatory = false;         ///< complex eigenvalues, due to follower loads: it may flutter, which statics cannot decide
  std::vector<std::string> moving;  ///< bodies that move most in each unstable, then each neutral direction
};

/// Rest position of a mechanism: r(q, 0, 0, λ) = Cqᵀλ − f = 0 and C(q, t) = 0, with drivers and loads held at t.
struct Equilibrium {
  bool found = false;
  std::string reason;  ///< in words, when not found
  /// At rest there; closed contacts get the approach speed of the impact that would reach this depth.
  State state;
  Eigen::VectorXd lambda;  ///< joint forces; for redundant rows those of least norm
  int iterations = 0;
  std::string method;   ///< how it was found, in words
  double residual = 0;  ///< largest remaining force or couple, relative to the largest acting one
  Stability stability;
  std::vector<std::string> warnings;
  Table table;  ///< one row, as `record` makes it: configuration, joint forces, driving torques, contacts, loads
};

/// Stability of a mechanism in equilibrium. @pre eq was evaluated at `state`, where the joint forces are λ
/// @param direction  a displacement along the most unstable direction, n, scaled to 1 at most; empty if there is none
Stability stability_of(const System&, const State&, const Equations&, const Eigen::VectorXd& lambda, Eigen::VectorXd* direction = nullptr);

/// Finds the equilibrium that the mechanism reaches from its assembled start, by Newton's method on the configuration, with steps damped by
/// K + σM where they would not lower the potential energy. For σ → ∞ the path is that of an overdamped mechanism (its masses in a fluid so
/// viscous that nothing oscillates), so the equilibrium found is stable unless the start itself is at rest. With follower loads there is no
/// potential; σ then falls with the forces out of balance. A contact exerts the elastic part k δⁿ of its law, without friction because
/// nothing slides; dampers exert no force. Never throws for numerical reasons: `found` and `reason` report the result.
/// @throws AssemblyError  rigid contacts
/// @param at  time of the drivers and loads [s]; the mechanism is moved there from t = 0 along its drivers
Equilibrium find_equilibrium(const Scene&, const Model&, const Assembly&, double at = 0);

/// statics.csv and statics.json in `directory`.
/// @throws std::runtime_error  naming the path that cannot be written
void write_equilibrium(const std::filesystem::path& directory, const Scene&, const Model&, const Equilibrium&);
std::string equilibrium_json(const Scene&, const Model&, const Equilibrium&);

}  // namespace pintle
