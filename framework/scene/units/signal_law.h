#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>

#include "framework/common/signal_function.h"
#include "framework/scene/units/formula.h"
#include "framework/scene/units/table.h"

/// Laws of signals as SignalFunctions (framework/common/signal_function.h).
namespace pintle {

inline constexpr std::size_t most_signals = 32;  ///< in one expression

/// A formula in its inputs and t. A derivative is the rate at which the value changes while one input changes at rate 1.
struct SignalFormula {
  explicit SignalFormula(Program);
  double operator()(double t, const double* in, double* slope) const;
  Program program;
  std::size_t inputs = 0;  ///< how many it has
};

/// What a table is outside its samples: the value at its end, as asked for or not; or no number, which ends the run with the law's name.
enum class Outside { holds, holds_unasked, refused };

/// A table over a formula: of f(x(in)) the derivatives are f′ ∂x/∂in.
struct SignalTable {
  std::variant<Spline, Polyline> table;
  SignalFormula over;
  double begin = 0, period = 0;  ///< what the samples span, where it comes again and again; period 0: it has ends
  Outside outside = Outside::holds;
  std::string unit = {};  ///< of what it is read at, in SI
  double operator()(double t, const double* in, double* slope) const;
  bool refuses(double x) const;
};

/// A table over two formulas of the same inputs, bilinear between its values.
struct SignalMap {
  Bilinear table;
  std::array<SignalFormula, 2> over;
  Outside outside = Outside::refused;
  std::array<std::string, 2> units = {};  ///< likewise
  double operator()(double t, const double* in, double* slope) const;
  bool refuses(double a, double b) const;
};

/// Where a law that is a table ends, if `in` lies outside a table that does so there: "it is read at 2 m, and goes from 0 to 1 m"; else
/// empty.
std::string beyond_its_table(const SignalFunction&, double t, const double* in, Outside);

/// Samples that span one period, as a table that comes again and again.
/// @pre the first value is the last
SignalTable periodic_table(Samples, bool linear, SignalFormula over);

}  // namespace pintle
