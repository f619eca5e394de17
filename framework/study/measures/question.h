#pragma once

#include <optional>

namespace pintle {

/// The question that a study asks of each of its cases, as the command of that name does.
enum class Analysis { run, kinematics, inverse, statics, linearize, modes };

struct Question {
  Analysis analysis = Analysis::run;
  std::optional<double> at = {};  ///< of statics and linearize: drivers and loads as they are then [s]
  bool equilibrium = false;       ///< of linearize: about where the mechanism rests
};

/// It finds modes instead of columns.
constexpr bool of_modes(const Question& q) { return q.analysis == Analysis::linearize || q.analysis == Analysis::modes; }
/// It follows the scene's `run` over time.
constexpr bool over_time(const Question& q) { return !of_modes(q) && q.analysis != Analysis::statics; }
/// It needs the scene's `run`, and so has its tolerance.
constexpr bool needs_run(const Question& q) { return over_time(q) || (q.analysis == Analysis::linearize && q.at && !q.equilibrium); }

}  // namespace pintle
