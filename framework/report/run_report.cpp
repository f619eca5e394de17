#include "framework/report/run_report.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/text.h"
#include "framework/report/body_report.h"
#include "framework/report/drawn_model.h"
#include "framework/report/description.h"
#include "framework/report/page.h"
#include "framework/report/table_report.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/scene/yaml/reader.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Results of a moving scene.
std::optional<Description> motion_in(const fs::path& directory) {
  for (const char* const question : {"inverse", "kinematics", "run", "statics"}) {
    auto out = description(directory, question);
    if (!out) continue;
    if (!out->json.contains("scene") || !out->json["scene"].is_object())
      throw ResultsError(out->file.string() +
                         ": contains no scene; a report needs the results of a scene file, so run it again from a file");
    return out;
  }
  return {};
}

Scene scene_of(const Description& results) {
  std::string file = results.json.value("file", std::string());  // meshes and tables are next to it
  if (file.empty()) file = results.file.string();
  Scene scene = read_scene_text(results.json["scene"].dump(), file, {}, fs::path(file).parent_path());
  if (results.question == "statics") scene = ready_for_statics(std::move(scene));
  scene = results.question == "kinematics" ? ready_for_kinematics(std::move(scene)) : with_pieces(std::move(scene));
  scene.output.frames = std::max(scene.output.frames, 2);  // so that shapes for drawing are kept
  return scene;
}

Json sheet_json(const Sheet& sheet) {
  Json columns = Json::array();
  for (std::size_t c = 0; c < sheet.columns.size(); ++c)
    columns.push_back(
        {{"name", sheet.columns[c].name}, {"unit", sheet.columns[c].unit}, {"values", base64(std::span<const double>(sheet.values[c]))}});
  return {{"t", base64(std::span<const double>(sheet.t))}, {"columns", columns}};
}

Json table_json(const ReducedTable& table) {
  Json sheets = Json::array();
  for (const Sheet& sheet : table.sheets) sheets.push_back(sheet_json(sheet));
  return {{"rows", table.rows},
          {"whole", table.whole},
          {"sheets", sheets},
          {"poses", table.poses.t.empty() ? Json() : sheet_json(table.poses)}};
}

Json event_json(const std::vector<std::string>& fields) {
  Json out = Json::array({fields[0]});
  for (std::size_t k = 1; k < fields.size(); ++k) {
    if (fields[k].empty())
      out.push_back(nullptr);
    else
      out.push_back(std::stod(fields[k]));
  }
  return out;
}

double strength(const Json& event, std::size_t column) { return event[column].is_number() ? event[column].get<double>() : 0; }

Json events_json(const fs::path& path, std::size_t most) {
  CsvReader file(path);
  Json columns = Json::array(), rows = Json::array();
  std::size_t force = 0;
  for (std::size_t c = 0; c < file.header().size(); ++c) {
    const ColumnName column = column_name(file.header()[c]);
    columns.push_back({{"name", column.name}, {"unit", column.unit}});
    if (column.name == "impulse" || (force == 0 && column.name == "peak force")) force = c;
  }
  for (std::vector<std::string> fields; file.next(fields);) {
    try {
      rows.push_back(event_json(fields));
    } catch (const std::logic_error&) {
      file.fail("a field that should be a number is not one");
    }
  }
  const std::size_t all = rows.size();
  if (all > most && force > 0) {
    std::stable_sort(rows.begin(), rows.end(), [&](const Json& a, const Json& b) { return strength(a, force) > strength(b, force); });
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(most), rows.end());
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) { return strength(a, 1) < strength(b, 1); });
  return {{"columns", columns}, {"rows", rows}, {"all", all}};
}

/// The first `most` actions of the scene's events.
Json actions_json(const fs::path& path, std::size_t most) {
  CsvReader file(path);
  Json columns = Json::array(), rows = Json::array();
  for (const std::string& heading : file.header()) {
    const ColumnName column = column_name(heading);
    columns.push_back({{"name", column.name}, {"unit", column.unit}});
  }
  if (columns.size() != 3) throw ResultsError(path.string() + ":1: does not have the columns event, t and did. Run the scene again");
  std::size_t all = 0;
  for (std::vector<std::string> fields; file.next(fields); ++all) {
    if (rows.size() == most) continue;
    try {
      rows.push_back({fields[0], std::stod(fields[1]), fields[2]});
    } catch (const std::logic_error&) {
      file.fail("a time that should be a number is not one");
    }
  }
  return {{"columns", columns}, {"rows", rows}, {"all", all}};
}

