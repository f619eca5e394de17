#include "framework/scene/yaml/override.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "framework/common/nearest.h"
#include "framework/scene/yaml/keys.h"

namespace pintle {

namespace {

std::string trimmed(const std::string& s) {
  const auto begin = s.find_first_not_of(" \t"), end = s.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : s.substr(begin, end - begin + 1);
}

/// Splits "a.b c[2].d" into a, b c, 2, d.
std::vector<std::string> steps(const std::string& path) {
  std::vector<std::string> out{""};
  for (const char c : path) {
    if (c == '.' || c == '[')
      out.emplace_back();
    else if (c != ']')
      out.back() += c;
  }
  for (std::string& s : out) s = trimmed(s);
  return out;
}

std::vector<std::string> top_keys() {
  std::vector<std::string> out;
  for (const KeyTable& table : key_tables())
    if (table.path.empty())
      for (const Key& key : table.keys) out.push_back(key.name);
  return out;
}

std::vector<std::string> keys_of(const Yaml& map) {
  std::vector<std::string> out;
  for (const Yaml& item : map.items) out.push_back(item.key);
  return out;
}

Yaml* find(Yaml& map, const std::string& key) {
  const auto found = std::ranges::find(map.items, key, &Yaml::key);
  return found == map.items.end() ? nullptr : &*found;
}

/// Entries of these groups have names chosen by the scene's author: an unknown one is a typing error, not a new entry. @returns what the
/// entry is called in a message, or nullptr.
const char* named_entry(const std::string& group) {
  constexpr std::array<std::array<const char*, 2>, 8> named{{{"bodies", "body"},
                                                             {"instances", "instance"},
                                                             {"assemblies", "assembly"},
                                                             {"joints", "joint"},
                                                             {"drivers", "driver"},
                                                             {"forces", "force"},
                                                             {"materials", "material"},
                                                             {"parameters", "parameter"}}};
  for (const auto& [key, word] : named)
    if (group == key) return word;
  return nullptr;
}

void mark(Yaml& yaml) {
  yaml.line = set_by_override;
  for (Yaml& item : yaml.items) mark(item);
}

/// Entries inserted into an instance may use its parameters.
void adopt(Yaml& yaml, int scope) {
  yaml.scope = scope;
  for (Yaml& item : yaml.items) adopt(item, scope);
}

std::optional<std::size_t> whole(const std::string& s) {
  if (s.empty() || s.size() > 9 || !std::ranges::all_of(s, [](char c) { return c >= '0' && c <= '9'; })) return {};
  return static_cast<std::size_t>(std::stoul(s));
}

/// Whether the path of these steps exists below an entry.
bool leads_on(const Yaml& entry, std::span<const std::string> steps) {
  if (steps.empty()) return true;
  const auto next = std::ranges::find(entry.items, steps[0], &Yaml::key);
  return entry.kind == Yaml::Kind::map && next != entry.items.end() && leads_on(*next, steps.subspan(1));
}

/// Adds all paths below `at` that end in these steps; if not `whole`, those that exist at least up to the first of the steps.
void add_ending_so(const Yaml& at, const std::string& path, std::span<const std::string> steps, bool whole, std::vector<std::string>& out) {
  if (at.kind != Yaml::Kind::map) return;
  for (const Yaml& entry : at.items) {
    if (!path.empty() && entry.key == steps[0] && (!whole || leads_on(entry, steps.subspan(1)))) {
      out.push_back(path);
      for (const std::string& step : steps) out.back() += step + (&step == &steps.back() ? "" : ".");
    }
    add_ending_so(entry, path + entry.key + ".", steps, whole, out);
  }
}

/// " Did you mean "joints.pin.clearance"?" for "pin.clearance"; empty if no path ends like this.
std::string did_you_mean_below(const Yaml& scene, const std::vector<std::string>& steps) {
  std::vector<std::string> found;
  add_ending_so(scene, "", steps, true, found);
  if (found.empty()) add_ending_so(scene, "", steps, false, found);
  constexpr std::size_t most = 3;
  if (found.size() > most) found.resize(most);
  for (std::string& path : found) path = '"' + path + '"';
  return found.empty() ? "" : " Did you mean " + listed(found) + "?";
}

/// Follows one override down the tree.
class Walk {
 public:
  Walk(const std::string& file, const std::string& path, const std::string& text)
      : file_(file), path_(path), text_(text), steps_(steps(path)) {}

