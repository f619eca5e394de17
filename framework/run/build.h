#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/system.h"
#include "framework/integration/integrator.h"
#include "framework/scene/error.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Overlap, over the journal's radius, beyond which no contact law of ours means anything.
inline constexpr double too_deep = 0.1;

/// A scene made ready to run.
struct Model {
  System system;
  Scheme scheme;
  std::vector<std::vector<Eigen::Vector2d>> outlines;  ///< points of each body, named or joined, for drawing [m]
  std::vector<std::pair<int, int>> pin_joints;         ///< joint, marker: where a joint is drawn
};

/// Turns names into indices and judges everything that the reader cannot: the only place that does.
/// @throws SceneError  naming file, line, key, value and remedy
Model build(const Scene&);

/// Contact stiffness as the scene's words give it [N/mⁿ].
double contact_stiffness(const SceneClearance&);

}  // namespace pintle
