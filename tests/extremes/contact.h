#pragma once

#include <array>
#include <string>

#include "tests/extremes/atlas.h"

/// What the axes of contact share: a puck in a bearing, and where they stand.
namespace extremes {

using Pair = std::array<double, 2>;

/// A journal of 0.4 kg in a bearing on the ground, nothing else.
struct Puck {
  double clearance = 1e-3, bearing_radius = 1e-2;  ///< [m]
  std::string law = "hertz: {stiffness: 1e10}";    ///< as a scene has it
  std::string friction = {};                       ///< "ambrosio: {…}"; empty: none
  Pair at{0, 0}, velocity{0, 0};                   ///< of its centre from the bearing's [m, m/s]
  double spin = 0;                                 ///< [rad/s]
  Pair gravity{0, 0};                              ///< [m/s²]
  double until = 1, every = 0, tolerance = 1e-10;  ///< [s, s, –]; every 0: a hundredth of the run
  std::string method = "auto";
  std::string more = {};  ///< of `run`, from a comma on
};
inline constexpr double puck_mass = 0.4, puck_inertia = 1e-4;  ///< [kg], [kg m²]
std::string text(const Puck&);

/// |ours/target − 1|
double off(double ours, double target);
/// Trouble: another number of impacts than `wanted`.
Finding count_wrong(const Attempt&, std::size_t wanted);
/// Where K depthⁿ is `force` [m].
double depth_under(double force, double stiffness, double exponent = 1.5);

Axis radial_clearance();
Axis contact_stiffness_axis();
Axis restitution_axis();
Axis friction_coefficient();
Axis friction_onset();
Axis sticking();
Axis impact_count();
Axis impact_speed();
Axis impact_time();
Axis deep_start();
Axis start_at_the_wall();
Axis grazing();
Axis clearances_at_once();
Axis coming_to_rest();
Axis end_at_an_event();

}  // namespace extremes
