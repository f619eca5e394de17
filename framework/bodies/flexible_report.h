#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/attachments.h"
#include "framework/bodies/mechanism_body.h"
#include "framework/bodies/modal_choice.h"

/// Information on flexible bodies that a user needs to judge a run.
namespace pintle {

/// Limits of the deflection within the frame, relative to the body's size, and of the slope, beyond which a linear body in a single frame
/// bends too far.
inline constexpr double large_deflection = 0.05, large_slope = 0.1;
/// Relative change of the first frequency by loads of the run above which geometric stiffness matters.
inline constexpr double stiffening_matters = 0.01;

/// Estimates for a flexible body from a preliminary run with rigid bodies, using single-mode oscillators.
struct MotionEstimate {
  double deflection = 0;     ///< largest displacement within the frame, relative to the body's size
  double slope = 0;          ///< largest rotation of a section or point within the frame [rad]
  double spin = 0;           ///< largest [rad/s]
  double excited_up_to = 0;  ///< frequency below which 99 % of the varying excitation lies [Hz]
  /// Relative change of the first frequency, where largest in magnitude, due to inertia loads and due to all loads; −1: it falls to zero
  /// and the body buckles. Zero if not computed.
  double by_rotation = 0, by_all_loads = 0;
};

/// Summary of the reduction of a flexible body.
struct FlexibleReport {
  std::string body, basis;  ///< "coupler", "Craig-Bampton, chord frame"
  int shapes = 0;
  double lowest = 0, highest = 0;              ///< frequency [Hz]
  double least_damping = 0, most_damping = 0;  ///< ratio
  std::vector<double> frequencies, damping;    ///< of each shape, ascending [Hz], and its ratio
  /// Share of the mass in x, y and of the inertia in rotation; none with mean axes, whose shapes carry no momentum.
  std::optional<Eigen::Vector3d> mass;
  double compliance = 1;                 ///< smallest share of static compliance represented at a port in use
  std::string compliance_at;             ///< "B, y"; empty: no port is compliant
  std::optional<ModalChoice> choice;     ///< for `keep: auto`
  std::optional<MotionEstimate> motion;  ///< after a preliminary run
};

/// Relative change of the first frequency due to loads, where largest in magnitude; −1: it falls to zero.
struct FrequencyChange {
  double spin = 0;                           ///< largest [rad/s]
  double by_rotation = 0, by_all_loads = 0;  ///< due to inertia loads, due to all loads
};

/// Data with which a run estimates how much its loads stiffen or soften a body.
struct StiffeningProbe {
  std::string body;
  int index = 0;  ///< into System::bodies
  Stiffening now = Stiffening::none;
  bool judged = false;             ///< already covered by the model's warnings
  Eigen::VectorXd omega;           ///< of the lowest shapes
  std::vector<Eigen::MatrixXd> F;  ///< foreshortening for each of `loads_on`, on these shapes
};

/// Measures the deflection of a body within its frame from a few of its points.
struct BendingProbe {
  std::string body;
  int index = 0;                 ///< into System::bodies
  double size = 1;               ///< diagonal of the body [m]
  Eigen::MatrixXd displacement;  ///< x and y of each point, 2·points × n
  Eigen::MatrixXd slope;         ///< of points with a rotation, points × n
};
BendingProbe bending_probe(const MechanismBody&, int index);

/// @pre the body has shapes
FlexibleReport flexible_report(const MechanismBody&);
StiffeningProbe stiffening_probe(const MechanismBody&, int index);
/// For a history of loads. @param factor  loads × times, as LoadHistory
FrequencyChange frequency_change(const Eigen::VectorXd& omega, const std::vector<Eigen::MatrixXd>& F, const Eigen::MatrixXd& factor);
MotionEstimate motion_estimate(const MechanismBody&, const LoadHistory&);
/// Relative change of the first frequency due to steady rotation at `spin`, about the point where the scene's first revolute or weld holds
/// it on the ground, otherwise about the mass centre.
double stiffened_by_spin(const Scene&, const MechanismBody&, double spin);
/// Spin given to the body by drivers on the ground or by `start` [rad/s]; 0: none is directly given.
double given_spin(const Scene&, const std::string& body);

/// Advice for such a change if the body's stiffening is `now`; empty if that includes everything that matters.
std::string stiffening_warning(const std::string& body, Stiffening now, const FrequencyChange&);
/// Why the choice of modes or the linear body is doubtful, in words.
std::vector<std::string> warnings_of(const Scene&, const FlexibleReport&, const std::vector<Imposed>&);
/// Advice for a spin whose loads cause this change of the first frequency; empty if it is small.
std::string spin_warning(const std::string& body, double spin, double change);
/// Advice for a deflection or slope, empty if both are small; `when`: "bends" or "would bend".
std::string deflection_warning(const std::string& body, double deflection, double slope, const std::string& when);

}  // namespace pintle
