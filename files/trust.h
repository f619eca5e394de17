#pragma once

#include <filesystem>
#include <vector>

namespace pintle {

/// What the user allows beyond what is safe for a scene of unknown origin (SECURITY.md). The program's command line or
/// the library's caller says it; a scene cannot.
struct Trust {
  std::vector<std::filesystem::path> folders;  ///< scenes may read from these too, and from all below them
  bool geo = false;                            ///< .geo scripts run unconfined, with all that they ask for
};

/// Holds for the whole process. Set it before scenes are read, not while other threads read them.
void set_trust(Trust);
const Trust& trust();

}  // namespace pintle
