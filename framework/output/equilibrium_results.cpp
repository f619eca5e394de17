#include <nlohmann/json.hpp>

#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/configuration/equilibrium.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

/// Rates and accelerations are zero and omitted.
bool is_rate(const std::string& column) {
  for (const char* unit : {"[m/s]", "[rad/s]", "[m/s^2]", "[rad/s^2]"})
    if (column.ends_with(unit)) return true;
  return false;
}

Json stability_json(const Stability& s) {
  if (!s.judged) return nullptr;
  return {{"freedoms", s.dofs},
          {"unstable directions", s.unstable},
          {"neutral directions", s.neutral},
          {"may flutter", s.circulatory},
          {"bodies that move most in them", s.moving}};
}

}  // namespace

std::string equilibrium_json(const Scene& scene, const Model&, const Equilibrium& e) {
  Json values = Json::object();
  for (std::size_t c = 0; c < e.table.data.size(); ++c)
    if (!is_rate(e.table.header[c])) values[e.table.header[c]] = e.table.data[c];
  const Json out = {{"program", "pintle"},
                    {"version", PINTLE_VERSION},
                    {"title", scene.title},
                    {"file", scene.file},
                    {"found", e.found},
                    {"reason", e.reason},
                    {"warnings", e.warnings},
                    {"at [s]", e.state.t},
                    {"method", e.method},
                    {"iterations", e.iterations},
                    {"residual over greatest force", e.residual},
                    {"stability", stability_json(e.stability)},
                    {"values", values}};
  return text_with_scene(out, scene);
}

void write_equilibrium(const std::filesystem::path& directory, const Scene& scene, const Model& model, const Equilibrium& e) {
  std::string csv = "quantity,value\n";
  for (std::size_t c = 0; c < e.table.data.size(); ++c) {
    if (is_rate(e.table.header[c])) continue;
    csv += csv_field(e.table.header[c]) + ",";
    append_number(csv, e.table.data[c]);
    csv += '\n';
  }
  write_text(directory / "statics.csv", csv);
  write_text(directory / "statics.json", equilibrium_json(scene, model, e));
}

}  // namespace pintle