  void apply(Yaml& scene) {
    if (std::ranges::find(steps_, "") != steps_.end()) fail("a key is missing between two dots; write GROUP.NAME.KEY");
    if (trimmed(text_).empty()) fail("no value is given; write null to remove the key");
    Yaml value = parse_yaml(text_, file_ + ": --set " + path_);
    mark(value);
    Yaml* at = &scene;
    for (std::size_t i = 0; i + 1 < steps_.size(); ++i) {
      if (Yaml* next = child(*at, i, value.kind == Yaml::Kind::nothing))
        at = next;
      else
        return;  // nothing to remove
    }
    put(*at, std::move(value));
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(file_, {set_by_override, path_}, message); }

  [[noreturn]] void fail_at_top(const Yaml& scene, const std::vector<std::string>& known) const {
    const std::string below = did_you_mean_below(scene, steps_);
    fail("a scene has no key \"" + steps_[0] + "\"." + (below.empty() ? did_you_mean(steps_[0], known) : below));
  }

  /// The path of the first n steps.
  std::string upto(std::size_t n) const {
    std::string out;
    for (std::size_t i = 0; i < n; ++i) out += (i > 0 ? "." : "") + steps_[i];
    return out;
  }

  void must_be_key(const Yaml& group, std::size_t i) const {
    if (i == 0) {
      const std::vector<std::string> known = top_keys();
      if (std::ranges::find(known, steps_[0]) == known.end()) fail_at_top(group, known);
    }
    const char* what = i == 1 ? named_entry(steps_[0]) : nullptr;
    if (what && std::ranges::find(group.items, steps_[i], &Yaml::key) == group.items.end())
      fail(std::string("there is no ") + what + " \"" + steps_[i] + "\"." + did_you_mean(steps_[i], keys_of(group)));
  }

  /// Opens a group to descend into, creating it if empty. @returns false if it is empty and need not be created
  bool open(Yaml& group, std::size_t i, bool removing) const {
    if (group.kind == Yaml::Kind::map || group.kind == Yaml::Kind::list) return true;
    if (group.kind == Yaml::Kind::scalar)
      fail(upto(i) + " is \"" + group.text + "\", not a group that can contain \"" + steps_[i] + "\"; write --set \"" + upto(i) + "={" +
           steps_[i] + ": …}\" to replace it");
    if (removing) return false;
    group.kind = Yaml::Kind::map;
    return true;
  }

  std::size_t index(const Yaml& list, std::size_t i, std::size_t most) const {
    const std::optional<std::size_t> k = whole(steps_[i]);
    if (!k || *k < 1 || *k > most)
      fail(upto(i) + " is a list of " + std::to_string(list.items.size()) + "; name an entry by its number, from 1 to " +
           std::to_string(most) + ", not \"" + steps_[i] + "\"");
    return *k - 1;
  }

  /// Entry i of the path, created if missing. @returns nullptr if it is missing and something is to be removed
  Yaml* child(Yaml& group, std::size_t i, bool removing) const {
    if (i == 0) must_be_key(group, 0);
    if (!open(group, i, removing)) return nullptr;
    if (group.kind == Yaml::Kind::list) return &group.items[index(group, i, group.items.size())];
    if (i > 0) must_be_key(group, i);
    if (Yaml* found = find(group, steps_[i])) return found;
    if (removing) return nullptr;
    return &group.items.emplace_back(Yaml{Yaml::Kind::nothing, set_by_override, steps_[i], {}, {}, 0, group.scope});
  }

