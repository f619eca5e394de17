#pragma once

#include <string>
#include <vector>

#include "framework/study/fit/optimiser.h"
#include "framework/study/study.h"

/// The goal of a fit: evaluates the measures of a case.
namespace pintle {

/// A measure that should reach a value.
struct Aim {
  std::size_t measure;
  double to, tolerance;  ///< in the measure's unit
};

/// A measure that must stay on one side of a limit.
struct Bound {
  std::size_t measure;
  double limit;
  bool at_most;  ///< otherwise at least
};

struct Goal {
  enum class Kind { minimise, maximise, reach, path } kind = Kind::minimise;
  std::size_t measure = 0;     ///< for minimise, maximise and path
  std::vector<Aim> aims = {};  ///< for reach and path: the sum of ((value − to)/tolerance)² is minimised
  bool exact = false;          ///< a tolerance was given, so the goal can be missed
  std::vector<Bound> bounds = {};

  Worth worth(const std::vector<double>& values) const;
  /// Whether every aim is within its tolerance; always true for minimise and maximise.
  bool reached(const std::vector<double>& values) const;
  /// Value below which further improvement is useless: 1e-4 of each tolerance; negative: none.
  double good_enough() const;
};

/// Reads `goal` and `subject to`; adds to the study the measures that they describe in words and it lacks.
/// @throws SceneError
Goal read_goal(const StudyFile&, Study&);

}  // namespace pintle
