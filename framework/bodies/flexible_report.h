#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/attachments.h"
#include "framework/bodies/mechanism_body.h"
#include "framework/bodies/modal_choice.h"

/// What a reader should know of a flexible body before he believes a run.
namespace pintle {

/// Deflection within the frame, over the body's size, and slope beyond which one frame bends too far
/// for a linear body.
inline constexpr double large_deflection = 0.05, large_slope = 0.1;
/// Relative change of the first frequency by loads of the run above which stiffening matters.
inline constexpr double stiffening_matters = 0.01;

/// What a rigid run of the mechanism tells of a flexible body: estimates by single oscillators.
struct MotionEstimate {
  double deflection = 0;     ///< greatest displacement within the frame, over the body's size
  double slope = 0;          ///< greatest turn of a section or point within the frame [rad]
  double spin = 0;           ///< greatest [rad/s]
  double excited_up_to = 0;  ///< frequency that holds 99 % of what varies in the excitation [Hz]
  /// Relative change of the first frequency where it is greatest in magnitude, by the loads of
  /// inertia and by all loads; −1: it falls to zero, the body buckles. Nothing if not asked for.
  double by_rotation = 0, by_all_loads = 0;
};

/// What a flexible body kept of its elements.
struct FlexibleReport {
  std::string body, basis;  ///< "coupler", "Craig-Bampton, chord frame"
  int shapes = 0;
  double lowest = 0, highest = 0;              ///< frequency [Hz]
  double least_damping = 0, most_damping = 0;  ///< ratio
  std::vector<double> frequencies, damping;    ///< of each shape, ascending [Hz], and its ratio
  /// Share of the mass in x, y and of the inertia in rotation; none under mean axes, whose shapes
  /// carry no momentum.
  std::optional<Eigen::Vector3d> mass;
  double compliance = 1;                 ///< least share of static compliance covered at a port in use
  std::string compliance_at;             ///< "B, y"; empty: no port yields
  std::optional<ModalChoice> choice;     ///< of `keep: auto`
  std::optional<MotionEstimate> motion;  ///< after a rigid run
};

/// Relative change of the first frequency by loads, where it is greatest in magnitude; −1: it falls to zero.
struct FrequencyChange {
  double spin = 0;                           ///< greatest [rad/s]
  double by_rotation = 0, by_all_loads = 0;  ///< by those of inertia, by all
};

/// What a run needs to tell how its loads would stiffen or soften a body.
struct StiffeningProbe {
  std::string body;
  int index = 0;  ///< into System::bodies
  Stiffening now = Stiffening::none;
  bool judged = false;             ///< the model's warnings speak of it already
  Eigen::VectorXd omega;           ///< of the lowest shapes
  std::vector<Eigen::MatrixXd> F;  ///< foreshortening of each of `loads_on`, on these
};

/// By how much a body bends within its frame, told from a few of its points.
struct BendingProbe {
  std::string body;
  int index = 0;                 ///< into System::bodies
  double size = 1;               ///< diagonal of the body [m]
  Eigen::MatrixXd displacement;  ///< x and y of each point, 2·points × n
  Eigen::MatrixXd slope;         ///< of points that turn, points × n
};
BendingProbe bending_probe(const MechanismBody&, int index);

/// @pre the body has shapes
FlexibleReport flexible_report(const MechanismBody&);
StiffeningProbe stiffening_probe(const MechanismBody&, int index);
/// Over a history of loads. @param factor  loads × times, as LoadHistory
FrequencyChange frequency_change(const Eigen::VectorXd& omega, const std::vector<Eigen::MatrixXd>& F, const Eigen::MatrixXd& factor);
MotionEstimate motion_estimate(const MechanismBody&, const LoadHistory&);
/// Relative change of the first frequency by steady turning at `spin`, about the first of its points that
/// a joint pins to the ground, else about the mass centre.
double stiffened_by_spin(const Scene&, const MechanismBody&, double spin);
/// Spin that drivers on the ground or `start` give the body [rad/s]; 0: none that is plain to see.
double given_spin(const Scene&, const std::string& body);

/// The advice on such a change for a body that stiffens as `now`; empty if that counts all that matters.
std::string stiffening_warning(const std::string& body, Stiffening now, const FrequencyChange&);
/// What makes the choice of modes or the linear body doubtful, in words.
std::vector<std::string> warnings_of(const Scene&, const FlexibleReport&, const std::vector<Imposed>&);
/// The advice on a spin by whose loads the first frequency changes so; empty if it hardly does.
std::string spin_warning(const std::string& body, double spin, double change);
/// The advice on a deflection or slope, empty if both are small; `when`: "bends" or "would bend".
std::string deflection_warning(const std::string& body, double deflection, double slope, const std::string& when);

}  // namespace pintle
