#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/system.h"
#include "framework/integration/integrator.h"
#include "framework/run/flexible_drawing.h"
#include "framework/scene/error.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Overlap, over the journal's radius, beyond which no contact law of ours means anything.
inline constexpr double too_deep = 0.1;

/// A point whose motion is recorded.
struct RecordedPoint {
  std::string name;  ///< "coupler.M"
  Marker marker;
};
/// A point of a flexible body whose stress is recorded.
struct RecordedStress {
  std::string name;
  int body;
  StressProbe probe;
};

/// A scene made ready to run. Nothing here is of finite-element size but `drawings`, which there are only
/// if frames are asked for.
struct Model {
  System system;
  Scheme scheme;
  std::vector<RecordedPoint> points;
  std::vector<RecordedStress> stresses;
  std::vector<FlexibleDrawing> drawings;               ///< of flexible bodies, in their order
  std::vector<std::string> warnings;                   ///< what makes the model doubtful, in words
  std::vector<std::vector<Eigen::Vector2d>> outlines;  ///< points of each body, named or joined, for drawing [m]
  std::vector<std::pair<int, int>> pin_joints;         ///< joint, marker: where a joint is drawn
};

/// Turns names into indices and judges everything that the reader cannot: the only place that does.
/// @throws SceneError  naming file, line, key, value and remedy
Model build(const Scene&);

/// Contact stiffness as the scene's words give it [N/mⁿ].
double contact_stiffness(const SceneClearance&);

}  // namespace pintle
