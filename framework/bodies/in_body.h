#pragma once

#include <stdexcept>
#include <utility>

#include "framework/scene/error.h"

namespace pintle {

/// Runs `work`, and reports its errors at the place where the body is described.
/// @throws SceneError  for every std::invalid_argument and std::runtime_error that is not one already
template <class Work>
decltype(auto) in_body(const Scene& scene, const SceneBody& body, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const SceneError&) {
    throw;
  } catch (const std::invalid_argument& e) {
    throw SceneError(scene.file, body.place, e.what());
  } catch (const std::runtime_error& e) {
    throw SceneError(scene.file, body.place, e.what());
  }
}

}  // namespace pintle
