#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/build/build.h"

namespace pintle {

/// What a run writes [bytes].
struct RoomNeeded {
  double least = 0, likely = 0;            ///< on the disk
  double file_least = 0, file_likely = 0;  ///< of the largest file
};
/// From numbers of rows, columns, frames and saved states. At least: each number one digit and a comma.
/// @param from  where a run goes on from a saved state [s]
RoomNeeded room_needed(const Scene&, const Model&, double from = 0);

/// What there is [bytes], infinite where it is not known or not limited.
struct Room {
  double on_disk = 0, in_a_file = 0;
};
Room room_at(const std::filesystem::path& directory);

/// @returns what is doubtful, in words   @throws std::runtime_error  what is needed at least is more than there is
std::vector<std::string> validate_room(const std::filesystem::path& directory, const RoomNeeded&, const Room&);

}  // namespace pintle
