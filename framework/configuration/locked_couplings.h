#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/model/system.h"

namespace pintle {

/// Couplings that lock each other at a pose, such as gears with contradictory ratios: even with drivers released, the bodies that they
/// couple cannot move, but can if any one of the couplings is removed. @returns one text for each such train, with the names of its
/// couplings. Mechanisms of more than 300 coordinates are not examined.
std::vector<std::string> locked_couplings(const System&, double t, const Eigen::VectorXd& y);

}  // namespace pintle
