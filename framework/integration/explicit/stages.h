#pragma once

#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/integration/constraint_treatment.h"
#include "framework/integration/explicit/partition.h"
#include "framework/integration/explicit/tableau.h"
#include "framework/common/members.h"
#include "framework/integration/step.h"

namespace pintle {

/// Scratch of a scheme: its stages and the constraint treatment. One per thread.
class Stages {
 public:
  Stages(const System&, const Tableau&, Constraints);

  /// Brings y onto the constraints and evaluates everything there. @returns false at a singular pose
  bool project(const System&, Instant&, Equations&);
  /// Fills step.to and step.error from step.from and h. @returns false if a stage could not be
  /// evaluated or is not finite; step.from is never changed.
  bool attempt(const System&, double h, Step&, Equations&);
  /// The state that a step of h from a node leads to, projected onto the constraints and evaluated, without an error estimate.
  bool reach(const System&, const Instant& from, double h, Instant& to, Equations&);
  /// Chooses a new independent set if the present one has worn out. After an accepted step.
  void refresh(const System&, Equations&);
  /// Adds to the internal states and integrals that `interpolate` has put into `out` what the last attempt's stages know of them between its ends.
  /// @pre the step is that of the last attempt
  void refine_cubics(const System&, const Step&, State& out) const;

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
  /// A stage of the last attempt stood in or near a singular pose, or bodies have very unlike inertias.
  bool weak() const { return weak_; }
  /// h times the fastest rate that the last attempt met, by the change from its last inner stage at the end's instant to that end
  /// [HairerWanner1996, IV.2]; 0 of a pair without such a stage.
  double stiffness(const System&, const Step&) const;
  /// What the next steps depend on besides the nodes.
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(partition_));
  }
  /// What was loaded fits the system.
  bool fits(const System& system) const { return partition_.fits(system); }

 private:
  bool evaluate_inner(const System&, const Instant& from, double h, Equations&);
  bool evaluate_stage(const System&, State&, Equations&, Eigen::VectorXd& dy);
  void watch(const Equations&);

  const Tableau& tableau_;
  Constraints constraints_;
  Partition partition_;
  std::vector<Eigen::VectorXd> k_;
  State stage_;
  bool project_stages_ = false;  ///< of the last attempt: each is brought onto the constraints
  bool weak_ = false;
  double least_ = 1, most_ = 0;  ///< of the smallest pivots of the stages
};

}  // namespace pintle
