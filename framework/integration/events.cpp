// Contact onset and loss as events in time: the part of Integrator that finds them and ends a step there.
#include <algorithm>
#include <cmath>

#include "framework/integration/integrator.h"

namespace pintle {

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Greatest f(x), 0 < x < 1, of an f with one summit: golden section.
template <class F>
double greatest(F f) {
  constexpr double golden = 0.6180339887498949, enough = 1e-5;
  double a = 0, b = 1, x = 1 - golden, y = golden, fx = f(x), fy = f(y);
  while (b - a > enough) {
    if (fx > fy) {
      b = y, y = x, fy = fx;
      fx = f(x = b - golden * (b - a));
    } else {
      a = x, x = y, fx = fy;
      fy = f(y = a + golden * (b - a));
    }
  }
  return std::max(fx, fy);
}
}  // namespace

void Integrator::close(int contact, double rate) {
  State& state = step_.to.state;
  const double latched = std::max(rate, system_.contacts[at(contact)].slowest_impact);
  state.impact_rate[at(contact)] = latched;
  open_impact_[at(contact)] = static_cast<int>(impacts_.size());
  Impact impact{.contact = contact, .begin = state.t, .approach = latched};
  if (const Touch now = touch(contact, state); now.depth > 0) {  // a start inside the wall
    impact.deepest = now.depth;
    impact.peak_force =
        evaluate(system_.contacts[at(contact)].normal, Approach{now.depth, now.rate, latched}).force;
  }
  loss_at_begin_[at(contact)] = state.y[2 * system_.n() + system_.contact_z[at(contact)]] +
                                (system_.contacts[at(contact)].friction
                                     ? state.y[2 * system_.n() + system_.contact_z[at(contact)] + 1]
                                     : 0);
  impacts_.push_back(impact);
}

void Integrator::open(int contact) {
  State& state = step_.to.state;
  Impact& impact = impacts_[at(open_impact_[at(contact)])];
  impact.end = state.t;
  impact.separation = -touch(contact, state).rate;
  state.impact_rate[at(contact)] = 0;
  open_impact_[at(contact)] = -1;
}

// Deepest penetration, peak force and loss of the contacts that are closed during the last step.
void Integrator::follow_impacts() {
  for (int c = 0; c < static_cast<int>(system_.contacts.size()); ++c) {
    if (open_impact_[at(c)] < 0) continue;
    Impact& impact = impacts_[at(open_impact_[at(c)])];
    const ContactPair& pair = system_.contacts[at(c)];
    const double t0 = step_.from.state.t, latched = step_.from.state.impact_rate[at(c)];
    const auto force = [&](const Touch& now) {
      return now.depth > 0 && latched > 0 ? evaluate(pair.normal, Approach{now.depth, now.rate, latched}).force : 0;
    };
    const Touch from = before_[at(c)], to = touch(c, step_.to.state);
    impact.deepest = std::max(impact.deepest, to.depth);
    if (from.rate > 0 && to.rate < 0)
      impact.deepest = std::max(impact.deepest, greatest([&](double x) { return touch_at(c, t0 + x * step_.h).depth; }));
    impact.peak_force = std::max(impact.peak_force, force(to));
    const auto inside = [&](double x) { return force(touch_at(c, t0 + x * step_.h)); };
    constexpr double near = 1e-3;  // the force rises at the step's start and falls at its end
    if (step_.h > 0 && inside(1 - near) > force(to) && inside(near) > force(from))
      impact.peak_force = std::max(impact.peak_force, greatest(inside));
    const Eigen::Index z = 2 * system_.n() + system_.contact_z[at(c)];
    impact.lost = step_.to.state.y[z] + (pair.friction ? step_.to.state.y[z + 1] : 0) -
                  loss_at_begin_[at(c)];
  }
}

// Where depth crosses zero between two times of the last step whose depths differ in sign: the
// Illinois variant of regula falsi on the dense output.
double Integrator::crossing(int contact, double t0, double t1, bool onset) {
  const double sign = onset ? 1 : -1;
  double f0 = sign * touch_at(contact, t0).depth, f1 = sign * touch_at(contact, t1).depth;
  if (f0 >= 0) return t0;
  for (int i = 0; i < 100 && t1 - t0 > 1e-16 * std::abs(t1); ++i) {
    double t = t1 - f1 * (t1 - t0) / (f1 - f0);
    if (!(t > t0 && t < t1)) t = 0.5 * (t0 + t1);
    if (t <= t0 || t >= t1) break;
    const double f = sign * touch_at(contact, t).depth;
    if (f == 0) return t;
    if (f < 0) {
      t0 = t, f0 = f;
      f1 /= 2;
    } else {
      t1 = t, f1 = f;
      f0 /= 2;
    }
  }
  return t1;
}

// The earliest onset or loss inside the last step; contact = −1 if there is none.
double Integrator::first_event(int& contact, bool& onset) {
  const double t0 = step_.from.state.t, t1 = step_.to.state.t, h = t1 - t0;
  double first = t1;
  contact = -1;
  for (int c = 0; c < static_cast<int>(system_.contacts.size()); ++c) {
    const bool closed = open_impact_[at(c)] >= 0;
    const double sign = closed ? -1 : 1;  // the event is where sign·depth becomes positive
    const Touch a = before_[at(c)], b = touch(c, step_.to.state);
    const double fa = sign * a.depth, fb = sign * b.depth, ra = sign * a.rate, rb = sign * b.rate;
    double begin = t0, end = t1;
    bool found = fb > 0;
    if (!found && ra > 0 && rb < 0) {  // may touch and leave within the step
      const double peak = t0 + h * ra / (ra - rb);
      if (sign * touch_at(c, peak).depth > 0) end = peak, found = true;
    }
    if (!found) continue;
    const double wall = 1e-9 * system_.contacts[at(c)].gap.clearance();
    if (fa > -wall && ra < 0) {  // at the wall and going away: search from where it has gone away
      for (double part = 0.5; part > 1e-9 && begin == t0; part /= 2)
        if (const double t = t0 + part * (end - t0); sign * touch_at(c, t).depth < std::min(fa, 0.0))
          begin = t;
      if (begin == t0 && fa >= 0) continue;
    } else if (fa >= 0) {
      end = t0;
    }
    const double t = end > begin ? crossing(c, begin, end, !closed) : t0;
    if (contact < 0 || t < first) first = t, contact = c, onset = !closed;
  }
  return first;
}

// Ends the last step at the event near t: true steps of the scheme, not dense output, corrected until the
// depth is zero to rounding. @returns false if it is not found so; step_.h is then as before
bool Integrator::finish_at(double t, int contact) {
  const double t0 = step_.from.state.t, t1 = step_.to.state.t, h = step_.h;
  const double enough = 1e-15 * system_.length, wall = 1e-9 * system_.contacts[at(contact)].gap.clearance();
  if (t <= t0) {  // at once
    step_.to = step_.from;
    step_.h = 0;
    return true;
  }
  double depth = 0;
  for (int i = 0; i < 6 && t > t0; ++i) {
    if (!attempt(t - t0)) return stop("singular pose while locating an impact");
    const Touch at_end = touch(contact, step_.to.state);
    depth = at_end.depth;
    if (std::abs(depth) <= enough || at_end.rate == 0) return true;
    const double next = std::clamp(t - depth / at_end.rate, t0, t1);
    if (std::abs(next - t) <= 2e-16 * std::abs(t1)) return true;
    t = next;
  }
  if (t > t0 && std::abs(depth) <= wall) return true;
  step_.h = h;
  return false;
}

}  // namespace pintle
