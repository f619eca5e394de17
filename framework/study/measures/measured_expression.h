#pragma once

#include <optional>
#include <string>

#include "framework/scene/scene.h"
#include "framework/study/measures/measure_words.h"

/// Signals and expressions of them as measures, which no column has: each is an output of its case that no file shows.
namespace pintle {

/// What the text begins with, up to a time or the end, as an expression of signals, columns and outputs; and how long that is.
struct MeasuredExpression {
  SceneOutput output;  ///< its name is its text
  std::size_t length = 0;
};
/// @param why  gets what is wrong with the whole text as an expression
std::optional<MeasuredExpression> measured_expression(const std::string& text, const Scene&, std::string& why);

/// It has a sign of a formula, so that it is no name alone.
bool looks_like_a_formula(const std::string& text);
/// "coil.length": a signal, of which there is no column.
bool is_signal_alone(const Scene&, const std::string& name);
/// "coil.normal": neither a column nor a signal, though another thing may have one.
bool is_no_word(const Scene&, const std::string& name);
/// What is written follows from places, speeds and accelerations, which kinematics knows, and from no forces.
bool is_of_motion(const Scene&, const Asked&);

}  // namespace pintle
