#pragma once

#include <functional>
#include <string>

#include "framework/integration/integrator.h"

namespace pintle {

/// An orbit cannot be followed further.
struct OrbitTrouble {
  std::string status, reason;
};

/// Integrates to time t. @throws OrbitTrouble  it fails, ends or is interrupted
void go_to(Integrator&, double t, const std::function<bool()>& go_on);
/// Integrates to the end of the step at which an event asks for a row. @returns false if none has until `until`
/// @throws OrbitTrouble  likewise
bool go_to_return(Integrator&, double until, const std::function<bool()>& go_on);

/// Scales of coordinates, speeds and states: speeds have those of the coordinates divided by a time.
Eigen::VectorXd phase_scales(const System&, double time);

}  // namespace pintle
