#pragma once

#include <memory>
#include <vector>

#include "framework/common/sided_law.h"
#include "framework/common/signal_function.h"
#include "framework/scene/units/formula.h"

namespace pintle {

/// A formula whose comparisons and kinks, as far as they depend on its inputs, are held on sides: −1 where the difference compared, or the
/// operand, is negative, otherwise 1. Those of t alone are known beforehand and are not held.
class SidedProgram {
 public:
  explicit SidedProgram(Program);
  int switches() const { return switches_; }
  /// The sides that are held, and the output: the sides found, and the distance of each from its end; nullptr: not wanted.
  struct Sides {
    const int* held = nullptr;  ///< nullptr: each is determined again
    int* found = nullptr;
    double* left = nullptr;
  };
  Jet run(const Jet& t, const Jet* in, const Sides&) const;
  /// With derivatives with respect to its first `inputs` inputs.
  double value(double t, const double* in, std::size_t inputs, double* slope, const Sides&) const;

 private:
  Jet held(std::size_t i, const Jet* operand, const Sides&) const;
  Program program_;
  std::vector<int> first_;  ///< switch of each instruction; −1: none
  int switches_ = 0;
};

/// A law of signals with its sides, for a formula, a table or a map of formulas; nullptr: it is smooth, or its definition is unknown.
std::shared_ptr<const SidedLaw> sided(const SignalFunction&);

}  // namespace pintle
