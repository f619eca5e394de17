#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contact/gap.h"
#include "eigen_layout.h"
#include "framework/common/sided_law.h"
#include "framework/common/signal_function.h"

/// Numbers of the motion, laws of them, and the numbers of the scene's own that change at such laws. Theory: docs/theory/signals.md.
///
/// A scene's expression is a `Law` (scene.h) that read_law or ActingSignals made; SignalMaker (build/signals.h) makes of it a
/// SignalLaw of the system. law_at (signal_values.h) is its value in any state, from t and y alone; in equations evaluated up to
/// apply_forces the values of System::laws are at hand in Equations::laws. The own states of a scene are y[own_state(system, i)],
/// which an event may set.
namespace pintle {

/// A number of the motion of the markers a and b, less `offset`; or an own state, whose number is a.
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
    relative_speed,  ///< direction of b less that of a [rad], [rad/s]
    along,
    across,  ///< b in the axes of a [m]
    state,   ///< an own state
  } kind;
  int a = 0, b = 0;
  double offset = 0;
  auto operator<=>(const MotionSignal&) const = default;
};
bool of_two(MotionSignal::Kind);
/// A speed of the motion, not a place or an own state.
bool is_speed(MotionSignal::Kind);

/// Its derivatives in the poses (r, angle) of its markers and in their rates.
struct SignalSlope {
  Eigen::Vector3d pose_a = Eigen::Vector3d::Zero(), rate_a = pose_a, pose_b = pose_a, rate_b = pose_a;
};

/// Cannot fail; between points that meet a length has no direction, and derivatives 0. @pre no state
double signal_value(const MotionSignal&, const MovingPoint& a, const MovingPoint& b);
SignalSlope signal_slope(const MotionSignal&, const MovingPoint& a, const MovingPoint& b);

inline constexpr std::size_t most_law_inputs = 32;

/// A law of signals: `of` takes the values of System::signals[in[0]], [in[1]], …
struct SignalLaw {
  SignalFunction of;
  std::vector<int> in;
  std::shared_ptr<const SidedLaw> sided = nullptr;  ///< the same by sides; none where it is smooth …
  int first_side = 0;                               ///< … else where its switches begin among those of all laws
};

/// A number of the scene's own: ẋ = the law.
struct OwnState {
  std::string name, unit;
  double scale;  ///< what its errors are measured by, above 0
  double start;
  int rate;  ///< index into System::laws
};

}  // namespace pintle
