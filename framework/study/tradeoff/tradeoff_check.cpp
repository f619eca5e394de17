#include "framework/study/tradeoff/tradeoff_check.h"

#include "framework/study/tradeoff/refinement.h"

namespace pintle {

namespace {

/// Largest number of combinations read for a value that the reader rejects without other values.
constexpr int most_tries = 400;

Scene scene_with(const CaseSource& source, const Overrides& set) {
  Overrides all = source.common;
  all.insert(all.end(), set.begin(), set.end());
  return read_scene_text(source.text, source.file.string(), all, source.file.parent_path());
}

/// Why the reader rejects it; empty: it does not.
std::string refusal(const CaseSource& source, const Overrides& set) {
  try {
    scene_with(source, set);
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

Overrides joined(Overrides set, const Overrides& more) {
  set.insert(set.end(), more.begin(), more.end());
  return set;
}

/// Whether the reader accepts this value in a combination: tries first one value of one other axis, then of all.
bool taken_somewhere(const CaseSource& source, const TradePlan& plan, std::size_t axis, std::size_t value) {
  const Overrides& set = plan.axes[axis].values[value].set;
  int tries = 0;
  for (std::size_t other = 0; other < plan.axes.size(); ++other)
    for (const AxisValue& v : plan.axes[other].values)
      if (other != axis && ++tries < most_tries && refusal(source, joined(v.set, set)).empty()) return true;
  std::vector<std::size_t> at(plan.axes.size(), 0);
  at[axis] = value;
  for (bool more = plan.axes.size() > 2; more && ++tries < most_tries;) {
    if (refusal(source, setting(plan, at)).empty()) return true;
    more = false;
    for (std::size_t i = plan.axes.size(); i-- > 0 && !more;) {
      if (i == axis) continue;
      more = ++at[i] < plan.axes[i].values.size();
      if (!more) at[i] = 0;
    }
  }
  return false;
}

/// The reader's message about an override, without the command line that it mentions.
std::string said_of_override(const std::string& why) {
  const std::string mark = "--set ";
  const auto at = why.find(mark);
  return at == std::string::npos ? why : why.substr(at + mark.size());
}

[[noreturn]] void reject(const StudyFile& study, const FidelityAxis& axis, const AxisValue& value, const std::string& why) {
  int line = value.lines.empty() ? 0 : value.lines.front();
  for (std::size_t i = 0; i < value.lines.size(); ++i)
    if (said_of_override(why).starts_with(value.set[i].first)) line = value.lines[i];
  throw SceneError(study.study.file, {line, "tradeoff.axes." + axis.name}, said_of_override(why));
}

}  // namespace

void validate_settings(const StudyFile& study, const TradePlan& plan) {
  const CaseSource& source = study.study.scene;
  for (std::size_t a = 0; a < plan.axes.size(); ++a)
    for (std::size_t v = 0; v < plan.axes[a].values.size(); ++v) {
      const AxisValue& value = plan.axes[a].values[v];
      const std::string why = refusal(source, value.set);
      if (!why.empty() && !taken_somewhere(source, plan, a, v)) reject(study, plan.axes[a], value, why);
    }
  if (const std::string why = refusal(source, plan.reference);
      !why.empty() && !refusal(source, joined(finest(plan, false), plan.reference)).empty()) {
    const Node section = study.root().at("tradeoff");
    (section.has("reference") ? section.at("reference") : section).fail(said_of_override(why));
  }
}

std::vector<std::string> own_columns() {
  return {"setting", "status",      "time",  "least time",       "most time", "timed runs", "build",
          "steps",   "evaluations", "error", "error resolution", "role",      "reason"};
}

void validate_measures(const CaseSource& source, const TradePlan& plan, const std::vector<Measure>& measures) {
  std::vector<std::string> varied, columns = own_columns();
  for (const Measure& m : measures)
    for (const char* const error : {"error of ", "reference's error of ", "model's error of "}) columns.push_back(error + m.name);
  for (const FidelityAxis& axis : plan.axes) {
    for (const Measure& m : measures) require_other_name(axis.name, columns, m.file, m.place);
    columns.push_back(axis.name);
  }
  require_other_names(measures, columns);
  for (const FidelityAxis& axis : plan.axes)
    for (const AxisValue& v : axis.values)
      for (const auto& [path, text] : v.set) varied.push_back(path);
  const Scene scene = common_scene(source);
  validate(measures, scene);
  validate_flexible(measures, scene, varied);
}

}  // namespace pintle
