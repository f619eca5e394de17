#include "framework/integration/step.h"

#include <cmath>

namespace pintle {

using Index = Eigen::Index;

Stages::Stages(const System& system, const Tableau& tableau, Constraints constraints)
    : tableau_(tableau),
      constraints_(constraints),
      k_(static_cast<std::size_t>(tableau.stages()), Eigen::VectorXd::Zero(system.n_y())) {
  stage_.y.setZero(system.n_y());
  stage_.impact_rate.assign(system.contacts.size(), 0.0);
}

bool Stages::evaluate_stage(const System& system, State& state, Equations& eq, Eigen::VectorXd& dy) {
  if (constraints_ == Constraints::projection || system.n_rows() == 0)
    return evaluate(system, state, eq, dy);
  if (!partition_.correct(system, state.t, state.y, eq)) return false;
  accelerate(system, state, eq);
  fill_derivative(system, state.y, eq, dy);
  return true;
}

bool Stages::settle(const System& system, Node& node, Equations& eq) {
  if (constraints_ == Constraints::partitioning && system.n_rows() > 0) {
    if (partition_.dependent().empty()) {
      pose(system, node.state.t, node.state.y, eq);
      partition_.choose(system, eq);
    }
    return evaluate_stage(system, node.state, eq, node.dy);
  }
  if (!project(system, node.state.t, node.state.y, eq)) return false;
  accelerate(system, node.state, eq);
  fill_derivative(system, node.state.y, eq, node.dy);
  return true;
}

void Stages::refresh(const System& system, Equations& eq) {
  if (constraints_ == Constraints::partitioning && system.n_rows() > 0 && partition_.worn())
    partition_.choose(system, eq);
}

bool Stages::attempt(const System& system, double h, Step& step, Equations& eq) {
  const State& from = step.from.state;
  const int stages = tableau_.stages(), inner = tableau_.closes ? stages - 1 : stages;
  step.h = h;
  stage_.impact_rate = from.impact_rate;
  k_[0] = step.from.dy;
  for (int i = 1; i < inner; ++i) {
    const auto& a = tableau_.a[static_cast<std::size_t>(i)];
    stage_.t = from.t + tableau_.c[static_cast<std::size_t>(i)] * h;
    stage_.y = from.y;
    for (int j = 0; j < i; ++j)
      if (a[static_cast<std::size_t>(j)] != 0)
        stage_.y += (h * a[static_cast<std::size_t>(j)]) * k_[static_cast<std::size_t>(j)];
    if (!evaluate_stage(system, stage_, eq, k_[static_cast<std::size_t>(i)])) return false;
  }

  State& to = step.to.state;
  to.t = from.t + h;
  to.impact_rate = from.impact_rate;
  to.y = from.y;
  for (int i = 0; i < inner; ++i)
    if (tableau_.b[static_cast<std::size_t>(i)] != 0)
      to.y += (h * tableau_.b[static_cast<std::size_t>(i)]) * k_[static_cast<std::size_t>(i)];
  if (!to.y.allFinite() || !settle(system, step.to, eq)) return false;
  if (tableau_.closes) k_.back() = step.to.dy;

  step.error.setZero(system.n_y());
  for (int i = 0; i < stages; ++i)
    if (tableau_.e[static_cast<std::size_t>(i)] != 0)
      step.error += (h * tableau_.e[static_cast<std::size_t>(i)]) * k_[static_cast<std::size_t>(i)];
  return step.to.dy.allFinite() && step.error.allFinite();
}

void interpolate(const System& system, const Step& step, double t, State& out) {
  const Index n = system.n(), nz = system.n_z();
  const double h = step.h, x = (t - step.from.state.t) / h;
  const double x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x;
  const auto& y0 = step.from.state.y;
  const auto& y1 = step.to.state.y;
  out.t = t;
  out.impact_rate = step.from.state.impact_rate;
  out.y.resize(system.n_y());

  // q = Σ of the six quintic Hermite polynomials, s = q′/h
  const double p1 = 10 * x3 - 15 * x4 + 6 * x5, v0 = x - 6 * x3 + 8 * x4 - 3 * x5,
               v1 = -4 * x3 + 7 * x4 - 3 * x5, a0 = 0.5 * x2 - 1.5 * x3 + 1.5 * x4 - 0.5 * x5,
               a1 = 0.5 * x3 - x4 + 0.5 * x5;
  const double dp1 = 30 * x2 - 60 * x3 + 30 * x4, dv0 = 1 - 18 * x2 + 32 * x3 - 15 * x4,
               dv1 = -12 * x2 + 28 * x3 - 15 * x4, da0 = x - 4.5 * x2 + 6 * x3 - 2.5 * x4,
               da1 = 1.5 * x2 - 4 * x3 + 2.5 * x4;
  for (Index i = 0; i < n; ++i) {
    const double rise = y1[i] - y0[i], s0 = h * y0[n + i], s1 = h * y1[n + i];
    const double b0 = h * h * step.from.dy[n + i], b1 = h * h * step.to.dy[n + i];
    out.y[i] = y0[i] + p1 * rise + v0 * s0 + v1 * s1 + a0 * b0 + a1 * b1;
    out.y[n + i] = (dp1 * rise + dv0 * s0 + dv1 * s1 + da0 * b0 + da1 * b1) / h;
  }
  for (Index i = 2 * n; i < 2 * n + nz; ++i) {
    const double rise = y1[i] - y0[i];
    out.y[i] = y0[i] + x2 * (3 - 2 * x) * rise + x * (1 - x) * (1 - x) * h * step.from.dy[i] +
               x2 * (x - 1) * h * step.to.dy[i];
  }
}

}  // namespace pintle
