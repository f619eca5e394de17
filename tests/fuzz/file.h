#pragma once

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace pintle {

/// A folder in memory, one for a process, gone at its end.
class FuzzFolder {
 public:
  FuzzFolder() {
    std::error_code error;
    const bool memory = std::filesystem::is_directory("/dev/shm", error);
    std::string name = std::string(memory ? "/dev/shm" : "/tmp") + "/pintle_fuzz_XXXXXX";
    path_ = mkdtemp(name.data());
  }
  ~FuzzFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FuzzFolder(const FuzzFolder&) = delete;

  std::filesystem::path write(const char* name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline const FuzzFolder& fuzz_folder() {
  static const FuzzFolder folder;
  return folder;
}

}  // namespace pintle
