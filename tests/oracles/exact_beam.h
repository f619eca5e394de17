#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

/// The geometrically exact straight beam in the plane (Reissner, Simo): any displacement and turn,
/// small strain, linear elastic, undamped. With the section's place r(s) and angle θ(s) in world
/// axes and e₁(θ), e₂(θ) its axes,
///     ε = e₁·r′ − 1,  γ = e₂·r′,  κ = θ′,
///     V = ½ ∫ EA ε² + GA γ² + EI κ² ds,   T = ½ ∫ ρA |ṙ|² + ρI θ̇² ds.
/// Space: Lagrange elements of equal length with 3 absolute coordinates [x y θ] a node, `degree`
/// Gauss points for V (no locking) and one more for T, whose matrix is constant. Statics and
/// frequencies are of order 2·degree at the elements' ends, places between them of degree + 1.
/// Time: Gauss' collocation of three stages (order 6, symplectic; a freely flying beam keeps its
/// momenta). Modes faster than the step lower the order to 3 or 4: compare two steps, or let
/// `converge` do so. A start or law that jumps stirs such modes in truth.
namespace pintle_oracle {

/// [x y θ] of a section in world axes, or its rate [m m rad, /s, /s²].
using Place = Eigen::Vector3d;
using Places = Eigen::Matrix3Xd;  ///< one column a node, from end A to end B

struct SectionMotion {
  Place place = Place::Zero(), rate = Place::Zero(), acceleration = Place::Zero();
};
using MotionLaw = std::function<SectionMotion(double t)>;

/// What holds an end. `hinge` follows the law's x and y, `clamp` its angle too; `slide` lets the
/// end move on the line through its first place and turn.
enum class Hold { free, hinge, clamp, slide };
struct BeamEnd {
  Hold hold = Hold::free;
  MotionLaw law = {};             ///< of hinge and clamp; empty: rests at its first place
  Eigen::Vector2d line = {1, 0};  ///< direction of slide
  double mass = 0;                ///< of a point at the end [kg]
  Place load = Place::Zero();     ///< dead force and couple [N N Nm]
};

struct ExactBeam {
  double length;                                      ///< [m]
  double EA, EI, GA;                                  ///< GA with its shear factor [N], [N m²], [N]
  double rhoA, rhoI;                                  ///< [kg/m], [kg m]
  BeamEnd a = {}, b = {};                             ///< at s = 0 and s = length
  Eigen::Vector2d gravity = Eigen::Vector2d::Zero();  ///< [m/s²]
  int elements = 8, degree = 3;                       ///< degree 1, 2 or 3
};

/// Place and rate at arc length s [m] when a run begins; strain is measured from the straight beam.
/// Must agree with the laws of the ends at t = 0.
using BeamStart = std::function<SectionMotion(double s)>;
/// Straight, in rigid motion, from those of end A.
BeamStart rigid_start(const Place& place_a, const Place& rate_a = Place::Zero());

/// Law of a pin on a circle; `turn` gives [angle, rate, acceleration] of the crank at t.
MotionLaw crank_pin(const Eigen::Vector2d& centre, double radius, std::function<Eigen::Vector3d(double t)> turn);

/// What a run reports at a time.
struct BeamFrame {
  double t;
  Places place, rate;
  double kinetic, strain, potential;     ///< potential: of gravity and dead loads [J]
  Eigen::Vector3d momentum;              ///< linear; angular about the world's origin
  Eigen::Vector3d support_a, support_b;  ///< force and couple of what holds the end, on the beam
};

/// Equilibrium under gravity and loads, reached from `start` in equal steps of both.
/// @throws std::invalid_argument for a beam that cannot be; std::runtime_error without convergence.
Places static_shape(const ExactBeam&, const BeamStart& start, int load_steps = 10);

/// Frames at `times` (ascending, ≥ 0; the run begins at 0). The steps between two times are equal,
/// none longer than `step`.
/// @throws as `static_shape`.
std::vector<BeamFrame> simulate(const ExactBeam&, const BeamStart& start, const std::vector<double>& times, double step);

/// Section at arc length s between the nodes, by the elements' own interpolation.
Place place_at(const ExactBeam&, const Places&, double s);

/// Runs with twice the elements and half the step until no end of an element moves more than
/// `tolerance`·length at any of the times. The last run is much nearer to the limit than `change`
/// says once its order is above one.
/// @throws std::runtime_error if `doublings` do not suffice.
struct Converged {
  ExactBeam beam;  ///< with the last number of elements
  std::vector<BeamFrame> frames;
  double step, change;  ///< change: the last one, by length
};
Converged converge(ExactBeam, const BeamStart& start, const std::vector<double>& times, double step, double tolerance, int doublings = 6);

}  // namespace pintle_oracle
