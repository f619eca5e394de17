#pragma once

#include <optional>
#include <string>

#include "framework/scene/scene.h"
#include "framework/study/measures/measure_words.h"

/// Signals and expressions of them as measures. They are no columns: each is an output of its case that is not written to a file.
namespace pintle {

/// The beginning of a text, up to a time or the end, as an expression of signals, columns and outputs, and its length.
struct MeasuredExpression {
  SceneOutput output;  ///< its name is its text
  std::size_t length = 0;
};
/// @param why  receives the reason why the whole text is no expression
std::optional<MeasuredExpression> measured_expression(const std::string& text, const Scene&, std::string& why);

/// Whether it contains an operator or bracket, so that it is more than a name.
bool looks_like_a_formula(const std::string& text);
/// Whether it is a signal that has no column, such as "coil.length".
bool is_signal_alone(const Scene&, const std::string& name);
/// Whether no signal of the scene has this name, such as "coil.normal", although other elements may have one.
bool is_unknown_signal(const Scene&, const std::string& name);
/// Whether the measure depends only on positions, speeds and accelerations, which kinematics computes, and on no forces.
bool is_of_motion(const Scene&, const Asked&);

}  // namespace pintle
