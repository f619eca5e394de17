#include "app/run_end.h"

#include <algorithm>
#include <cerrno>
#include <iostream>
#include <new>
#include <stdexcept>

#include "app/progress.h"
#include "framework/common/file.h"
#include "framework/report/description.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

/// Message of the exception being handled. @throws std::bad_alloc  no memory for it
std::string reason() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "there was not enough memory to write the results; end other programs, or raise the limit (ulimit -v)";
  } catch (const std::exception& e) {
    return e.what();
  }
}

}  // namespace

void require_place(const fs::path& out) {
  now_doing("checking the folder for the results");
  require_writable(out);
  now_doing("computing");
}

void require_file_place(const fs::path& file) {
  std::error_code error;
  const fs::file_status there = fs::status(file, error);
  if (fs::exists(there) && !fs::is_regular_file(there))
    throw std::runtime_error(file.string() + ": " + (fs::is_directory(there) ? "is a directory" : "is not an ordinary file") +
                             "; name a file to write");
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
    throw std::runtime_error(file.string() + ": cannot be written: there is no folder " + folder.string() + "; create it, or name another");
  try {
    fs::remove(make_unique_folder(folder / ".pintle"), error);
  } catch (const FileError&) {
    const int why = errno;
    throw FileError(file, why);
  }
}

void tell_leftovers(const Options& options, const fs::path& out) {
  const std::vector<fs::path> all = leftovers(out);
  if (options.quiet || all.empty()) return;
  constexpr std::size_t most = 3;
  std::cerr << "  note: " << all.size() << (all.size() == 1 ? " folder" : " folders")
            << " of interrupted or still running runs with the same --out:";
  for (std::size_t k = 0; k < std::min(most, all.size()); ++k) {
    std::cerr << " " << all[k].string();
    if (const auto t = time_of_last_row(all[k])) std::cerr << " (to t = " << number(*t) << " s)";
  }
  std::cerr << (all.size() > most ? " …" : "") << "; rename those worth keeping and remove the rest\n";
}

void tell_if_unfinished(const fs::path& directory) {
  const auto t = time_of_last_row(directory);
  if (!t || !is_unfinished(directory)) return;
  std::cerr << directory.string()
            << (is_being_filled(directory) ? ": the run is still going on; so far its rows" : ": the run did not finish; its rows")
            << " end at t = " << number(*t) << " s\n";
}

void write_whole(const Options& options, const fs::path& out, const std::function<void(const fs::path&)>& write) {
  now_doing("writing the results");
  tell_leftovers(options, out);
  ResultsDirectory results(out);
  results_are_in(results.path().string());
  if (!asked_to_stop()) end_on_signals();  // otherwise the user has asked already, and this is what was computed
  write(results.path());
  handle_signals();
  results.commit();
}

void finish_run(ResultsDirectory& results, Run& run, const std::function<void()>& write, const std::function<void()>& report) {
  bool whole = run.status != Status::not_written;
  const auto attempt = [&](const std::function<void()>& act) {
    try {
      act();
    } catch (...) {
      if (whole) run.reason = reason();
      run.status = Status::not_written;
      whole = false;
    }
  };
  attempt(write);
  if (whole)
    attempt([&] { results.commit(); });
  else
    attempt(report);
  if (whole || run.reason.find("the results are in") != std::string::npos) return;
  if (!results.holds_files()) return void(run.reason += "; no results could be written");
  const double last = time_of_last_row(results.path()).value_or(0);  // rows after it were lost
  run.reason +=
      "; what was computed" + (last > 0 ? " up to t = " + number(last) + " s" : std::string()) + " is in " + results.path().string();
}

int exit_code(const Options& options, const Scene& scene, const Run& run) {
  const bool unsaid = options.quiet || options.json || run.status == Status::not_written || run.status == Status::out_of_memory;
  if (run.status != Status::finished && unsaid) std::cerr << scene.file << ": " << status_text(run.status) << ": " << run.reason << "\n";
  switch (run.status) {
    case Status::finished: return ok;
    case Status::failed: return run_failed;
    case Status::interrupted: return stopped;
    case Status::ledger_over_bound: return ledger_over;
    case Status::not_written:
    case Status::out_of_memory: return trouble;
  }
  return trouble;
}

}  // namespace pintle::app
