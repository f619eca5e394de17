#pragma once

#include "framework/configuration/closure.h"

namespace pintle {

/// A pose in which every joint of a tree is closed, whatever its size: first the angles that joints couple, then, at these angles, the places
/// of the bodies. Both are linear, so one step each is enough. Bodies that the scene draws move only as far as the others cannot. Gaps of
/// loops are spread over the joints of the loop.
/// @param y     the drawn pose
/// @param W     diagonal ≥ 0: coordinates with 0 stay
/// @param bend  [rad] by which bodies drawn without an angle turn first, alternately: takes a loop out of a line, where no rotation closes it
Eigen::VectorXd placed(const Scene&, const System&, Closure&, const Eigen::VectorXd& y, const Eigen::VectorXd& W, double bend);

}  // namespace pintle
