// Where periodic orbits lose their stability along a branch.
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/study/nonlinear/nonlinear.h"

namespace pintle {

namespace {

std::size_t outside(const Cycle& cycle) {
  std::size_t n = 0;
  for (std::size_t j = 0; j < cycle.re.size(); ++j) n += cycle.modulus(j) > 1;
  return n;
}

std::size_t real_outside(const Cycle& cycle, double sign) {
  std::size_t n = 0;
  for (std::size_t j = 0; j < cycle.re.size(); ++j) n += cycle.im[j] == 0 && sign * cycle.re[j] > 1;
  return n;
}

/// The signed distance of the multiplier nearest to its crossing: of real ones from 1 or -1, of pairs from the unit circle. Real ones may
/// come from a pair; if only pairs are there, it is that of their real parts.
double nearest(const Cycle& cycle, Crossing through) {
  const auto among = [&](bool pairs) {
    std::optional<double> out;
    for (std::size_t j = 0; j < cycle.re.size(); ++j) {
      if ((cycle.im[j] != 0) != pairs) continue;
      const double off = through == Crossing::pair       ? cycle.modulus(j) - 1
                         : through == Crossing::plus_one ? cycle.re[j] - 1
                                                         : -cycle.re[j] - 1;
      if (!out || std::abs(off) < std::abs(*out)) out = off;
    }
    return out;
  };
  const std::optional<double> found = among(through == Crossing::pair);
  return found ? *found : among(through != Crossing::pair).value_or(0);
}

/// A change in the number of real multipliers beyond -1 or beyond 1; otherwise a pair has crossed.
Crossing crossing(const Cycle& a, const Cycle& b) {
  if (real_outside(a, -1) % 2 != real_outside(b, -1) % 2) return Crossing::minus_one;
  if (real_outside(a, 1) % 2 != real_outside(b, 1) % 2) return Crossing::plus_one;
  return Crossing::pair;
}

}  // namespace

std::vector<LossOfStability> losses_of_stability(const std::vector<FollowedValue>& values) {
  std::vector<std::size_t> order;
  for (const bool backwards : {false, true}) {
    std::vector<std::size_t> one;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (values[k].backwards == backwards) one.push_back(k);
    if (backwards) std::ranges::reverse(one);
    order.insert(order.end(), one.begin(), one.end());
  }
  std::vector<LossOfStability> out;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const FollowedValue &a = values[order[i - 1]], &b = values[order[i]];
    const Cycle &from = a.orbit.cycle, &to = b.orbit.cycle;
    if (!from.found() || to.continued == 0 || outside(from) == outside(to)) continue;
    const Crossing through = crossing(from, to);
    const double off = nearest(from, through), on = nearest(to, through);
    out.push_back({through, order[i - 1], order[i], off == on ? b.at[0] : a.at[0] + (b.at[0] - a.at[0]) * off / (off - on)});
  }
  return out;
}

std::string crossing_words(Crossing through) {
  if (through == Crossing::minus_one) return "period doubling (multiplier -1)";
  if (through == Crossing::plus_one) return "a fold or a branching (multiplier +1)";
  return "a pair of multipliers (Neimark-Sacker)";
}

}  // namespace pintle
