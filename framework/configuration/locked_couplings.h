#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/model/system.h"

namespace pintle {

/// Couplings that hold each other still at a pose, as gears do whose ratios contradict each other: all that they couple stands, drivers let
/// go, and moves as soon as any one of them is gone. @returns in words, with their names, one text for each such train. Mechanisms of more
/// than a few hundred coordinates are not looked at.
std::vector<std::string> locked_couplings(const System&, double t, const Eigen::VectorXd& y);

}  // namespace pintle
