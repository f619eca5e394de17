#include "framework/study/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

#include <nlohmann/json.hpp>

#include "framework/scene/error.h"
#include "framework/study/fingerprint.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// JSON has no infinity and no NaN, and its numbers pass through many hands: these pass as text.
std::string exact(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

double exact(const Json& text) {
  const auto& s = text.get_ref<const std::string&>();
  double out = std::nan("");
  std::from_chars(s.data(), s.data() + s.size(), out);
  return out;
}

std::string sealed(const Json& content) {
  const std::string text = content.dump(-1, ' ', false, Json::error_handler_t::replace);
  return fingerprint_text(fingerprint(text)) + " " + text + "\n";
}

std::optional<Json> unsealed(std::string_view line) {
  constexpr std::size_t digits = 16;
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.size() < digits + 2 || line[digits] != ' ') return {};
  const std::string_view text = line.substr(digits + 1);
  if (line.substr(0, digits) != fingerprint_text(fingerprint(text))) return {};
  Json content = Json::parse(text, nullptr, false);
  return content.is_discarded() ? std::optional<Json>() : std::move(content);
}

std::string heading(std::uint64_t study) {
  return sealed({{"pintle sweep", fingerprint_text(study)}});
}

/// @returns false: there is no whole heading
bool judge_heading(const fs::path& path, const std::string& text, std::uint64_t study) {
  const std::size_t end = text.find('\n');
  const std::optional<Json> first = end == std::string::npos ? std::nullopt : unsealed(std::string_view(text).substr(0, end));
  if (!first || !first->contains("pintle sweep")) return false;
  if (text.substr(0, end + 1) != heading(study))
    throw SceneError(path.string(), {}, "belongs to another study, or to this one before it, its scene, a file that they name, --set or "
                                        "the program was changed; name another directory with --out, or remove " + path.parent_path().string());
  return true;
}

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream s;
  s << in.rdbuf();
  if (!in.is_open() || in.bad()) throw std::runtime_error(path.string() + ": cannot be read; check its permissions");
  return s.str();
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end = now() + seconds; !holds(); std::this_thread::sleep_for(std::chrono::milliseconds(50)))
    if (now() > end) return false;
  return true;
}

/// Where the file system has no locks, everything is free.
bool locked(int file, int how, double patience) {
  return within(patience, [&] { return ::flock(file, how | LOCK_NB) == 0 || errno != EWOULDBLOCK; });
}

bool is_journal(const fs::path& path) {
  return path.filename().string().starts_with("journal-") && path.extension() == ".txt";
}

}  // namespace

std::string line_of(const Row& r) {
  Json values = Json::array();
  for (double x : r.values) values.push_back(exact(x));
  return sealed({{"case", r.number}, {"status", r.status}, {"reason", r.reason}, {"values", values}, {"units", r.units}, {"t_end", exact(r.t_end)},
                 {"unexplained", exact(r.unexplained_share)}, {"steps", r.steps}, {"impacts", r.impacts}, {"worker", r.worker},
                 {"build", exact(r.build_seconds)}, {"run", exact(r.run_seconds)}});
}

std::optional<Row> row_of(std::string_view line) {
  const std::optional<Json> found = unsealed(line);
  if (!found || !found->contains("case")) return {};
  const Json& j = *found;
  Row r;
  r.number = j["case"], r.status = j["status"], r.reason = j["reason"], r.units = j["units"], r.steps = j["steps"], r.impacts = j["impacts"];
  r.worker = j["worker"], r.t_end = exact(j["t_end"]), r.unexplained_share = exact(j["unexplained"]);
  r.build_seconds = exact(j["build"]), r.run_seconds = exact(j["run"]);
  for (const Json& x : j["values"]) r.values.push_back(exact(x));
  return r;
}

Journal::Journal(const fs::path& path, std::uint64_t study) : path_(path) {
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) throw std::runtime_error(path.string() + ": cannot be written (" + std::strerror(errno) + "); name another place with --out");
  try {
    if (!locked(file_, LOCK_EX, 3))
      throw std::runtime_error(path.string() + ": another process works on this sweep; wait for it, or end it. (If many were started at once as one "
                                               "MPI job, they do not see each other: start them by mpirun, or by srun --mpi=pmix.)");
    const std::string text = contents(path);
    const bool begun = judge_heading(path, text, study);
    size_ = begun ? static_cast<std::int64_t>(text.rfind('\n') + 1) : 0;
    if (::ftruncate(file_, size_) != 0) throw std::runtime_error(path.string() + ": cannot be written (" + std::strerror(errno) + ")");
    if (!begun) write(heading(study));
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Journal::~Journal() {
  ::fdatasync(file_);
  ::close(file_);
}

void Journal::write(const std::string& line) {
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t n = ::pwrite(file_, line.data() + done, line.size() - done, size_ + static_cast<std::int64_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const std::string why = n < 0 ? std::strerror(errno) : "the disk may be full";
      [[maybe_unused]] const int ignored = ::ftruncate(file_, size_);
      throw std::runtime_error(path_.string() + ": cannot be written (" + why +
                               "); the cases that ended before are kept: mend that, and start the same command again");
    }
    done += static_cast<std::size_t>(n);
  }
  size_ += static_cast<std::int64_t>(line.size());
}

void Journal::append(const Row& row) {
  const std::string line = line_of(row);
  const std::lock_guard lock(one_at_a_time_);
  write(line);
  if (now() - flushed_ < 1) return;
  ::fdatasync(file_);
  flushed_ = now();
}

fs::path journal_path(const fs::path& folder, int rank) {
  return folder / ("journal-" + std::to_string(rank) + ".txt");
}

std::vector<Row> read_journals(const fs::path& folder, std::uint64_t study) {
  std::map<std::size_t, Row> rows;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!is_journal(entry.path())) continue;
    const std::string text = contents(entry.path());
    if (!judge_heading(entry.path(), text, study)) continue;
    for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      if (std::optional<Row> row = row_of(std::string_view(text).substr(begin, end - begin))) rows.emplace(row->number, std::move(*row));
  }
  std::vector<Row> out;
  for (auto& [number, row] : rows) out.push_back(std::move(row));
  return out;
}

bool journals_are_free(const fs::path& folder, const fs::path& but, double seconds) {
  const auto held = [&] {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      if (!is_journal(entry.path()) || entry.path() == but) continue;
      const int file = ::open(entry.path().c_str(), O_RDONLY | O_CLOEXEC);
      if (file < 0) continue;
      const bool free = locked(file, LOCK_SH, 0);
      ::close(file);
      if (!free) return true;
    }
    return false;
  };
  return within(seconds, [&] { return !held(); });
}

}  // namespace pintle
