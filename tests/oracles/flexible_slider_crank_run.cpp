#include <algorithm>
#include <cmath>
#include <utility>

#include "flexible_slider_crank.h"
#include "runge_kutta.h"

namespace pintle_oracle::flexible {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vec<size> scales(const Model& m) {
  const Params& p = m.p;
  const double c = m.ideal ? p.crank : p.clearance;
  const double v = std::max(std::abs(p.speed), std::sqrt(p.gravity / p.crank)) * std::sqrt(c * p.crank);
  const double energy = p.slider_mass * v * v;
  const Vector3d strain = (2 * energy * m.coupler.stiffness.diagonal().cwiseInverse()).cwiseSqrt();
  const double turn = v / p.coupler;
  return {c / p.crank, c / p.coupler, strain[0], strain[1], strain[2], c, v / p.crank, turn, v, turn, turn, v, energy, energy, energy};
}

/// One run: the mode (touching or not) is constant within a step and changes at located events.
struct Runner {
  const Model& m;
  const Options& o;
  Result out{};
  State& s = out.end;
  const Vec<size> scale = scales(m);
  Impact impact{};
  Y k{}, y_new{}, k_new{};
  double h_next[2] = {o.first_step, o.first_step};  // one memory per mode

  void renew_slope() {
    rhs(m, s, k);
    ++out.evaluations;
  }

  /// @returns the error over what is tolerated
  double step(double h) {
    Y error;
    State at = s;
    const auto f = [&](const Y& y, Y& dy) {
      at.y = y;
      rhs(m, at, dy);
    };
    out.evaluations += embedded_step<Dopri54, dynamic, size>(f, s.y, k, h, y_new, k_new, error);
    if (m.ideal) close_loop(m.p, y_new);
    return error_ratio<size>(error, scale, o.tolerance);
  }

  /// Depth and rate.
  std::array<double, 2> margin(const Y& y) const {
    const Gap g = gap(m, y);
    return {g.depth, g.rate};
  }

  /// First eighth of the step at whose end the other mode is due, by cubics in e; 0 if none is.
  int crossing(double h) const {
    const Gap a = gap(m, s.y), b = gap(m, y_new);
    for (int i = 1; i <= 8; ++i) {
      const double u = i / 8.0, w = u * u * (3 - 2 * u);
      const Vector2d e =
          i == 8 ? b.e : Vector2d(a.e + w * (b.e - a.e) + h * u * (1 - u) * (1 - u) * a.e_rate - h * u * u * (1 - u) * b.e_rate);
      if ((e.norm() > m.p.clearance) != s.touching) return i;
    }
    return 0;
  }

  /// Shortens the step to end on the event; y_new, k_new and h follow. @returns false if the motion
  /// at `upper` turns out not to have crossed: then that is the step.
  bool locate(double upper, double& h) {
    const double sign = s.touching ? -1 : 1;
    double low = 0, high = upper, t = upper;
    for (int i = 0; i < 60; ++i) {
      step(h = t);
      const auto [depth, depth_rate] = margin(y_new);
      const double past = sign * depth, rate = sign * depth_rate;
      if (i == 0 && past <= 0) return false;
      if (std::abs(past) <= 2e-16 * (m.p.crank + m.p.coupler) && rate > 0) break;
      (past > 0 ? high : low) = t;
      if (high - low <= 1e-17) break;
      const double guess = rate > 0 ? t - past / rate : low;
      t = guess > low && guess < high ? guess : 0.5 * (low + high);
    }
    return true;
  }

  /// True if the step was made to end on an event.
  bool cut_at_event(double& h) {
    if (m.ideal) return false;
    int eighth = crossing(h);
    while (eighth == 1 && h > 1e-13) {  // just left the last event: separate the two first
      step(h /= 8);
      eighth = crossing(h);
    }
    return eighth > 0 && locate(h * eighth / 8, h);
  }

  void begin_contact() {
    const double rate = margin(s.y)[1];
    if (!s.touching) s.latch = std::max(rate, latch_floor);  // a continued run keeps its own
    s.touching = true;
    impact = {.begin = s.t, .approach = rate, .loss = -s.y[12], .friction_loss = -s.y[13]};
  }

  void end_contact(bool finished) {
    impact.end = s.t;
    impact.finished = finished;
    if (finished) impact.separation = -margin(s.y)[1];
    impact.loss += s.y[12];
    impact.friction_loss += s.y[13];
    out.impacts.push_back(impact);
    if (finished) s.touching = false;
  }

  /// Deepest point of a touching step; inside it by the cubic through depths and rates.
  void track_depth(double h) {
    const auto [d0, r0] = margin(s.y);
    const auto [d1, r1] = margin(y_new);
    impact.deepest = std::max(impact.deepest, d1);
    if (r0 <= 0 || r1 > 0) return;
    // Rate over the step: r0 + u (b + 3 a u), zero where it falls.
    const double a = h * (r0 + r1) - 2 * (d1 - d0), b = 3 * (d1 - d0) - h * (2 * r0 + r1);
    const double root = std::sqrt(std::max(0.0, b * b - 3 * a * h * r0));
    const double u = std::clamp(h * r0 / (root - b), 0.0, 1.0);
    impact.deepest = std::max(impact.deepest, d0 + u * (h * r0 + u * (b + u * a)));
  }

  /// @returns false if evaluations ran out
  bool advance(double t_end) {
    while (s.t < t_end) {
      if (out.evaluations > o.max_evaluations) return false;
      const bool was = s.touching;
      double h = std::min(h_next[was], t_end - s.t);
      const bool cut = h < h_next[was];
      const double ratio = step(h);
      if (!(ratio <= 1) && h > 1e-15) {
        ++out.rejected;
        h_next[was] = h * std::min(1.0, std::isfinite(ratio) ? step_factor(ratio) : 0.1);
        continue;
      }
      const double factor = step_factor(ratio);
      if (!cut || factor < 1) h_next[was] = h * factor;
      const double whole = h;
      const bool event = cut_at_event(h);
      if (was) track_depth(h);
      ++out.steps;
      s.t = h == whole && s.t + h >= t_end ? t_end : s.t + h;
      s.y = y_new;
      k = k_new;
      if (!event) continue;
      was ? end_contact(true) : begin_contact();
      renew_slope();
    }
    return true;
  }
};

}  // namespace

Result simulate(const Model& m, const Options& o, const State& from, const std::vector<double>& times) {
  Runner runner{.m = m, .o = o};
  State& s = runner.s;
  s = from;
  if (s.touching) runner.begin_contact();
  runner.renew_slope();
  runner.out.completed = true;
  for (const double t : times) {
    if (!runner.advance(t)) {
      runner.out.completed = false;
      break;
    }
    runner.out.samples.push_back(evaluate(m, s));
  }
  if (s.touching) runner.end_contact(false);
  return std::move(runner.out);
}

}  // namespace pintle_oracle::flexible
