#include "framework/scene/yaml/instances.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/scene/yaml/placing.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

constexpr std::size_t most_values = 1'000'000;
constexpr long most_copies = 100'000;
constexpr int most_levels = 30;

const Yaml* item_of(const Yaml& map, std::string_view key) {
  const auto found = std::ranges::find(map.items, key, &Yaml::key);
  return found == map.items.end() ? nullptr : &*found;
}

bool repeats(const Yaml& entry) { return entry.kind == Yaml::Kind::map && item_of(entry, "repeat"); }

/// Whether the ground is named, or may be the default frame of a joint.
bool says_ground(const Yaml& yaml) {
  const bool frame = yaml.key == "screw" || yaml.key == "cam" || yaml.key == "differential";
  return frame || yaml.text == "ground" || std::ranges::any_of(yaml.items, says_ground);
}

/// Groups of the scene as a whole; all other top-level groups contain named parts.
bool is_of_the_whole(std::string_view section) {
  static constexpr std::array whole{"title", "gravity", "parameters", "run", "static", "output", "start", "ground"};
  return std::ranges::find(whole, section) != whole.end();
}
bool is_written_out(std::string_view section) {
  return section == "assemblies" || section == "instances" || section == "parameters" || section == "ports";
}

/// The scene, or an instance of an assembly.
struct Part {
  const Yaml& written;
  std::string path;       ///< key path: "assemblies.leg."
  int scope = 0;          ///< 0: the scene
  std::string name = {};  ///< of the instance
  Placing placing = {};
  const Part* outer = nullptr;
  std::string full(const std::string& own) const { return name.empty() ? own : name + " " + own; }
};

class Expansion {
 public:
  Expansion(Yaml& scene, Source& source) : source_(source), written_(std::move(scene)) {
    out_ = {.kind = Yaml::Kind::map, .line = written_.line};
  }

  Yaml whole() {
    if (const Yaml* assemblies = item_of(written_, "assemblies")) {
      node(*assemblies, "assemblies").entries("names and assemblies: {leg: {bodies: {…}}}");
      for (const Yaml& assembly : assemblies->items) names_of(assembly);
    }
    lay({.written = written_, .path = ""});
    for (const Yaml& section : out_.items)
      if (section.key == "ground")
        for (const Yaml& kind : section.items) refuse_twins(kind, "ground." + kind.key);
      else if (!is_of_the_whole(section.key) && section.kind == Yaml::Kind::map)
        refuse_twins(section, section.key);
    return std::move(out_);
  }

 private:
  Node node(const Yaml& yaml, const std::string& path) const {
    return {yaml, source_, {yaml.line, path, source_.file_of(yaml.file)}, yaml.key};
  }

  Yaml copied(const Yaml& yaml, int scope) {
    if (++values_ > most_values) node(yaml, yaml.key).fail("repeat and instances make more than a million values; use fewer copies");
    Yaml out{yaml.kind, yaml.line, yaml.key, yaml.text, {}, yaml.file, scope};
    out.items.reserve(yaml.items.size());
    for (const Yaml& item : yaml.items) out.items.push_back(copied(item, scope));
    return out;
  }

  Yaml& group(Yaml& map, const Yaml& like) {
    const auto found = std::ranges::find(map.items, like.key, &Yaml::key);
    return found != map.items.end() ? *found : map.items.emplace_back(Yaml{Yaml::Kind::map, like.line, like.key, {}, {}, like.file, 0});
  }

  /// Calls `does` for the entry, or for its copies "NAME 1", "NAME 2", … if it repeats; each in a scope with its `index`.
  template <class Do>
  void each_copy(const Yaml& entry, const std::string& path, int scope, Do does) {
    Yaml one = copied(entry, scope);
    if (!repeats(one)) return does(std::move(one));
    const Node repeat = node(one, path + entry.key).at("repeat");
    const long n = repeat.count(0);
    if (n > most_copies) repeat.fail(repeat.shown() + " is more than a hundred thousand; use fewer copies");
    std::erase_if(one.items, [](const Yaml& item) { return item.key == "repeat"; });
    for (long i = 1; i <= n; ++i) {
      Yaml copy = copied(one, copy_scope(scope, i));
      copy.key += " " + std::to_string(i);
      does(std::move(copy));
    }
  }

