#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "tests/scenes/mechanisms.h"

/// Scenes with flexible bodies, as text, and what whole-run tests ask of their runs. SI units.
namespace pintle_scenes {

/// The scene that a text describes, its beams cut into their pieces. Files are in
/// testing::TempDir().
pintle::Scene scene_of(const std::string& text);
Whole run_text(const std::string& text);

/// "  NAME:" and its keys, as `bodies` takes them.
std::string body_text(const std::string& name, const std::string& keys);

/// The paper's slider-crank, its coupler of any kind. Bodies crank, coupler, slider; joints "main
/// bearing", "crank pin", "gudgeon pin", "guide". Starts with the coupler straight.
struct FlexibleCrank {
  std::string coupler;  ///< keys of the body, with points A at its origin, B 0.12 m along x
  double speed = 150;   ///< of the crank at the start [rad/s]
  double until = 0.05;  ///< [s]
  double tolerance = 1e-11;
  int outputs = 50;
  std::string points = "coupler.A, coupler.B";  ///< recorded
  double clearance = 0;                         ///< radial, of the gudgeon pin; 0: an ideal pin [m]
  double angle = 0;                             ///< of the crank at the start [rad]
};
std::string text(const FlexibleCrank&);

/// Keys of a beam body from A to B, straight along x, with a point M between them.
struct FlexibleBeam {
  double length = 0.12, diameter = 0.01;  ///< [m]
  double at = 0.5;                        ///< of M, as a part of the length; 0: there is no M
  double young = 207e9;                   ///< [Pa]; Poisson's ratio 0.3
  double mass = 0.21;                     ///< [kg]
  int elements = 4;
  std::string modes = "{frame: chord, keep: all}";  ///< empty: rigid
  std::string more = "";                            ///< further keys, one a line, without indent
};
std::string text(const FlexibleBeam&);

/// Keys of a plate 0.21 m × 0.03 m with a waist and two oblong holes, 0.12 m apart along x: A, a
/// rigid ring at the origin, and B, of soft rim. 64 nodal dofs; its mesh is written to a file.
std::string holed_plate(const std::string& modes, const std::string& more = "");

/// Largest distance between where two runs put a recorded point at the same output.
double apart(const Whole&, const Whole&, const std::string& point);
/// Largest displacement by deformation of a recorded point [m].
double deflection(const Whole&, const std::string& point);

/// Slope of log(value) over log(parameter), point to point.
std::vector<double> slopes(const std::vector<double>& parameter, const std::vector<double>& value);

}  // namespace pintle_scenes
