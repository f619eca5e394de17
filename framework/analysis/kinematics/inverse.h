#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

/// What a driver must do: the torque on its second body, or the thrust that parts its two points.
struct DriverEffort {
  std::string name;
  bool turns = true;             ///< torque [N m], else thrust [N]
  std::vector<double> t, value;  ///< fine enough for a table of a scene, see `error`
  double error = 0;  ///< greatest difference between a spline through the rows and the effort midway between them; NaN: not known
};

/// Driving efforts and joint forces of a driven mechanism.
struct Inverse {
  Run run;                 ///< trajectory as `simulate` gives it; by algebra there is no ledger
  bool by_algebra = true;  ///< false: integrated forward with the drivers as constraints
  std::string how;         ///< in words
  std::vector<DriverEffort> drivers;
};

/// Rigid and fully driven: the motion of `kinematics`, then Cqᵀλ = f − M a at each instant, λ of least norm where rows
/// are redundant. With bodies that bend, clearances or freedoms that no driver moves, the motion follows from the
/// equations of motion: it is integrated forward, bodies that bend from the shape that they would keep if the motion
/// stayed as it is at the start (`steady_start`), so that the start itself makes nothing ring.
/// @throws SceneError  the scene has no driver
Inverse inverse(const Scene&, const Model&, const Assembly&, const Listeners& = {});

/// The assembled start with flexible bodies bent so that M a + Cqᵀλ = f holds with η̇ = η̈ = 0 and the frames moving as
/// drivers and `start` have them. @returns the start unchanged if there is no such shape or it is not found
Assembly steady_start(const Model&, const Assembly&);

/// trajectory.csv, NAME.csv of each driver and inverse.json in `directory`; of an integrated motion also what a run
/// writes. @throws std::runtime_error  naming the path that cannot be written
void write_inverse(const std::filesystem::path& directory, const Scene&, const Model&, const Assembly&, const Inverse&);
std::string inverse_json(const Scene&, const Model&, const Inverse&);
/// The file of a driver's effort: "motor.csv".
std::string effort_file(const Inverse&, std::size_t driver);

}  // namespace pintle
