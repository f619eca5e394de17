#pragma once

#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"

/// Loads of a mechanism on its flexible bodies, computed with these rigid.
/// Theory: docs/theory/reduction.md, "Choosing modes by the scene".
namespace pintle {

/// Columns of `loads_on` before those of the ports, 3 each.
inline constexpr int inertia_loads = 4;

/// The loads that motion and joints can exert on a body, in independent dofs, n × (4 + 3·ports): M T along x, along y, M R and M x
/// about the mass centre, then a unit force along x, along y and a unit couple at each port (zero where it has no rotation).
Eigen::MatrixXd loads_on(const ElasticBody&);

/// Factors of the loads over time, one column per time: gravity minus acceleration of the mass centre [m/s²], minus the angular
/// acceleration [rad/s²], spin² [rad²/s²], then [N, N, N m] at each port; body axes. Together they are in equilibrium.
struct LoadHistory {
  std::vector<double> t;   ///< ends of the steps, ascending [s]
  Eigen::MatrixXd factor;  ///< (4 + 3·ports) × times
};

/// Motion imposed by a driver: turns per second, or the dominant frequency of its acceleration.
struct Imposed {
  std::string driver;
  double frequency = 0;  ///< [Hz], 0: at rest or uniform
  bool turns = false;    ///< the frequency is that of rotation
  bool even = false;     ///< the law has no acceleration
};
/// One per driver, from its law over `run.until`.
std::vector<Imposed> imposed_frequencies(const Scene&);

/// Power of the varying part of samples taken at equal intervals over a span T, by frequency k/T, k = 0 … n/2.
/// @pre the number of samples is a power of two
Eigen::VectorXd power_spectrum(const Eigen::VectorXd& samples);

}  // namespace pintle
