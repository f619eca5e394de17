#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// The search for the least value in a box, by NLopt. The one file that knows NLopt is optimiser.cpp.
namespace pintle {

enum class Optimiser { bobyqa, cobyla, nelder_mead, sbplx, slsqp, mma, direct, crs, isres };

const char* name_of(Optimiser);
/// Wants differences for the gradient.
bool by_gradient(Optimiser);
/// Looks all over the box, not from a start downwards.
bool looks_everywhere(Optimiser);
bool takes_constraints(Optimiser);

/// What a point is worth.
struct Worth {
  bool known = false;               ///< false: the mechanism could not be measured there
  double value = 0;                 ///< to be made small
  std::vector<double> excess = {};  ///< of each constraint, met where ≤ 0

  double worst() const;  ///< the greatest excess; 0 where all are met
};
/// Both known: less excess, or with none the less value.
bool better(const Worth&, const Worth&);

/// A point of the box [0, 1]ⁿ.
using BoxPoint = std::vector<double>;

/// What is searched. @returns nothing to end the search: stopped, or out of evaluations
using WorthAt = std::function<const Worth*(const BoxPoint&)>;

struct SearchSettings {
  Optimiser method = Optimiser::bobyqa;
  BoxPoint start;
  std::size_t constraints = 0;
  double first_step = 0.1;   ///< share of the box
  double precision = 1e-6;   ///< share of the box to which a point is to be found
  double difference = 1e-4;  ///< of gradients, share of the box
  double good_enough = -1;   ///< a value at which to end; below 0: none
  std::uint64_t seed = 1;    ///< of methods that look everywhere
};

/// Excess up to which a constraint counts as met, of its limit.
inline constexpr double met_within = 1e-6;

/// Searches until it has converged or `worth` has nothing more to say. Points that are not known are passed as worse than all that the
/// search has seen. What was found is known to `worth`, which sees every point. Deterministic; one thread.
/// @throws what `worth` throws
/// @returns how it ended, in words
std::string search(const SearchSettings&, const WorthAt& worth);

}  // namespace pintle
