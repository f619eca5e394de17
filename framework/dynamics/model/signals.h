#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contact/gap.h"
#include "eigen_layout.h"
#include "framework/common/sided_law.h"
#include "framework/common/signal_function.h"

/// Signals of the motion, laws of them, and the scene's own states, whose rates are such laws. Theory: docs/theory/signals.md.
///
/// An expression of a scene is a `Law` (scene.h), created by read_law or ActingSignals; SignalMaker (build/signals.h) converts it into a
/// SignalLaw of the system. law_at (signal_values.h) gives its value in any state, from t and y only; in equations evaluated up to
/// apply_forces, the values of System::laws are in Equations::laws. The own states of a scene are y[own_state(system, i)], and an event may
/// set them.
namespace pintle {

/// A signal of the motion of the markers a and b, minus `offset`; or an own state, whose index is a.
struct MotionSignal {
  enum Kind {
    x,
    y,
    angle,  ///< of a [m], [rad]
    vx,
    vy,
    speed,  ///< of a [m/s], [rad/s]
    length,
    length_rate,  ///< from a to b [m], [m/s]
    relative_angle,
    relative_speed,  ///< direction of b minus that of a [rad], [rad/s]
    along,
    across,  ///< position of b in the axes of a [m]
    state,   ///< an own state
  } kind;
  int a = 0, b = 0;
  double offset = 0;
  auto operator<=>(const MotionSignal&) const = default;
};
bool of_two(MotionSignal::Kind);
/// Whether it is a speed of the motion, not a position or an own state.
bool is_speed(MotionSignal::Kind);

/// Its derivatives with respect to the poses (r, angle) of its markers and to their rates.
struct SignalSlope {
  Eigen::Vector3d pose_a = Eigen::Vector3d::Zero(), rate_a = pose_a, pose_b = pose_a, rate_b = pose_a;
};

/// Cannot fail; between coinciding points a length has no direction, and its derivatives are 0. @pre not an own state
double signal_value(const MotionSignal&, const MovingPoint& a, const MovingPoint& b);
SignalSlope signal_slope(const MotionSignal&, const MovingPoint& a, const MovingPoint& b);

inline constexpr std::size_t most_law_inputs = 32;

/// A law of signals: `of` takes the values of System::signals[in[0]], [in[1]], …
struct SignalLaw {
  SignalFunction of;
  std::vector<int> in;
  std::shared_ptr<const SidedLaw> sided = nullptr;  ///< the same law with its sides; nullptr if it is smooth …
  int first_side = 0;                               ///< … otherwise the index of its first switch among those of all laws
};

/// A state of the scene's own: ẋ = the law.
struct OwnState {
  std::string name, unit;
  double scale;  ///< scale of its errors, above 0
  double start;
  int rate;  ///< index into System::laws
};

}  // namespace pintle
