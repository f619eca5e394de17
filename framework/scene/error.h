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
  std::string file = {}, message = {};  ///< the parts of what(); empty where it is of no place
  Place place = {};
};

/// The mechanism cannot be put together at t = 0, or holds a joint twice: names the joint, what
/// remains open and what to do, in the form of a SceneError.
struct AssemblyError : std::runtime_error {
  AssemblyError(const std::string& file, const Place& place, const std::string& message);
  std::string file, message;  ///< the parts of what()
  Place place;
};

}  // namespace pintle
