#include "framework/integration/implicit/generalized_alpha.h"

#include <algorithm>
#include <limits>

#include "framework/common/archive.h"
#include "framework/integration/dense_output.h"

namespace pintle {

GeneralizedAlpha::GeneralizedAlpha(const System& system, const Equations& eq, double rho, double tolerance)
    : system_(system),
      rho_(rho),
      tolerance_(tolerance),
      traits_{.order = Alpha::order + 1,
              .implicit = true,
              .follows_impacts = false,
              .ends_evaluated = false,
              .least_change = 0.9,
              .least_growth = 1.2},
      alpha_(system, eq, rho, tolerance) {}

bool GeneralizedAlpha::attempt(double h, const ErrorNorm& norm, Step& step, Equations& eq) {
  alpha_.validate_by(norm.length(), norm.speed(step.from.state.y, h));
  return alpha_.attempt(system_, h, step, eq);
}

// A step much longer than a period shows only part of the error: the first step is so short that nothing moves by more than the tolerance,
// and each further one is at most five times as long as the one before, which it relies on.
double GeneralizedAlpha::first_step(const Instant& start, const ErrorNorm& norm, double left) const {
  const double fastest = norm.fastest_speed(start.state.y);
  if (!(fastest > 0)) return std::numeric_limits<double>::infinity();
  return std::max(std::max(tolerance_, 1e-6) * norm.length() / fastest, 1e-12 * left);
}

void GeneralizedAlpha::interpolate(const Step& step, double t, Eigen::VectorXd& y) const { interpolate_cubic(system_, step, t, y); }

// A true step where possible: stiff spring forces are in balance at its end, but not between nodes.
bool GeneralizedAlpha::sample(const Step& step, double t, Equations& eq, State& out) {
  if (!reading_) reading_ = std::make_unique<Reading>(Reading{Alpha(system_, eq, rho_, tolerance_), {}});
  auto& [alpha, part] = *reading_;
  out = step.to.state;
  alpha.begin_beside(alpha_);
  if (t < step.to.state.t) {
    const double h = t - step.from.state.t;
    const bool ours = step.from.memory.a.size() > 0;  // not the step before a change of the method
    if (ours && h > short_part * step.h) {
      part.from = step.from;
      part.to = step.to;
      if (alpha.attempt(system_, h, part, eq)) {
        out = part.to.state;
        return true;
      }
      alpha.begin_beside(alpha_);
    }
    alpha.interpolate_between(system_, step, t, out, eq);
  }
  alpha.evaluate_between(system_, step, out, eq);
  return out.y.allFinite();
}

void GeneralizedAlpha::save(Writer& out) const { out.whole(alpha_); }
void GeneralizedAlpha::load(Reader& in) { in.whole(alpha_); }

bool GeneralizedAlpha::fits(const Instant& node) const { return node.memory.a.size() == system_.n_s(); }

}  // namespace pintle
