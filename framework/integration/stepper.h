#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>

#include "framework/dynamics/equations/equations.h"
#include "framework/integration/error_norm.h"
#include "framework/integration/held_forces.h"
#include "framework/integration/scheme.h"
#include "framework/integration/step.h"

namespace pintle {

class Reader;
class Writer;

/// Properties of a method that step control needs.
struct StepperTraits {
  int order;  ///< of the error that it estimates for the step h: hᵖ
  bool implicit;
  bool follows_impacts;                       ///< its steps resolve contact forces: they end where these have a kink
  bool ends_evaluated;                        ///< `attempt` leaves contacts evaluated at the step's end
  double fixed_step = 0;                      ///< the length of its steps; 0: chosen by the error [s]
  double least_change = 1, least_growth = 1;  ///< a change of the step by a ratio between these is not worth another factorization
};

/// Whether stability limits a step, in a fast decay or in an undamped oscillation.
struct StabilityLimits {
  bool decay = false, oscillation = false;
};

/// A method of time integration as seen by the integrator: it makes steps and samples the motion inside them. It is independent of error
/// control, events and switching. Chosen once, by make_stepper.
class Stepper {
 public:
  virtual ~Stepper() = default;

  virtual std::string_view name() const = 0;
  virtual const StepperTraits& traits() const = 0;

  /// Projects a node onto the constraints and evaluates it: a start, so the method discards its memory of earlier steps.
  /// @returns false in a singular configuration
  virtual bool project(Instant&, Equations&) = 0;
  /// Fills step.to and step.error from step.from and h; step.from is never changed.
  /// @returns false if it fails; see trouble()
  virtual bool attempt(double h, const ErrorNorm&, Step&, Equations&) = 0;
  /// The step was accepted; its end is in the equations.
  virtual void accept(Equations&) = 0;
  /// Bound of the first step after a start [s].
  virtual double first_step(const Instant& start, const ErrorNorm&, double left) const = 0;

  /// Dense output of an attempted step, not projected onto the constraints.
  virtual void interpolate(const Step&, double t, Eigen::VectorXd& y) const = 0;
  /// The motion at t in the last accepted step, fully evaluated in the given equations, which are not those of the steps. Depends only on
  /// the step and does not affect later ones. @returns false if it cannot be evaluated
  virtual bool sample(const Step&, double t, Equations&, State& out) = 0;

  /// Whether a stage of the last attempt was near a singular configuration.
  virtual bool passed_near_singular() const = 0;
  /// Whether the equations are so near a singular configuration that no step should end there.
  virtual bool near_singular(const Equations&) const = 0;
  /// Whether a stage of the step was much nearer to a singular configuration than its end, too near for the tolerance.
  virtual bool strayed_near_singular(const Step&, const Equations&) const = 0;
  /// Whether the step is as long, or nearly, as stability allows.
  virtual StabilityLimits stability_limits(const Step&) const = 0;
  virtual std::string trouble() const = 0;
  virtual int partitions() const = 0;

  /// The data besides the nodes that the next steps depend on.
  virtual void save(Writer&) const = 0;
  virtual void load(Reader&) = 0;
  /// Whether the loaded data fit the system and this node.
  virtual bool fits(const Instant&) const = 0;
  /// Evaluates the last step's end as the steps did.
  virtual void evaluate_end(const Step&, Equations&) = 0;
};

/// @param name  as in scene files   @returns nullptr if no method has that name
std::unique_ptr<Stepper> make_stepper(std::string_view name, const System&, const Scheme&, const Equations&);

/// Accuracy of holding forces inside a step of this tolerance, relative to the most that can be held.
inline double known_inside(double tolerance) { return std::max(1e-6, 100 * tolerance); }

/// A state inside a step, and which of its frictions have forces there.
struct StateInside {
  State state;
  std::vector<std::size_t> loaded;
};

/// A step's motion, for code that looks inside it. The step must not change meanwhile.
class DenseOutput {
 public:
  DenseOutput(const Stepper& stepper, const Step& step, const HeldForces& held, StateInside& work)
      : stepper_(stepper), step_(step), held_(held), work_(work) {}
  const State& at(double t) const;
  /// Whether forces of sticking friction and closed rigid contacts are known inside the step, not only at its ends.
  bool knows_held_forces() const { return held_.known(); }

 private:
  void begin() const;

  const Stepper& stepper_;
  const Step& step_;
  const HeldForces& held_;
  StateInside& work_;
  mutable bool begun_ = false;
};

}  // namespace pintle
