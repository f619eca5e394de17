#include "framework/study/sweep/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <nlohmann/json.hpp>

#include "files/files.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/common/fingerprint.h"
#include "framework/scene/error.h"
#include "framework/study/sweep/curves.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// JSON has no infinity and no NaN, and its numbers may be changed by other programs: these are stored as text.
std::string exact(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

double exact(const Json& text) {
  const auto& s = text.get_ref<const std::string&>();
  double out = 0;
  if (std::from_chars(s.data(), s.data() + s.size(), out).ptr != s.data() + s.size() || s.empty()) throw std::invalid_argument(s);
  return out;
}

/// A count; JSON would silently convert a fraction or a negative number.
template <class T>
T count(const Json& j) {
  const auto x = j.is_number_integer() ? j.get<std::int64_t>() : -1;
  if (x < 0 || (j.is_number_unsigned() && j.get<std::uint64_t>() > INT64_MAX)) throw std::invalid_argument("count");
  return static_cast<T>(x);
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

std::string heading(std::uint64_t study) { return sealed({{"pintle sweep", fingerprint_text(study)}}); }

std::string remedy_of_sweep(const fs::path& path) {
  return "name another directory with --out, or remove " + path.parent_path().string() + " and run the study again";
}

/// @returns false: there is no heading yet, because its process was killed while writing it
/// @throws OtherStudy, SceneError
bool validate_heading(const fs::path& path, const std::string& text, std::uint64_t study, const std::string& remedy) {
  const std::string ours = heading(study);
  const std::size_t end = text.find('\n');
  if (end == std::string::npos && text.size() <= ours.size() &&
      text.substr(0, text.find('\0')) == ours.substr(0, std::min(text.size(), text.find('\0'))))
    return false;
  const std::optional<Json> first = end == std::string::npos ? std::nullopt : unsealed(std::string_view(text).substr(0, end));
  if (!first || !first->is_object() || !first->contains("pintle sweep"))
    throw SceneError(path.string() + ":1: is damaged: its first line does not name a sweep, so its cases may belong to another one; " +
                     remedy);
  if (text.substr(0, end + 1) != ours)
    throw OtherStudy(path.string(), {},
                     "belongs to another study, or was written before the study, its scene, a file that they name, --set or the program "
                     "was changed; name another directory with --out, or remove " +
                         path.parent_path().string());
  return true;
}

std::string contents(const fs::path& path, const std::string& remedy) {
  try {
    return read_file(path, std::numeric_limits<std::size_t>::max());
  } catch (const FileRejected& rejected) {
    throw SceneError(path.string() + ": " + rejected.what() + "; " + remedy);
  }
}

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool within(double seconds, const std::function<bool()>& holds) {
  for (const double end = now() + seconds; !holds(); std::this_thread::sleep_for(std::chrono::milliseconds(50)))
    if (now() > end) return false;
  return true;
}

/// Locks a file, waiting for at most `patience` [s]. @returns false if another process holds the lock; true on a file system without locks
bool locked(int file, int how, double patience) {
  return within(patience, [&] { return ::flock(file, how | LOCK_NB) == 0 || errno != EWOULDBLOCK; });
}

/// Note about an incomplete last line.
std::string torn(const fs::path& path, const std::string& text) {
  const auto line = 1 + std::count(text.begin(), text.end(), '\n');
  return path.string() + ":" + std::to_string(line) + ": is incomplete, because its process ended while writing it; " +
         (line == 1 ? "no case counts as run" : "its case counts as not run");
}

bool is_journal(const fs::path& path) { return path.filename().string().starts_with("journal-") && path.extension() == ".txt"; }

}  // namespace

bool lacked_memory(const Row& row) { return row.status == status_text(Status::out_of_memory); }

Row row_of(std::size_t number, const Outcome& o, std::string worker) {
  return {.number = number,
          .status = o.status,
          .reason = o.reason,
          .values = o.values,
          .units = o.units,
          .t_end = o.t_end,
          .unexplained_share = o.unexplained_share,
          .steps = o.counts.steps,
          .impacts = o.impacts,
          .worker = std::move(worker),
          .build_seconds = o.build_seconds,
          .run_seconds = o.run_seconds,
          .warnings = o.warnings};
}

std::string line_of(const Row& r) {
  Json values = Json::array();
  for (double x : r.values) values.push_back(exact(x));
  Json row{{"case", r.number},
           {"status", r.status},
           {"reason", r.reason},
           {"values", values},
           {"units", r.units},
           {"t_end", exact(r.t_end)},
           {"unexplained", exact(r.unexplained_share)},
           {"steps", r.steps},
           {"impacts", r.impacts},
           {"worker", r.worker},
           {"build", exact(r.build_seconds)},
           {"run", exact(r.run_seconds)}};
  if (!r.curves.empty()) row["curves"] = r.curves;
  if (!r.warnings.empty()) row["warnings"] = r.warnings;
  return sealed(row);
}

std::optional<Row> row_of(std::string_view line) try {
  const std::optional<Json> found = unsealed(line);
  if (!found || !found->is_object()) return {};
  const Json& j = *found;
  Row r;
  r.number = count<std::size_t>(j.at("case")), r.status = j.at("status"), r.reason = j.at("reason"), r.units = j.at("units");
  r.steps = count<long>(j.at("steps")), r.impacts = count<long>(j.at("impacts"));
  r.worker = j.at("worker"), r.t_end = exact(j.at("t_end")), r.unexplained_share = exact(j.at("unexplained"));
  r.build_seconds = exact(j.at("build")), r.run_seconds = exact(j.at("run"));
  if (!j.at("values").is_array()) return {};
  for (const Json& x : j.at("values")) r.values.push_back(exact(x));
  if (j.contains("curves")) r.curves = j.at("curves").get<std::map<std::string, std::string>>();
  if (j.contains("warnings")) r.warnings = j.at("warnings").get<std::vector<std::string>>();
  for (const auto& [name, print] : r.curves)
    if (!is_curve_of(r.number, name)) return {};
  return r;
} catch (const Json::exception&) {  // valid checksum, but not written by line_of
  return {};
} catch (const std::invalid_argument&) {
  return {};
}

Journal::Journal(const fs::path& path, std::uint64_t study, std::vector<std::string>* notes) : path_(path) {
  std::error_code error;
  if (const fs::file_status there = fs::status(path, error); fs::exists(there) && !fs::is_regular_file(there))
    throw SceneError(path.string() + ": is not an ordinary file; " + remedy_of_sweep(path));
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0)
    throw std::runtime_error(path.string() + ": cannot be written (" + std::strerror(errno) + "); name another place with --out");
  try {
    if (!locked(file_, LOCK_EX, 3))
      throw std::runtime_error(path.string() +
                               ": another process works on this sweep; wait for it, or end it. (If several were started as one MPI job, "
                               "they do not see each other: start them with mpirun, or with srun --mpi=pmix.)");
    const std::string text = contents(path, remedy_of_sweep(path));
    const bool begun = validate_heading(path, text, study, remedy_of_sweep(path));
    size_ = begun ? static_cast<std::int64_t>(text.rfind('\n') + 1) : 0;
    if (notes && size_ < static_cast<std::int64_t>(text.size())) notes->push_back(torn(path, text));
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
                               "); the cases that ended before are kept: remove the cause, and start the same command again");
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

fs::path journal_path(const fs::path& folder, int rank) { return folder / ("journal-" + std::to_string(rank) + ".txt"); }

std::vector<Row> read_journals(const fs::path& folder, std::uint64_t study, std::size_t cases, std::vector<std::string>* notes,
                               const std::string& remedy) {
  std::map<std::size_t, Row> rows;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    if (!is_journal(path)) continue;
    const std::string otherwise = remedy.empty() ? remedy_of_sweep(path) : remedy;
    const std::string text = contents(path, otherwise);
    if (notes && !text.ends_with('\n') && !text.empty()) notes->push_back(torn(path, text));
    if (!validate_heading(path, text, study, otherwise)) continue;
    std::size_t line = 2;
    for (std::size_t begin = text.find('\n') + 1, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1, ++line) {
      std::optional<Row> row = row_of(std::string_view(text).substr(begin, end - begin));
      const std::string where = path.string() + ":" + std::to_string(line);
      if (!row)
        throw SceneError(where +
                         ": is damaged: its checksum or its content is wrong; remove this line, then its case is run again when the study "
                         "is continued, or " +
                         otherwise);
      if (row->number < 1 || row->number > cases)
        throw SceneError(where + ": is of case " + std::to_string(row->number) + ", but the study has only " + std::to_string(cases) +
                         "; " + otherwise);
      const std::size_t number = row->number;
      if (const auto [at, fresh] = rows.try_emplace(number, *row); !fresh && lacked_memory(at->second)) at->second = std::move(*row);
    }
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
