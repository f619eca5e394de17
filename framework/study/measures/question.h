#pragma once

#include <optional>

namespace pintle {

/// The analysis that a study performs for each of its cases, like the command of this name.
enum class Analysis { run, kinematics, inverse, statics, linearize, modes };

struct Question {
  Analysis analysis = Analysis::run;
  std::optional<double> at = {};  ///< for statics and linearize: time of drivers and loads [s]
  bool equilibrium = false;       ///< for linearize: about the equilibrium of the mechanism
};

/// It computes modes instead of columns.
constexpr bool of_modes(const Question& q) { return q.analysis == Analysis::linearize || q.analysis == Analysis::modes; }
/// It follows the scene's `run` over time.
constexpr bool over_time(const Question& q) { return !of_modes(q) && q.analysis != Analysis::statics; }
/// It needs the scene's `run`, including its tolerance.
constexpr bool needs_run(const Question& q) { return over_time(q) || (q.analysis == Analysis::linearize && q.at && !q.equilibrium); }

}  // namespace pintle
