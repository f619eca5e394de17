#pragma once

#include <filesystem>
#include <string>

#include "framework/dynamics/energy.h"
#include "framework/scene/scene.h"

namespace pintle {

/// What a run needs to go on from the end of an accepted step as if it had never stopped, bit for bit.
struct SavedState {
  double t = 0;             ///< [s]
  std::string memory;       ///< of the integrator, see Integrator::save
  Energies first;           ///< the books at the run's very start
  double energy_in_play = 0, worst_unexplained = 0;  ///< so far [J]
};

/// A state as a text file that names the scene it belongs to by all that changes the motion: not its title,
/// `run.until` and `output`.
std::string state_text(const Scene&, const SavedState&);
/// @throws SceneError  the file cannot be read, is no saved state or not whole, or is of another scene or version
SavedState read_state(const std::filesystem::path&, const Scene&);

}  // namespace pintle
