#include "framework/scene/units/law_pole.h"

#include <cmath>
#include <utility>
#include <vector>

#include "framework/scene/units/machine.h"

namespace pintle {

namespace {

constexpr double narrowest_at_pole = 1e-14;  // relative to the run: smallest interval
constexpr int most_looks = 40'000;           // evaluations for one law

bool bounded(const Range& r) { return std::isfinite(r.lo) && std::isfinite(r.hi); }

/// Compares the law at 10⁻⁶, 10⁻⁹ and 10⁻¹² of the run before and after t. From each to the next, a pole |t − t₀|^−p grows 10^3p times as
/// much as before, whatever is added to it; a logarithm grows equally.
bool diverges(const TimeLaw& law, double t, double until, double Jet::*part) {
  constexpr double slowest = 10;  // p > 1/3
  for (const double side : {-1.0, 1.0}) {
    if (const double end = t + side * until * 1e-6; !(end >= 0 && end <= until)) continue;
    double x[3];
    for (int i = 0; i < 3; ++i) x[i] = law(t + side * until * std::pow(10, -6 - 3 * i)).*part;
    if (std::abs(x[2] - x[1]) > slowest * std::abs(x[1] - x[0]) && std::abs(x[2]) > slowest * std::abs(x[0])) return true;
  }
  return false;
}

}  // namespace

std::optional<double> pole_of(const TimeLaw& law, double until, bool rate) {
  const auto* program = law.target<Program>();
  if (!program || !(until > 0)) return {};
  Machine<RangeJet> ranges;
  std::vector<std::pair<double, double>> left{{0, until}};
  for (int looks = 0; !left.empty() && looks < most_looks; ++looks) {
    const auto [a, b] = left.back();
    left.pop_back();
    const RangeJet all = ranges.run(*program, program->code.size(), time_from(a, b))[-1];
    if (bounded(all.value) && (!rate || bounded(all.rate))) continue;
    const double middle = a + (b - a) / 2;
    if (b - a > narrowest_at_pole * until) {
      left.emplace_back(middle, b);
      left.emplace_back(a, middle);
    } else if (diverges(law, middle, until, &Jet::value) || (rate && diverges(law, middle, until, &Jet::rate))) {
      return middle;
    }
  }
  return {};
}

}  // namespace pintle
