#pragma once

/// Closed-form kinematics of the four-bar and the slider-crank: positions, rates, accelerations.
namespace pintle_oracle {

struct Turn {
  double angle = 0, rate = 0, acceleration = 0;  ///< from +x [rad]
};

/// Crank about (0, 0), rocker about (ground, 0): crank U(θ) + coupler U(φ) = (ground, 0) + rocker
/// U(ψ).
struct FourBar {
  double ground, crank, coupler, rocker;  ///< lengths [m]
  bool open = true;                       ///< the rocker's end is left of the line from the crank's end to the rocker's
                                          ///< pivot; false: right of it, the crossed assembly
};
struct FourBarMotion {
  Turn coupler, rocker;
  bool closes;  ///< false: the links cannot meet at this crank angle; the rest is meaningless
};
FourBarMotion evaluate(const FourBar&, const Turn& crank);

/// Links as rigid bodies, mass centres on the links' lines at a fraction of their lengths.
struct LinkMass {
  double mass, inertia, fraction = 0.5;  ///< [kg], about the mass centre [kg m²], –
};
/// Torque on the crank that produces its motion, by virtual power. Gravity along −y [m/s²].
double crank_torque(const FourBar&, const Turn& crank, const LinkMass (&links)[3], double gravity);
/// Kinetic energy plus gravity's, 0 at y = 0 [J].
double energy(const FourBar&, const Turn& crank, const LinkMass (&links)[3], double gravity);

/// Crank about (0, 0), slider on the line y = offset: crank U(θ) + coupler U(φ) = (x, offset).
struct SliderCrank {
  double crank, coupler, offset = 0;  ///< [m]
  bool forward = true;                ///< slider ahead of the crank pin, else behind it
};
struct SliderCrankMotion {
  Turn coupler;
  double x, x_rate, x_acceleration;
};
SliderCrankMotion evaluate(const SliderCrank&, const Turn& crank);

}  // namespace pintle_oracle
