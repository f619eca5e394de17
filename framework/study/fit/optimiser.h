#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Minimisation in a box, by NLopt. Only optimiser.cpp uses NLopt.
namespace pintle {

enum class Optimiser { bobyqa, cobyla, nelder_mead, sbplx, slsqp, mma, direct, crs, isres };

const char* name_of(Optimiser);
/// Whether it searches the whole box instead of descending from a start.
bool looks_everywhere(Optimiser);
bool takes_constraints(Optimiser);

/// Value of a point.
struct Worth {
  bool known = false;               ///< false: the mechanism could not be evaluated there
  double value = 0;                 ///< to be minimised
  std::vector<double> excess = {};  ///< of each constraint, satisfied where ≤ 0

  double worst() const;  ///< the largest excess; 0 if all are satisfied
};
/// Whether a is better than b, both known: smaller excess, or if there is none, smaller value.
bool better(const Worth&, const Worth&);

/// A point of the box [0, 1]ⁿ.
using BoxPoint = std::vector<double>;

/// The function to be minimised. @returns nullptr to end the search: stopped, or out of evaluations
using WorthAt = std::function<const Worth*(const BoxPoint&)>;

struct SearchSettings {
  Optimiser method = Optimiser::bobyqa;
  BoxPoint start;
  std::size_t constraints = 0;
  double first_step = 0.1;   ///< share of the box
  double precision = 1e-6;   ///< precision of the result, share of the box
  double difference = 1e-4;  ///< of gradients, share of the box
  double good_enough = -1;   ///< a value at which to end; negative: none
  std::uint64_t seed = 1;    ///< for methods that search the whole box
};

/// Excess up to which a constraint counts as satisfied, relative to its limit.
inline constexpr double met_within = 1e-6;

/// Searches until it has converged or `worth` returns nothing. Unknown points are treated as worse than all points seen. `worth` sees every
/// point, including the result. Deterministic; one thread.
/// @throws what `worth` throws
/// @returns how it ended, in words
std::string search(const SearchSettings&, const WorthAt& worth);

}  // namespace pintle
