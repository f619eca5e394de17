#include "app/options.h"

#include <algorithm>
#include <ostream>
#include <thread>

#include "files/trust.h"
#include "framework/common/text.h"
#include "framework/output/results_directory.h"
#include "framework/scene/units/expression.h"
#include "meshes/limits.h"

namespace pintle::app {

namespace fs = std::filesystem;

Overrides overrides(const Options& options) {
  Overrides out;
  for (const std::string& s : options.set) {
    const auto equals = s.find('=');
    if (equals == std::string::npos || equals == 0)
      throw SceneError("--set " + s + ": write it as NAME=VALUE, for example --set clearance=0.1mm");
    out.emplace_back(s.substr(0, equals), s.substr(equals + 1));
  }
  return out;
}

void set_bounds(const Options& options) {
  Trust trust;
  trust.geo = options.trust_geo;
  for (const std::string& folder : options.allowed) {
    if (!fs::is_directory(folder)) throw SceneError("--allow-path " + folder + ": there is no such folder; name an existing one");
    trust.folders.emplace_back(folder);
  }
  set_trust(std::move(trust));
  MesherLimits limits;
  if (options.mesh_memory > 0) limits.bytes = static_cast<std::size_t>(options.mesh_memory * (1 << 30));
  try {
    if (!options.mesh_time.empty()) limits.seconds = read_quantity(options.mesh_time, dimension::time);
    if (!(limits.seconds > 0)) throw ExpressionError("write a time above 0");
  } catch (const ExpressionError& e) {
    throw SceneError("--mesh-time " + options.mesh_time + ": " + e.what());
  }
  set_mesher_limits(limits);
}

double instant(const Options& options) {
  try {
    const double t = read_quantity(options.at, dimension::time);
    if (t < 0) throw ExpressionError("a run begins at t = 0");
    return t;
  } catch (const ExpressionError& e) {
    throw SceneError("--at " + options.at + ": " + e.what());
  }
}

std::string number(double x, int digits) { return number_text(x, digits); }

void print_rows(std::ostream& out, const Rows& rows) {
  const auto characters = [](const std::string& utf8) {
    return static_cast<std::size_t>(std::ranges::count_if(utf8, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
  };
  std::size_t width = 0;
  for (const auto& row : rows) width = std::max(width, characters(row.first));
  for (const auto& [left, right] : rows) out << "  " << left << std::string(width + 2 - characters(left), ' ') << right << "\n";
}

fs::path study_directory(const Options& options, const std::string& suffix) {
  if (!options.out.empty()) return without_slash(options.out);
  fs::path name = fs::path(options.scene).stem();
  if (name.extension() == ".pintle" && name != ".pintle") name = name.stem();  // the scene of crank.pintle.yaml is named crank
  return fs::path("runs") / (name.string() + suffix);
}

int thread_count(const Options& options) {
  return options.threads > 0 ? options.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

fs::path results_directory(const Options& options, const std::string& suffix) {
  fs::path base = study_directory(options, suffix);
  if (!options.out.empty()) return base;
  fs::path path = base;
  for (int k = 2; fs::exists(path); ++k) path = base.string() + "-" + std::to_string(k);
  return path;
}

}  // namespace pintle::app
