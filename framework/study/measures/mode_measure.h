#pragma once

#include <string>

#include "framework/analysis/linearize/linearize.h"
#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/study/measures/measure.h"

/// Measures of modes: "frequency of mode 1", "damping of root 2", "frequency of mode 3 of coupler". docs/studies.md
namespace pintle {

struct AskedMode {
  enum class Part { frequency, natural, damping, decay, real, imaginary } part = Part::frequency;
  int number = 1;         ///< from 1, in the order of `pintle linearize` and `pintle modes`
  std::string body = {};  ///< for `modes`; empty: the only body of elements
  const char* unit = "";
};

/// @throws SceneError  the words cannot be read, or name a body without modes
AskedMode read_mode_measure(const Measure&, const Scene&);

/// NaN if there are fewer modes.
double value_of(const AskedMode&, const Linearization&);
double value_of(const AskedMode&, const ModesReport&);

}  // namespace pintle
