#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/mechanism/model.h"
#include "framework/study/nonlinear/orbit.h"

namespace pintle {

struct CycleRun {
  int period = 1;       ///< returns
  double interval = 0;  ///< between them; 0: they are events [s]
  double expected = 1;  ///< approximate time of all of them [s]
  double longest = 1;   ///< time limit for them [s]
  double tolerance = 1e-8;
  double distance = 0;  ///< of neighbours, in scaled coordinates; 0: the best of several is chosen
};

/// Coordinates, speeds and states near a point of the wanted orbit.
using CycleGuess = Eigen::VectorXd;

/// The periodic orbit near a guess, a fixed point of the section's map, by Newton's method (shooting), and its Floquet multipliers,
/// the eigenvalues of the map's derivative, by central differences of neighbours on the constraints.
/// @param near  the motion at a return: its time, its modes, and the whole turns of its angles
/// @param read  reads the signals at a return
/// @throws OrbitTrouble  no orbit is found, or the run cannot continue
Cycle find_cycle(const Model&, const State& near, const CycleGuess&, const CycleRun&,
                 const std::function<std::vector<double>(Integrator&)>& read, const std::function<bool()>& go_on);

/// Predicts the orbit at the parameter x by the secant through the orbits of the previous two values.
/// @pre before was found
CycleGuess continued_guess(const System&, const Cycle& before, double x);

}  // namespace pintle
