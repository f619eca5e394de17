#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/integration/step.h"

namespace pintle {

class Stepper;

/// Whether some friction sticks or some rigid contact is closed, so that the accelerations determine its force.
bool holds_anything(const System&, const State&);

/// Such forces inside a step. Dense output does not include them: a body at rest may be pushed and released within one long step.
class HeldForces {
 public:
  /// Evaluates them in the middle of the step. @param work  any state of the system
  void look(const System&, const Stepper&, const Step&, State& work);
  void forget() { known_ = false; }
  bool known() const { return known_; }
  const std::vector<DryFriction>& middle() const { return middle_; }
  /// The k-th friction at t, by parabolas through both ends and the middle.
  DryFriction at(const Step&, double t, std::size_t k) const;

 private:
  std::unique_ptr<Equations> eq_;  ///< created at the first look
  Eigen::VectorXd dy_;
  std::vector<DryFriction> middle_;
  bool known_ = false;
};

}  // namespace pintle