  int copy_scope(int outer, long index) {
    const Scope* around = source_.scope(outer);
    Scope made{.outer = outer, .parameters = source_.visible(outer)};
    values_ += made.parameters.size();
    if (around) made.own = around->own, made.said = around->said, made.mirrored = around->mirrored;
    made.parameters["index"] = {static_cast<double>(index), {}};
    made.own.insert("index");
    source_.scopes.push_back(std::move(made));
    return static_cast<int>(source_.scopes.size());
  }

  void lay(const Part& part) {
    for (const Yaml& section : part.written.items)
      if (part.scope == 0 &&
          (section.key == "parameters" || (is_of_the_whole(section.key) && section.key != "start" && section.key != "ground")))
        out_.items.push_back(copied(section, 0));
      else if (!is_written_out(section.key))
        lay_section(section, part);
    if (const Yaml* instances = item_of(part.written, "instances")) {
      check_instances(*instances, part);
      for (const Yaml& entry : instances->items)
        each_copy(entry, part.path + "instances.", part.scope, [&](const Yaml& one) { lay_instance(one, part); });
    }
  }

  void check_instances(const Yaml& instances, const Part& part) const {
    node(instances, part.path + "instances").entries("names and instances: {left: {of: leg, at: [0, 0]}}");
  }

  void lay_section(const Yaml& section, const Part& part) {
    const bool scene = part.scope == 0;
    if (section.kind != Yaml::Kind::map) {
      if (!scene)
        node(section, part.path + section.key).fail("must be a group of names in an assembly; another form is allowed in a scene only");
      out_.items.push_back(copied(section, 0));
      return;
    }
    if (Yaml& to = group(out_, section); to.kind != Yaml::Kind::map)
      node(section, part.path + section.key)
          .fail("cannot be combined with " + section.key + ": " + to.text + " of the scene; remove one of them");
    if (section.key == "ground") {
      Yaml& ground = group(out_, section);
      for (const Yaml& kind : section.items) lay_entries(kind, part, group(ground, kind), "ground." + kind.key);
    } else if (section.key == "output") {
      lay_output(section, part);
    } else {
      lay_entries(section, part, group(out_, section), section.key);
    }
  }

  void lay_entries(const Yaml& section, const Part& part, Yaml& to, const std::string& as) {
    for (const Yaml& entry : section.items)
      each_copy(entry, part.path + as + ".", part.scope, [&](Yaml one) {
        if (as == "start")
          one.key = starting(one.key, part);
        else if (one.key != "ground")
          one.key = part.full(one.key);
        if (as == "start" && !started_.insert(one.key).second) return;  // already set by the enclosing part
        if (!part.placing.stays()) place(one, as, as + "." + one.key, part.placing, source_);
        to.items.push_back(std::move(one));
      });
  }

  /// The body or joint with start values; a joint may have the name of a port.
  std::string starting(const std::string& key, const Part& part) const {
    const Scope* scope = source_.scope(part.scope);
    return scope && scope->names->has(key) ? part.full(key) : resolved(source_, part.scope, {key, ""}).part;
  }

  /// Adds the recorded points of an assembly to those of the scene.
  void lay_output(const Yaml& section, const Part& part) {
    Yaml& output = group(out_, section);
    for (const Yaml& list : section.items) {
      const Node at = node(list, part.path + "output." + list.key);
      if (list.key != "points" && list.key != "stress") at.fail("is for the scene only; the output of an assembly has points and stress");
      Yaml& to = group(output, list);
      if (to.items.empty()) to.kind = Yaml::Kind::list;
      for (std::size_t i = 0; i < at.list(1, "a list of points").size(); ++i) to.items.push_back(copied(list.items[i], part.scope));
    }
  }

  const Yaml& assembly_named(const Node& of, const Part& part) const {
    const std::string name = of.text("the name of an assembly");
    std::vector<std::string> known;
    for (const Part* p = &part; p; p = p->outer)
      if (const Yaml* assemblies = item_of(p->written, "assemblies"))
        for (const Yaml& assembly : assemblies->items) {
          if (assembly.key == name) return assembly;
          known.push_back(assembly.key);
        }
    of.fail("there is no assembly \"" + name + "\"" + (known.empty() ? "; describe it under assemblies" : "." + did_you_mean(name, known)));
  }

