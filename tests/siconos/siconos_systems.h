#pragma once

#include <functional>
#include <vector>

/// Rigid contacts by Siconos (INRIA), an implementation of its own of Moreau's and Jean's time-stepping. It includes nothing of ours.
namespace siconos_judge {

/// Coordinates, their rates, at the end of a step.
struct Sample {
  double t;
  std::vector<double> q, v;
};

/// A disc of 1 kg that falls from rest with its lowest point at `height` onto a floor, restitution e: q is that height.
std::vector<Sample> bouncing_disc(double height, double e, double step, double until);
/// A block of 1 kg that slides up a slope from a speed and then stays or slides back: q along the slope and across it.
std::vector<Sample> block_on_slope(double angle, double mu, double speed, double step, double until);
/// The slider-crank with translational clearance of Flores, Leine and Glocker (2010): q the angles of crank, rod and slider.
std::vector<Sample> slider_crank(double step, double until);

}  // namespace siconos_judge
