#pragma once

#include <filesystem>
#include <vector>

namespace pintle {

/// While it exists, records the files that this thread opens or passes by name to another process. One at a time in a thread.
class FilesNoted {
 public:
  FilesNoted();
  ~FilesNoted();
  FilesNoted(const FilesNoted&) = delete;
  /// The names as given, each once; those from contained_file need not exist.
  const std::vector<std::filesystem::path>& paths() const { return paths_; }

 private:
  friend void note_file(const std::filesystem::path&);
  std::vector<std::filesystem::path> paths_;
};

}  // namespace pintle
