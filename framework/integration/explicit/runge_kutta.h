#pragma once

#include <memory>

#include "framework/integration/explicit/inner_motion.h"
#include "framework/integration/explicit/stages.h"
#include "framework/integration/stepper.h"

namespace pintle {

/// An embedded explicit Runge–Kutta pair.
class RungeKutta final : public Stepper {
 public:
  RungeKutta(const System&, const Tableau&, Constraints, double tolerance);

  std::string_view name() const override { return stages_.tableau().name; }
  const StepperTraits& traits() const override { return traits_; }
  bool project(Instant& node, Equations& eq) override { return stages_.project(system_, node, eq); }
  bool attempt(double h, const ErrorNorm&, Step&, Equations&) override;
  void accept(Equations& eq) override { stages_.refresh(system_, eq); }
  double first_step(const Instant&, const ErrorNorm&, double left) const override;
  void interpolate(const Step&, double t, Eigen::VectorXd& y) const override;
  bool sample(const Step&, double t, Equations&, State& out) override;
  bool passed_near_singular() const override { return stages_.near_singular(); }
  bool near_singular(const Equations&) const override;
  bool strayed_near_singular(const Step&, const Equations&) const override;
  StabilityLimits stability_limits(const Step&) const override;
  std::string trouble() const override { return {}; }
  int partitions() const override { return stages_.partitions(); }
  void save(Writer&) const override;
  void load(Reader&) override;
  bool fits(const Instant&) const override { return stages_.fits(system_); }
  void evaluate_end(const Step&, Equations&) override;

 private:
  /// Has its own stages, so that samples affect neither the steps nor each other.
  struct Reading {
    Stages stages;
    Instant node;
    InnerMotion inner;  ///< for long steps
  };

  double pivot_known(const Step&) const;

  const System& system_;
  StepperTraits traits_;
  double tolerance_;
  Stages stages_;
  std::unique_ptr<Reading> reading_;  ///< created at the first sample
};

}  // namespace pintle
