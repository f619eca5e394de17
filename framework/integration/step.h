#pragma once

#include <vector>

#include "framework/dynamics/equations.h"
#include "framework/integration/constraints.h"
#include "framework/integration/tableau.h"

namespace pintle {

/// How C = 0 and Ċ = 0 are kept.
enum class Constraints {
  projection,   ///< after each step, by the shortest way in the metric of M
  partitioning  ///< in each stage: dependent coordinates follow from the independent ones
};

/// A state with its derivative.
struct Node {
  State state;
  Eigen::VectorXd dy;
};

/// From one accepted node to a trial one, with what dense output and error control need.
struct Step {
  Node from, to;
  double h = 0;           ///< [s]
  Eigen::VectorXd error;  ///< of the lower-order solution, as y
};

/// Scratch of a scheme: its stages and the constraint treatment. One per thread.
class Stages {
 public:
  Stages(const System&, const Tableau&, Constraints);

  /// Brings y onto the constraints and evaluates everything there. @returns false at a singular pose
  bool settle(const System&, Node&, Equations&);
  /// Fills step.to and step.error from step.from and h. @returns false if a stage could not be
  /// evaluated or is not finite; step.from is never changed.
  bool attempt(const System&, double h, Step&, Equations&);
  /// Chooses a new independent set if the present one has worn out. After an accepted step.
  void refresh(const System&, Equations&);

  const Tableau& tableau() const { return tableau_; }
  int partitions() const { return partition_.choices(); }

 private:
  bool evaluate_stage(const System&, State&, Equations&, Eigen::VectorXd& dy);

  const Tableau& tableau_;
  Constraints constraints_;
  Partition partition_;
  std::vector<Eigen::VectorXd> k_;
  State stage_;
};

/// Dense output at from.t ≤ t ≤ to.t: q by the quintic that meets q, s and a at both ends, s by its
/// derivative, z by the cubic. Not brought onto the constraints.
void interpolate(const System&, const Step&, double t, State& out);

}  // namespace pintle
