#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/system.h"
#include "framework/integration/integrator.h"
#include "framework/scene/error.h"
#include "framework/scene/scene.h"

namespace pintle {

/// A scene made ready to run.
struct Model {
  System system;
  Scheme scheme;
  std::vector<std::vector<Eigen::Vector2d>> outlines;  ///< named points of each body, for drawing [m]
  std::vector<std::pair<int, int>> pin_joints;         ///< joint, marker: where a joint is drawn
};

/// Turns names into indices and judges everything that the reader cannot: the only place that does.
/// @throws SceneError  naming file, line, key, value and remedy
Model build(const Scene&);

/// Contact stiffness as the scene's words give it [N/mⁿ].
double contact_stiffness(const SceneClearance&);

}  // namespace pintle
