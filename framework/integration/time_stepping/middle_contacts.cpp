#include "framework/integration/time_stepping/middle_contacts.h"

#include <algorithm>

#include "framework/common/index.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

namespace {

State earlier(const System& system, const State& state, double time) {
  const Eigen::Index n = system.n();
  State out = state;
  out.t -= time;
  out.y.head(n) -= time * state.y.segment(n, n);
  return out;
}

bool is_same_corner(const Piece& a, const Piece& b) { return is_corner(a) && is_corner(b) && a.centre == b.centre; }

}  // namespace

MiddleContacts::MiddleContacts(const System& system)
    : system_(system), before_(system.contacts.size(), 0), now_(before_), goes_on_(before_) {}

void MiddleContacts::look(const State& from, const State& middle, double h) {
  passed_ = -1;
  for (int c = 0; c < static_cast<int>(now_.size()); ++c) {
    goes_on_[at(c)] = was_pressed(system_, c, from);
    now_[at(c)] = look(c, middle, h);
  }
}

bool MiddleContacts::look(int c, const State& middle, double h) {
  const ContactPair& pair = system_.contacts[at(c)];
  if (is_released(system_, Switch::contact, c, middle.y)) return false;
  const double touch = std::max(1e-9 * fine_length(pair, system_.length), pair.slack) + pair.slack, now = gap_of(system_, c, middle).value;
  const auto inside = [&](const State& state) { return !pair.profiles || margin_of(system_, c, state).value >= 0; };
  if (now <= 0 && goes_on_[at(c)]) return inside(middle);
  if (!(now > -touch)) return false;
  if (!pair.profiles) return true;
  if (now <= 0 || before_[at(c)]) return now < pair.deepest && inside(middle);

  const double before = gap_of(system_, c, earlier(system_, middle, h)).value;
  if (before <= 0) {
    if (!inside(earlier(system_, middle, h * now / (now - before)))) return false;
    if (now >= pair.deepest) passed_ = c;
    return now < pair.deepest && inside(middle);
  }
  if (now >= pair.deepest || !inside(middle)) return false;
  const bool goes_on = std::ranges::any_of(pair.beyond, [&](int other) { return other >= 0 && before_[at(other)]; });
  return goes_on || (onset_of(system_, c, middle).value > 0 && !is_held_elsewhere(c));
}

// Whether one of its pieces is a corner that is in contact with another piece already.
bool MiddleContacts::is_held_elsewhere(int c) const {
  const ContactPair& pair = system_.contacts[at(c)];
  for (int other = c - pair.pair; other < c - pair.pair + pair.pairs; ++other) {
    const PiecePair &here = pair.gap, &there = system_.contacts[at(other)].gap;
    if (before_[at(other)] && (is_same_corner(here.a, there.a) || is_same_corner(here.b, there.b))) return true;
  }
  return false;
}

}  // namespace pintle
