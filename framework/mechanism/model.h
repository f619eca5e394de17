#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/bodies/flexible_report.h"
#include "framework/bodies/attachments.h"
#include "framework/drawing/flexible_drawing.h"
#include "framework/dynamics/model/system.h"
#include "framework/integration/integrator.h"

namespace pintle {

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

/// A number computed for each row of the trajectory.
struct WrittenOutput {
  struct Input {
    enum From { signal, column, output } from;
    int index;  ///< index into System::signals, the trajectory's columns or Model::outputs
  };
  std::string name, unit;
  SignalFunction of;
  std::vector<Input> in;
};

/// A profile for drawing.
struct DrawnProfile {
  int marker, body;                     ///< the marker that carries it
  bool solid;                           ///< the material is inside a closed line
  std::vector<Eigen::Vector2d> points;  ///< in the marker's axes [m]
};

/// Summary of the preliminary run with which modes were chosen and warnings derived.
struct PreliminaryRun {
  double until = 0, seconds = 0;  ///< time reached, and computing time [s]
  long steps = 0;
  std::string trouble;  ///< why there was none, or why it ended early
};

/// A scene prepared to run. Only `drawings` have the size of the finite-element models, and they exist only if frames are requested.
struct Model {
  System system;
  Scheme scheme;
  std::vector<RecordedPoint> points;
  std::vector<RecordedStress> stresses;
  std::vector<WrittenOutput> outputs;
  std::vector<FlexibleDrawing> drawings;               ///< of flexible bodies, in their order
  std::vector<std::string> clearances;                 ///< how each is modelled, in words
  std::vector<std::string> contacts;                   ///< how each contact of profiles is modelled
  std::vector<DrawnProfile> profiles;                  ///< those used by contacts
  std::vector<std::string> warnings;                   ///< why the model is doubtful, in words
  std::vector<std::vector<Eigen::Vector2d>> outlines;  ///< points of each body, named or joined, for drawing [m]
  std::vector<FlexibleReport> flexible;                ///< of flexible bodies, in their order
  std::vector<BendingProbe> bending;                   ///< likewise
  std::vector<StiffeningProbe> stiffening;             ///< likewise
  std::vector<std::pair<int, Eigen::VectorXd>> bent;   ///< bodies that start deformed, and their modal coordinates
  std::vector<Attachment> attachments;                 ///< on flexible bodies
  BuiltOrder order;
  std::optional<PreliminaryRun> preliminary_run;  ///< if there was one
};

}  // namespace pintle
