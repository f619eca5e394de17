#pragma once

#include <optional>

#include "framework/integration/alpha.h"
#include "framework/integration/step.h"

namespace pintle {

/// Reads the motion inside a step that was made. It has equations, stages and a Newton iteration of its own and
/// starts each reading from the step alone, so that readings change neither the steps nor each other.
class Sampler {
 public:
  explicit Sampler(const System&);

  /// The scheme that made the step, or goes on from its end; the later call counts.
  void follow(const System&, const Stages&);
  void follow(const System&, Alpha&, double rho, double tolerance);
  /// As Integrator::sample. @param lasting  rows that others imply, as the steps have found: Equations::lasting
  bool sample(const System&, const Step&, double t, int permanent, State& out);
  /// Evaluated at the state of the last sample.
  const Equations& equations() const { return eq_; }

 private:
  bool sample_explicit(const System&, const Step&, double t, State& out);
  bool sample_implicit(const System&, const Step&, double t, State& out);

  Equations eq_;
  std::optional<Stages> stages_;  ///< one of the two
  std::optional<Alpha> alpha_;
  const Stages* stages_of_steps_ = nullptr;  ///< what made the step: its stages
  Alpha* of_steps_ = nullptr;                ///< or its Newton iteration
  Instant node_;
  Step part_;
};

}  // namespace pintle
