#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

/// The one place where files are opened that somebody else wrote.
namespace pintle {

/// Why a file is not read, and what to do: "is a directory; name a file in it". Without its name.
struct FileRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The whole of an ordinary file. Devices, pipes and sockets are not even opened.
/// @throws FileRefused  it is not there, not an ordinary file, larger than `most_bytes`, or cannot be read
std::string read_file(const std::filesystem::path&, std::size_t most_bytes);

/// At most the first `count` bytes of an ordinary file.  @throws FileRefused  as read_file
std::string read_head(const std::filesystem::path&, std::size_t count);

/// Where files may be read from for a scene in `folder`: there and below, and in the folders that the user trusts.
/// Absolute, without symbolic links; those that do not exist are left out.
std::vector<std::filesystem::path> readable_folders(const std::filesystem::path& folder);

/// The path of a file that a scene in `folder` names, if that leads, symbolic links followed, into one of
/// readable_folders(folder). Whether it is there is not looked at.
/// @param named  relative to `beside`, or absolute
/// @throws FileRefused  it lies elsewhere (with the name, here)
std::filesystem::path contained_file(const std::filesystem::path& named, const std::filesystem::path& beside,
                                     const std::filesystem::path& folder);
inline std::filesystem::path contained_file(const std::filesystem::path& named, const std::filesystem::path& folder) {
  return contained_file(named, folder, folder);
}

}  // namespace pintle