  void put(Yaml& group, Yaml value) const {
    adopt(value, group.scope);
    const std::size_t last = steps_.size() - 1;
    const bool removing = value.kind == Yaml::Kind::nothing;
    if (last == 0) must_be_key(group, 0);
    if (!open(group, last, removing)) return;
    if (group.kind == Yaml::Kind::list) {
      const std::size_t k = index(group, last, group.items.size() + (removing ? 0 : 1));
      if (removing)
        group.items.erase(group.items.begin() + static_cast<std::ptrdiff_t>(k));
      else if (k == group.items.size())
        group.items.push_back(std::move(value));
      else
        group.items[k] = std::move(value);
      return;
    }
    if (removing) {
      must_be_key(group, last);
      std::erase_if(group.items, [&](const Yaml& item) { return item.key == steps_[last]; });
      return;
    }
    value.key = steps_[last];
    if (Yaml* there = find(group, steps_[last]))
      *there = std::move(value);
    else
      group.items.push_back(std::move(value));
  }

  const std::string &file_, &path_, &text_;
  std::vector<std::string> steps_;
};

/// Whether the scalar can be written without quotes in a flow list or map.
bool plain(const std::string& s, bool inside) {
  if (s.empty() || s == "null" || s == "~" || s == "Null" || s == "NULL") return false;
  if (trimmed(s) != s || s.find_first_of("\n\r\t\"\\") != std::string::npos) return false;
  if (std::string_view("&*!|>'%@`#?,[]{}:-").find(s[0]) != std::string_view::npos && !(s[0] == '-' && s.size() > 1 && s[1] != ' '))
    return false;
  if (s.find(": ") != std::string::npos || s.find(" #") != std::string::npos || s.back() == ':') return false;
  return !inside || s.find_first_of(",[]{}:#") == std::string::npos;
}

std::string scalar(const std::string& s, bool inside) {
  if (plain(s, inside)) return s;
  std::string out = "\"";
  for (const char c : s) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (c == '\r')
      out += "\\r";
    else
      out += c;
  }
  return out + "\"";
}

std::string text(const Yaml& yaml, bool inside) {
  if (yaml.kind == Yaml::Kind::nothing) return "null";
  if (yaml.kind == Yaml::Kind::scalar) return scalar(yaml.text, inside);
  const bool map = yaml.kind == Yaml::Kind::map;
  std::string out = map ? "{" : "[";
  for (std::size_t i = 0; i < yaml.items.size(); ++i) {
    if (i > 0) out += ", ";
    if (map) out += scalar(yaml.items[i].key, true) + ": ";
    out += text(yaml.items[i], true);
  }
  return out + (map ? "}" : "]");
}

}  // namespace

bool is_path(const std::string& name, const Yaml& scene) {
  if (name.find('.') != std::string::npos) return true;
  const auto parameters = std::ranges::find(scene.items, "parameters", &Yaml::key);
  if (parameters != scene.items.end() && std::ranges::find(parameters->items, name, &Yaml::key) != parameters->items.end()) return false;
  const std::vector<std::string> known = top_keys();
  return std::ranges::find(known, name) != known.end();
}

Overrides apply_paths(Yaml& scene, const std::string& file, const Overrides& overrides) {
  Overrides parameters;
  for (const auto& [name, value] : overrides) {
    if (is_path(name, scene))
      Walk(file, name, value).apply(scene);
    else
      parameters.emplace_back(name, value);
  }
  return parameters;
}

namespace {
/// Groups to which instances and repeats add no entries.
bool is_as_written(std::string_view group) {
  static constexpr std::array as_written{"title", "gravity", "parameters", "run",        "static",   "output",
                                         "start", "ground",  "include",    "assemblies", "instances"};
  return std::ranges::find(as_written, group) != as_written.end();
}
}  // namespace

std::pair<Overrides, Overrides> written_and_made(const Yaml& scene, const Overrides& overrides) {
  std::pair<Overrides, Overrides> out;
  for (const auto& [name, value] : overrides) {
    const std::vector<std::string> path = steps(name);
    const auto group = std::ranges::find(scene.items, path[0], &Yaml::key);
    const bool made = path.size() > 1 && !is_as_written(path[0]) &&
                      (group == scene.items.end() || std::ranges::find(group->items, path[1], &Yaml::key) == group->items.end());
    (made ? out.second : out.first).emplace_back(name, value);
  }
  return out;
}

std::string override_text(const Yaml& yaml) { return text(yaml, false); }

}  // namespace pintle
