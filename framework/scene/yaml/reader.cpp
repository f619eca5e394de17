#include "framework/scene/yaml/reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/common/nearest.h"
#include "framework/scene/text_file.h"
#include "framework/scene/yaml/include.h"
#include "framework/scene/yaml/instances.h"
#include "framework/scene/yaml/override.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

constexpr std::size_t most_bytes = std::size_t{100} << 20;

// An override is written like a parameter's value; a bare number gets the dimension of the parameter's own unit, in SI.
Quantity overridden(const std::string& name, const std::string& text, const Quantity& written, const Source& source) {
  const Place place{0, "--set " + name};
  try {
    const Quantity q = read_quantity(text, source.parameters);
    if (bare(q.dimension)) return {q.value, written.dimension};
    if (!bare(written.dimension) && !same(q.dimension, written.dimension))
      throw ExpressionError("\"" + text + "\" is " + describe(q.dimension) + ", but the scene gives " + name + " as " +
                            describe(written.dimension));
    return q;
  } catch (const ExpressionError& error) {
    throw SceneError(source.file, place, error.what());
  }
}

// Names set by events of the scene and its assemblies, except those that an assembly defines itself.
void set_by_events(const Yaml& level, std::set<std::string>& names) {
  const auto item = [](const Yaml& of, std::string_view key) {
    const auto found = std::ranges::find(of.items, key, &Yaml::key);
    return found == of.items.end() ? nullptr : &*found;
  };
  if (const Yaml* events = item(level, "events"))
    for (const Yaml& event : events->items)
      for (const Yaml& doing : event.items)
        if (const Yaml* set = doing.kind == Yaml::Kind::map ? item(doing, "set") : nullptr)
          for (const Yaml& one : set->items) names.insert(one.key);
  if (const Yaml* assemblies = item(level, "assemblies"))
    for (const Yaml& assembly : assemblies->items) {
      std::set<std::string> inner;
      set_by_events(assembly, inner);
      for (const char* own : {"parameters", "states"})
        if (const Yaml* group = item(assembly, own))
          for (const Yaml& one : group->items) inner.erase(one.key);
      names.merge(inner);
    }
}

void read_parameters(const Node& root, const Overrides& overrides, Source& source, Scene& scene) {
  std::map<std::string, std::string> set;
  for (const auto& [name, text] : overrides) set[name] = text;
  std::vector<std::string> all;
  std::set<std::string> varying;
  set_by_events(root.yaml(), varying);
  if (root.has("parameters")) {
    const Node group = root.at("parameters");
    const std::vector<Node> entries = group.entries("names and values: {clearance: 0.1 mm}");
    all = group.keys();
    for (const Node& node : entries) {
      const std::string name = node.name();
      Quantity q = read_parameter(node, all);
      if (const auto found = set.find(name); found != set.end()) q = overridden(name, found->second, q, source);
      q.varies = varying.contains(name);
      source.parameters[name] = q;
      scene.parameters.push_back({name, q.value, si_unit(q.dimension), q.varies});
    }
  }
  for (const auto& [name, text] : set)
    if (!source.parameters.contains(name))
      throw SceneError(source.file, {0, "--set " + name},
                       all.empty() ? "the scene has no parameters; name one under parameters, or any key by its path: run.until"
                                   : "the scene has no such parameter." + did_you_mean(name, all));
}

// A parameter set by events is a state with rate 0 where a value may follow it; elsewhere it has no value.
void make_parameters_states(Scene& scene) {
  for (const SceneParameter& p : scene.parameters) {
    if (!p.varies) continue;
    scene.states.push_back({.name = p.name,
                            .rate = {[](double) {
                                       return Jet{0, 0, 0};
                                     },
                                     "0", true},
                            .start = p.value,
                            .scale = p.value == 0 ? 1 : std::abs(p.value),
                            .unit = p.unit,
                            .place = {0, "parameters." + p.name}});
  }
}

void require_text(const std::string& file, const Overrides& overrides) {
  for (const auto& [name, text] : overrides)
    if (line_not_text(name + text) > 0)
      throw SceneError(file, {0, "--set"},
                       "the override of \"" + (line_not_text(name) > 0 ? "?" : name) +
                           "\" is not text (a zero byte, or bytes that are not UTF-8); "
                           "set the terminal to UTF-8, or put the value into the scene");
}

