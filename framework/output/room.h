#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/build/build.h"

namespace pintle {

/// Disk space for the output of a run [bytes].
struct RoomNeeded {
  double least = 0, likely = 0;            ///< on the disk
  double file_least = 0, file_likely = 0;  ///< of the largest file
};
/// From the numbers of rows, columns, frames and saved states. Minimum: each number takes one digit and a comma.
/// @param from  time of a saved state from which the run continues [s]
RoomNeeded room_needed(const Scene&, const Model&, double from = 0);

/// Available space [bytes], infinite if unknown or not limited.
struct Room {
  double on_disk = 0, in_a_file = 0;
};
Room room_at(const std::filesystem::path& directory);

/// @returns warnings, in words   @throws std::runtime_error  the minimum needed exceeds the available space
std::vector<std::string> validate_room(const std::filesystem::path& directory, const RoomNeeded&, const Room&);

}  // namespace pintle
