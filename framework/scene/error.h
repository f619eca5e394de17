#pragma once

#include <stdexcept>
#include <string>

#include "framework/scene/scene.h"

namespace pintle {

/// The scene is wrong: names file, line, key, the value, and what to do about it.
/// what() reads  "slider.yaml:12: joints.pin.clearance.radial: … ".
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
  SceneError(const std::string& file, const Place& place, const std::string& message);
};

/// The mechanism cannot be put together at t = 0: names the joint and what remains open.
struct AssemblyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace pintle
