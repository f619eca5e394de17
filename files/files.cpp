#include "files/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "files/noted.h"
#include "files/trust.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

Trust& settings() {
  static Trust trust;
  return trust;
}

void validate_kind(const struct stat& s) {
  if (S_ISDIR(s.st_mode)) throw FileRejected("is a directory; name a file in it");
  if (!S_ISREG(s.st_mode)) throw FileRejected("is not an ordinary file; copy its contents to one");
}

/// An open ordinary file.
class File {
 public:
  explicit File(const fs::path& path) {
    struct stat s {};
    // Checked by name first: opening a device or a pipe may already have effects.
    if (::stat(path.c_str(), &s) != 0) {
      if (errno == ENOENT || errno == ENOTDIR) throw FileRejected("there is no such file; check the path");
      throw FileRejected(std::string("cannot be read (") + std::strerror(errno) + "); check its permissions");
    }
    validate_kind(s);
    number_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
    if (number_ < 0) throw FileRejected(std::string("cannot be read (") + std::strerror(errno) + "); check its permissions");
    if (::fstat(number_, &s) != 0 || !S_ISREG(s.st_mode)) {
      ::close(number_);
      throw FileRejected("is not an ordinary file; copy its contents to one");
    }
    size_ = static_cast<std::uintmax_t>(s.st_size);
  }
  ~File() { ::close(number_); }
  File(const File&) = delete;

  std::uintmax_t size() const { return size_; }

  /// The next `count` bytes, or fewer where the file ends.
  std::string read(std::size_t count) const {
    std::string text(count, '\0');
    std::size_t got = 0;
    while (got < count) {
      const ssize_t n = ::read(number_, text.data() + got, count - got);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) throw FileRejected(std::string("cannot be read to its end (") + std::strerror(errno) + ")");
      if (n == 0) break;
      got += static_cast<std::size_t>(n);
    }
    text.resize(got);
    return text;
  }

 private:
  int number_ = -1;
  std::uintmax_t size_ = 0;
};

bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

void set_trust(Trust trust) { settings() = std::move(trust); }

const Trust& trust() { return settings(); }

static thread_local FilesNoted* noting = nullptr;

void note_file(const fs::path& path) {
  if (noting && std::ranges::find(noting->paths_, path) == noting->paths_.end()) noting->paths_.push_back(path);
}

FilesNoted::FilesNoted() { noting = this; }
FilesNoted::~FilesNoted() { noting = nullptr; }

std::string read_file(const fs::path& path, std::size_t most_bytes) {
  const File file(path);
  note_file(path);
  if (file.size() > most_bytes)
    throw FileRejected("has " + std::to_string(file.size() >> 20) + " MB; at most " + std::to_string(most_bytes >> 20) +
                       " MB are read. Is it the right file?");
  return file.read(static_cast<std::size_t>(file.size()));
}

std::string read_head(const fs::path& path, std::size_t count) {
  const File file(path);
  note_file(path);
  return file.read(static_cast<std::size_t>(std::min<std::uintmax_t>(file.size(), count)));
}

std::vector<fs::path> readable_folders(const fs::path& folder) {
  std::vector<fs::path> out;
  const auto add = [&](const fs::path& path) {
    std::error_code error;
    const fs::path real = fs::canonical(path.empty() ? "." : path, error);
    if (!error) out.push_back(real);
  };
  add(folder);
  for (const fs::path& path : trust().folders) add(path);
  return out;
}

fs::path contained_file(const fs::path& named, const fs::path& beside, const fs::path& folder) {
  std::error_code error;
  fs::path path = beside / named;
  const fs::path real = fs::weakly_canonical(path.is_absolute() ? path : fs::current_path() / path, error);
  if (error) throw FileRejected("\"" + named.string() + "\": its path cannot be resolved (" + error.message() + "); check it");
  const std::vector<fs::path> folders = readable_folders(folder);
  if (std::none_of(folders.begin(), folders.end(), [&](const fs::path& f) { return lies_in(real, f); }))
    throw FileRejected("\"" + named.string() + "\" lies outside the folder of the scene" +
                       (folders.empty() ? std::string() : ", " + folders[0].string()) + "; copy it there, or allow it with --allow-path " +
                       real.parent_path().string());
  note_file(path);
  return path;
}

}  // namespace pintle
