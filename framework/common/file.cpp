#include "framework/common/file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <system_error>

namespace pintle {

namespace {

namespace fs = std::filesystem;

const char* remedy(int error) {
  switch (error) {
    case ENOSPC: return "make room on that disk, or name another place";
    case EDQUOT: return "your quota on that disk is used up; make room, or name another place";
    case EFBIG: return "the file would be larger than is allowed; raise the limit (ulimit -f), or write fewer rows (output.every)";
    case EACCES:
    case EPERM: return "check the permissions of the folder, or name another place";
    case EROFS: return "the disk is read-only; name another place";
    case ENAMETOOLONG: return "use a shorter name";
    case EIO: return "the disk reports an error; check it, and name another place";
    case EMFILE:
    case ENFILE: return "too many files are open; raise the limit (ulimit -n)";
    case ENOMEM: return "there is not enough memory";
    case ENOENT: return "its folder does not exist, or was removed in the meantime";
    case ENOTDIR: return "a part of the path is not a folder";
    case EEXIST:
    case ENOTEMPTY: return "something else was given this name in the meantime; choose another";
    default: return "name another place";
  }
}

/// @returns 0 or errno; `done` is the number of bytes written in any case
int write_all(int file, std::string_view text, std::size_t& done) {
  done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    if (n == 0) return ENOSPC;
    done += static_cast<std::size_t>(n);
  }
  return 0;
}

/// A close that was interrupted by a signal counts as done. @returns 0 or errno
int close_file(int file) { return ::close(file) == 0 || errno == EINTR ? 0 : errno; }

/// File systems that cannot sync cause no error. @returns 0 or errno
int sync_file(int file) {
  while (::fsync(file) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOSYS || errno == ENOTSUP || errno == EROFS ? 0 : errno;
  }
  return 0;
}

std::string random_letters() {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  static std::atomic<std::uint64_t> count{0};
  std::uint64_t bits = 0;
  if (::getrandom(&bits, sizeof bits, GRND_NONBLOCK) != sizeof bits)
    bits = (static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch().count()) ^ static_cast<std::uint64_t>(::getpid())
                                                                                                          << 40) *
               0x9e3779b97f4a7c15U +
           0x632be59bd9b4e019U * ++count;
  std::string out;
  for (int i = 0; i < 6; ++i, bits /= letters.size()) out += letters[bits % letters.size()];
  return out;
}

constexpr int tries = 100;                          // attempts at a random name
constexpr std::size_t many = std::size_t{1} << 18;  // bytes written at a time

void write_file(const fs::path& path, const std::string& text, bool synced) {
  fs::path part;
  int file = -1;
  for (int k = 0; k < tries && file < 0; ++k) {
    part = unique_neighbour(path);
    file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno != EEXIST && errno != EINTR) throw FileError(path, errno);
  }
  if (file < 0) throw FileError(path, errno);
  std::size_t done = 0;
  int error = write_all(file, text, done);
  if (error == 0 && synced) error = sync_file(file);
  const int closed = close_file(file);
  if (error == 0) error = closed;
  if (error == 0 && ::rename(part.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(part.c_str());
  throw FileError(path, error);
}

}  // namespace

FileError::FileError(const fs::path& path, int error, const std::string& what)
    : runtime_error(path.string() + ": " + what + " (" + std::system_category().message(error) + "); " + remedy(error)) {}

FileError::FileError(const fs::path& path, const std::string& why) : runtime_error(path.string() + ": cannot be written (" + why + ")") {}

FileWriter::FileWriter(fs::path path) : path_(std::move(path)) {
  do file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  while (file_ < 0 && errno == EINTR);
  if (file_ < 0) throw FileError(path_, errno);
  buffer_.reserve(many + many / 4);
}

FileWriter::~FileWriter() {
  if (file_ < 0) return;
  try {
    flush();
  } catch (...) {  // complete records are kept
  }
  ::close(file_);
}

void FileWriter::append(std::string_view record) {
  if (failed_) return;
  buffer_.reserve(buffer_.size() + record.size());  // so that a record is added completely or not at all
  ends_.push_back(buffer_.size() + record.size());
  buffer_ += record;
  buffer_.size() >= many ? flush() : flush_if_due();
}

void FileWriter::flush_if_due() {
  if (!buffer_.empty() && std::chrono::steady_clock::now() - flushed_ > std::chrono::seconds(1)) flush();
}

