#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/scene/scene.h"
#include "framework/scene/units/spelling.h"

/// The vocabulary of signals: quantities of the motion by their column names in trajectory.csv, "crank.angle", "slider.P.vx",
/// "coil.length". docs/scene.md, "Signals".
namespace pintle {

/// The meaning of a name, for the points a and b.
struct SignalWord {
  enum What {
    x,
    y,
    vx,
    vy,  ///< of point a, or of body a's origin [m], [m/s]
    angle,
    speed,  ///< of body a [rad], [rad/s]
    ux,
    uy,  ///< displacement of a point of a flexible body in its axes [m]
    length,
    length_rate,  ///< between a and b [m], [m/s]
    relative_angle,
    relative_speed,  ///< direction of b minus that of a [rad], [rad/s]
    travel,          ///< of b along a's direction [m]
    state,           ///< `index` among the scene's own states
    output,          ///< likewise
    column,          ///< of trajectory.csv, headed `text` if that is not the name: quantities that depend on the accelerations
    work_rate,  ///< power of a force or driver into the mechanism [W]: the product `text` of signals and columns; empty: 0 at all times
  };
  What what;
  Dimension dimension;
  PointRef a = {}, b = {};
  int index = 0;
  std::string text = {};
};

/// All signals that are known from the parts of the scene read so far.
std::map<std::string, SignalWord, std::less<>> signal_words(const Scene&);

/// Use of signals. Expressions that act on the motion may contain no outputs and nothing that depends on the accelerations.
enum class SignalUse { acts, written };
SignalNames signal_names(const std::map<std::string, SignalWord, std::less<>>&, SignalUse);

}  // namespace pintle
