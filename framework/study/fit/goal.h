#pragma once

#include <string>
#include <vector>

#include "framework/study/fit/optimiser.h"
#include "framework/study/study.h"

/// What a fit is for: measures of a case in, what it is worth out.
namespace pintle {

/// A measure that is to come to a value.
struct Aim {
  std::size_t measure;
  double to, tolerance;  ///< in the measure's unit
};

/// A measure that is to stay on one side of a limit.
struct Bound {
  std::size_t measure;
  double limit;
  bool at_most;  ///< else at least
};

struct Goal {
  enum class Kind { minimise, maximise, reach, path } kind = Kind::minimise;
  std::size_t measure = 0;     ///< of minimise, maximise and path
  std::vector<Aim> aims = {};  ///< of reach and path: the sum of ((value − to)/tolerance)² is made small
  bool exact = false;          ///< a tolerance was given, so that the goal can be missed
  std::vector<Bound> bounds = {};

  Worth worth(const std::vector<double>& values) const;
  /// Every aim within its tolerance; always of minimise and maximise.
  bool reached(const std::vector<double>& values) const;
  /// Value below which nothing is left to gain: a ten-thousandth of each tolerance; below 0: there is none.
  double good_enough() const;
};

/// Reads `goal` and `subject to`; measures that they name in words and the study has not are added to it.
/// @throws SceneError
Goal read_goal(const StudyFile&, Study&);

}  // namespace pintle
