#pragma once

#include <memory>
#include <vector>

#include "framework/common/sided_law.h"
#include "framework/common/signal_function.h"
#include "framework/scene/units/formula.h"

namespace pintle {

/// A formula whose comparisons and kinks, as far as they depend on its inputs, are held on sides: −1 where what they compare, or their
/// operand, is below zero, else 1. Those of t alone are known beforehand, and are not held.
class SidedProgram {
 public:
  explicit SidedProgram(Program);
  int switches() const { return switches_; }
  /// Each side that is held, and what comes out: the sides found, and how far each is from its end; nullptr: not wanted.
  struct Sides {
    const int* held = nullptr;  ///< nullptr: each is as it is found
    int* found = nullptr;
    double* left = nullptr;
  };
  Jet run(const Jet& t, const Jet* in, const Sides&) const;
  /// With derivatives in its first `inputs` inputs.
  double value(double t, const double* in, std::size_t inputs, double* slope, const Sides&) const;

 private:
  Jet held(std::size_t i, const Jet* operand, const Sides&) const;
  Program program_;
  std::vector<int> first_;  ///< switch of each instruction; −1: none
  int switches_ = 0;
};

/// A law of signals by its sides, of a formula, a table or a map over such; nullptr: it is smooth, or nothing is known of how it is made.
std::shared_ptr<const SidedLaw> sided(const SignalFunction&);

}  // namespace pintle
