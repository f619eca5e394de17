#pragma once

#include <string>

#include "tests/extremes/atlas.h"

/// What the axes of motion share, and where they stand.
namespace extremes {

/// |ours − target| over `size`.
double apart(double ours, double target, double size = 1);
/// As `measured`, of a run that is expected to stop: its energy books up to there.
Finding stopped_with_books(const Attempt&, double bound);
/// A case that only ends, as said.
Case past(double value, const std::string& label, const std::string& what, End end, const std::string& says, const std::string& scene);

/// A rigid rod of 1 kg, its pin at the world's origin 1 m from its mass centre.
struct Rod {
  double gravity = 9.81, inertia = 0.01;                       ///< along −y [m/s²]; about the mass centre [kg m²]
  double angle = 0, speed = 0;                                 ///< at the start, from the x axis [rad, rad/s]
  double until = 2, every = 0;                                 ///< [s]; 0: a tenth of the run
  std::string tolerance = "1e-8", method = "auto", more = {};  ///< more: of `run`, from a comma on
};
std::string text(const Rod&);
/// Greatest |angle − closed form| over all rows of a rod released from rest in gravity [rad].
double off_the_pendulum(const Attempt&, const Rod&);

// motion_speed.cpp
Axis rigid_speed();
Axis clearance_speed();
Axis blade_speed();
Axis start_spin();
Axis turns();
// motion_masses.cpp
Axis mass_ratio();
Axis inertia_ratio();
Axis driven_mass_ratio();
Axis light_on_stiff_spring();
Axis chain_links();
Axis many_clearances();
// motion_elastic.cpp
Axis slenderness();
Axis poisson_ratio();
Axis modes_kept();
Axis part_stiffness();
Axis modal_damping();
// motion_time.cpp
Axis damping();
Axis step_asked();
Axis tolerance_axis();
Axis gravity_axis();
Axis run_length();
Axis output_interval();
Axis units();
// motion_poses.cpp
Axis flat_starts();
Axis dead_centres();
Axis assembly_limit();

}  // namespace extremes
