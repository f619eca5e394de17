#pragma once

#include <stdexcept>
#include <string>

#include "framework/scene/scene.h"

namespace pintle {

/// An error in the scene: names file, line, key, the value, and the remedy.
/// what() reads  "slider.yaml:12: joints.pin.clearance.radial: … ".
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
  SceneError(const std::string& file, const Place& place, const std::string& message);
  std::string file = {}, message = {};  ///< the parts of what(); empty if it has no place
  Place place = {};
};

/// The mechanism cannot be assembled at t = 0, or a joint is duplicated: names the joint, what remains open and the remedy, in the form of
/// a SceneError.
struct AssemblyError : std::runtime_error {
  AssemblyError(const std::string& file, const Place& place, const std::string& message);
  std::string file, message;  ///< the parts of what()
  Place place;
};

}  // namespace pintle
