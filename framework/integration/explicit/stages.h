#pragma once

#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/integration/constraint_treatment.h"
#include "framework/integration/explicit/partition.h"
#include "framework/integration/explicit/tableau.h"
#include "framework/common/members.h"
#include "framework/integration/step.h"

namespace pintle {

/// Scratch of a scheme: its stages and the treatment of constraints. One per thread.
class Stages {
 public:
  Stages(const System&, const Tableau&, Constraints);

  /// Projects y onto the constraints and evaluates everything there. @returns false in a singular configuration
  bool project(const System&, Instant&, Equations&);
  /// Fills step.to and step.error from step.from and h. @returns false if a stage could not be
  /// evaluated or is not finite; step.from is never changed.
  bool attempt(const System&, double h, Step&, Equations&);
  /// Computes the state after a step of h from a node, projected onto the constraints and evaluated, without an error estimate.
  bool reach(const System&, const Instant& from, double h, Instant& to, Equations&);
  /// Chooses a new independent set if the present one has become ill conditioned. After an accepted step.
  void refresh(const System&, Equations&);
  /// Improves the internal states and integrals that `interpolate` has put into `out`, with the last attempt's stages.
  /// @pre the step is that of the last attempt
  void refine_cubics(const System&, const Step&, State& out) const;

  /// Uses the same independent coordinates as `other`.
  void take_partition(const Stages& other) { partition_.take_set(other.partition_); }

  const Tableau& tableau() const { return tableau_; }
  Constraints constraints() const { return constraints_; }
  int partitions() const { return partition_.choices(); }
  /// Whether a stage since the last `reach` began was at or near a configuration with dependent rows, or may be for the long steps of a
  /// pair of high order: a pivot falls with the square of the distance.
  bool near_singular() const { return weak_ || (tableau_.order > 5 && least_ < 0.1 * most_); }
  /// Smallest pivot of the last attempt's stages; 0: a stage was in a singular configuration.
  double closest() const { return least_; }
  /// h times the fastest rate in the last attempt, of a decay and of an oscillation, from the difference between its last inner stage at the
  /// end time and the step's end [HairerWanner1996, IV.2]; 0 for a pair without such a stage.
  struct Stiffness {
    double decay = 0, oscillation = 0;
  };
  Stiffness stiffness(const System&, const Step&) const;
  /// The data besides the nodes that the next steps depend on.
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(partition_));
  }
  /// Whether the loaded data fit the system.
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
  bool project_stages_ = false;  ///< in the last attempt: each stage is projected onto the constraints
  bool weak_ = false;
  double least_ = 1, most_ = 0;  ///< of the smallest pivots of the stages
};

}  // namespace pintle
