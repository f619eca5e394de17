#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/equations/equations.h"
#include "framework/integration/step.h"

namespace pintle {

class Stepper;

/// Some friction sticks, or some rigid contact is closed: by forces that accelerations decide.
bool holds_anything(const System&, const State&);

/// Such forces inside a step. Dense output does not know them: what rests may be pushed and let go again between the ends of a step that
/// nothing else keeps short.
class HeldForces {
 public:
  /// Evaluates them in the middle of the step. @param work  any state of the system
  void look(const System&, const Stepper&, const Step&, State& work);
  void forget() { known_ = false; }
  bool known() const { return known_; }
  /// Puts the parabolas through both ends and the middle into the friction of a state at t.
  void put(const Step&, double t, std::vector<DryFriction>&) const;

 private:
  std::unique_ptr<Equations> eq_;  ///< from the first look on
  Eigen::VectorXd dy_;
  std::vector<DryFriction> middle_;
  bool known_ = false;
};

}  // namespace pintle
