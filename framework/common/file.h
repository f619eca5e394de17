#pragma once

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// A file or folder that cannot be written: names the path, the reason and the remedy.
struct FileError : std::runtime_error {
  /// @param error  errno
  FileError(const std::filesystem::path&, int error, const std::string& what = "cannot be written");
  FileError(const std::filesystem::path&, const std::string& why);
};

/// A new file that grows at its end. Records stay in memory until there are many or a second has passed. Every call is checked; if the disk
/// becomes full, the file ends with a complete record.
class FileWriter {
 public:
  /// @throws FileError  the file exists or cannot be created
  explicit FileWriter(std::filesystem::path path);
  ~FileWriter();  ///< flushes as far as possible
  FileWriter(const FileWriter&) = delete;
  /// @throws FileError  once; later records are dropped
  void append(std::string_view record);
  void flush();
  void flush_if_due();  ///< if a second has passed since the last flush
  void close();         ///< flushes. @throws FileError

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

/// An unused name next to `path`: its own name, shortened if it is long, and ".part-" with six random letters or digits.
std::filesystem::path unique_neighbour(const std::filesystem::path& path);
/// Creates a folder with such a name. @throws FileError
std::filesystem::path make_unique_folder(const std::filesystem::path& path);

/// Writes a file completely or not at all: first under a unique name beside it, then renamed. It is on the disk once its folder is synced.
/// @throws FileError
void write_text(const std::filesystem::path&, const std::string&);
/// The same; the content is on the disk when it returns.
void write_synced(const std::filesystem::path&, const std::string&);

/// All files below a folder, and all folders, itself first. (The standard library's iterators terminate the program if memory runs out.)
/// @throws FileError
struct Tree {
  std::vector<std::filesystem::path> files, folders;
};
Tree tree_of(const std::filesystem::path& folder);
/// Names in a folder. @throws FileError
std::vector<std::string> names_in(const std::filesystem::path& folder);

/// Syncs a folder and all files in it to the disk. @throws FileError
void sync_tree(const std::filesystem::path& folder);
/// Syncs the names in a folder to the disk. @throws FileError
void sync_folder(const std::filesystem::path& folder);
/// Renames, never over an existing file. @returns 0 or errno
int rename_new(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace pintle
