#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/scene.h"
#include "framework/scene/units/spelling.h"

/// Quantities with units, and laws of time, as written in a scene file: docs/scene.md.
namespace pintle {

/// The value of an expression without t. Evaluated left to right with the usual precedence; a space before a unit multiplies:
/// `0.5*clearance + 1 um`, `1/2 mm`, `3 N/mm`, `5 N m`, `1e-4 kg*m^2`.
/// @throws ExpressionError  it cannot be read, mixes dimensions, is not finite, or depends on t
Quantity read_quantity(std::string_view text, const Parameters& = {});

/// The same, in SI, where a given dimension is expected. A bare number is taken as SI.
/// @throws ExpressionError  as above, or the dimension is different
double read_quantity(std::string_view text, const Dimension& expected, const Parameters& = {});

/// A frequency in Hz: turns per second. Only here are Hz and kHz units; an angular speed (rad/s, rpm) is converted, a bare number is taken
/// as Hz.
/// @throws ExpressionError  as above, or 1/s without angle, which is ambiguous
double read_frequency(std::string_view text, const Parameters& = {});

/// An expression in t. t is a time, so 150 rad/s*t is an angle; if no factor of t has a unit, t is the number of seconds, so 150*t is an
/// angle too.
/// @throws ExpressionError  it cannot be read or does not have the dimension
/// @param signals  signals of the motion that it may name; if it names any, the law is a law of signals
Law read_law(std::string_view text, const Dimension& expected, const Parameters& = {}, const SignalNames* signals = nullptr);

/// An expression in t and signals, of any dimension.
struct MeasuredLaw {
  Law law;
  Dimension dimension;
};
/// @throws ExpressionError  it cannot be read
MeasuredLaw read_measured_law(std::string_view text, const Parameters&, const SignalNames&);

/// An expression in another variable, `variable`, of the dimension `of`; derivatives are with respect to it.
/// @throws ExpressionError  likewise
Law read_curve(std::string_view text, std::string_view variable, const Dimension& of, const Dimension& expected, const Parameters& = {});

/// Why a parameter must not have this name; empty if it may.
std::string fault_of_name(std::string_view name);

}  // namespace pintle
