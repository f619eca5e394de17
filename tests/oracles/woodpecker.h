#pragma once

#include <vector>

/// The woodpecker toy by itself: a sleeve on a pole, a bird on it by a torsion spring; three coordinates, the sleeve's height and the two
/// angles, by Runge and Kutta's method in short steps. What touches opens, sticks or slides, at forces as at impacts: all cases are tried, and
/// the one that contradicts nothing is taken. Newton's restitution, Coulomb's friction; lengths and masses of examples/woodpecker.yaml.
namespace pintle_oracle {

struct Knock {
  double t, height;  ///< of the sleeve [s], [m]
};
/// Knocks of the beak from the example's start on. @param dt  of its steps [s]
std::vector<Knock> woodpecker_knocks(double until, double dt);

}  // namespace pintle_oracle
