#pragma once

#include <functional>
#include <string>

#include "framework/integration/integrator.h"

namespace pintle {

/// An orbit cannot be followed further.
struct OrbitTrouble {
  std::string status, reason;
};

/// On to time t, where a step ends. @throws OrbitTrouble  it cannot, or is not to, go on
void go_to(Integrator&, double t, const std::function<bool()>& go_on);
/// On to the end of the step at which an event asks for a row. @returns false: it has not by `until`
/// @throws OrbitTrouble  likewise
bool go_to_return(Integrator&, double until, const std::function<bool()>& go_on);

/// What coordinates, speeds and states are measured by: coordinates by their own scales, speeds by these over a time.
Eigen::VectorXd phase_scales(const System&, double time);

}  // namespace pintle
