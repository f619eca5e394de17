#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

/// Effort of a driver: the torque on its second body, or the thrust that pushes its two points apart.
struct DriverEffort {
  std::string name;
  bool turns = true;             ///< torque [N m], otherwise thrust [N]
  std::vector<double> t, value;  ///< fine enough for a table in a scene, see `error`
  double error = 0;  ///< largest error of a spline through every second row, at the others, in the unit of `value`; NaN: unknown
};

/// Driving efforts and joint forces of a driven mechanism.
struct Inverse {
  Run run;                 ///< trajectory as from `simulate`; with algebra there is no energy balance
  bool by_algebra = true;  ///< false: integrated forward with the drivers as constraints
  std::string how;         ///< in words
  std::vector<DriverEffort> drivers;
};

/// Rigid and fully driven: the motion of `kinematics`, then Cqᵀλ = f − M a at each instant, with λ of least norm where rows are redundant.
/// With flexible bodies, clearances or undriven degrees of freedom, the motion follows from the equations of motion: it is integrated, with
/// flexible bodies starting in the shape that they would keep if the motion stayed as at the start (`steady_start`), so that the start does
/// not excite oscillations.
/// @throws SceneError  the scene has no driver
Inverse inverse(const Scene&, const Model&, const Assembly&, const Listeners& = {});

/// The assembled start with flexible bodies deformed such that M a + Cqᵀλ = f holds with η̇ = η̈ = 0, while the frames move as the drivers
/// prescribe. @returns the start unchanged if drivers do not determine all frames, if no such shape is found, or above 600 coordinates
Assembly steady_start(const Model&, const Assembly&);

/// trajectory.csv, NAME.csv of each driver and inverse.json in `directory`; for an integrated motion also the files of a run. @throws
/// std::runtime_error  naming the path that cannot be written
void write_inverse(const std::filesystem::path& directory, const Scene&, const Model&, const Assembly&, const Inverse&);
/// NAME.csv of each driver and inverse.json in `directory`. @throws FileError
void write_efforts(const std::filesystem::path& directory, const Scene&, const Model&, const Inverse&);
std::string inverse_json(const Scene&, const Model&, const Inverse&);
/// File name of a driver's effort: "motor.csv".
std::string effort_file(const Inverse&, std::size_t driver);

}  // namespace pintle