void FileWriter::flush() {
  if (failed_) return;
  std::size_t done = 0;
  const int error = write_all(file_, buffer_, done);
  if (error != 0) {
    failed_ = true;
    cut(done);
    throw FileError(path_, error);
  }
  size_ += static_cast<long long>(done);
  buffer_.clear();
  ends_.clear();
  flushed_ = std::chrono::steady_clock::now();
}

void FileWriter::cut(std::size_t written) {
  const auto after = std::upper_bound(ends_.begin(), ends_.end(), written);
  const long long whole = size_ + (after == ends_.begin() ? 0 : static_cast<long long>(*(after - 1)));
  [[maybe_unused]] const int ignored = ::ftruncate(file_, whole);
}

void FileWriter::close() {
  flush();
  const int file = file_;
  file_ = -1;
  if (file < 0) return;
  if (const int error = close_file(file); error != 0 && !failed_) {
    failed_ = true;
    throw FileError(path_, error);
  }
}

fs::path unique_neighbour(const fs::path& path) {
  const std::string ending = ".part-" + random_letters();
  std::string name = path.filename().string();
  name.resize(std::min(name.size(), NAME_MAX - ending.size()));
  return path.parent_path() / (name + ending);
}

fs::path make_unique_folder(const fs::path& path) {
  for (int k = 0; k < tries; ++k) {
    fs::path folder = unique_neighbour(path);
    if (::mkdir(folder.c_str(), 0777) == 0) return folder;
    if (errno != EEXIST && errno != EINTR) throw FileError(folder, errno, "cannot be made");
  }
  throw FileError(path, EEXIST, "cannot be made");
}

void write_text(const fs::path& path, const std::string& text) { write_file(path, text, false); }

void write_synced(const fs::path& path, const std::string& text) {
  write_file(path, text, true);
  sync_folder(path.parent_path());
}

void sync_folder(const fs::path& folder) {
  const fs::path path = folder.empty() ? "." : folder;
  const int file = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) throw FileError(path, errno);
  const int error = sync_file(file);
  ::close(file);
  if (error != 0) throw FileError(path, error);
}

std::vector<std::string> names_in(const fs::path& folder) {
  const auto close = [](DIR* open) { ::closedir(open); };
  const std::unique_ptr<DIR, decltype(close)> open(::opendir(folder.empty() ? "." : folder.c_str()), close);
  if (!open) throw FileError(folder, errno, "cannot be read");
  std::vector<std::string> out;
  for (const dirent* entry; (errno = 0, entry = ::readdir(open.get())) != nullptr;)
    if (std::string name = entry->d_name; name != "." && name != "..") out.push_back(std::move(name));
  if (errno != 0) throw FileError(folder, errno, "cannot be read");
  return out;
}

Tree tree_of(const fs::path& folder) {
  Tree out{{}, {folder}};
  for (std::size_t k = 0; k < out.folders.size(); ++k)
    for (const std::string& name : names_in(out.folders[k])) {
      fs::path path = out.folders[k] / name;
      struct stat is;
      if (::lstat(path.c_str(), &is) != 0) throw FileError(path, errno, "cannot be read");
      (S_ISDIR(is.st_mode) ? out.folders : out.files).push_back(std::move(path));
    }
  return out;
}

void sync_tree(const fs::path& folder) {
  const auto tree = tree_of(folder);
  const auto each = [&](auto act) {
    for (const fs::path& path : tree.files) {
      const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
      if (file < 0) throw FileError(path, errno);
      const int failed = act(file);
      ::close(file);
      if (failed != 0) throw FileError(path, failed);
    }
  };
#if defined(__linux__)
  if (tree.files.size() > 2) {  // waits for the disk once instead of once per file
    const int whole = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (whole < 0) throw FileError(folder, errno);
    const int failed = ::syncfs(whole) == 0 ? 0 : errno;
    ::close(whole);
    if (failed == 0) return;
    if (failed != ENOSYS && failed != EINVAL) throw FileError(folder, failed);
  }
#endif
  each([](int file) { return sync_file(file); });
  for (const fs::path& path : tree.folders) sync_folder(path);
}

int rename_new(const fs::path& from, const fs::path& to) {
#if defined(RENAME_NOREPLACE)
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != ENOSYS && errno != EINVAL) return errno;
#endif
  struct stat there;
  if (::lstat(to.c_str(), &there) == 0) return EEXIST;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

}  // namespace pintle
