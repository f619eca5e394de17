// Where periodic orbits lose their stability along a branch.
#include <algorithm>
#include <complex>

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

/// A smooth function of the orbit that vanishes where multipliers cross [Kuznetsov2004, 10.2]: Π(λ_j + 1), Π(λ_j − 1), or for a pair
/// Π(λ_i λ_j − 1)/(|λ_i λ_j| + 1) over i < j.
double vanishing(const Cycle& cycle, Crossing through) {
  std::complex<double> product = 1;
  const auto multiplier = [&](std::size_t j) { return std::complex(cycle.re[j], cycle.im[j]); };
  for (std::size_t j = 0; j < cycle.re.size(); ++j)
    if (through == Crossing::pair)
      for (std::size_t i = 0; i < j; ++i) {
        const std::complex<double> both = multiplier(i) * multiplier(j);
        product *= (both - 1.0) / (std::abs(both) + 1);
      }
    else
      product *= multiplier(j) + (through == Crossing::minus_one ? 1.0 : -1.0);
  return product.real();
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
    const double off = vanishing(from, through), on = vanishing(to, through);
    const double share = off * on < 0 ? off / (off - on) : 0.5;  // the middle, where other multipliers hide the crossing
    out.push_back({through, order[i - 1], order[i], a.at[0] + (b.at[0] - a.at[0]) * share});
  }
  return out;
}

std::string crossing_words(Crossing through) {
  if (through == Crossing::minus_one) return "period doubling (multiplier -1)";
  if (through == Crossing::plus_one) return "a fold or a branching (multiplier +1)";
  return "a pair of multipliers (Neimark-Sacker)";
}

}  // namespace pintle
