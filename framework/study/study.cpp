#include "framework/study/study.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "framework/common/file_names.h"
#include "framework/common/words.h"
#include "framework/scene/text_file.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/override.h"
#include "framework/study/measures/measure_vocabulary.h"
#include "framework/study/measures/measure_words.h"

namespace pintle {

namespace {

Overrides read_set(const Node& node) {
  Overrides out;
  for (const Node& entry : node.entries("overrides of the scene: {run.until: 0.05 s, clearance: 0.1 mm}"))
    out.emplace_back(entry.name(), override_text(entry.yaml()));
  return out;
}

/// The analysis of each case: `analysis`, `at`, `equilibrium`.
Question read_question(const Node& root) {
  Question q;
  const auto words = choices("study", "analysis");
  if (root.has("analysis")) q.analysis = static_cast<Analysis>(std::ranges::find(words, root.at("analysis").one_of(words)) - words.begin());
  const bool linearizes = q.analysis == Analysis::linearize;
  if (root.has("at")) {
    if (!linearizes && q.analysis != Analysis::statics)
      root.at("at").fail(
          "is for analysis: statics and analysis: linearize only; give the instant of a measure in its words: x of BODY at 0.05 s");
    q.at = root.at("at").quantity(dimension::time, rule::not_negative);
  }
  if (root.has("equilibrium")) {
    if (!linearizes)
      root.at("equilibrium").fail("is for analysis: linearize only; leave it out, or write analysis: statics to find the equilibrium");
    q.equilibrium = root.at("equilibrium").yes();
  }
  return q;
}

std::vector<Situation> read_situations(const Node& root, const CaseSource& source) {
  std::vector<Situation> out;
  if (!root.has("situations")) return out;
  const Node section = root.at("situations");
  for (const Node& entry : section.entries("names and what each sets: {idle: {speed: 800 rpm}, full: {speed: 6000 rpm}}")) {
    out.push_back({entry.name(), read_set(entry)});
    try {
      case_scene(source, out.back().set);
    } catch (const SceneError& error) {
      entry.fail(error.what());
    }
  }
  if (out.empty()) section.fail("names no situation; write for example {idle: {speed: 800 rpm}, full: {speed: 6000 rpm}}");
  return out;
}

/// Each measure in each situation: "peak in idle", "peak in full".
std::vector<Measure> in_situations(const std::vector<Measure>& measures, const std::vector<Situation>& situations) {
  if (situations.empty()) return measures;
  std::vector<Measure> out;
  for (const Measure& m : measures)
    for (std::size_t s = 0; s < situations.size(); ++s) {
      Measure& one = out.emplace_back(m);
      one.name += " in " + situations[s].name;
      one.situation = s;
    }
  return out;
}

std::vector<Measure> read_measures(const Node& node, const std::string& file, const Question& question) {
  constexpr const char* remedy = "names and what they are: {peak: peak force at crank pin, lost: energy lost}";
  std::vector<Measure> out;
  const auto add = [&](const Node& entry, const std::string& name) {
    const std::string words = entry.text("words such as peak force at crank pin");
    out.push_back({name.empty() ? words : name, words, entry.place(), file, question, {}});
  };
  each_entry(node, remedy, add);
  if (out.empty()) node.fail(std::string("measures nothing; write ") + remedy);
  return out;
}

/// "peak [N]" becomes "peak": tables add the unit to the name. @throws SceneError  the name has another unit
void without_unit(Measure& m, const std::string& unit) {
  const auto open = m.name.rfind('[');
  if (open == std::string::npos || m.name.back() != ']') return;
  const std::string written = m.name.substr(open + 1, m.name.size() - open - 2);
  const auto end = m.name.find_last_not_of(' ', open > 0 ? open - 1 : 0);
  if (written == unit && open > 0 && end != std::string::npos) m.name.resize(end + 1);
  if (written == unit || written.find_first_not_of(' ') == std::string::npos) return;
  try {
    read_quantity("1 " + written);
  } catch (const ExpressionError&) {
    return;  // no unit
  }
  throw SceneError(m.file, m.place,
                   "is named with the unit " + written + ", but is measured " + (unit.empty() ? "without a unit" : "in " + unit) +
                       "; leave the unit out: the table adds it to the name");
}

void validate_names(std::vector<Measure>& measures, const Scene& scene, const Node& node) {
  for (Measure& m : measures) without_unit(m, measured_unit(m, scene));
  for (std::size_t i = 0; i < measures.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (measures[i].name == measures[k].name) node.fail("measures \"" + measures[i].name + "\" twice; leave one out");
}

/// The first name in a group of a scene, or a default.
std::string first_in(const Node& scene, const char* group, const char* otherwise) {
  if (!scene.has(group) || !scene.at(group).is_map() || scene.at(group).keys().empty()) return otherwise;
  return scene.at(group).keys().front();
}

std::string example_of_sweep(const Node& root) {
  const std::string parameter = first_in(root, "parameters", "run.tolerance");
  const std::string value = parameter == "run.tolerance" ? "1e-6" : override_text(root.at("parameters").at(parameter).yaml());
  return "measure: {peak: peak force at " + first_in(root, "joints", "JOINT") + "}, sweep: {grid: {" + parameter + ": [" + value + ", …]}}";
}

}  // namespace

void require_measures(const StudyFile& file) {
  if (file.study.measures.empty()) file.root().fail("lacks a required key; add for example measure: {peak: peak force at crank pin}");
}

void require_other_name(const std::string& name, const std::vector<std::string>& columns, const std::string& file, const Place& place) {
  if (std::ranges::find(columns, name) != columns.end()) throw SceneError(file, place, "\"" + name + "\" " + taken_name);
}

void require_other_names(const std::vector<Measure>& measures, const std::vector<std::string>& columns) {
  for (const Measure& m : measures) require_other_name(m.name, columns, m.file, m.place);
}

namespace {

/// The statistic, or "time of" or "frequency of", that the words begin with. Empty if there is none.
std::string statistic_at_front(const std::string& text) {
  Words words(text);
  words.skip_articles();
  for (const StatisticWord& s : statistic_words)
    if (words.take(s.words)) return s.words;
  return words.take_any({"time of", "instant of", "frequency of", "dominant frequency of", "main frequency of"});
}

/// What the words ask for by themselves; nothing if they cannot be read.
std::optional<Asked> read_alone(Measure curve, const std::string& words, const Scene& scene) {
  curve.words = words;
  try {
    return read_measure(curve, scene);
  } catch (const SceneError&) {
    return {};
  }
}

/// A curve is a whole time history, so its words have no statistic and no time.
void require_history(const Node& entry, const Measure& curve, const std::string& words, const Scene& scene) {
  const std::string remedy = "; each case keeps the whole history: leave these words out, or ask for the number under measure";
  const auto reject_time = [&](const Asked& asked) {
    if (asked.instant || asked.last > 0 || asked.from > 0 || asked.to < std::numeric_limits<double>::infinity())
      entry.fail("\"" + words + "\" names an instant or a window of time" + remedy);
  };
  if (const auto alone = read_alone(curve, words, scene)) {
    const std::string statistic = statistic_at_front(words);
    if ((alone->statistic != Statistic::none || alone->frequency) && !statistic.empty())
      entry.fail("\"" + words + "\" asks for one number by \"" + statistic + "\"" + remedy);
    reject_time(*alone);
  }
  reject_time(read_measure(curve, scene));
}

}  // namespace

std::vector<Measure> read_curves(const StudyFile& file) {
  std::vector<Measure> out;
  if (!file.root().has("keep")) return out;
  const Node keep = file.root().at("keep");
  const Question& question = file.study.scene.question;
  const Scene scene = common_scene(file.study.scene);
  if (!over_time(question))
    keep.fail("is for analyses over time (run, kinematics and inverse); leave it out: here each case has one state");
  for (const Node& entry : keep.list(1, "a list of quantities such as [x of slider, force at crank pin]")) {
    const std::string words = entry.text("a quantity such as x of slider or force at crank pin");
    if (std::ranges::find(out, words, &Measure::name) != out.end()) entry.fail("\"" + words + "\" is kept twice; leave one out");
    out.push_back({words, "final " + words, entry.place(), file.study.file, question, {}});
    require_history(entry, out.back(), words, scene);
  }
  return out;
}

namespace {

/// The scene with the study's `set`. @throws SceneError  at the entry that is invalid in the scene
Scene scene_as_set(const Node& root, const CaseSource& scene) {
  try {
    return common_scene(scene);
  } catch (const SceneError& error) {
    const std::string said = error.what();
    for (const auto& [name, text] : scene.common)
      if (const std::string mark = ": --set " + name + ": "; said.find(mark) != std::string::npos)
        root.at("set").at(name).fail(said.substr(said.find(mark) + mark.size()));
    throw;
  }
}

/// Keys that other studies have in a section, but studies with `section` and `lyapunov` have beside these.
void refuse_loose_limits(const Node& root) {
  if (root.has("section") || root.has("lyapunov")) return;
  for (const char* limit : {"limit", "most steps"}) {
    if (!root.has(limit)) continue;
    const bool sweeps = root.has("sweep"), only_steps = limit == std::string("most steps");
    for (const char* section : {"fit", "sensitivity"})
      if (only_steps && !sweeps && root.has(section))
        root.at(limit).fail(std::string("belongs under ") + section + " in this study; move it there");
    root.at(limit).fail("belongs under sweep in this study; move it there");
  }
}

}  // namespace

StudyFile read_study(const std::filesystem::path& path, const std::string& instead) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  StudyFile file;
  file.source.file = file.study.file = path.string();
  file.tree = parse_yaml(read_text_file(path, most_bytes), path.string());
  const Node root = file.root();
  if (root.is_nothing()) root.fail("is empty; docs/studies.md shows what to write");
  if (root.is_map() && root.has("bodies") && !root.has("scene"))
    throw SceneError(path.string(), {},
                     "is a scene, not a study. Write a study beside it, for example  {scene: " + path.filename().string() + ", " +
                         (instead.empty() ? example_of_sweep(root) : instead) + "}  (docs/studies.md)");
  check_keys(root, "study");
  refuse_loose_limits(root);
  if (root.has("title")) file.study.title = root.at("title").text("a line of text");
  const Node scene = root.at("scene");
  const std::filesystem::path scene_path = path.parent_path() / scene.text("the scene's file, beside the study");
  // A study may name a scene anywhere, but no other kind of file, since errors show the file's content.
  const std::string kind = ending_of(scene_path);
  if (kind != ".yaml" && kind != ".yml" && kind != ".json") scene.fail(scene.shown() + " is not a scene; name a .yaml, .yml or .json file");
  if (!std::filesystem::exists(scene_path)) scene.fail("there is no file " + scene_path.string() + "; its path is relative to the study");
  file.study.scene = read_case_source(scene_path, root.has("set") ? read_set(root.at("set")) : Overrides{});
  const Question question = file.study.scene.question = read_question(root);
  file.study.scene.situations = read_situations(root, file.study.scene);
  const Scene common = scene_as_set(root, file.study.scene);
  if (!root.has("measure")) {
    if ((root.has("section") || root.has("lyapunov")) && instead.empty())
      root.fail("is a study of nonlinear motion; run pintle nonlinear " + path.string());
    if (!root.has("goal") && instead.empty()) require_measures(file);
    return file;
  }
  file.study.measures = read_measures(root.at("measure"), path.string(), question);
  validate(file.study.measures, common);
  validate_names(file.study.measures, common, root.at("measure"));
  file.study.measures = in_situations(file.study.measures, file.study.scene.situations);
  return file;
}

}  // namespace pintle
