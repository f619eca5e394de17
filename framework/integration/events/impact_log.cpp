#include "framework/integration/events/impact_log.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/dynamics/equations/meshing.h"
#include "framework/dynamics/model/massless_boundary.h"
#include "framework/integration/stepper.h"

namespace pintle {

namespace {

// Maximum of f(x), 0 < x < 1, for f with one maximum: vertex of the parabola through three points, golden section where that converges
// slowly [Brent1973, ch. 5]. f is flat there: x to 1e-3 gives f to about 1e-6 of its change.
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

}  // namespace

ImpactLog::ImpactLog(const System& system)
    : system_(system), open_(system.contacts.size(), -1), loss_at_begin_(system.contacts.size(), 0.0) {}

double ImpactLog::loss(int contact, const State& state) const {
  const Eigen::Index z = system_.z_begin() + system_.contact_z[at(contact)];
  return state.y[z] + (system_.contacts[at(contact)].friction ? state.y[z + 1] : 0);
}

void ImpactLog::begin(int contact, const State& before, const Guard& gap, double begin, double latched) {
  const ContactPair& pair = system_.contacts[at(contact)];
  open_[at(contact)] = static_cast<int>(impacts_.size());
  Impact impact{.contact = contact, .begin = begin, .approach = latched};
  if (!is_rigid(pair) && (gap.value > 0 || begins_with_jump(pair.normal))) {
    impact.deepest = std::max(gap.value, 0.0);  // a start with overlap, or a force that begins with a jump
    impact.peak_force = (pair.massless ? normal_force(system_, contact, before, latched)
                                       : evaluate(pair.normal, approach_of(pair, gap.value, gap.rate, latched)))
                            .force;
  }
  loss_at_begin_[at(contact)] = loss(contact, before);
  impacts_.push_back(impact);
}

void ImpactLog::end(int contact, double end, double separation) {
  Impact& impact = impacts_[at(open_[at(contact)])];
  impact.end = end;
  impact.separation = separation;
  open_[at(contact)] = -1;
}

void ImpactLog::strike(const Blow& blow, const State& state) {
  Impact& impact = impacts_[at(open_[at(blow.contact)])];
  impact.impulse += blow.impulse;
  impact.lost = loss(blow.contact, state) - loss_at_begin_[at(blow.contact)];
  if (blow.at_rest) impact.begin = *blow.at_rest;
  if (blow.separation > 0) end(blow.contact, state.t, blow.separation);
}

void ImpactLog::pass(int contact, int to) {
  impacts_[at(open_[at(contact)])].contact = to;
  loss_at_begin_[at(to)] = loss_at_begin_[at(contact)];
  std::swap(open_[at(to)], open_[at(contact)]);
}

void ImpactLog::follow(const Step& step, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput& motion) {
  for (int c = 0; c < static_cast<int>(open_.size()); ++c)
    if (touching(c)) follow(c, step, from[at(c)], to[at(c)], motion);
}

void ImpactLog::follow(int c, const Step& step, const Guard& from, const Guard& to, const DenseOutput& motion) {
  Impact& impact = impacts_[at(open_[at(c)])];
  const ContactPair& pair = system_.contacts[at(c)];
  if (is_rigid(pair)) {
    if (const double overlap = gap_of(system_, c, step.to.state).value; overlap > pair.slack)
      impact.deepest = std::max(impact.deepest, overlap);
    impact.peak_force = std::max(impact.peak_force, step.to.state.friction[at(c)].load);
    impact.lost = loss(c, step.to.state) - loss_at_begin_[at(c)];
    return;
  }
  const double t0 = step.from.state.t, latched = step.from.state.impact_rate[at(c)];
  const auto inside = [&](double x) -> const State& { return motion.at(t0 + x * step.h); };
  const auto force = [&](const State& state, const Guard& now) {
    if (pair.massless && latched > 0) return normal_force(system_, c, state, latched);
    return now.value > 0 && latched > 0 ? evaluate(pair.normal, approach_of(pair, now.value, now.rate, latched)) : NormalForce{};
  };
  const NormalForce first = force(step.from.state, from), last = force(step.to.state, to);
  impact.deepest = std::max(impact.deepest, to.value);
  if (from.rate > 0 && to.rate < 0)
    impact.deepest = std::max(impact.deepest, greatest([&](double x) { return gap_of(system_, c, inside(x)).value; }));
  impact.peak_force = std::max(impact.peak_force, last.force);
  const double mean = step.h > 0 ? (to.rate - from.rate) / step.h : 0;
  const auto rising = [&](const NormalForce& f, const Guard& now) { return f.d_depth * now.rate + f.d_rate * mean > 0; };
  if (step.h > 0 && last.force > 0 && !rising(last, to) && (first.force == 0 || rising(first, from)))
    impact.peak_force = std::max(impact.peak_force, greatest([&](double x) {
                                   const State& state = inside(x);
                                   return force(state, gap_of(system_, c, state)).force;
                                 }));
  impact.lost = loss(c, step.to.state) - loss_at_begin_[at(c)];
}

const char* ImpactLog::fault() const {
  const std::size_t contacts = system_.contacts.size();
  if (open_.size() != contacts || loss_at_begin_.size() != contacts) return foreign_modes;
  for (std::size_t c = 0; c < contacts; ++c) {
    const int open = open_[c];
    if (open >= static_cast<int>(impacts_.size()) || open < -1 || (open >= 0 && impacts_[at(open)].contact != static_cast<int>(c)))
      return "the impact of a contact is missing";
  }
  for (const Impact& i : impacts_)
    if (i.contact < 0 || i.contact >= static_cast<int>(contacts)) return "an impact belongs to no contact";
  return nullptr;
}

namespace {

struct Facing {
  MovingPoint a, b;
  Gap gap;
};
Facing facing(const System& system, int contact, const State& state) {
  const ContactPair& pair = system.contacts[at(contact)];
  const MovingPoint a = moving_point(system, pair.a, state.y);
  MovingPoint b = moving_point(system, pair.b, state.y);
  if (pair.flank) b = in_its_gap(system, pair, contact, state.y, b);
  Facing out{a, b, gap_between(pair, a, b)};
  out.gap.depth -= pair.slack;
  return out;
}

}  // namespace

Guard gap_of(const System& system, int contact, const State& state) {
  const Gap gap = facing(system, contact, state).gap;
  return {gap.depth, gap.rate};
}

ContactEffect pressing(const System& system, int contact, const State& state) {
  const ContactPair& pair = system.contacts[at(contact)];
  ContactEffect out;
  out.gap = facing(system, contact, state).gap;
  if (is_rigid(pair))
    out.normal.force = state.friction[at(contact)].load;
  else if (const double latched = state.impact_rate[at(contact)]; latched > 0)
    out.normal = pair.massless ? normal_force(system, contact, state, latched)
                               : evaluate(pair.normal, approach_of(pair, out.gap.depth, out.gap.rate, latched));
  return out;
}

NormalForce normal_force(const System& system, int contact, const State& state, double latched) {
  const ContactPair& pair = system.contacts[at(contact)];
  const Facing now = facing(system, contact, state);
  if (!pair.massless) return evaluate(pair.normal, approach_of(pair, now.gap.depth, now.gap.rate, latched));
  return now.gap.depth > 0 ? massless_force(pair, now.a, now.b, now.gap, latched) : NormalForce{};
}

namespace {

// If the other piece is inside the material behind a straight piece: how much nearer it is to this piece than to its ends, and thus to the
// pieces there. Deeper inside, the piece through which it came can no longer be identified.
Guard belonging(const ContactPair& pair, const Facing& now) {
  Guard out{std::numeric_limits<double>::infinity(), 0};
  const std::array<PlaceOn, 2> place = places(pair.gap, now.gap, now.a, now.b);
  for (std::size_t i = 0; i < 2; ++i) {
    const Piece &line = i == 0 ? pair.gap.a : pair.gap.b, &other = i == 0 ? pair.gap.b : pair.gap.a;
    if (!line.straight || std::isinf(line.half)) continue;
    const double inside = now.gap.depth - (other.curve ? least_radius(other) : std::max(other.radius, 0.0));
    for (const int side : {-1, 1}) {
      const double left = (pair.extent[2 * i + (side > 0)] - side * place[i].at) * line.half - inside;
      if (inside > 0 && left < out.value) out = {left, -side * place[i].rate * line.half - now.gap.rate};
    }
  }
  return out;
}

}  // namespace

Guard onset_of(const System& system, int contact, const State& state) {
  if (is_released(system, Switch::contact, contact, state.y)) return {-1};
  const ContactPair& pair = system.contacts[at(contact)];
  const Facing now = facing(system, contact, state);
  Guard out{now.gap.depth, now.gap.rate};
  if (!pair.profiles) return out;
  if (pair.deepest - now.gap.depth < out.value) out = {pair.deepest - now.gap.depth, -now.gap.rate};
  if (const Margin inside = margin(pair, now.gap, now.a, now.b); inside.value < out.value) out = {inside.value, inside.rate};
  if (const Guard nearest = belonging(pair, now); nearest.value < out.value) out = nearest;
  return out;
}

bool was_pressed(const System& system, int contact, const State& from) {
  const auto pressed = [&](int c) { return c >= 0 && from.impact_rate[at(c)] > 0; };
  return pressed(contact) || std::ranges::any_of(system.contacts[at(contact)].beyond, pressed);
}

double time_of_force(const System& system, int contact, const State& from, double h, double fixed_step) {
  return h > short_part * fixed_step && was_pressed(system, contact, from) ? h : fixed_step;
}

ToExamine to_examine(const System& system, int contact, const Step& step) {
  constexpr double faster = 2, least = 16, most = 4096;
  const ContactPair& pair = system.contacts[at(contact)];
  double speed = 0, rate = 0, near = -std::numeric_limits<double>::infinity(), onset = near;
  for (const State* state : {&step.from.state, &step.to.state}) {
    const Gap gap = facing(system, contact, *state).gap;
    speed = std::max(speed, std::hypot(gap.rate, gap.sideways));
    near = std::max(near, gap.depth);
  }
  if (near < -faster * speed * step.h) return {};
  for (const State* state : {&step.from.state, &step.to.state}) {
    rate = std::max({rate, speed, std::abs(margin_of(system, contact, *state).rate)});
    onset = std::max(onset, onset_of(system, contact, *state).value);
  }
  if (onset < -faster * rate * step.h) return {};
  double size = std::min(system.length, pair.deepest);
  for (const Piece* piece : {&pair.gap.a, &pair.gap.b}) {
    const double length = piece->straight || piece->curve ? piece->half : std::abs(piece->radius) * std::min(piece->half, 1.0);
    if (length > 0) size = std::min(size, 2 * length);
  }
  const double reach = 4 * speed * step.h;
  return {static_cast<int>(std::clamp(reach / size, least, most)), reach};
}

Margin margin_of(const System& system, int contact, const State& state) {
  const ContactPair& pair = system.contacts[at(contact)];
  const Facing now = facing(system, contact, state);
  return margin(pair, now.gap, now.a, now.b);
}

}  // namespace pintle