  void refuse_circle(const Node& of, const Yaml& assembly, const Part& part) const {
    std::string circle = assembly.key;
    int levels = 0;
    for (const Part* p = &part; p->outer; p = p->outer) {
      circle = p->written.key + " > " + circle;
      if (&p->written == &assembly) of.fail("makes an assembly contain itself: " + circle + "; remove one of these");
      if (++levels > most_levels) of.fail("is nested more than " + std::to_string(most_levels) + " levels deep; use fewer levels");
    }
  }

  void lay_instance(const Yaml& one, const Part& part) {
    const Node spec = node(one, part.path + "instances." + one.key);
    checked_name(spec);
    check_keys(spec, "instances.*");
    const Yaml& assembly = assembly_named(spec.at("of"), part);
    refuse_circle(spec.at("of"), assembly, part);
    Part inner{.written = assembly, .path = "assemblies." + assembly.key + ".", .name = part.full(one.key), .outer = &part};
    inner.placing = part.placing * placing_of(spec);
    source_.scopes.push_back({.outer = one.scope, .instance = inner.name, .names = &names_of(assembly)});
    inner.scope = static_cast<int>(source_.scopes.size());
    Scope& scope = source_.scopes.back();
    const std::string file = one.file == 0 ? source_.file : source_.file_of(one.file);
    scope.said = " (in the instance \"" + inner.name + "\", " + file + ":" + std::to_string(one.line) + ")";
    scope.placed = !inner.placing.stays();
    scope.mirrored = inner.placing.mirrored;
    fill_parameters(spec, assembly, inner, scope);
    fill_ports(spec, assembly, scope);
    if (scope.placed && says_ground_[&assembly]) lay_origin(one, inner);
    lay(inner);
  }

  static Placing placing_of(const Node& spec) {
    Placing out;
    if (spec.has("at")) out.at = spec.at("at").pair(dimension::length);
    read_optional(spec, "angle", dimension::angle, rule::any, out.angle);
    if (!spec.has("mirror")) return out;
    out.mirrored = true;
    if (spec.at("mirror").one_of(choices("instances.*", "mirror")) == "x") out.angle += std::numbers::pi;
    return out;
  }

  const OwnNames& names_of(const Yaml& assembly) {
    if (const auto known = names_.find(&assembly); known != names_.end()) return *known->second;
    check_keys(node(assembly, "assemblies." + assembly.key), "assemblies.*");
    OwnNames& names = source_.names.emplace_back();
    for (const Yaml& section : assembly.items) {
      if (section.kind != Yaml::Kind::map || section.key == "start" || section.key == "output" || section.key == "assemblies") continue;
      if (section.key == "ground") {
        for (const Yaml& kind : section.items)
          for (const Yaml& entry : kind.items) names.ground.insert(entry.key);
      } else if (!is_written_out(section.key) || section.key == "instances") {
        const bool numbers = section.key == "states" || section.key == "outputs";
        for (const Yaml& entry : section.items) {
          (section.key == "instances" || repeats(entry) ? names.families : names.parts).insert(entry.key);
          if (numbers && !repeats(entry)) names.numbers.insert(entry.key);
        }
      }
    }
    says_ground_[&assembly] = says_ground(assembly);
    return *names_.emplace(&assembly, &names).first->second;
  }

  /// The assembly's own parameter values, replaced by those of the instance where given.
  void fill_parameters(const Node& spec, const Yaml& assembly, const Part& inner, Scope& scope) {
    scope.parameters = source_.visible(spec.yaml().scope);
    if (const Scope* around = source_.scope(spec.yaml().scope)) scope.own = around->own;
    values_ += scope.parameters.size();
    const Yaml* group = item_of(assembly, "parameters");
    std::vector<std::string> known;
    std::map<std::string, Node> given;
    if (spec.has("with"))
      for (const Node& value : spec.at("with").entries("names and values of the assembly's parameters: {phase: 90 deg}"))
        given.emplace(value.name(), value);
    if (group) {
      Yaml usual = copied(*group, inner.scope);
      const Node values = node(usual, inner.path + "parameters");
      const std::vector<Node> entries = values.entries("names and values: {phase: 0 deg}");
      known = values.keys();
      for (const Node& entry : entries) {
        Quantity q = read_parameter(entry, known);
        if (const auto value = given.find(entry.name()); value != given.end()) q = in_place_of(q, value->second);
        scope.parameters[entry.name()] = q;
        scope.own.insert(entry.name());
      }
    }
    for (const auto& [name, value] : given)
      if (std::ranges::find(known, name) == known.end())
        value.fail("\"" + assembly.key + "\" has no such parameter" +
                   (known.empty() ? "; name it under its parameters" : "." + did_you_mean(name, known)));
  }

