#pragma once

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// Energy balance at an instant [J]. stored + lost − input is constant; any change of it is the energy-balance error.
struct Energies {
  double kinetic = 0, gravity = 0, springs = 0, contacts = 0, strain = 0;  ///< stored
  double lost = 0;   ///< to hysteresis, friction, dampers, material damping and the integration scheme since the start
  double input = 0;  ///< by loads and drivers since the start
  double stored() const { return kinetic + gravity + springs + contacts + strain; }
  double balance() const { return stored() + lost - input; }
};

/// @pre eq was evaluated at `state`. The potential energy of gravity is zero at the world's origin.
Energies energies(const System&, const State&, const Equations&);
double kinetic_energy(const System&, const Eigen::VectorXd& y);

}  // namespace pintle
