#pragma once

#include <filesystem>
#include <vector>

namespace pintle {

/// Notes the files that this thread opens, or is about to name to another process, while it lives. One at a time in a thread.
class FilesNoted {
 public:
  FilesNoted();
  ~FilesNoted();
  FilesNoted(const FilesNoted&) = delete;
  /// As they were named, each once; some of contained_file need not be there.
  const std::vector<std::filesystem::path>& paths() const { return paths_; }

 private:
  friend void note_file(const std::filesystem::path&);
  std::vector<std::filesystem::path> paths_;
};

}  // namespace pintle
