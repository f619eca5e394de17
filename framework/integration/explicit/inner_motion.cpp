#include "framework/integration/explicit/inner_motion.h"

namespace pintle {

using Eigen::VectorXd;

namespace {

/// out ← the cubic through the values and rates of both ends.
void put_cubic(const Step& step, double x, VectorXd& out) {
  const VectorXd& y0 = step.from.state.y;
  out = y0 + x * x * (3 - 2 * x) * (step.y_end() - y0);
  out += step.h * (x * (1 - x) * (1 - x) * step.from.dy + x * x * (x - 1) * step.dy_end());
}

/// out ← h ẏ − the derivative of the cubic to x
void put_rate(const Step& step, double x, const VectorXd& dy, VectorXd& out) {
  out = step.h * (dy - (1 - x) * (1 - 3 * x) * step.from.dy - x * (3 * x - 2) * step.dy_end());
  out -= 6 * x * (1 - x) * (step.y_end() - step.from.state.y);
}

}  // namespace

bool InnerMotion::is_prepared(const Step& step) const {
  return step.h == h_ && step.from.state.t == t_ && step.from.state.y == from_ && step.y_end() == to_;
}

bool InnerMotion::prepare(const System& system, const Step& step, Stages& stages, Equations& eq) {
  if (is_prepared(step)) return true;
  h_ = 0;
  if (!follow(system, step, stages, eq)) return false;
  from_ = step.from.state.y, to_ = step.y_end();
  t_ = step.from.state.t, h_ = step.h;
  return true;
}

// The quintic through the middle has an error of h⁶. Rates evaluated along a polynomial with an error of hᵖ leave one of hᵖ⁺¹.
bool InnerMotion::follow(const System& system, const Step& step, Stages& stages, Equations& eq) {
  constexpr int passes = evaluations_beyond_step / 4;
  middle_.at.dy.resize(system.n_y());
  if (!stages.reach(system, step.from, step.h / 2, middle_.at, eq)) return false;
  put_rate(step, middle_.x, middle_.at.dy, middle_.rate);
  put_cubic(step, middle_.x, a_);
  a_ = 16 * (middle_.at.state.y - a_);
  b_ = 16 * middle_.rate;
  for (VectorXd* v : {&c_, &d_, &e_, &f_}) v->setZero(system.n_y());
  for (int pass = 0; pass < passes; ++pass) {
    for (Inner& inner : sixths_) {
      inner.at.dy.resize(system.n_y());
      interpolate(step, step.from.state.t + inner.x * step.h, inner.at.state);
      if (!stages.project(system, inner.at, eq)) return false;
      put_rate(step, inner.x, inner.at.dy, inner.rate);
    }
    bend();
  }
  return f_.allFinite();
}

// Differences of the rates at u = ±⅙ and ±⅓ determine c and e, their sums d and f.
void InnerMotion::bend() {
  const VectorXd &r1 = sixths_[0].rate, &r2 = sixths_[1].rate, &r3 = sixths_[2].rate, &r4 = sixths_[3].rate;
  c_ = -4.8 * a_ + 21.6 * (r3 - r2) - 30.24 * (r4 - r1);
  e_ = 259.2 * a_ + 291.6 * (r3 - r2) + 466.56 * (r4 - r1);
  d_ = -81.0 / 7 * b_ + 972.0 / 7 * (r3 + r2) - 1944.0 / 35 * (r4 + r1);
  f_ = 612.0 / 7 * b_ + 972.0 / 7 * (r3 + r2) + 7776.0 / 7 * (r4 + r1);
}

void InnerMotion::interpolate(const Step& step, double t, State& out) const {
  const double x = (t - step.from.state.t) / step.h, u = x - 0.5, part = x * x * (1 - x) * (1 - x);
  out.t = t;
  out.impact_rate = step.from.state.impact_rate;
  out.friction = step.from.state.friction;
  put_cubic(step, x, out.y);
  out.y += part * (a_ + u * (b_ + u * (c_ + u * (d_ + u * (e_ + u * f_)))));
}

}  // namespace pintle
