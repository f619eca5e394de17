#pragma once

#include <string>
#include <vector>

#include "framework/bodies/load_history.h"
#include "framework/component/reduction/modal_model.h"

/// Which of a body's modes its motion needs, and what the others would add.
/// Theory: docs/theory/reduction.md, "Choosing modes by the scene".
namespace pintle {

inline constexpr int considered_modes = 24;      ///< the lowest; all if there are fewer
inline constexpr double negligible_part = 0.01;  ///< of strain energy and of displacement
inline constexpr int without_a_run = 6;          ///< modes kept where the rigid run cannot be done

/// A mode that `keep: auto` has considered. Parts are of the greatest strain energy and displacement
/// in the run.
struct ConsideredMode {
  double frequency;          ///< [Hz]
  double energy;             ///< greatest strain energy that the mode itself holds, part
  double left_energy;        ///< what is left out when this one and those below it are kept, part
  double left_displacement;  ///< likewise
  bool kept;
};

/// What `keep: auto` comes to.
struct ModalChoice {
  int count = 0;                           ///< natural, fixed-interface or free modes, by the body's method
  std::string reason;                      ///< in words, of how the count was found or why by rule
  std::vector<ConsideredMode> considered;  ///< empty if by rule
  /// What not even all considered modes cover.
  double beyond_energy = 0, beyond_displacement = 0;
};

/// η of oscillators η̈ + 2ζω η̇ + ω²η = Q that start at rest and undeformed, Q linear between times:
/// exact then, whatever the steps. @param Q  modes × times  @returns modes × times
Eigen::MatrixXd oscillator_response(const Eigen::VectorXd& omega, const Eigen::VectorXd& zeta, const std::vector<double>& t,
                                    const Eigen::MatrixXd& Q);

/// The fewest of the lowest modes such that those of the considered ones that are left out add less
/// than `negligible_part` to the strain energy and to the displacement; one at least.
/// @pre the body has `modes`
ModalChoice choose_modes(const Scene&, const ElasticBody&, const LoadHistory&);
/// The rule where there is no history: the `without_a_run` lowest, or as many as there are.
ModalChoice choose_by_rule(const Scene&, const ElasticBody&, const std::string& why);

/// Work of each of `loads_on` on each shape, shapes × loads; times a history's factors: modal forces.
Eigen::MatrixXd work_of_loads(const ElasticBody&, const ModalModel&);

/// Frequency that holds 99 % of the strain energy of what varies, if every mode followed
/// statically [Hz].
double excited_up_to(const std::vector<double>& t, const Eigen::MatrixXd& Q, const Eigen::VectorXd& omega);

}  // namespace pintle
