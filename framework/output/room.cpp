#include "framework/output/room.h"

#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

#include "framework/mechanism/result_tables.h"
#include "framework/output/results_directory.h"

namespace pintle {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Three digits; the space needed is rounded up, the available space down.
std::string size_text(double bytes, double (*round)(double)) {
  static constexpr const char* units[] = {" bytes", " kB", " MB", " GB", " TB"};
  std::size_t unit = 0;
  for (; bytes >= 1000 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
  const double digit = unit == 0 || bytes >= 100 ? 1 : bytes >= 10 ? 0.1 : 0.01;
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(digit == 1 ? 0 : digit == 0.1 ? 1 : 2) << round(bytes / digit) * digit << units[unit];
  return out.str();
}
std::string needs(double bytes) { return size_text(bytes, std::ceil); }
std::string has(double bytes) { return size_text(bytes, std::floor); }

double times(double from, double until, double interval) { return interval > 0 ? std::ceil((until - from) / interval - 1e-9) + 1 : 0; }

}  // namespace

RoomNeeded room_needed(const Scene& scene, const Model& model, double from) {
  constexpr double least_number = 2, number = 17;  // bytes of text
  constexpr double least_frame = 1000, frame = 11000, point = 72;
  const double until = scene.run.until;
  const double rows = times(from, until, scene.output.every > 0 ? scene.output.every : until / 1000);
  const double wide = rows * static_cast<double>(trajectory_table(model).columns()),
               narrow = rows * static_cast<double>(ledger_table(model.system).columns());
  const double frames = scene.output.frames > 1 ? std::ceil(scene.output.frames * (until - from) / until) : 0;
  const double states = times(from, until, scene.output.states) * 8 * model.system.n_y();
  double points = 0;
  for (std::size_t k = 0, b = 0; k < model.drawings.size() && b < model.system.bodies.size(); ++b) {
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(model.system.bodies[b].modes());
    if (still.size() > 0) points += static_cast<double>(model.drawings[k++].at({{0, 0}, {0, 0}, 0, 0, still, still}, 1).points.cols());
  }
  RoomNeeded out;
  out.least = least_number * (wide + narrow) + least_frame * frames;
  out.likely = number * (wide + narrow) + (frame + point * points) * frames + states;
  out.file_least = least_number * std::max(wide, narrow);
  out.file_likely = number * std::max(wide, narrow);
  return out;
}

Room room_at(const std::filesystem::path& directory) {
  Room out{infinite, infinite};
  struct statvfs disk;
  if (::statvfs(nearest_that_exists(directory).c_str(), &disk) == 0 && disk.f_blocks > 0)
    out.on_disk = static_cast<double>(::geteuid() == 0 ? disk.f_bfree : disk.f_bavail) * static_cast<double>(disk.f_frsize);
  struct rlimit limit;
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) out.in_a_file = static_cast<double>(limit.rlim_cur);
  return out;
}

std::vector<std::string> validate_room(const std::filesystem::path& directory, const RoomNeeded& needed, const Room& room) {
  const std::string at = directory.string() + ": ", remedy = "write fewer rows (output.every) or frames";
  if (needed.least > room.on_disk)
    throw std::runtime_error(at + "the results need at least " + needs(needed.least) + ", and the disk has " + has(room.on_disk) +
                             " left; make room, name another place with --out, or " + remedy);
  if (needed.file_least > room.in_a_file)
    throw std::runtime_error(at + "trajectory.csv needs at least " + needs(needed.file_least) + ", and the limit for one file is " +
                             has(room.in_a_file) + "; raise the limit (ulimit -f), or " + remedy);
  std::vector<std::string> out;
  if (needed.likely > room.on_disk)
    out.push_back("the results may need " + needs(needed.likely) + ", and the disk of " + directory.string() + " has " + has(room.on_disk) +
                  " left; make room, name another place with --out, or " + remedy);
  if (needed.file_likely > room.in_a_file)
    out.push_back("trajectory.csv may need " + needs(needed.file_likely) + ", and the limit for one file is " + has(room.in_a_file) +
                  "; raise the limit (ulimit -f), or " + remedy);
  return out;
}

}  // namespace pintle
