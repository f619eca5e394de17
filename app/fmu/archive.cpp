#include "app/fmu/archive.h"

#include <minizip/zip.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "framework/common/file.h"

namespace pintle::app {

namespace fs = std::filesystem;

ZipFile::ZipFile(const fs::path& path)
    : path_(path), staging_(unique_neighbour(path)), zip_(zipOpen64(staging_.c_str(), APPEND_STATUS_CREATE)) {
  if (!zip_) throw FileError(path_, errno);
}

ZipFile::~ZipFile() {
  if (zip_) zipClose(zip_, nullptr);
  std::error_code ignored;
  fs::remove(staging_, ignored);
}

void ZipFile::fail() const { throw FileError(path_, errno); }

void ZipFile::add(const std::string& name, std::string_view content, bool program) {
  zip_fileinfo about{};
  about.tmz_date.tm_year = 1980, about.tmz_date.tm_mday = 1;  // the earliest date of the format
  constexpr uLong ordinary_file = 0100000, utf8_name = 1u << 11, made_by_unix = 3u << 8 | 45;
  about.external_fa = (ordinary_file | (program ? 0755 : 0644)) << 16;
  const bool large = content.size() > 0xffffffffu;
  if (zipOpenNewFileInZip4_64(zip_, name.c_str(), &about, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, Z_DEFAULT_COMPRESSION, 0, -MAX_WBITS,
                              DEF_MEM_LEVEL, Z_DEFAULT_STRATEGY, nullptr, 0, made_by_unix, utf8_name, large) != ZIP_OK)
    fail();
  while (!content.empty()) {
    const std::size_t part = std::min<std::size_t>(content.size(), std::size_t{1} << 20);
    if (zipWriteInFileInZip(zip_, content.data(), static_cast<unsigned>(part)) != ZIP_OK) fail();
    content.remove_prefix(part);
  }
  if (zipCloseFileInZip(zip_) != ZIP_OK) fail();
}

void ZipFile::commit() {
  void* const zip = zip_;
  zip_ = nullptr;
  if (zipClose(zip, nullptr) != ZIP_OK) fail();
  std::error_code error;
  fs::rename(staging_, path_, error);
  if (error) throw FileError(path_, error.value());
}

}  // namespace pintle::app
