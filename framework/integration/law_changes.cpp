#include "framework/integration/law_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {

namespace {

/// A time that rounding alone separates from t counts as passed: what ends a step may be located one digit before it.
double just_after(double t) {
  constexpr double roundings = 1e-15;
  return t + roundings * std::abs(t);
}

/// End of the next step for a law with these bends, for a method that evaluates it only at the ends of its steps.
double end_within_bend(const std::vector<LawBend>& bends, double t) {
  constexpr double steps = 6, rest = 0.01;  // a remainder shorter than this part is not a separate step
  const double after = just_after(t);
  const auto bend = std::upper_bound(bends.begin(), bends.end(), after, [](double x, const LawBend& b) { return x < b.end; });
  if (bend == bends.end()) return std::numeric_limits<double>::infinity();
  if (after < bend->begin) return bend->begin;
  const double longest = (bend->end - bend->begin) / steps;
  return t + (1 + rest) * longest < bend->end ? t + longest : bend->end;
}

auto next_change(const Scheme& scheme, double t) {
  return std::upper_bound(scheme.changes.begin(), scheme.changes.end(), just_after(t),
                          [](double x, const LawChange& c) { return x < c.before; });
}

}  // namespace

double law_end(const Scheme& scheme, double t, bool sees_ends_alone) {
  double ahead = std::numeric_limits<double>::infinity();
  const auto change = next_change(scheme, t);
  if (change != scheme.changes.end()) ahead = change->before;
  for (const std::vector<double>& ends : scheme.pieces)
    if (const auto end = std::upper_bound(ends.begin(), ends.end(), t); end != ends.end() && end + 1 != ends.end())
      ahead = std::min(ahead, *(end + 1));
  if (sees_ends_alone)
    for (const std::vector<LawBend>& bends : scheme.bends) ahead = std::min(ahead, end_within_bend(bends, t));
  return ahead;
}

const LawChange* change_at(const Scheme& scheme, double t) {
  const auto next = next_change(scheme, t);
  return next == scheme.changes.begin() || t >= (next - 1)->after ? nullptr : &*(next - 1);
}

TurnAhead::TurnAhead(const System& system) {
  for (const MotionSignal& signal : system.signals) matters_ = matters_ || (!is_speed(signal.kind) && signal.kind != MotionSignal::state);
  for (const Joint& joint : system.joints)
    if (const auto* relation = std::get_if<Relation>(&joint)) matters_ = matters_ || relation->curve;
}

double TurnAhead::time(const System& system, const State& state) const {
  constexpr double turn = 0.1;
  double fastest = 0;
  if (matters_)
    for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) fastest = std::max(fastest, std::abs(state.y[system.n() + 3 * b + 2]));
  return fastest > 0 ? turn / fastest : std::numeric_limits<double>::infinity();
}

}  // namespace pintle
