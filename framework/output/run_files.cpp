#include "framework/output/run_files.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <exception>

#include "framework/common/text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

constexpr const char* event_columns =
    "joint,begin [s],end [s],approach speed [m/s],separation speed [m/s],deepest penetration [m],"
    "peak force [N],energy lost [J]";

bool with_impulses(const System& system) {
  return std::ranges::any_of(system.contacts, [](const ContactPair& c) { return is_rigid(c); });
}

bool with_pressures(const System& system) {
  return std::ranges::any_of(system.contacts, [](const ContactPair& c) { return c.pressure.has_value(); });
}

}  // namespace

RunFiles::RunFiles(const fs::path& directory, const Scene& scene, const Model& model)
    : system_(model.system),
      trajectory_(directory / "trajectory.csv"),
      ledger_(directory / "ledger.csv"),
      events_(directory / "events.csv") {
  trajectory_.append(csv_heading(trajectory_table(model)));
  ledger_.append(csv_heading(ledger_table(system_)));
  events_.append(std::string(event_columns) + (with_impulses(system_) ? ",impulse [N s]" : "") +
                 (with_pressures(system_) ? ",peak pressure [Pa],half angle [rad]\n" : "\n"));
  if (!scene.events.empty()) actions_.emplace(directory / "actions.csv").append("event,t [s],did\n");
}

void RunFiles::add_rows(const Table& table, FileWriter& file) {
  for (std::size_t r = 0; r < table.rows(); ++r) {
    row_.clear();
    append_csv_row(row_, table, r);
    file.append(row_);
  }
}

void RunFiles::add_impact(const Impact& i) {
  row_ = csv_field(system_.contact_names[static_cast<std::size_t>(i.contact)]);
  for (const double x : {i.begin, i.end, i.approach, i.separation, i.deepest, i.peak_force, i.lost}) {
    row_ += ',';
    append_number(row_, x);
  }
  if (with_impulses(system_)) row_ += ',', append_number(row_, i.impulse);
  if (const auto& theory = system_.contacts[static_cast<std::size_t>(i.contact)].pressure) {
    const Pressure p = pressure_under(*theory, i.peak_force);
    row_ += ',', append_number(row_, p.greatest), row_ += ',', append_number(row_, p.half_angle);
  } else if (with_pressures(system_)) {
    row_ += ",,";
  }
  row_ += '\n';
  events_.append(row_);
  ++impacts_;
}

void RunFiles::add_actions(const std::vector<Happening>& all) {
  for (; did_ < all.size(); ++did_) {
    row_ = csv_field(all[did_].event) + ',';
    append_number(row_, all[did_].t);
    actions_->append(row_ + ',' + csv_field(all[did_].did) + '\n');
  }
}

void RunFiles::add(const Table& trajectory, const Table& ledger, const std::vector<Impact>& impacts,
                   const std::vector<Happening>& happenings) {
  add_rows(trajectory, trajectory_);
  add_rows(ledger, ledger_);
  while (impacts_ < impacts.size() && !std::isnan(impacts[impacts_].end)) add_impact(impacts[impacts_]);
  if (actions_) add_actions(happenings);
  events_.flush_if_due();
  if (actions_) actions_->flush_if_due();
}

void RunFiles::flush() {
  for (FileWriter* file : {&trajectory_, &ledger_, &events_}) file->flush();
  if (actions_) actions_->flush();
}

void RunFiles::finish(const std::vector<Impact>& impacts, const std::vector<Happening>& happenings) {
  std::exception_ptr trouble;
  const auto attempt = [&](auto act) {
    try {
      act();
    } catch (...) {
      if (!trouble) trouble = std::current_exception();
    }
  };
  attempt([&] { trajectory_.close(); });
  attempt([&] { ledger_.close(); });
  attempt([&] {
    while (impacts_ < impacts.size()) add_impact(impacts[impacts_]);
    events_.close();
  });
  if (actions_) attempt([&] { add_actions(happenings), actions_->close(); });
  if (trouble) std::rethrow_exception(trouble);
}

ReservedRoom::ReservedRoom(const fs::path& file, std::size_t bytes) {
  const fs::path beside = unique_neighbour(file);
  open_ = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (open_ < 0) throw FileError(file, errno);
  ::unlink(beside.c_str());
  const int error = ::posix_fallocate(open_, 0, static_cast<off_t>(bytes));
  if (error != ENOSPC && error != EDQUOT && error != EFBIG) return;  // otherwise the file system does not support it, or it succeeded
  release();
  throw FileError(file, error);
}

void ReservedRoom::release() {
  if (open_ >= 0) ::close(open_);
  open_ = -1;
}

}  // namespace pintle
