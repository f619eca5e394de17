#include "framework/scene/yaml/include.h"

#include <algorithm>
#include <array>
#include <set>

#include "files/files.h"
#include "framework/scene/text_file.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{100} << 20, most_files = 1000;

Yaml* entry_of(Yaml& map, std::string_view key) {
  const auto found = std::ranges::find(map.items, key, &Yaml::key);
  return found == map.items.end() ? nullptr : &*found;
}

void mark_file(Yaml& yaml, int file) {
  yaml.file = file;
  for (Yaml& item : yaml.items) mark_file(item, file);
}

class Inclusion {
 public:
  explicit Inclusion(Source& source) : source_(source) {}

  /// Adds included parts to the scene or to an assembly.
  void complete(Yaml& part, const std::string& path, bool is_scene) {
    if (part.kind != Yaml::Kind::map) return;
    if (Yaml* written = entry_of(part, "include")) {
      const Yaml files = *written;
      std::erase_if(part.items, [](const Yaml& item) { return item.key == "include"; });
      Yaml all{.kind = Yaml::Kind::map};
      std::set<fs::path> once;
      each_file(node(files, path), [&](const Node& file) { add(file, once, all); });
      merge(part, std::move(all), is_scene);
    }
    Yaml* assemblies = entry_of(part, "assemblies");
    if (!assemblies) return;
    for (Yaml& assembly : assemblies->items) complete(assembly, path + "assemblies." + assembly.key + ".", false);
  }

 private:
  Node node(const Yaml& files, const std::string& path) const {
    return {files, source_, {files.line, path + "include", source_.file_of(files.file)}, "include"};
  }

  template <class Do>
  static void each_file(const Node& files, Do does) {
    if (!files.is_list()) return does(files);
    for (const Node& file : files.list(1, "the name of a scene file beside this one, or a list of them")) does(file);
  }

  /// Inserts the content of a file, with its own includes, before the existing entries.
  void add(const Node& named, std::set<fs::path>& once, Yaml& all) {
    const fs::path beside = named.yaml().file == 0 ? fs::path() : source_.included[static_cast<std::size_t>(named.yaml().file - 1)].folder;
    const fs::path name = named.text("the name of a scene file beside this one");
    fs::path path;
    try {
      path = contained_file(name, source_.folder / beside, source_.folder);
    } catch (const FileRejected& rejected) {
      named.fail(rejected.what());
    }
    if (!fs::exists(path)) named.fail("there is no file \"" + name.string() + "\"; its path is relative to the file that names it");
    path = fs::weakly_canonical(path);
    refuse_circle(named, path);
    if (!once.insert(path).second) return;
    Yaml tree = parsed(named, name, (beside / name).lexically_normal());
    open_.push_back({path, name.string()});
    if (Yaml* more = entry_of(tree, "include")) {
      const Yaml files = *more;
      std::erase_if(tree.items, [](const Yaml& item) { return item.key == "include"; });
      each_file(node(files, ""), [&](const Node& file) { add(file, once, all); });
    }
    complete(tree, "", true);
    open_.pop_back();
    join(all, std::move(tree));
  }

  void refuse_circle(const Node& named, const fs::path& path) const {
    const auto first = std::ranges::find(open_, path, &Open::path);
    if (first == open_.end() && path != fs::weakly_canonical(source_.file)) return;
    std::string circle = fs::path(source_.file).filename().string();
    if (first != open_.end()) circle = first->name;
    for (auto at = first == open_.end() ? open_.begin() : first + 1; at != open_.end(); ++at) circle += " > " + at->name;
    named.fail("includes itself: " + circle + " > " + named.yaml().text + "; remove one of these includes");
  }

  Yaml parsed(const Node& named, const fs::path& name, const fs::path& from_scene) {
    if (source_.included.size() >= most_files) named.fail("gives more than " + std::to_string(most_files) + " files; include fewer");
    const std::string shown = (fs::path(source_.file).parent_path() / from_scene).lexically_normal().string();
    source_.included.push_back({shown, from_scene.parent_path()});
    Yaml tree = parse_yaml(read_text_file(source_.folder / from_scene, most_bytes), shown);
    if (tree.kind != Yaml::Kind::map)
      throw SceneError(shown, {tree.line, {}},
                       "contains no keys of a scene, but " + named.place().key + " includes \"" + name.string() + "\" as a scene");
    mark_file(tree, static_cast<int>(source_.included.size()));
    return tree;
  }

  [[noreturn]] void twice(const Yaml& entry, const std::string& path, const Yaml& other) const {
    const std::string file = other.file == 0 ? source_.file : source_.file_of(other.file);
    throw SceneError(source_.file, {entry.line, path + entry.key, source_.file_of(entry.file)},
                     "is also in " + file + ":" + std::to_string(other.line) + "; rename or remove one of them");
  }

  /// Joins two included files, entry by entry; settings of the first are kept.
  void join(Yaml& first, Yaml second) const {
    for (Yaml& section : second.items)
      if (!is_setting(section) || !entry_of(first, section.key)) put(first, std::move(section), "");
  }
  static bool is_setting(const Yaml& section) {
    static constexpr std::array settings{"title", "gravity", "run", "static", "output"};
    return std::ranges::find(settings, section.key) != settings.end();
  }
  void put(Yaml& map, Yaml entry, const std::string& path) const {
    Yaml* there = entry_of(map, entry.key);
    if (!there) return void(map.items.push_back(std::move(entry)));
    const bool group = path.empty() || path == "ground.";
    if (!group || there->kind != Yaml::Kind::map || entry.kind != Yaml::Kind::map) twice(entry, path, *there);
    std::set<std::string> known;
    for (const Yaml& item : there->items) known.insert(item.key);
    for (Yaml& item : entry.items) {
      if (known.contains(item.key))
        put(*there, std::move(item), path + entry.key + ".");
      else
        there->items.push_back(std::move(item));
    }
  }

  /// Included parts come first; the part's own parameter values and settings take precedence.
  void merge(Yaml& part, Yaml all, bool is_scene) const {
    std::erase_if(all.items, [&](const Yaml& section) { return is_setting(section) && (!is_scene || entry_of(part, section.key)); });
    own_values(part, all, "parameters");
    own_values(part, all, "start");
    std::vector<Yaml> own = std::move(part.items);
    part.items = std::move(all.items);
    for (Yaml& section : own) put(part, std::move(section), "");
  }

  static void own_values(Yaml& part, Yaml& all, std::string_view key) {
    Yaml *own = entry_of(part, key), *other = entry_of(all, key);
    if (!own || !other) return;
    if (own->kind != Yaml::Kind::map || other->kind != Yaml::Kind::map) {
      std::erase_if(all.items, [&](const Yaml& section) { return section.key == key; });
      return;
    }
    for (Yaml& value : other->items)
      if (Yaml* mine = entry_of(*own, value.key)) {
        value = std::move(*mine);
        own->items.erase(own->items.begin() + (mine - own->items.data()));
      }
  }

  struct Open {
    fs::path path;
    std::string name;
  };
  Source& source_;
  std::vector<Open> open_;
};

}  // namespace

void include_files(Yaml& scene, Source& source) { Inclusion(source).complete(scene, "", true); }

}  // namespace pintle
