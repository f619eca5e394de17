#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pintle::app {

/// A new .zip file, written completely or not at all. The same contents give the same bytes, since entries have a fixed date.
class ZipFile {
 public:
  /// @throws FileError  it cannot be created
  explicit ZipFile(const std::filesystem::path&);
  ~ZipFile();
  ZipFile(const ZipFile&) = delete;
  void add(const std::string& name, std::string_view content, bool program = false);
  /// Moves it to its path, replacing an existing file.
  void commit();

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_, staging_;
  void* zip_;
};

}  // namespace pintle::app
