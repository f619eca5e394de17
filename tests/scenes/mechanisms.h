#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/scene/scene.h"
#include "tests/oracles/four_bar.h"
#include "tests/oracles/pendulum.h"
#include "tests/oracles/slider_crank_clearance.h"

/// Scenes made in C++, shared by the whole-run tests. Everything in SI units.
namespace pintle_scenes {

// --- words to write a scene with ---

/// "crank.A", "crank" or "ground"
pintle::PointRef ref(const std::string& text);
pintle::ScenePoint point(const std::string& name, double x, double y = 0, double angle = 0);
pintle::SceneBody body(const std::string& name, double mass, double inertia, std::vector<pintle::ScenePoint> points);
pintle::SceneJoint joint(const std::string& name, pintle::JointKind kind, const std::string& a, const std::string& b);
/// value + rate t + ½ accel t²
pintle::Law law(double value, double rate = 0, double accel = 0);
/// mean + amplitude sin(omega t)
pintle::Law wave(double mean, double amplitude, double omega);
pintle::SceneDriver angle_driver(const std::string& name, const std::string& a, const std::string& b, pintle::Law law);
pintle::SceneLoad spring(const std::string& name, const std::string& a, const std::string& b, double stiffness, double damping,
                         double free_length);
pintle::SceneLoad torque(const std::string& name, const std::string& on, pintle::Law law);
pintle::SceneLoad force(const std::string& name, const std::string& at, pintle::Law x, pintle::Law y, bool follows = false);
/// What is pinned down of a body at t = 0.
pintle::StartBody start_angle(const std::string& name, double angle, double speed);
pintle::StartBody start_at(const std::string& name, double x, double y, double angle, double vx, double vy, double speed);

// --- mechanisms ---

/// The paper's slider-crank (its Table 1), bodies crank, coupler and slider, joints "main bearing",
/// "crank pin", "gudgeon pin" and "guide". Ground point "O" carries bearing and guide.
struct SliderCrank {
  double clearance = 1e-5;  ///< 0: an ideal pin [m]
  double speed = 150;       ///< of the crank at the start [rad/s]
  double angle = 0;         ///< of the crank at the start [rad]
  double restitution = 0.8;
  double friction = 0;
  bool geometric = false;  ///< sliding speed as the paper has it
  bool bearing_on_slider = true;
  bool driven = false;  ///< crank kept at its speed by the driver "motor"
  pintle::Pair eccentricity{0, 0};
  double until = 0.05, tolerance = 1e-8;
  std::string method = "dopri5", constraints = "projection";
  int outputs = 100;
};
pintle::Scene scene(const SliderCrank&);
/// The same for the independent model.
pintle_oracle::Params oracle(const SliderCrank&);

/// The clearance that `scene(SliderCrank)` would give the gudgeon pin.
pintle::SceneClearance clearance(const std::string& bearing, double radial, double restitution);

/// A body "bob" hung at the ground's point "P" in the origin, its point "end" 1 m from it. Swings
/// as a point mass at "end": either the centre of mass held there by a rigid link, or a body with
/// its centre half-way and the inertia that has the same period.
enum class Hanging { by_link, by_pin };
pintle::Scene pendulum(Hanging, double release, double gravity = 9.81);

/// Bodies "upper" and "lower", from angles and rates as the oracle has them.
pintle::Scene double_pendulum(const pintle_oracle::DoublePendulum&, const pintle_oracle::Vec<4>&);

/// Bodies "crank", "coupler", "rocker"; joints A, B, C, D around the loop; the crank's angle is
/// start + rate t + ½ accel t² by the driver "motor".
pintle::Scene four_bar(const pintle_oracle::FourBar&, const pintle_oracle::LinkMass (&)[3], double gravity, double start, double rate,
                       double accel);

/// Andrews' squeezing mechanism, bodies K1 … K7, joints named as in tests/data/andrews.json.
pintle::Scene andrews();
/// SUNDIALS' slider-crank: bodies "crank" and "rod", whose origin rides the ground's x axis.
pintle::Scene sundials_slider_crank();

/// Three bodies in free space, held together by two pins and a spring–damper, tumbling.
pintle::Scene floating_chain(double damping);

// --- scenes changed ---

/// The world shifted and turned, its gravity with it. Starts may pin angles and speeds only.
pintle::Scene moved(pintle::Scene, double dx, double dy, double turn);
/// The world mirrored in the x axis, its gravity with it.
pintle::Scene mirrored(pintle::Scene);

// --- runs ---

struct Whole {
  pintle::Model model;
  pintle::Assembly assembly;
  pintle::Run run;
  std::vector<double> column(const std::string& name) const;
  double last(const std::string& name) const { return column(name).back(); }
  double ledger(const std::string& name) const { return run.ledger.column(name).back(); }
};
/// Build, assemble, simulate.
Whole run(const pintle::Scene&);

/// Largest |a − b| over the largest |b|.
double relative_difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace pintle_scenes
