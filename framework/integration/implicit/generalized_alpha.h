#pragma once

#include <memory>

#include "framework/integration/implicit/alpha.h"
#include "framework/integration/stepper.h"

namespace pintle {

/// Generalised-α with the error estimate and the Newton iteration of Alpha.
class GeneralizedAlpha final : public Stepper {
 public:
  static constexpr std::string_view method = "generalized-alpha";
  GeneralizedAlpha(const System&, const Equations&, double rho, double tolerance);

  std::string_view name() const override { return method; }
  const StepperTraits& traits() const override { return traits_; }
  bool project(Instant& node, Equations& eq) override { return alpha_.project(system_, node, eq); }
  bool attempt(double h, const ErrorNorm&, Step&, Equations&) override;
  void accept(Equations&) override {}
  double first_step(const Instant&, const ErrorNorm&, double left) const override;
  void interpolate(const Step&, double t, Eigen::VectorXd& y) const override;
  bool sample(const Step&, double t, Equations&, State& out) override;
  bool passed_near_singular() const override { return false; }
  bool near_singular(const Equations&) const override { return false; }
  bool strayed_near_singular(const Step&, const Equations&) const override { return false; }
  StabilityLimits stability_limits(const Step&) const override { return {}; }
  std::string trouble() const override { return alpha_.trouble(); }
  int partitions() const override { return 0; }
  void save(Writer&) const override;
  void load(Reader&) override;
  bool fits(const Instant&) const override;
  void evaluate_end(const Step& step, Equations& eq) override { alpha_.evaluate_between(system_, step, step.to.state, eq); }

 private:
  /// Has its own Newton iteration, so that samples affect neither the steps nor each other.
  struct Reading {
    Alpha alpha;
    Step part;
  };

  const System& system_;
  double rho_, tolerance_;
  StepperTraits traits_;
  Alpha alpha_;
  std::unique_ptr<Reading> reading_;  ///< created at the first sample
};

}  // namespace pintle
