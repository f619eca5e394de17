// Results of kinematics and inverse dynamics.
#include <cmath>

#include <nlohmann/json.hpp>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/common/file.h"
#include "framework/common/file_names.h"
#include "framework/common/text.h"
#include "framework/output/results.h"
#include "framework/output/run_head.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json head(const Scene& scene, const Model& model, const Run& run) {
  Json out = run_head(scene, run);
  out.update(Json{
      {"model", {{"bodies", model.system.bodies.size()}, {"coordinates", model.system.n()}, {"constraint rows", model.system.n_rows()}}},
      {"worst scaled violation", {{"position", run.worst_position}, {"velocity", run.worst_velocity}}},
      {"counts", {{"steps", run.counts.steps}, {"rejected", run.counts.rejected}}},
      {"timings [s]", {{"computing", run.seconds}}}});
  return out;
}

std::string effort_csv(const DriverEffort& e) {
  std::string out = std::string("t [s],") + (e.turns ? "torque [N m]" : "thrust [N]") + "\n";
  for (std::size_t k = 0; k < e.t.size(); ++k) {
    append_number(out, e.t[k]);
    out += ',';
    append_number(out, e.value[k]);
    out += '\n';
  }
  return out;
}

}  // namespace

std::string kinematics_json(const Scene& scene, const Model& model, const Run& run) {
  return text_with_scene(head(scene, model, run), scene);
}

void write_kinematics(const fs::path& directory, const Scene& scene, const Model& model, const Run& run) {
  write_csv(directory / "trajectory.csv", run.trajectory);
  write_text(directory / "kinematics.json", kinematics_json(scene, model, run));
}

std::string effort_file(const Inverse& inverse, std::size_t driver) {
  FileNames names({"trajectory", "ledger", "events"});
  for (std::size_t d = 0; d < driver; ++d) names.add(inverse.drivers[d].name, "driver");
  return names.add(inverse.drivers[driver].name, "driver") + ".csv";
}

std::string inverse_json(const Scene& scene, const Model& model, const Inverse& inverse) {
  Json out = head(scene, model, inverse.run);
  out["how"] = inverse.how;
  Json drivers = Json::object();
  for (std::size_t d = 0; d < inverse.drivers.size(); ++d) {
    const DriverEffort& e = inverse.drivers[d];
    double most = 0, least = 0, sum = 0;
    for (std::size_t k = 0; k < e.t.size(); ++k) {
      if (k == 0) most = least = e.value[0];
      most = std::max(most, e.value[k]), least = std::min(least, e.value[k]);
      if (k > 0) sum += (e.t[k] - e.t[k - 1]) * (e.value[k] * e.value[k] + e.value[k - 1] * e.value[k - 1]) / 2;
    }
    const double span = e.t.size() > 1 ? e.t.back() - e.t.front() : 0;
    const std::string unit = e.turns ? " [N m]" : " [N]";
    drivers[e.name] = {{"file", effort_file(inverse, d)},
                       {"rows", e.t.size()},
                       {"greatest" + unit, most},
                       {"least" + unit, least},
                       {"root of mean square" + unit, span > 0 ? std::sqrt(sum / span) : 0},
                       {"error of a spline through every second row" + unit, std::isnan(e.error) ? Json(nullptr) : Json(e.error)}};
  }
  out["drivers"] = drivers;
  return text_with_scene(out, scene);
}

void write_inverse(const fs::path& directory, const Scene& scene, const Model& model, const Assembly& assembly, const Inverse& inverse) {
  if (inverse.by_algebra)
    write_csv(directory / "trajectory.csv", inverse.run.trajectory);
  else
    write_results(directory, scene, model, assembly, inverse.run);
  write_efforts(directory, scene, model, inverse);
}

void write_efforts(const fs::path& directory, const Scene& scene, const Model& model, const Inverse& inverse) {
  for (std::size_t d = 0; d < inverse.drivers.size(); ++d) write_text(directory / effort_file(inverse, d), effort_csv(inverse.drivers[d]));
  write_text(directory / "inverse.json", inverse_json(scene, model, inverse));
}

}  // namespace pintle
