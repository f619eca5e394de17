#pragma once

#include <string>

#include "framework/integration/scheme.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Fills the times that steps owe to the laws of drivers and loads: changes and pieces; and max_step, as the scene says, or where
/// nothing is known of a law, which may do nothing for long and then act.
/// @throws SceneError  a law is not finite, a driver's law jumps, or its speed does
void follow_laws(const Scene&, Scheme&);

/// Which law makes a run fail at t, where that could not be seen before: it is not finite there, or grows far faster than until
/// then. Empty: none does.
std::string explain_laws(const Scene&, double t);

}  // namespace pintle
