#include <algorithm>
#include <array>
#include <map>

#include "framework/common/nearest.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/override.h"
#include "framework/study/tradeoff/refinement.h"
#include "framework/study/tradeoff/tradeoff.h"
#include "framework/study/tradeoff/tradeoff_check.h"
#include "framework/study/tradeoff/share_and_duration.h"

namespace pintle {

namespace {

const Yaml& entry(const Yaml& map, std::string_view key) { return *std::ranges::find(map.items, key, &Yaml::key); }

/// Default label of a value.
std::string label_of(const Yaml& value) { return value.kind == Yaml::Kind::scalar ? value.text : override_text(value); }

/// {run.tolerance: [1e-4, 1e-6]}; several names vary together.
std::vector<AxisValue> listed_values(const Node& node, const Yaml& axis) {
  std::vector<AxisValue> out(axis.items.front().items.size());
  for (const Yaml& name : axis.items) {
    if (name.items.size() != out.size())
      node.at(name.key).fail("has " + std::to_string(name.items.size()) + " values, " + axis.items.front().key + " has " +
                             std::to_string(out.size()) + "; the lists of one axis are combined one by one, so give equally many values");
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].label += (out[i].label.empty() ? "" : ", ") + label_of(name.items[i]);
      out[i].set.emplace_back(name.key, override_text(name.items[i]));
      out[i].lines.push_back(name.items[i].line > 0 ? name.items[i].line : name.line);
    }
  }
  return out;
}

/// {rigid: {bodies.coupler.modes: null}, 2 modes: {…}}
std::vector<AxisValue> named_values(const Node& node, const Yaml& axis) {
  std::vector<AxisValue> out;
  for (const Yaml& value : axis.items) {
    if (value.kind != Yaml::Kind::map && value.kind != Yaml::Kind::nothing)
      node.at(value.key).fail(
          "must give what this setting sets: {run.tolerance: 1e-6}; or give every name of the axis a list: {run.tolerance: [1e-4, 1e-6]}");
    AxisValue v{value.key, {}};
    for (const Yaml& set : value.items) v.set.emplace_back(set.key, override_text(set)), v.lines.push_back(set.line);
    out.push_back(std::move(v));
  }
  return out;
}

FidelityAxis read_axis(const Node& node, const Yaml& axis) {
  const char* remedy = "{run.tolerance: [1e-4, 1e-6]} or named settings {rigid: {bodies.coupler.modes: null}, …}";
  node.entries(remedy);
  if (axis.items.empty()) node.fail(std::string("is empty; write ") + remedy);
  for (const Yaml& name : axis.items)
    if (name.kind == Yaml::Kind::list && name.items.empty()) node.at(name.key).fail("is an empty list; give it values: [1e-4, 1e-6]");
  const bool lists = std::ranges::all_of(axis.items, [](const Yaml& y) { return y.kind == Yaml::Kind::list && !y.items.empty(); });
  FidelityAxis out{.name = node.name(), .values = lists ? listed_values(node, axis) : named_values(node, axis)};
  for (std::size_t i = 0; i < out.values.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (out.values[i].label == out.values[k].label) node.fail("has two settings called \"" + out.values[i].label + "\"; leave one out");
  validate_axis(out);
  return out;
}

template <class Read>
double wanted(const Node& node, const char* remedy, Read read) {
  try {
    return read(node.text(remedy));
  } catch (const ExpressionError& e) {
    node.fail(node.shown() + ": " + e.what());
  }
}

}  // namespace

TradePlan read_tradeoff(const StudyFile& study) {
  const Node root = study.root();
  if (!root.has("tradeoff") && root.has("sweep"))
    root.fail(
        "has a sweep and no tradeoff; run it with pintle sweep, or add what tradeoff should vary: tradeoff: {error: 1%, axes: {tolerance: "
        "{run.tolerance: [1e-4, 1e-6, 1e-8]}}}");
  if (!root.has("tradeoff"))
    root.fail("has no section tradeoff; add for example tradeoff: {error: 1%, axes: {tolerance: {run.tolerance: [1e-4, 1e-6, 1e-8]}}}");
  const Node node = root.at("tradeoff");
  const Yaml& tree = entry(study.tree, "tradeoff");
  check_keys(node, "study.tradeoff");
  TradePlan plan;
  plan.title = study.study.title;
  if (node.has("error")) plan.error = wanted(node.at("error"), "a share such as 1%", read_share);
  if (node.has("time")) plan.time = wanted(node.at("time"), "a time such as 0.5 s", read_duration);
  if (node.has("budget")) plan.budget = wanted(node.at("budget"), "a time such as 10 min", read_duration);
  if (node.has("repeats")) plan.repeats = static_cast<int>(std::min(node.at("repeats").count(1), 1000L));
  if (node.has("ensemble")) plan.ensemble = static_cast<int>(std::min(node.at("ensemble").count(4), 100000L));
  double all = 1;
  for (const Node& axis : node.at("axes").entries("axes and their settings: {tolerance: {run.tolerance: [1e-4, 1e-6]}}")) {
    require_other_name(axis.name(), own_columns(), study.study.file, axis.place());
    plan.axes.push_back(read_axis(axis, entry(entry(tree, "axes"), axis.name())));
    all *= static_cast<double>(plan.axes.back().values.size());
  }
  if (plan.axes.empty()) node.at("axes").fail("names no axis; write for example {tolerance: {run.tolerance: [1e-4, 1e-6]}}");
  if (all > 20000)
    node.at("axes").fail("make " + std::to_string(static_cast<long>(all)) + " combinations; more than 20000 are not allowed");
  if (node.has("reference"))
    for (const Node& set : node.at("reference").entries("what the reference sets: {run.tolerance: 1e-12}"))
      plan.reference.emplace_back(set.name(), override_text(entry(entry(tree, "reference"), set.name())));
  plan.tolerance = common_scene(study.study.scene).run.tolerance;
  plan.integrates = needs_run(study.study.scene.question);
  validate_settings(study, plan);
  validate_measures(study.study.scene, plan, study.study.measures);
  return plan;
}

}  // namespace pintle
