#pragma once

#include <filesystem>
#include <string>

#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/energy.h"

namespace pintle {

/// The data with which a run continues from the end of an accepted step as if it had never stopped, bit for bit.
struct SavedState {
  double t = 0;                                      ///< [s]
  std::string memory;                                ///< of the integrator, see Integrator::save
  Energies first;                                    ///< energies at the very start of the run
  double energy_in_play = 0, worst_unexplained = 0;  ///< so far [J]
};

/// A state from which a run starts: its energy balance begins with it.
SavedState beginning(const Model&, const State&);

/// A state as stored in a file, with a checksum of the whole.
/// @param identity  of its scene (identity.h), computed before the run because files may change meanwhile
std::string state_text(const std::string& identity, const SavedState&);
/// @param source  names the text in messages
SavedState state_of(const std::string& text, const std::string& source, const Scene&, const Model&, const Assembly&);
/// @throws SceneError  the file cannot be read, is not a saved state, is incomplete or altered, or belongs to another scene, program or
/// version
SavedState read_state(const std::filesystem::path&, const Scene&, const Model&, const Assembly&);

}  // namespace pintle
