#pragma once

#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/integration/constraints.h"
#include "framework/integration/members.h"
#include "framework/integration/tableau.h"

namespace pintle {

/// How C = 0 and Ċ = 0 are kept.
enum class Constraints {
  projection,    ///< both: after each explicit step, by the shortest way in the metric of M; in each implicit one
  partitioning   ///< both, in each stage of an explicit scheme: dependent coordinates follow from the independent ones
};

/// What an implicit scheme knows at a node besides the state; empty for an explicit one.
struct Memory {
  double h = 0;                    ///< of the step that led here; 0: a start, nothing before it counts [s]
  Eigen::VectorXd a;               ///< the scheme's own accelerations
  Eigen::VectorXd lambda, lambda_before;  ///< multipliers here and a step earlier
  Eigen::VectorXd dy_before;       ///< derivative a step earlier
  Eigen::VectorXd F, P;            ///< f − Cqᵀλ, and M v̇, which Newton leaves a little apart
  template <class A>
  void archive(A& x) { x(PINTLE_MEMBERS(h, a, lambda, lambda_before, dy_before, F, P)); }
};

/// A state with its derivative.
struct Instant {
  State state;
  Eigen::VectorXd dy;
  Memory memory = {};
  template <class A>
  void archive(A& x) { x(PINTLE_MEMBERS(state.t, state.y, state.impact_rate, dy, memory)); }
};

/// From one accepted node to a trial one, with what dense output and error control need.
struct Step {
  Instant from, to;
  double h = 0;           ///< [s]
  Eigen::VectorXd error;  ///< of the lower-order solution, as y
  bool struck = false;    ///< a force that begins with a jump has changed to.dy …
  Eigen::VectorXd dy_before = {};  ///< … from this, which ends the step's dense output
  const Eigen::VectorXd& dy_end() const { return struck ? dy_before : to.dy; }
};

inline constexpr double short_part = 1e-3;  ///< of a step: in less, an implicit one shows the rounding of speeds in accelerations and multipliers

/// Scratch of a scheme: its stages and the constraint treatment. One per thread.
class Stages {
 public:
  Stages(const System&, const Tableau&, Constraints);

  /// Brings y onto the constraints and evaluates everything there. @returns false at a singular pose
  bool settle(const System&, Instant&, Equations&);
  /// Fills step.to and step.error from step.from and h. @returns false if a stage could not be
  /// evaluated or is not finite; step.from is never changed.
  bool attempt(const System&, double h, Step&, Equations&);
  /// The state that a step of h from a node leads to, settled and evaluated, without an error estimate.
  bool reach(const System&, const Instant& from, double h, Instant& to, Equations&);
  /// Chooses a new independent set if the present one has worn out. After an accepted step.
  void refresh(const System&, Equations&);
  /// Adds to the integrals that `interpolate` has put into `out` what the last attempt's stages know of them between its ends.
  /// @pre the step is that of the last attempt
  void refine_integrals(const System&, const Step&, State& out) const;

  /// Has the same coordinates follow from the others.
  void take_partition(const Stages& other) { partition_.take_set(other.partition_); }

  const Tableau& tableau() const { return tableau_; }
  Constraints constraints() const { return constraints_; }
  int partitions() const { return partition_.choices(); }
  /// A stage since the last `reach` began stood at or near a pose where rows are dependent, or there is one among the long steps
  /// of a pair of high order: a pivot falls with the square of the distance.
  bool near_singular() const { return weak_ || (tableau_.order > 5 && least_ < 0.1 * most_); }
  /// Smallest pivot of the last attempt's stages; 0: one stood in a singular pose.
  double closest() const { return least_; }
  /// h times the fastest rate that the last attempt met, by the change from its last inner stage to its end
  /// [HairerWanner1996, IV.2]; 0 unless both stand at one instant.
  double stiffness(const System&, const Step&) const;
  /// What the next steps depend on besides the nodes.
  template <class A>
  void archive(A& x) { x(PINTLE_MEMBERS(partition_)); }
  /// What was loaded fits the system.
  bool fits(const System& system) const { return partition_.fits(system); }

 private:
  bool evaluate_stage(const System&, State&, Equations&, Eigen::VectorXd& dy);
  void monitor(const Equations&);

  const Tableau& tableau_;
  Constraints constraints_;
  Partition partition_;
  std::vector<Eigen::VectorXd> k_;
  State stage_;
  bool weak_ = false;
  double least_ = 1, most_ = 0;  ///< of the smallest pivots of the stages
};

/// Dense output at from.t ≤ t ≤ to.t: q by the quintic that meets q, s and a at both ends, s by its
/// derivative, z by the cubic. Of an implicit step, whose q, s and a agree to h² only, each by the cubic
/// of itself and the next. Not brought onto the constraints.
void interpolate(const System&, const Step&, double t, State& out);

}  // namespace pintle
