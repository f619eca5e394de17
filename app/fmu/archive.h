#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pintle::app {

/// A new .zip file, whole or not at all. What is the same is the same file: entries bear no time.
class ZipFile {
 public:
  /// @throws FileError  it cannot be made
  explicit ZipFile(const std::filesystem::path&);
  ~ZipFile();
  ZipFile(const ZipFile&) = delete;
  void add(const std::string& name, std::string_view content, bool program = false);
  /// Puts it in its place, over one that is there.
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_, staging_;
  void* zip_;
};

}  // namespace pintle::app