void require_columns(const fs::path& file, const ReducedTable& table, const std::vector<std::string>& needed) {
  std::vector<std::string> there;
  for (const Sheet& sheet : table.sheets)
    for (const ColumnName& column : sheet.columns) there.push_back(column.name);
  const std::set<std::string> known(there.begin(), there.end());
  for (const std::string& name : needed)
    if (!known.contains(name))
      throw ResultsError(file.string() + ":1: has no column " + quoted(name) +
                         ", which its scene requires; the file belongs to other results." + " Run the scene again");
}

}  // namespace

ReportLimits report_limits(double bytes) {
  ReportLimits out;
  const double share = bytes / 5e6;
  for (std::size_t* limit : {&out.trajectory.values, &out.trajectory.poses, &out.ledger, &out.events, &out.meshes, &out.text, &out.rows})
    *limit = static_cast<std::size_t>(share * static_cast<double>(*limit));
  return out;
}

namespace {

std::string title_of(const Scene& scene, const fs::path& directory) {
  return scene.title.empty() ? directory.filename().string() : scene.title;
}

/// At least 1.
double bytes_of(const fs::path& file) {
  std::error_code unknown;
  const auto bytes = fs::file_size(file, unknown);
  return unknown || bytes == 0 ? 1 : static_cast<double>(bytes);
}

std::string motion_page(const Description& results, const fs::path& directory, const ReportLimits& limits) {
  const Scene scene = scene_of(results);
  const Model model = build(scene);
  const bool moves = results.question != "statics";
  const fs::path file = directory / (moves ? "trajectory.csv" : "statics.csv");
  const fs::path ledger = directory / "ledger.csv";
  const bool balanced = results.question == "run" || fs::exists(ledger);
  const double trajectory_work = balanced ? 1 / (1 + bytes_of(ledger) / bytes_of(file)) : 1;
  const ReducedTable trajectory =
      moves ? reduced_by_column(file, limits.trajectory, drawn_columns(model), {0, trajectory_work}) : single_row(file);
  require_columns(file, trajectory, pose_columns(model));
  const std::string title = title_of(scene, directory);
  Json run = facts(results, limits.text);
  if (is_unfinished(directory) && !trajectory.sheets.empty() && !trajectory.sheets[0].t.empty())
    run["reached [s]"] = trajectory.sheets[0].t.back();
  Json out{
      {"title", title}, {"run", run}, {"model", drawn_model_json(scene, model, limits.meshes)}, {"trajectory", table_json(trajectory)}};
  if (!moves) out["tables"] = tables_json(results, limits.rows);
  if (balanced) {
    out["ledger"] = table_json(reduced_by_row(ledger, limits.ledger, {trajectory_work, 1}));
    out["events"] = events_json(directory / "events.csv", limits.events);
  }
  if (fs::exists(directory / "actions.csv")) out["actions"] = actions_json(directory / "actions.csv", limits.events);
  return page(title, json_text(out, -1));
}

/// The mechanism in each mode of a linearization, one after another.
std::string mode_page(const Description& results, const fs::path& directory, const ReportLimits& limits) {
  const Scene scene = scene_of(results);
  const Model model = build(scene);
  const fs::path file = directory / "mode_motions.csv";
  const ReducedTable motions = mode_motions(file);
  require_columns(file, motions, pose_columns(model));
  const std::string title = title_of(scene, directory);
  return page(title, json_text(Json{{"title", title},
                                    {"run", facts(results, limits.text)},
                                    {"model", drawn_model_json(scene, model, limits.meshes)},
                                    {"trajectory", table_json(motions)},
                                    {"modes", results.json.value("modes", Json::array())},
                                    {"tables", tables_json(results, limits.rows)}},
                               -1));
}

}  // namespace

std::string report_page(const fs::path& directory, const ReportLimits& limits) {
  if (const auto results = motion_in(directory)) return motion_page(*results, directory, limits);
  if (const auto results = description(directory, "linearized"); results && fs::exists(directory / "mode_motions.csv"))
    return mode_page(*results, directory, limits);
  if (const auto out = body_page(directory, limits)) return *out;
  if (const auto out = table_page(directory, limits.rows, limits.text)) return *out;
  throw ResultsError(directory.string() + ": contains no results" +
                     (fs::is_directory(directory) ? "" : ", because there is no such folder") +
                     "; name a folder written by `pintle run`, statics, kinematics, inverse, linearize, modes, sweep, fit, sensitivity, "
                     "nonlinear or tradeoff" +
                     (fs::exists(directory / "trajectory.csv") ? ". It has a trajectory.csv: pintle plot shows its columns" : ""));
}

}  // namespace pintle
