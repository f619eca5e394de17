#include "framework/study/changed_scene.h"

#include <algorithm>

#include "framework/scene/units/expression.h"
#include "framework/scene/units/unit.h"
#include "framework/scene/yaml/instances.h"
#include "framework/scene/yaml/override.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

/// Changes the paths of tables and drawings to be relative to another folder.  @returns whether there are any
bool mend_paths(Yaml& yaml, const std::string& parent, const fs::path& from, const fs::path& to) {
  bool any = false;
  for (Yaml& item : yaml.items) any = mend_paths(item, yaml.kind == Yaml::Kind::map ? yaml.key : parent, from, to) || any;
  if (yaml.kind != Yaml::Kind::scalar || !(yaml.key == "table" || (yaml.key == "file" && parent == "plate"))) return any;
  const fs::path path(yaml.text);
  if (path.is_absolute()) return true;
  const fs::path whole = fs::absolute(from / path).lexically_normal();
  const fs::path relative = whole.lexically_relative(fs::absolute(to).lexically_normal());
  yaml.text = (relative.empty() ? whole : relative).generic_string();
  return true;
}

/// A bare number for a parameter gets the parameter's unit.
void set_parameters(Yaml& scene, const Overrides& parameters) {
  const auto group = std::ranges::find(scene.items, "parameters", &Yaml::key);
  if (group == scene.items.end()) return;
  Parameters known;
  for (Yaml& p : group->items) {
    Quantity q = read_quantity(p.text, known);
    for (const auto& [name, text] : parameters) {
      if (name != p.key) continue;
      Quantity given = read_quantity(text, known);
      p.text = text;
      if (bare(given.dimension) && !bare(q.dimension))
        p.text = "(" + text + ")*(1 " + si_unit(q.dimension) + ")", given.dimension = q.dimension;
      q = given;
    }
    known[p.key] = q;
  }
}

/// Entries that fit on one line are written on it, others one per line.
void block(const Yaml& yaml, std::size_t indent, std::string& out) {
  const std::string flow = override_text(yaml);
  const bool open = yaml.kind == Yaml::Kind::map && !yaml.items.empty() && (indent == 0 || flow.size() + indent > 120);
  if (!open) {
    out += " " + flow + "\n";
    return;
  }
  if (indent > 0) out += "\n";
  for (const Yaml& item : yaml.items) {
    out += std::string(indent > 0 ? indent - 2 + 2 : 0, ' ');
    out += override_text(Yaml{Yaml::Kind::scalar, 0, {}, item.key, {}}) + ":";
    block(item, indent + 2, out);
  }
}

}  // namespace

std::string changed_scene(const CaseSource& source, const Overrides& set, const fs::path& directory, const std::string& comment) {
  Yaml scene = parse_yaml(source.text, source.file.string());
  const bool whole = std::ranges::find(scene.items, "include", &Yaml::key) == scene.items.end() && !has_copies(scene);
  if (!whole) scene = parse_yaml(common_scene(source).filled_in, source.file.string());  // with everything expanded
  Overrides all = source.common;
  all.insert(all.end(), set.begin(), set.end());
  set_parameters(scene, apply_paths(scene, source.file.string(), all));
  fs::path folder = source.file.parent_path();
  if (folder.empty()) folder = ".";
  std::string out;
  if (mend_paths(scene, "", folder, directory))
    out += "# It reads files beside " + source.file.filename().string() + ": run it with --allow-path " +
           fs::absolute(folder).lexically_normal().string() + "\n";
  for (std::size_t begin = 0; begin < comment.size();) {
    const std::size_t end = std::min(comment.find('\n', begin), comment.size());
    out += "# " + comment.substr(begin, end - begin) + "\n";
    begin = end + 1;
  }
  block(scene, 0, out);
  return out;
}

}  // namespace pintle
