#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/scene.h"
#include "framework/scene/units/spelling.h"

/// Quantities with units, and laws of time, as a scene file writes them: docs/scene.md.
namespace pintle {

/// The value of an expression without t. Left to right with the usual precedence; a space before a
/// unit multiplies: `0.5*clearance + 1 um`, `1/2 mm`, `3 N/mm`, `5 N m`, `1e-4 kg*m^2`.
/// @throws ExpressionError  it cannot be read, mixes dimensions, is not finite, or depends on t
Quantity read_quantity(std::string_view text, const Parameters& = {});

/// The same, in SI, for a place that expects a dimension. A bare number is taken as SI.
/// @throws ExpressionError  as above, or the dimension is another one
double read_quantity(std::string_view text, const Dimension& expected, const Parameters& = {});

/// A frequency in Hz: turns a second. Here, and only here, Hz and kHz are units; an angular speed
/// (rad/s, rpm) is converted, a bare number is taken as Hz.
/// @throws ExpressionError  as above, or 1/s without angle, which could mean either
double read_frequency(std::string_view text, const Parameters& = {});

/// An expression in t. t is a time, so 150 rad/s*t is an angle; where no factor of t has a unit, t
/// is the bare number of seconds, so 150*t is an angle as well.
/// @throws ExpressionError  it cannot be read or does not have the dimension
/// @param signals  numbers of the motion that it may name; with any of them the law is one of signals
Law read_law(std::string_view text, const Dimension& expected, const Parameters& = {}, const SignalNames* signals = nullptr);

/// An expression in t and signals of whatever dimension it has.
struct MeasuredLaw {
  Law law;
  Dimension dimension;
};
/// @throws ExpressionError  it cannot be read
MeasuredLaw read_measured_law(std::string_view text, const Parameters&, const SignalNames&);

/// An expression in another variable, `variable`, of the dimension `of`; derivatives are by it.
/// @throws ExpressionError  likewise
Law read_curve(std::string_view text, std::string_view variable, const Dimension& of, const Dimension& expected, const Parameters& = {});

/// Why a parameter may not have this name, or empty if it may.
std::string fault_of_name(std::string_view name);

}  // namespace pintle
