#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

/// Only these functions open files from other sources.
namespace pintle {

/// Why a file is not read, and the remedy: "is a directory; name a file in it". Without its name.
struct FileRejected : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The complete contents of an ordinary file. Devices, pipes and sockets are not even opened.
/// @throws FileRejected  it does not exist, is not an ordinary file, is larger than `most_bytes`, or cannot be read
std::string read_file(const std::filesystem::path&, std::size_t most_bytes);

/// The first `count` bytes of an ordinary file, or fewer.  @throws FileRejected  as read_file
std::string read_head(const std::filesystem::path&, std::size_t count);

/// Folders from which files may be read for a scene in `folder`: this one and below, and those that the user trusts. Absolute, without
/// symbolic links; missing ones are omitted.
std::vector<std::filesystem::path> readable_folders(const std::filesystem::path& folder);

/// The path of a file named by a scene in `folder`, if with symbolic links followed it is in one of readable_folders(folder). Does not
/// check whether it exists.
/// @param named  relative to `beside`, or absolute
/// @throws FileRejected  it is elsewhere (this message contains the name)
std::filesystem::path contained_file(const std::filesystem::path& named, const std::filesystem::path& beside,
                                     const std::filesystem::path& folder);
inline std::filesystem::path contained_file(const std::filesystem::path& named, const std::filesystem::path& folder) {
  return contained_file(named, folder, folder);
}

}  // namespace pintle
