// Contact onset and loss as events in time, and changes of laws: the part of Integrator that finds them and ends a step there.
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/integration/integrator.h"

namespace pintle {

namespace {
std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Greatest f(x), 0 < x < 1, of an f with one summit: the summit of the parabola through three points, golden section
// where that does not close in fast [Brent1973, ch. 5]. f is flat there: x to 1e-3 is f to about 1e-6 of its change.
template <class F>
double greatest(F f) {
  constexpr double golden = 0.3819660112501051, enough = 1e-3;
  struct Point {
    double x, f;
  };
  double a = 0, b = 1, moved = 1, moved_before = 1;
  Point best{0.5, f(0.5)}, second = best, third = best;
  for (int i = 0; i < 50 && std::abs(best.x - (a + b) / 2) + (b - a) / 2 > 2 * enough; ++i) {
    const double r = (best.x - second.x) * (best.f - third.f), q = (best.x - third.x) * (best.f - second.f);
    double step = q == r ? 2 : -0.5 * ((best.x - third.x) * q - (best.x - second.x) * r) / (q - r);
    const bool good = std::abs(step) < 0.5 * moved_before && best.x + step > a && best.x + step < b;
    if (!good) step = golden * (best.x < (a + b) / 2 ? b - best.x : a - best.x);
    if (std::abs(step) < enough) step = std::copysign(enough, step);
    moved_before = moved, moved = std::abs(step);
    const double x = best.x + step;
    const Point now{x, f(x)};
    if (now.f >= best.f) {
      (now.x > best.x ? a : b) = best.x;
      third = second, second = best, best = now;
    } else {
      (now.x > best.x ? b : a) = now.x;
      if (now.f >= second.f || second.x == best.x)
        third = second, second = now;
      else if (now.f >= third.f || third.x == best.x || third.x == second.x)
        third = now;
    }
  }
  return best.f;
}

// When depth was zero, to first order, if that was in the step of length h, or would be as soon after its end at t.
double moment(double t, double h, double depth, double rate) { return std::abs(depth) < std::abs(rate) * h ? t - depth / rate : t; }

}  // namespace

// Where a step from t must end for the sake of the laws of time: at a change of one, or at the end of the next piece.
double Integrator::law_ahead(double t) const {
  double ahead = std::numeric_limits<double>::infinity();
  const auto change = std::upper_bound(scheme_.changes.begin(), scheme_.changes.end(), t, [](double x, const LawChange& c) { return x < c.before; });
  if (change != scheme_.changes.end()) ahead = change->before;
  for (const std::vector<double>& ends : scheme_.pieces)
    if (const auto end = std::upper_bound(ends.begin(), ends.end(), t); end != ends.end() && end + 1 != ends.end()) ahead = std::min(ahead, *(end + 1));
  return ahead;
}

// A step that begins where a law changes begins after the change.
bool Integrator::pass_change() {
  State& from = step_.from.state;
  const auto next = std::upper_bound(scheme_.changes.begin(), scheme_.changes.end(), from.t, [](double x, const LawChange& c) { return x < c.before; });
  if (next == scheme_.changes.begin() || from.t >= (next - 1)->after) return true;
  from.t = (next - 1)->after;
  if (!(next - 1)->jumps) return true;
  h_ = 0;
  error_before_ = 1;
  return settle(step_.from) || stop("singular pose where a law of time jumps");
}

void Integrator::close(int contact, double rate) {
  State& state = step_.to.state;
  const Touch now = touch(contact, state);
  const double latched = std::max(rate, system_.contacts[at(contact)].slowest_impact);
  state.impact_rate[at(contact)] = latched;
  open_impact_[at(contact)] = static_cast<int>(impacts_.size());
  Impact impact{.contact = contact, .begin = scheme_.onset_cut > 0 ? state.t : moment(state.t, step_.h, now.depth, now.rate), .approach = latched};
  if (now.depth > 0 || system_.contacts[at(contact)].normal.d > 0) {
    impact.deepest = std::max(now.depth, 0.0);  // a start inside the wall, or a force that begins with a jump
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
  const Touch now = touch(contact, state);
  impact.end = scheme_.onset_cut > 0 ? state.t : moment(state.t, step_.h, now.depth, now.rate);
  impact.separation = -now.rate;
  state.impact_rate[at(contact)] = 0;
  open_impact_[at(contact)] = -1;
}

// The first explicit step of an impact. Its force begins as (1 + χ)(vt)ⁿ, which no series of whole powers follows and no embedded
// error sees in full: of the (1 + χ) ½ v (hv/δ)ⁿ⁺¹ by which it changes the speed v in the step h, δ the depth that v can reach, a
// pair misses some thousandth, and that is to be the tolerance [s].
double Integrator::onset_step(int contact) const {
  constexpr double missed = 1e-3, clock = 1e-14;
  const ImpactLaw& law = system_.contacts[at(contact)].normal;
  const double v = after_[at(contact)].rate;
  if (!(v > 0)) return h_;
  const double depth = std::pow((law.n + 1) * v * v / (2 * lightness(contact) * law.k), 1 / (law.n + 1));
  const double part = std::pow(scheme_.tolerance / (missed * (1 + law.chi)), 1 / (law.n + 1));
  return std::max(part * depth / v, clock * std::abs(step_.to.state.t));
}

// How long the closed contacts last at the rate at which they open: there the force has a kink, which a step should
// meet at its end rather than inside [s].
double Integrator::release_ahead() const {
  constexpr double little = 1e-2;  // of the step wished for: so near, the step may as well pass
  constexpr double past = 1.02;    // which opens faster and faster
  double ahead = std::numeric_limits<double>::infinity();
  if (alpha_) return ahead;
  for (std::size_t c = 0; c < before_.size(); ++c) {
    if (open_impact_[c] < 0 || !(before_[c].rate < 0) || !(before_[c].depth > 0)) continue;
    const double left = past * before_[c].depth / -before_[c].rate;
    if (left > little * h_) ahead = std::min(ahead, left);
  }
  return ahead;
}

// An explicit step leaves the equations as they are at its end.
void Integrator::look_at_end() {
  for (int c = 0; c < static_cast<int>(after_.size()); ++c)
    after_[at(c)] = stages_ && step_.h > 0 ? Touch{eq_.contact[at(c)].gap.depth, eq_.contact[at(c)].gap.rate} : touch(c, step_.to.state);
}

// Deepest penetration, peak force and loss of the contacts that are closed during the last step.
void Integrator::follow_impacts() {
  for (int c = 0; c < static_cast<int>(system_.contacts.size()); ++c) {
    if (open_impact_[at(c)] < 0) continue;
    Impact& impact = impacts_[at(open_impact_[at(c)])];
    const ContactPair& pair = system_.contacts[at(c)];
    const double t0 = step_.from.state.t, latched = step_.from.state.impact_rate[at(c)];
    const auto force = [&](const Touch& now) {
      return now.depth > 0 && latched > 0 ? evaluate(pair.normal, Approach{now.depth, now.rate, latched}) : NormalForce{};
    };
    const Touch from = before_[at(c)], to = after_[at(c)];
    const NormalForce first = force(from), last = force(to);
    impact.deepest = std::max(impact.deepest, to.depth);
    if (from.rate > 0 && to.rate < 0)
      impact.deepest = std::max(impact.deepest, greatest([&](double x) { return touch_at(c, t0 + x * step_.h).depth; }));
    impact.peak_force = std::max(impact.peak_force, last.force);
    const double mean = step_.h > 0 ? (to.rate - from.rate) / step_.h : 0;
    const auto rising = [&](const NormalForce& f, const Touch& now) { return f.d_depth * now.rate + f.d_rate * mean > 0; };
    if (step_.h > 0 && last.force > 0 && !rising(last, to) && (first.force == 0 || rising(first, from)))
      impact.peak_force = std::max(impact.peak_force, greatest([&](double x) { return force(touch_at(c, t0 + x * step_.h)).force; }));
    const Eigen::Index z = 2 * system_.n() + system_.contact_z[at(c)];
    impact.lost = step_.to.state.y[z] + (pair.friction ? step_.to.state.y[z + 1] : 0) -
                  loss_at_begin_[at(c)];
  }
}

// Where depth crosses zero between two times of the last step whose depths differ in sign: Newton's method on the dense
// output, bisection where it leaves the bracket or, going away, would lead back, by as little as rounding hides.
double Integrator::crossing(int contact, double t0, double t1, bool onset) {
  const double sign = onset ? 1 : -1, fine = 1e-9 * step_.h;  // finer than dense output is good for
  const double f0 = sign * touch_at(contact, t0).depth, f1 = sign * touch_at(contact, t1).depth;
  if (f0 >= 0) return t0;
  double t = t0 - f0 * (t1 - t0) / (f1 - f0);
  for (int i = 0; i < 100; ++i) {
    const Touch now = touch_at(contact, t);
    const double f = sign * now.depth;
    (f < 0 ? t0 : t1) = t;
    double next = t - f / (sign * now.rate);
    if (!(sign * now.rate > 0 && next >= t0 && next <= t1)) next = t0 + (t1 - t0) / 2;
    if (std::abs(next - t) <= fine) return next;
    t = next;
  }
  return t;
}

// The earliest onset or loss inside the last step; contact = −1 if there is none.
double Integrator::first_event(int& contact, bool& onset) {
  const double t0 = step_.from.state.t, t1 = step_.to.state.t;
  double first = t1;
  contact = -1;
  look_at_end();
  for (int c = 0; c < static_cast<int>(system_.contacts.size()); ++c) {
    if (system_.contacts[at(c)].link >= 0) continue;
    const bool closed = open_impact_[at(c)] >= 0;
    const double sign = closed ? -1 : 1;  // the event is where sign·depth becomes positive
    const Touch a = before_[at(c)], b = after_[at(c)];
    const double fa = sign * a.depth, fb = sign * b.depth, ra = sign * a.rate, rb = sign * b.rate;
    double begin = t0, end = t1;
    bool found = fb > 0;
    if (!found && ra > 0 && rb < 0) {  // may touch and leave within the step: secants of the rate lead to the summit
      double low = t0, high = t1, r0 = ra, r1 = rb;
      for (int i = 0; i < 8 && !found; ++i) {
        const double t = low + (high - low) * r0 / (r0 - r1);
        const Touch now = touch_at(c, t);
        const double depth = sign * now.depth, rate = sign * now.rate;
        if (depth > 0) end = t, found = true;
        if (depth + std::max(rate * (high - t), rate * (low - t)) <= 0) break;  // nor does the summit
        (rate > 0 ? low : high) = t;
        (rate > 0 ? r0 : r1) = rate;
      }
    }
    if (!found) continue;
    const double wall = 1e-9 * system_.contacts[at(c)].gap.clearance();
    if (fa > -wall && ra < 0) {  // at the wall and going away: search from where it has gone away
      for (double part = 0.5; part > 1e-9 && begin == t0; part /= 2)
        if (const double t = t0 + part * (end - t0); sign * touch_at(c, t).depth < std::min(fa, 0.0))
          begin = t;
      if (begin == t0 && fa >= 0) {  // it never has: an open contact that ends inside begins here again
        if (closed || events_here_ > 4) continue;
        end = t0;
      }
    } else if (fa >= 0) {
      end = t0;
    }
    const double t = end > begin ? crossing(c, begin, end, !closed) : t0;
    if (contact < 0 || t < first) first = t, contact = c, onset = !closed;
  }
  return first;
}

// Ends the last step at the event near t: true steps of the scheme, not dense output, corrected until the wall is
// met: until what the contact stores at the depth that is left is, of the impact's energy, a ten-thousandth of the tolerance.
// @returns false if it is not found so; step_.h is then as before
bool Integrator::finish_at(double t, int contact) {
  const double t0 = step_.from.state.t, t1 = step_.to.state.t, h = step_.h;
  const double wall = 1e-9 * system_.contacts[at(contact)].gap.clearance();
  if (t <= t0) {  // at once
    step_.to = step_.from;
    step_.h = 0;
    return true;
  }
  const double enough = 1e-15 * system_.length, part = std::sqrt(1e-4 * scheme_.tolerance);
  constexpr double last_digits = 4.5e-16;  // two of the clock's: between them the wall cannot be met more nearly
  double depth = 0;
  for (int i = 0; i < 6 && t > t0; ++i) {
    if (!attempt(t - t0)) return stop("singular pose while locating an impact");
    const Touch at_end = touch(contact, step_.to.state);
    depth = at_end.depth;
    if (std::abs(depth) <= enough || at_end.rate == 0) return true;
    if (speed_to_reach(contact, std::abs(depth)) <= part * std::abs(at_end.rate)) return true;
    const double next = std::clamp(t - depth / at_end.rate, t0, t1);
    if (std::abs(next - t) <= last_digits * std::abs(t1)) return true;
    t = next;
  }
  if (t > t0 && std::abs(depth) <= wall) return true;
  step_.h = h;
  return false;
}

}  // namespace pintle
