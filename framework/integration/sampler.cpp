#include "framework/integration/sampler.h"

namespace pintle {

Sampler::Sampler(const System& system) : eq_(system) { node_.dy.setZero(system.n_y()); }

void Sampler::follow(const System& system, const Stages& steps) {
  alpha_.reset();
  if (!stages_ || &stages_->tableau() != &steps.tableau()) stages_.emplace(system, steps.tableau(), steps.constraints());
  stages_->take_partition(steps);
  stages_of_steps_ = &steps;
}

void Sampler::follow(const System& system, Alpha& steps, double rho, double tolerance) {
  stages_.reset();
  if (!alpha_) alpha_.emplace(system, eq_, rho, tolerance);
  of_steps_ = &steps;
}

bool Sampler::sample(const System& system, const Step& step, double t, int permanent, State& out) {
  eq_.permanent = permanent;
  return alpha_ ? sample_implicit(system, step, t, out) : sample_explicit(system, step, t, out);
}

bool Sampler::sample_explicit(const System& system, const Step& step, double t, State& out) {
  const bool inside = t < step.to.state.t;
  const bool by_a_step = inside && stages_->tableau().order > 5;  // better than dense output, whose fifth order its long steps show
  bool found;
  if (by_a_step) {
    found = stages_->reach(system, step.from, t - step.from.state.t, node_, eq_);
  } else {
    if (inside) {
      interpolate(system, step, t, node_.state);
      stages_of_steps_->refine_integrals(system, step, node_.state);
    } else {
      node_.state = step.to.state;
    }
    found = stages_->settle(system, node_, eq_);
  }
  if (found) out = node_.state;
  return found;
}

// A true step where that can be made: forces of stiff springs are in balance at its end, not between nodes.
bool Sampler::sample_implicit(const System& system, const Step& step, double t, State& out) {
  out = step.to.state;
  alpha_->begin_beside(*of_steps_);
  if (t < step.to.state.t) {
    const double h = t - step.from.state.t;
    const bool implicit = step.from.memory.a.size() > 0;  // not the step after which the scheme was changed
    if (implicit && h > short_part * step.h) {
      part_.from = step.from;
      part_.to = step.to;
      if (alpha_->attempt(system, h, part_, eq_)) {
        out = part_.to.state;
        return true;
      }
      alpha_->begin_beside(*of_steps_);
    }
    alpha_->interpolate_between(system, step, t, out, eq_);
  }
  alpha_->evaluate_between(system, step, out, eq_);
  return out.y.allFinite();
}

}  // namespace pintle