Scene read(const std::string& text, const std::string& file, const Overrides& overrides, const std::filesystem::path& folder) {
  require_text(file, overrides);
  Yaml tree = parse_yaml(text, file);
  Source source{file, {}, folder};
  const Node root(tree, source, {tree.line, {}});
  if (tree.kind == Yaml::Kind::nothing) root.fail("is empty; docs/scene.md shows what to write");
  if (root.is_map() && root.has("scene") && !root.has("bodies"))
    throw SceneError(file, {},
                     "is a study, not a scene: its key scene names one. Commands of studies read it: sweep, fit, sensitivity, tradeoff and "
                     "nonlinear (docs/studies.md)");
  include_files(tree, source);
  const bool copies = tree.kind == Yaml::Kind::map && has_copies(tree);
  const auto [now, later] = copies ? written_and_made(tree, overrides) : std::pair{overrides, Overrides{}};
  const Overrides parameters = tree.kind == Yaml::Kind::map ? apply_paths(tree, file, now) : now;
  check_keys(root, "");

  Scene scene;
  scene.file = file;
  source.doubts = &scene.warnings;
  read_parameters(root, parameters, source, scene);
  if (has_copies(tree)) expand(tree, source);  // an override may have brought them
  apply_paths(tree, file, later);
  if (!root.has("bodies"))
    root.fail("lacks a required key; add for example bodies: {crank: {rigid: {mass: 0.3 kg, inertia: 1e-4 kg m^2}}}");
  if (root.has("title")) scene.title = root.at("title").text("a line of text");
  if (root.has("gravity")) scene.gravity = root.at("gravity").pair(dimension::acceleration);
  read_run(root, scene);
  read_materials(root, scene);
  read_bodies(root, scene);
  read_joints(root, scene);
  read_contacts(root, scene);
  read_drivers(root, folder, scene);
  make_parameters_states(scene);
  read_states(root, scene);
  read_forces(root, scene);
  read_state_rates(root, scene);
  read_force_laws(root, folder, scene);
  read_outputs(root, scene);
  read_events(root, scene);
  read_start(root, scene);
  read_static(root, scene);
  read_output(root, scene);
  for (const SceneBody& b : scene.bodies)
    if (b.elastic && b.elastic->modes) check_boundary(b, scene);
  for (SceneBody& b : scene.bodies)
    if (b.elastic && b.elastic->modes && b.elastic->modes->keep.automatic && !root.at("bodies").at(b.name).at("modes").has("frame"))
      choose_frame(b, scene);
  scene.filled_in = filled_in(scene);
  return scene;
}

}  // namespace

Quantity read_parameter(const Node& node, const std::vector<std::string>& all) {
  if (const std::string fault = fault_of_name(node.name()); !fault.empty())
    node.fail("\"" + node.name() + "\" cannot name a parameter: " + fault);
  const std::string text = node.text("a value such as 0.1 mm");
  try {
    return read_quantity(text, node.parameters());
  } catch (const ExpressionError& error) {
    const std::string said = error.what();
    for (const std::string& other : all)
      if (said.find(": \"" + other + "\" is neither") != std::string::npos)
        node.fail("\"" + text + "\": " + other + " is not known yet; parameters are read from the " + "top, so write " + other + " above " +
                  node.name());
    node.fail(said);
  }
}

void require_run(const Scene& scene) {
  if (!scene.has_run)
    throw SceneError(scene.file, {0, "run"},
                     "is missing: the scene has no duration of the run; add for example "
                     "run: {until: 1 s}");
}

Scene read_scene(const std::filesystem::path& file, const Overrides& overrides) {
  const std::string text = read_text_file(file, most_bytes);
  return read(text, file.string(), overrides, file.parent_path());
}

Scene read_scene_text(const std::string& text, const std::string& name, const Overrides& overrides, const std::filesystem::path& folder) {
  if (const int line = line_not_text(text); line > 0)
    throw SceneError(name, {line, {}}, "is not text (a zero byte, or bytes that are not UTF-8)");
  return read(text, name, overrides, folder);
}

}  // namespace pintle
