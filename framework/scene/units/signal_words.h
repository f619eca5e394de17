#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/scene/scene.h"
#include "framework/scene/units/spelling.h"

/// The vocabulary of signals: numbers of the motion by the names that trajectory.csv gives its columns, "crank.angle",
/// "slider.P.vx", "coil.length". docs/scene.md, "Signals".
namespace pintle {

/// What a name stands for, of the points a and b.
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
    relative_speed,  ///< direction of b less that of a [rad], [rad/s]
    travel,          ///< of b along a's direction [m]
    state,           ///< `index` among the scene's
    output,          ///< likewise
    column,          ///< of trajectory.csv: what the accelerations decide
    power,           ///< that it puts into the mechanism [W]: the product `text` of signals and columns; empty: 0 at all times
  };
  What what;
  Dimension dimension;
  PointRef a = {}, b = {};
  int index = 0;
  std::string text = {};
};

/// Every signal of a scene, in its present form: more are known as more of it is read.
std::map<std::string, SignalWord, std::less<>> signal_words(const Scene&);

/// How they may stand in an expression: in what acts on the motion no outputs, and nothing that accelerations decide.
enum class SignalUse { acts, written };
SignalNames signal_names(const std::map<std::string, SignalWord, std::less<>>&, SignalUse);

}  // namespace pintle
