#pragma once

#include <string>
#include <vector>

#include "framework/bodies/load_history.h"
#include "framework/component/reduction/modal_model.h"

/// Which modes of a body its motion needs, and what the others would add.
/// Theory: docs/theory/reduction.md, "Choosing modes by the scene".
namespace pintle {

inline constexpr int considered_modes = 24;      ///< the lowest considered; all if there are fewer
inline constexpr double negligible_part = 0.01;  ///< of strain energy and displacement
inline constexpr int without_a_run = 6;          ///< modes kept where the preliminary run is not possible

/// A mode considered for `keep: auto`. Energies and displacements are relative to the largest ones in the run.
struct ConsideredMode {
  double frequency;          ///< [Hz]
  double energy;             ///< largest strain energy of the mode itself
  double left_energy;        ///< error of the strain energy if this mode and those below it are kept
  double left_displacement;  ///< likewise, of the displacement
  bool kept;
};

/// Result of `keep: auto`.
struct ModalChoice {
  int count = 0;                           ///< natural, fixed-interface or free modes, by the body's method
  std::string reason;                      ///< how the count was found, or why a rule was used, in words
  std::vector<ConsideredMode> considered;  ///< empty if a rule was used
  /// The part that even all considered modes do not represent.
  double beyond_energy = 0, beyond_displacement = 0;
};

/// η of oscillators η̈ + 2ζω η̇ + ω²η = Q that start at rest and undeformed, with Q linear between the given times: exact for any step.
/// @param Q  modes × times  @returns modes × times
Eigen::MatrixXd oscillator_response(const Eigen::VectorXd& omega, const Eigen::VectorXd& zeta, const std::vector<double>& t,
                                    const Eigen::MatrixXd& Q);

/// The smallest number of lowest modes such that the considered modes left out add less than `negligible_part` to the strain energy and to
/// the displacement; at least one.
/// @pre the body has `modes`
ModalChoice choose_modes(const Scene&, const ElasticBody&, const LoadHistory&);
/// The rule without a history: the `without_a_run` lowest modes, or as many as there are.
ModalChoice choose_by_rule(const Scene&, const ElasticBody&, const std::string& why);

/// Work of each of `loads_on` on each shape, shapes × loads; multiplied by a history's factors it gives modal forces.
Eigen::MatrixXd work_of_loads(const ElasticBody&, const ModalModel&);

/// Frequency below which 99 % of the strain energy of the varying part lies, if every mode responded statically [Hz].
double excited_up_to(const std::vector<double>& t, const Eigen::MatrixXd& Q, const Eigen::VectorXd& omega);

}  // namespace pintle
