#include "framework/output/results_directory.h"

#include <fcntl.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <system_error>

#include "framework/common/file.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

void require_new(const fs::path& directory) {
  std::error_code error;
  const fs::file_status there = fs::symlink_status(directory, error);
  if (there.type() == fs::file_type::none) throw FileError(directory, error.value(), "cannot be made");
  if (fs::exists(there)) throw std::runtime_error(directory.string() + ": exists already; name another directory with --out, or remove it");
}

/// Creates a folder with an unused name based on `path`. Errors name `final`, the folder that the user named.
fs::path made_beside(const fs::path& path, const fs::path& final) {
  try {
    return make_unique_folder(path);
  } catch (const FileError&) {
    const int why = errno;
    throw FileError(final, why, "cannot be made");
  }
}

void require_short_names(const fs::path& directory) {
  for (const fs::path& part : directory)
    if (part.native().size() > NAME_MAX) throw FileError(directory, ENAMETOOLONG, "cannot be made");
  constexpr std::size_t inside = 300;  // added by the longest path in it
  if (directory.native().size() + inside > PATH_MAX) throw FileError(directory, ENAMETOOLONG, "cannot be made");
}

}  // namespace

bool is_being_filled(const fs::path& folder) {
  const int open = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (open < 0) return false;
  const bool locked = ::flock(open, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(open);
  return locked;
}

fs::path nearest_that_exists(const fs::path& directory) {
  fs::path at = directory.parent_path();
  std::error_code error;
  while (!at.empty() && !fs::exists(at, error)) at = at.parent_path();
  return at.empty() ? fs::path(".") : at;
}

fs::path without_slash(const fs::path& path) {
  fs::path out = path.lexically_normal();
  if (!out.has_filename() && out.has_parent_path() && out != out.root_path()) out = out.parent_path();
  return out;
}

std::vector<fs::path> leftovers(const fs::path& directory) {
  const fs::path final = without_slash(directory), parent = final.parent_path();
  const std::string begins = final.filename().string() + ".part-";
  std::vector<fs::path> out;
  try {
    for (const std::string& name : names_in(parent))
      if (name.starts_with(begins)) out.push_back(parent / name);
  } catch (const FileError&) {  // does not exist yet, or is not readable
  }
  std::ranges::sort(out);
  return out;
}

std::string no_such_folder(const fs::path& directory) {
  const std::vector<fs::path> begun = leftovers(directory);
  if (begun.empty()) return "there is no such folder; name one that `pintle run` has written";
  std::string names;
  for (const fs::path& folder : begun) names += (names.empty() ? "" : ", ") + folder.string();
  return "there is no such folder; a run into it has not ended, or was killed: " + names;
}

std::optional<double> time_of_last_row(const fs::path& folder) {
  constexpr std::streamoff widest = 1 << 20;  // of a row
  std::ifstream in(folder / "trajectory.csv", std::ios::binary);
  if (!in.seekg(0, std::ios::end)) return {};
  const std::streamoff size = in.tellg(), from = std::max<std::streamoff>(0, size - 2 * widest);
  std::string text(static_cast<std::size_t>(size - from), '\0');
  if (!in.seekg(from) || !in.read(text.data(), size - from)) return {};
  const auto end = text.rfind('\n');
  if (end == std::string::npos || end == 0) return {};
  const auto begin = text.rfind('\n', end - 1);
  if (begin == std::string::npos) return {};  // only the heading
  double t = 0;
  const auto [stop, error] = std::from_chars(text.data() + begin + 1, text.data() + end, t);
  return error == std::errc() && *stop == ',' ? std::optional(t) : std::nullopt;
}

namespace {

/// Whether run.json says that the run has ended. Its first lines say so.
bool has_ended(const fs::path& folder) {
  std::ifstream in(folder / "run.json", std::ios::binary);
  std::error_code error;
  if (!in) return fs::exists(folder / "run.json", error);  // unreadable: counts as ended
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return in.gcount() > 0 && head.find("\"status\": \"unfinished\"") == std::string::npos;
}

}  // namespace

std::string why_without(const std::string& lacking, const fs::path& folder) {
  constexpr std::array<std::array<const char*, 2>, 8> others{{{"sensitivity.json", "a sensitivity study"},
                                                              {"sweep.json", "a sweep"},
                                                              {"fit.json", "a fit"},
                                                              {"nonlinear.json", "a nonlinear study"},
                                                              {"tradeoff.json", "a trade-off"},
                                                              {"linearized.json", "a linearization"},
                                                              {"modes.json", "the modes of a body"},
                                                              {"static.json", "the statics of a body"}}};
  if (is_being_filled(folder)) return "its run is still going on and has written no " + lacking + " yet; wait for them";
  std::error_code error;
  for (const auto& [file, what] : others)
    if (fs::exists(folder / file, error))
      return std::string("it holds ") + what + ", which has no " + lacking + "; name the folder of a run";
  if (fs::exists(folder / "journal-0.txt", error))
    return "it holds a study that has not ended; to continue it, repeat its command with the same --out";
  const bool begun = folder.filename().string().find(".part-") != std::string::npos || fs::exists(folder / "trajectory.csv", error);
  const bool hidden = ::access((folder / "trajectory.csv").c_str(), R_OK) != 0 && errno == EACCES;
  if (begun && !hidden && !has_ended(folder) && !time_of_last_row(folder))
    return "its run was killed before it wrote any " + lacking + "; run its scene again";
  return "";
}

void require_writable(const fs::path& directory) {
  const fs::path final = without_slash(directory);
  require_new(final);
  require_short_names(final);
  const fs::path above = nearest_that_exists(final);
  std::error_code error;
  if (!fs::is_directory(above, error)) throw FileError(final, ENOTDIR, "cannot be made");
  ::rmdir(made_beside(above / ".pintle", final).c_str());
}

ResultsDirectory::ResultsDirectory(const fs::path& directory) : final_(without_slash(directory)) {
  require_new(final_);
  require_short_names(final_);
  std::error_code error;
  if (final_.has_parent_path()) fs::create_directories(final_.parent_path(), error);
  if (error) throw FileError(final_.parent_path(), error.value(), "cannot be made");
  staging_ = made_beside(final_, final_);
  try {
    frames_ = staging_ / "frames";
  } catch (...) {
    ::rmdir(staging_.c_str());
    throw;
  }
  ::mkdir(frames_.c_str(), 0777);
  lock_ = ::open(staging_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) ::flock(lock_, LOCK_EX | LOCK_NB);  // it only informs other programs, so a failure is ignored
}

ResultsDirectory::~ResultsDirectory() {
  if (lock_ >= 0) ::close(lock_);
  if (committed_) return;
  ::rmdir(frames_.c_str());  // only if empty, without allocating memory
  ::rmdir(staging_.c_str());
}

bool ResultsDirectory::holds_files() const { return !tree_of(staging_).files.empty(); }

void ResultsDirectory::commit() {
  const auto moved = [](const fs::path& where, const std::string& why) {
    return std::runtime_error(why + "; the results are in " + where.string());
  };
  ::rmdir(frames_.c_str());  // if it is empty
  try {
    sync_tree(staging_);
  } catch (const FileError& e) {
    throw moved(staging_, e.what());
  }
  if (const int error = rename_new(staging_, final_); error != 0) throw moved(staging_, FileError(final_, error, "cannot be made").what());
  committed_ = true;
  try {
    sync_folder(final_.parent_path());
  } catch (const FileError& e) {
    throw moved(final_, e.what());
  }
}

}  // namespace pintle
