#include "framework/integration/dense_output.h"

#include <cmath>
#include <limits>

#include "framework/integration/stepper.h"

namespace pintle {

using Index = Eigen::Index;

void begin_inside(const Step& step, double t, State& out) {
  const State &from = step.from.state, &to = step.to.state;
  out.t = t;
  out.impact_rate = from.impact_rate;
  out.friction = from.friction;
  for (std::size_t k = 0; k < out.friction.size(); ++k)
    interpolate_friction(from.friction[k], to.friction[k], (t - from.t) / step.h, out.friction[k]);
}

void interpolate_quintic(const System& system, const Step& step, double t, Eigen::VectorXd& y) {
  const Index n = system.n();
  const double h = step.h, x = (t - step.from.state.t) / h;
  const double x2 = x * x, x3 = x2 * x, x4 = x3 * x, x5 = x4 * x;
  const auto& y0 = step.from.state.y;
  const auto& y1 = step.y_end();
  const auto& dy1 = step.dy_end();
  y.resize(system.n_y());

  // q = Σ of the six quintic Hermite polynomials, s = q′/h. In a short step, s differs from the cubic through the speeds and accelerations
  // of both ends only by the rounding of q1 − q0 over h; then the cubic is better.
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const double p1 = 10 * x3 - 15 * x4 + 6 * x5, v0 = x - 6 * x3 + 8 * x4 - 3 * x5, v1 = -4 * x3 + 7 * x4 - 3 * x5,
               a0 = 0.5 * x2 - 1.5 * x3 + 1.5 * x4 - 0.5 * x5, a1 = 0.5 * x3 - x4 + 0.5 * x5;
  const double dp1 = 30 * x2 - 60 * x3 + 30 * x4, dv0 = 1 - 18 * x2 + 32 * x3 - 15 * x4, dv1 = -12 * x2 + 28 * x3 - 15 * x4,
               da0 = x - 4.5 * x2 + 6 * x3 - 2.5 * x4, da1 = 1.5 * x2 - 4 * x3 + 2.5 * x4;
  for (Index i = 0; i < n; ++i) {
    const double rise = y1[i] - y0[i], s0 = h * y0[n + i], s1 = h * y1[n + i];
    const double b0 = h * h * step.from.dy[n + i], b1 = h * h * dy1[n + i];
    y[i] = y0[i] + p1 * rise + v0 * s0 + v1 * s1 + a0 * b0 + a1 * b1;
    const double by_places = (dp1 * rise + dv0 * s0 + dv1 * s1 + da0 * b0 + da1 * b1) / h;
    const double by_speeds = y0[n + i] + (x2 * (3 - 2 * x) * (s1 - s0) + x * (1 - x) * (1 - x) * b0 + x2 * (x - 1) * b1) / h;
    y[n + i] = std::abs(by_places - by_speeds) <= rounding * (std::abs(y0[i]) + std::abs(y1[i])) / h ? by_speeds : by_places;
  }
  for (Index i = 2 * n; i < system.n_y(); ++i) {
    const double rise = y1[i] - y0[i];
    y[i] = y0[i] + x2 * (3 - 2 * x) * rise + x * (1 - x) * (1 - x) * h * step.from.dy[i] + x2 * (x - 1) * h * dy1[i];
  }
}

// Each is as accurate as the ends of an implicit step.
void interpolate_cubic(const System& system, const Step& step, double t, Eigen::VectorXd& y) {
  const double x = (t - step.from.state.t) / step.h;
  const double rise = x * x * (3 - 2 * x), from = x * (1 - x) * (1 - x) * step.h, to = x * x * (x - 1) * step.h;
  const auto &y0 = step.from.state.y, &y1 = step.y_end(), &dy1 = step.dy_end();
  y.resize(system.n_y());
  for (Index i = 0; i < system.n_y(); ++i) y[i] = y0[i] + rise * (y1[i] - y0[i]) + from * step.from.dy[i] + to * dy1[i];
}

// Modes are copied once for all times. Most pairs of pieces are open, and their friction stays zero.
void DenseOutput::begin() const {
  const State &from = step_.from.state, &to = step_.to.state, &modes = stepper_.traits().fixed_step > 0 ? to : from;
  work_.state.impact_rate = modes.impact_rate;
  work_.state.friction = modes.friction;
  work_.loaded.clear();
  const auto acts = [](const DryFriction& f) { return f.force != 0 || f.load != 0; };
  if (&modes == &from)
    for (std::size_t k = 0; k < from.friction.size(); ++k)
      if (acts(from.friction[k]) || acts(to.friction[k]) || (held_.known() && acts(held_.middle()[k]))) work_.loaded.push_back(k);
  begun_ = true;
}

const State& DenseOutput::at(double t) const {
  if (!begun_) begin();
  const double x = (t - step_.from.state.t) / step_.h;
  work_.state.t = t;
  stepper_.interpolate(step_, t, work_.state.y);
  for (const std::size_t k : work_.loaded) {
    DryFriction& friction = work_.state.friction[k];
    if (held_.known())
      friction = held_.at(step_, t, k);
    else
      interpolate_friction(step_.from.state.friction[k], step_.to.state.friction[k], x, friction);
  }
  return work_.state;
}

}  // namespace pintle