  /// A bare number gets the parameter's unit.
  static Quantity in_place_of(const Quantity& usual, const Node& value) {
    Quantity q;
    try {
      q = read_quantity(value.text("a value such as 90 deg"), value.parameters());
    } catch (const ExpressionError& error) {
      value.fail(error.what());
    }
    if (bare(q.dimension)) return {q.value, usual.dimension};
    if (!bare(usual.dimension) && !same(q.dimension, usual.dimension))
      value.fail(value.shown() + " is " + describe(q.dimension) + ", but the assembly gives " + value.name() + " as " +
                 describe(usual.dimension));
    return q;
  }

  void fill_ports(const Node& spec, const Yaml& assembly, Scope& scope) const {
    std::vector<std::string> known;
    if (const Yaml* ports = item_of(assembly, "ports"))
      for (const Node& port : node(*ports, "assemblies." + assembly.key + ".ports").list(1, "a list of names: [hip, guide]"))
        known.push_back(port.text("the name of a port"));
    if (spec.has("ports"))
      for (const Node& port : spec.at("ports").entries("names of the assembly's ports and points: {hip: body.R}")) {
        if (std::ranges::find(known, port.name()) == known.end())
          port.fail("\"" + assembly.key + "\" has no such port" +
                    (known.empty() ? "; name it under its ports" : "." + did_you_mean(port.name(), known)));
        scope.ports.emplace(port.name(), port.part("a point such as body.R, or a body"));
      }
    for (const std::string& port : known)
      if (!scope.ports.contains(port)) spec.fail("does not connect its port \"" + port + "\"; add ports: {" + port + ": body.A}");
  }

  /// Defines the origin meant by `ground` alone in an instance that is placed elsewhere.
  void lay_origin(const Yaml& like, const Part& inner) {
    Yaml at{Yaml::Kind::map, like.line, inner.name, {}, {}, like.file, 0};
    const auto number = [&](const char* key, double value) {
      std::string text;
      append_number(text, value);
      return Yaml{Yaml::Kind::scalar, like.line, key, text, {}, like.file, 0};
    };
    Yaml pair{Yaml::Kind::list, like.line, "at", {}, {}, like.file, 0};
    pair.items = {number("", inner.placing.at[0]), number("", inner.placing.at[1])};
    at.items = {std::move(pair), number("angle", inner.placing.angle)};
    at.items.back().text += " rad";
    Yaml& ground = group(out_, {.line = like.line, .key = "ground", .file = like.file});
    group(ground, {.line = like.line, .key = "points", .file = like.file}).items.push_back(std::move(at));
  }

  void refuse_twins(const Yaml& section, const std::string& path) const {
    std::unordered_map<std::string_view, const Yaml*> seen;
    for (const Yaml& entry : section.items)
      if (const auto [other, fresh] = seen.try_emplace(entry.key, &entry); !fresh) {
        const Yaml& first = *other->second;
        node(entry, path + "." + entry.key)
            .fail("the name is also used at " + (first.file == 0 ? source_.file : source_.file_of(first.file)) + ":" +
                  std::to_string(first.line) + "; rename one of them");
      }
  }

  Source& source_;
  const Yaml written_;
  Yaml out_;
  std::size_t values_ = 0;
  std::unordered_set<std::string> started_;
  std::map<const Yaml*, const OwnNames*> names_;
  std::map<const Yaml*, bool> says_ground_;
};

}  // namespace

bool has_copies(const Yaml& scene) {
  const auto group_repeats = [](const Yaml& section) { return std::ranges::any_of(section.items, repeats); };
  return std::ranges::any_of(scene.items, [&](const Yaml& section) {
    if (section.key == "assemblies" || section.key == "instances") return true;
    if (section.key == "ground") return std::ranges::any_of(section.items, group_repeats);
    return (section.key == "start" || !is_of_the_whole(section.key)) && group_repeats(section);
  });
}

void expand(Yaml& scene, Source& source) { scene = Expansion(scene, source).whole(); }

}  // namespace pintle
