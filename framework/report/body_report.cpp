#include "framework/report/body_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <nlohmann/json.hpp>

#include "framework/bodies/elastic_body.h"
#include "framework/drawing/body_drawing.h"
#include "framework/report/description.h"
#include "framework/report/drawn_model.h"
#include "framework/report/page.h"
#include "framework/report/table_report.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int phases = 24;

/// A mechanism of this body alone, at rest in the origin.
Json model_of(const Json& drawing) {
  Json out{{"length", drawing["size"]},
           {"pin", 0},
           {"exaggeration", 1},
           {"deformation", 1},
           {"palette", palette_json()},
           {"bodies", Json::array({{{"name", drawing["name"]},
                                    {"origin", {0, 0}},
                                    {"outline", Json::array()},
                                    {"profiles", Json::array()},
                                    {"modes", drawing["largest"].size()},
                                    {"mesh", drawing["mesh"]}}})}};
  for (const char* const none :
       {"ground", "markers", "joints", "contacts", "forces", "actuators", "points", "outputs", "wheels", "spans", "pitch lines"})
    out[none] = Json::array();
  return out;
}

Json table_of(const std::string& name, const std::vector<double>& t, const std::vector<std::vector<double>>& eta) {
  Json columns = Json::array();
  const auto add = [&](const std::string& column, const std::vector<double>& values) {
    columns.push_back({{"name", name + column}, {"unit", ""}, {"values", base64(std::span<const double>(values))}});
  };
  for (const char* const column : {".x", ".y", ".angle"}) add(column, std::vector<double>(t.size()));
  for (std::size_t k = 0; k < eta.size(); ++k) add(".mode " + std::to_string(k + 1), eta[k]);
  const Json sheet{{"t", base64(std::span<const double>(t))}, {"columns", columns}};
  return {{"rows", t.size()}, {"whole", true}, {"sheets", {sheet}}, {"poses", nullptr}};
}

/// The enlargement at which the first shape displaces the body by a twentieth of its size, as a round number.
double visible(const Json& drawing) {
  const double wanted = 0.05 * drawing["size"].get<double>() / drawing["largest"][0].get<double>();
  return std::isfinite(wanted) ? std::pow(10, std::max(0.0, std::floor(std::log10(wanted)))) : 1;
}

/// Each shape through a period, one after another; its largest displacement is a tenth of the body's size.
Json periods_of(const Json& drawing) {
  const std::size_t modes = drawing["largest"].size(), rows = phases + 1;
  std::vector<double> t;
  std::vector<std::vector<double>> eta(modes, std::vector<double>(modes * rows));
  for (std::size_t k = 0; k < modes; ++k) {
    const double amplitude = 0.1 * drawing["size"].get<double>() / drawing["largest"][k].get<double>();
    for (std::size_t i = 0; i < rows; ++i) {
      const double part = static_cast<double>(i) / phases;
      eta[k][t.size()] = amplitude * std::cos(2 * std::numbers::pi * part);
      t.push_back(2 * static_cast<double>(k) + part);
    }
  }
  return table_of(drawing["name"], t, eta);
}

}  // namespace

std::string body_drawing(const ElasticBody& body, const Eigen::MatrixXd& shapes, const StressField* stress) {
  const BodyDrawing drawing(body);
  Eigen::MatrixXd displacements(drawing.points.size(), shapes.cols()), stresses;
  Json largest = Json::array();
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    const Eigen::Matrix2Xd u = drawing.displacement(shapes.col(k));
    displacements.col(k) = u.reshaped();
    largest.push_back(u.colwise().norm().maxCoeff());
  }
  if (stress) stresses = drawing.stress(*stress).reshaped();
  const ShapedMesh mesh{drawing.points, drawing.cells, drawing.size, displacements, stress ? &stresses : nullptr};
  const Json out{
      {"name", body.scene->name}, {"size", drawing.size}, {"largest", largest}, {"mesh", mesh_json(mesh, ReportLimits().meshes)}};
  return json_text(out, -1);
}

std::optional<std::string> body_page(const fs::path& directory, const ReportLimits& limits) {
  const auto drawing = description(directory, "drawing");
  const auto modes = description(directory, "modes"), loaded = description(directory, "static");
  if (!drawing || (!modes && !loaded)) return {};
  const Description& results = modes ? *modes : *loaded;
  std::string title = results.json.value("title", std::string());
  if (title.empty()) title = drawing->json.value("name", std::string());
  Json out{{"title", title}, {"run", facts(results, limits.text)}, {"model", model_of(drawing->json)}};
  for (const char* const basis : {"natural", "reduced"})  // the tables have them
    if (out["run"].contains(basis)) out["run"][basis].erase("modes");
  if (modes)
    out["modes"] = modes->json["natural"]["modes"], out["trajectory"] = periods_of(drawing->json);
  else
    out["trajectory"] = table_of(drawing->json["name"], {0}, {{1}}), out["model"]["deformation"] = visible(drawing->json);
  out["tables"] = tables_json(results, limits.rows);
  return page(title, json_text(out, -1));
}

}  // namespace pintle
