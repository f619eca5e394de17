#pragma once

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// A file or folder that cannot be written: names the path, the reason and what to do.
struct FileError : std::runtime_error {
  /// @param error  of errno
  FileError(const std::filesystem::path&, int error, const std::string& what = "cannot be written");
  FileError(const std::filesystem::path&, const std::string& why);
};

/// A new file that grows at its end. Records stay in memory until there are many or a second has passed. Every call is
/// checked; where the disk is full the file ends with a whole record.
class FileWriter {
 public:
  /// @throws FileError  the file exists or cannot be made
  explicit FileWriter(std::filesystem::path path);
  ~FileWriter();  ///< flushes as far as it can
  FileWriter(const FileWriter&) = delete;
  /// @throws FileError  once; later records are dropped
  void append(std::string_view record);
  void flush();
  void close();  ///< flushes. @throws FileError

 private:
  void cut(std::size_t written);

  std::filesystem::path path_;
  int file_ = -1;
  bool failed_ = false;
  std::string buffer_;
  std::vector<std::size_t> ends_;  ///< of records in the buffer
  long long size_ = 0;             ///< of the file
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

/// A name beside `path` that nothing has: its own, cut if it is long, and ".part-" with six random letters or digits.
std::filesystem::path unique_neighbour(const std::filesystem::path& path);
/// A folder of such a name, made. @throws FileError
std::filesystem::path make_unique_folder(const std::filesystem::path& path);

/// A file, whole or not at all: to a unique neighbour first, which then takes the name. On the disk when its folder is synced.
/// @throws FileError
void write_text(const std::filesystem::path&, const std::string&);
/// The same, on the disk when it returns.
void write_synced(const std::filesystem::path&, const std::string&);

/// A folder's files, those of folders in it too, and folders, itself first. (The iterators of the standard library end the
/// program where memory does not suffice.) @throws FileError
struct Tree {
  std::vector<std::filesystem::path> files, folders;
};
Tree tree_of(const std::filesystem::path& folder);
/// Names in a folder. @throws FileError
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Puts a folder and all files in it on the disk. @throws FileError
void sync_tree(const std::filesystem::path& folder);
/// Puts the names in a folder on the disk. @throws FileError
void sync_folder(const std::filesystem::path& folder);
/// Renames, never over something that is there. @returns 0 or errno
int rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace pintle
