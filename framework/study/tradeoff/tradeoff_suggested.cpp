#include <algorithm>
#include <charconv>

#include "framework/build/build.h"
#include "framework/scene/error.h"
#include "framework/scene/yaml/include.h"
#include "framework/scene/yaml/instances.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/override.h"
#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

namespace {

const Yaml* entry(const Yaml* map, std::string_view key) {
  if (!map) return nullptr;
  const auto found = std::ranges::find(map->items, key, &Yaml::key);
  return found == map->items.end() ? nullptr : &*found;
}

FidelityAxis listed_axis(const std::string& name, const std::string& path, const std::vector<std::string>& values) {
  FidelityAxis axis{.name = name, .values = {}};
  for (const std::string& v : values) axis.values.push_back({v, {{path, v}}});
  validate_axis(axis);
  return axis;
}

/// The models of a clearance in the scene language.
std::vector<std::string> clearance_models() {
  for (const KeyTable& table : key_tables())
    if (table.path == "joints.*.clearance")
      for (const Key& key : table.keys)
        if (key.name == "model") return key.choices;
  return {};
}

/// `modes` of a body with this number of natural modes instead of its own.
Yaml with_count(const Yaml& modes, int count) {
  Yaml out = modes;
  Yaml* group = &out;
  for (Yaml& item : out.items)
    if (item.key == "craig-bampton" || item.key == "free") group = &item;
  if (group->kind != Yaml::Kind::map) group->kind = Yaml::Kind::map, group->text.clear();
  std::erase_if(group->items,
                [](const Yaml& y) { return y.key == "keep" || y.key == "count" || y.key == "below" || y.key == "effective mass"; });
  group->items.push_back(Yaml{Yaml::Kind::scalar, 0, "count", std::to_string(count), {}});
  return out;
}

/// Removes keys of a body with modes that a rigid one must not have.
Overrides rigid(const Yaml& scene, const std::string& body) {
  const std::string path = "bodies." + body + ".";
  Overrides set{{path + "modes", "null"}};
  const Yaml* const written = entry(entry(&scene, "bodies"), body);
  if (entry(written, "stiffening")) set.emplace_back(path + "stiffening", "null");
  if (entry(entry(written, "beam"), "pieces")) set.emplace_back(path + "beam.pieces", "null");
  const Yaml* const stress = entry(entry(&scene, "output"), "stress");
  if (stress && std::ranges::any_of(stress->items, [&](const Yaml& y) { return y.text.starts_with(body + "."); }))
    set.emplace_back("output.stress", "null");
  return set;
}

/// The number of natural modes kept: the additional static shapes are not part of the axis.
int modes_kept(const Yaml& modes, int shapes) {
  const Yaml* group = &modes;
  for (const Yaml& item : modes.items)
    if (item.key == "craig-bampton" || item.key == "free") group = &item;
  const Yaml* const count = entry(group, "count");
  int n = shapes;
  if (count) std::from_chars(count->text.data(), count->text.data() + count->text.size(), n);
  return std::min(n, shapes);
}

FidelityAxis modes_axis(const Yaml& scene, const std::string& body, int shapes) {
  const Yaml& modes = *entry(entry(entry(&scene, "bodies"), body), "modes");
  const std::string path = "bodies." + body + ".modes";
  FidelityAxis axis{.name = body, .values = {{"rigid", rigid(scene, body)}}};
  for (int n = 1; n < modes_kept(modes, shapes) && n <= 64; n *= 2)
    axis.values.push_back({n == 1 ? "1 mode" : std::to_string(n) + " modes", {{path, override_text(with_count(modes, n))}}});
  axis.values.push_back({"as written, " + std::to_string(shapes) + (shapes == 1 ? " shape" : " shapes"), {{path, override_text(modes)}}});
  validate_axis(axis);
  return axis;
}

}  // namespace

TradePlan suggested_plan(const CaseSource& source) {
  const Scene scene = common_scene(source);
  const Model model = build(scene);
  Yaml tree = parse_yaml(source.text, source.file.string());
  Source files{source.file.string(), {}, source.file.parent_path()};
  include_files(tree, files);
  apply_paths(tree, source.file.string(), has_copies(tree) ? written_and_made(tree, source.common).first : source.common);

  TradePlan plan;
  plan.title = scene.title.empty() ? source.file.stem().string() : scene.title;
  plan.tolerance = scene.run.tolerance;
  plan.budget = 60;
  plan.suggested = true;
  plan.integrates = needs_run(source.question);
  if (plan.integrates) {
    plan.axes.push_back(listed_axis("tolerance", "run.tolerance", {"1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9"}));
    plan.axes.push_back(listed_axis("scheme", "run.method", {"dopri5", "verner87", "generalized-alpha"}));
  }
  const std::vector<std::string> models = clearance_models();
  for (const SceneJoint& joint : scene.joints)
    if (joint.clearance && !is_open(joint) && models.size() > 1)
      plan.axes.push_back(listed_axis(joint.name, "joints." + joint.name + ".clearance.model", models));
  for (const FlexibleReport& r : model.flexible)
    if (entry(entry(entry(&tree, "bodies"), r.body), "modes")) plan.axes.push_back(modes_axis(tree, r.body, static_cast<int>(r.shapes)));
  if (plan.axes.empty())
    throw SceneError(scene.file, {0, "bodies"},
                     "the scene suggests no axis of fidelity; write a study with tradeoff: {axes: {elements: "
                     "{bodies.NAME.beam.elements: [2, 4, 8]}}}");
  return plan;
}

}  // namespace pintle
