#pragma once

#include <filesystem>
#include <vector>

namespace pintle {

/// What the user allows beyond what is safe for a scene of unknown origin (SECURITY.md). Set by the program's command line or the library's
/// caller; a scene cannot change it.
struct Trust {
  std::vector<std::filesystem::path> folders;  ///< scenes may read from these too, and below
  bool geo = false;                            ///< .geo scripts run unconfined, with full access
};

/// Applies to the whole process. Set it before scenes are read, not while other threads read them.
void set_trust(Trust);
const Trust& trust();

}  // namespace pintle
