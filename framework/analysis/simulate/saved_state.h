#pragma once

#include <filesystem>
#include <string>

#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/energy.h"

namespace pintle {

/// What a run needs to go on from the end of an accepted step as if it had never stopped, bit for bit.
struct SavedState {
  double t = 0;                                      ///< [s]
  std::string memory;                                ///< of the integrator, see Integrator::save
  Energies first;                                    ///< the books at the run's very start
  double energy_in_play = 0, worst_unexplained = 0;  ///< so far [J]
};

/// A state from which a run starts: its books open with it.
SavedState beginning(const Model&, const State&);

/// A state as a file holds it, with a checksum of the whole.
/// @param identity  of what it belongs to (identity.h), found before the run: files may change meanwhile
std::string state_text(const std::string& identity, const SavedState&);
/// @param source  names the text in messages
SavedState state_of(const std::string& text, const std::string& source, const Scene&, const Model&, const Assembly&);
/// @throws SceneError  the file cannot be read, is no saved state, not whole, not what was written, or is of another scene,
///                     program or version
SavedState read_state(const std::filesystem::path&, const Scene&, const Model&, const Assembly&);

}  // namespace pintle
