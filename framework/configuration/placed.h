#pragma once

#include "framework/configuration/closure.h"

namespace pintle {

/// A pose that closes every joint of a tree, however far apart its bodies are: first the angles that joints couple, then, with these
/// angles, the positions of the bodies. Both problems are linear, so one step each is enough. Bodies that the scene draws move only as far
/// as the others cannot. Gaps of loops are spread over the joints of the loop.
/// @param y     the drawn pose
/// @param W     diagonal ≥ 0: coordinates with 0 stay
/// @param bend  first turns bodies drawn without an angle by ±this, alternately [rad]: a straight loop cannot be closed by rotation
Eigen::VectorXd placed(const Scene&, const System&, Closure&, const Eigen::VectorXd& y, const Eigen::VectorXd& W, double bend);

}  // namespace pintle
