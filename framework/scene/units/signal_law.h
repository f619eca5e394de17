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

/// A formula in its inputs and t. A derivative is the rate of the value when one input changes at rate 1.
struct SignalFormula {
  explicit SignalFormula(Program);
  double operator()(double t, const double* in, double* slope) const;
  Program program;
  std::size_t inputs = 0;  ///< how many it has
};

/// Behaviour of a table outside its samples: it holds the end value, because the scene requests it or by default; or it has no value, which
/// ends the run with a message that names the law.
enum class Outside { holds, holds_unasked, rejected };

/// A table as a function of a formula: the derivatives of f(x(in)) are f′ ∂x/∂in.
struct SignalTable {
  std::variant<Spline, Polyline> table;
  SignalFormula over;
  double begin = 0, period = 0;  ///< range of the samples, and its repetition; period 0: not periodic
  Outside outside = Outside::holds;
  std::string unit = {};  ///< unit of its argument, in SI
  double operator()(double t, const double* in, double* slope) const;
  bool rejects(double x) const;
};

/// A table as a function of two formulas with the same inputs, bilinear between its values.
struct SignalMap {
  Bilinear table;
  std::array<SignalFormula, 2> over;
  Outside outside = Outside::rejected;
  std::array<std::string, 2> units = {};  ///< likewise
  double operator()(double t, const double* in, double* slope) const;
  bool rejects(double a, double b) const;
};

/// The range of a table, if `in` is outside a table with this behaviour: "it is read at 2 m, and goes from 0 to 1 m"; otherwise empty.
std::string beyond_its_table(const SignalFunction&, double t, const double* in, Outside);

/// A periodic table from samples of one period.
/// @pre the first value is the last
SignalTable periodic_table(Samples, bool linear, SignalFormula over);

}  // namespace pintle
