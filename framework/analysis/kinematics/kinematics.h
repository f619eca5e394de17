#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "framework/analysis/simulate/simulate.h"
#include "framework/configuration/row_solver.h"

namespace pintle {

/// The motion of rigid bodies that drivers determine completely: positions by Newton's method from the prediction q + hs + ½h²a, speeds by
/// Cq s = −Ct, accelerations by Cq a = γ, redundant rows by least squares. Masses have no effect. A step whose correction, or whose change
/// of speed, is larger than its prediction allows is divided, so that the linkage does not jump to another branch; at a singular
/// configuration the prediction selects the branch.
class DrivenMotion {
 public:
  /// @pre start nearly satisfies C = 0
  DrivenMotion(const System&, State start);
  /// Advances to time t ≥ state().t. @returns false if this fails; see failure()
  bool advance(double t);

  const State& state() const { return state_; }
  const Eigen::VectorXd& acceleration() const { return a_; }
  const RowSolver& rows() const { return rows_; }  ///< at state()
  Equations& equations() { return eq_; }           ///< with the pose and speed of state()
  const std::string& failure() const { return failure_; }
  long steps() const { return steps_; }
  long rejected() const { return rejected_; }
  double worst_position() const { return worst_position_; }  ///< scaled as in Integrator
  double worst_velocity() const { return worst_velocity_; }

 private:
  bool project(State&, Eigen::VectorXd& a);
  bool attempt(double h, State& trial, Eigen::VectorXd& a);
  double size(const Eigen::VectorXd& d) const { return d.cwiseQuotient(system_.scale).lpNorm<Eigen::Infinity>(); }
  std::string why();

  const System& system_;
  Equations eq_;
  RowSolver rows_;
  State state_;
  Eigen::VectorXd a_, gamma_;
  std::string failure_;
  double h_ = 0, worst_position_ = 0, worst_velocity_ = 0;
  long steps_ = 0, rejected_ = 0;
};

/// @throws AssemblyError  drivers and joints leave degrees of freedom at the start: how many, and which bodies move
void require_driven(const Scene&, const Model&, const Assembly&);

/// The driven motion over `run.until`: trajectory of bodies and points, without forces and energy balance. `reason` says why it ended
/// early, if it did; the results up to then are kept.
/// @throws AssemblyError  as require_driven
Run kinematics(const Scene&, const Model&, const Assembly&, const Listeners& = {});

/// trajectory.csv and kinematics.json in `directory`.
/// @throws std::runtime_error  naming the path that cannot be written
void write_kinematics(const std::filesystem::path& directory, const Scene&, const Model&, const Run&);
std::string kinematics_json(const Scene&, const Model&, const Run&);

/// Follows a driven motion through the scene's outputs, recorded in the run's table as defined by `written`, and its frames, until its end, a
/// failure or the listener's stop. Fills in status, reason, times and counts of the run.
/// @param advance  advances to a time and evaluates what is recorded there; returns false if this fails, see failure()
void follow(const Scene&, const Model& written, DrivenMotion&, const std::function<bool(double)>& advance, const Listeners&, Run&);

}  // namespace pintle
