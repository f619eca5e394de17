// Holds docs/scene.schema.json against the reader: the same keys, the same choices, the same
// verdicts.
#include <gtest/gtest.h>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "contact/cylinder_law.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/reader.h"
#include "tests/unit/scene/scene_of_every_key.h"

namespace pintle::scene_schema_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const Json& schema_json() {
  static const Json json = Json::parse(std::ifstream(fs::path(PINTLE_SOURCE_DIR) / "docs/scene.schema.json"));
  return json;
}

// Every schema that may apply where `schema` does: itself, what it refers to, and its alternatives.
void collect(const Json& schema, std::vector<const Json*>& out) {
  out.push_back(&schema);
  if (schema.contains("$ref")) {
    const std::string name = schema["$ref"].get<std::string>().substr(std::string("#/definitions/").size());
    collect(schema_json()["definitions"][name], out);
  }
  for (const char* word : {"allOf", "anyOf", "oneOf"})
    if (schema.contains(word))
      for (const Json& part : schema[word]) collect(part, out);
}

std::vector<const Json*> alternatives(const std::vector<const Json*>& schemas) {
  std::vector<const Json*> out;
  for (const Json* schema : schemas) collect(*schema, out);
  return out;
}

// The schemas one key deeper; * takes whatever name is given, and every entry of a list.
std::vector<const Json*> inside(const std::vector<const Json*>& schemas, const std::string& key) {
  std::vector<const Json*> out;
  for (const Json* schema : schemas) {
    const bool any = key == "*";
    if (schema->contains("properties"))
      for (const auto& [name, value] : (*schema)["properties"].items())
        if (any || name == key) out.push_back(&value);
    if (any && schema->contains("additionalProperties") && (*schema)["additionalProperties"].is_object())
      out.push_back(&(*schema)["additionalProperties"]);
    if (any && schema->contains("items")) out.push_back(&(*schema)["items"]);
  }
  return alternatives(out);
}

std::vector<const Json*> schemas_at(const std::string& path) {
  std::vector<const Json*> at = alternatives({&schema_json()});
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    at = inside(at, path.substr(begin, end - begin));
    begin = end + 1;
  }
  return at;
}

std::set<std::string> keys_in(const std::vector<const Json*>& schemas) {
  std::set<std::string> out;
  for (const Json* schema : schemas)
    if (schema->contains("properties"))
      for (const auto& [name, value] : (*schema)["properties"].items()) out.insert(name);
  return out;
}

// Required by every alternative that has keys at all.
bool required_in(const std::vector<const Json*>& schemas, const std::string& key) {
  return std::ranges::all_of(schemas, [&](const Json* schema) {
    if (!schema->contains("properties")) return true;
    const Json list = schema->value("required", Json::array());
    return std::any_of(list.begin(), list.end(), [&](const Json& word) { return word == key; });
  });
}

TEST(SceneSchema, KnowsExactlyTheKeysOfTheReader) {
  for (const KeyTable& table : key_tables()) {
    std::set<std::string> known;
    for (const Key& key : table.keys) known.insert(key.name);
    EXPECT_EQ(keys_in(schemas_at(table.path)), known) << "at \"" << table.path << "\"";
  }
}

TEST(SceneSchema, RequiresExactlyWhatTheReaderRequires) {
  for (const KeyTable& table : key_tables())
    for (const Key& key : table.keys)
      EXPECT_EQ(required_in(schemas_at(table.path), key.name), key.required) << table.path << "." << key.name;
}

TEST(SceneSchema, OffersExactlyTheChoicesOfTheReader) {
  for (const KeyTable& table : key_tables())
    for (const Key& key : table.keys) {
      std::set<std::string> offered;
      for (const Json* schema : inside(schemas_at(table.path), key.name)) {
        if (schema->contains("enum"))
          for (const Json& word : (*schema)["enum"]) offered.insert(word.get<std::string>());
        if (schema->value("type", Json()) == "boolean") offered = {"false", "true"};
      }
      EXPECT_EQ(offered, std::set<std::string>(key.choices.begin(), key.choices.end())) << table.path << "." << key.name;
    }
}

TEST(SceneSchema, OffersExactlyTheNormalLawsOfContact) {
  std::set<std::string> known;
  for (const ImpactFactor& factor : impact_factors()) known.emplace(factor.name);
  for (const CylinderLaw& law : cylinder_laws()) known.emplace(law.name);
  known.insert("spring-damper");
  known.insert("table");
  EXPECT_EQ(keys_in(schemas_at("joints.*.clearance.normal")), known);
  EXPECT_EQ(keys_in(schemas_at("contacts.*.normal")), known);
}

// Groups of the schema that no table of the reader describes would be keys it does not know.
void count_groups(const Json& schema, std::set<const Json*>& groups) {
  std::vector<const Json*> here;
  collect(schema, here);
  for (const Json* part : here) {
    if (part->contains("properties") && !groups.insert(part).second) continue;
    if (part->contains("properties"))
      for (const auto& [name, value] : (*part)["properties"].items()) count_groups(value, groups);
    for (const char* word : {"additionalProperties", "items"})
      if (part->contains(word) && (*part)[word].is_object()) count_groups((*part)[word], groups);
  }
}

TEST(SceneSchema, HasNoGroupTheReaderLacks) {
  std::set<const Json*> all, seen;
  count_groups(schema_json(), all);
  for (const KeyTable& table : key_tables())
    for (const Json* schema : schemas_at(table.path))
      if (schema->contains("properties")) seen.insert(schema);
  for (const Json* group : all) {
    const bool names_laws = (*group)["properties"].contains("hertz");
    EXPECT_TRUE(names_laws || seen.contains(group)) << group->dump().substr(0, 200);
  }
}

// The tree as an editor sees it: plain scalars that are JSON numbers or truths become those.
Json as_json(const Yaml& yaml) {
  switch (yaml.kind) {
    case Yaml::Kind::nothing: return nullptr;
    case Yaml::Kind::scalar: {
      const Json value = Json::parse(yaml.text, nullptr, false);
      return value.is_number() || value.is_boolean() ? value : Json(yaml.text);
    }
    case Yaml::Kind::list: {
      Json list = Json::array();
      for (const Yaml& item : yaml.items) list.push_back(as_json(item));
      return list;
    }
    case Yaml::Kind::map: break;
  }
  Json map = Json::object();
  for (const Yaml& entry : yaml.items) map[entry.key] = as_json(entry);
  return map;
}

// Empty if the schema accepts the scene.
std::string verdict(const std::string& text) {
  valijson::Schema schema;
  valijson::SchemaParser parser;
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json()), schema);
  const Json scene = as_json(parse_yaml(text, "scene"));
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(scene);
  if (valijson::Validator().validate(schema, target, &results)) return {};
  std::string out = "refused";
  for (valijson::ValidationResults::Error error; results.popError(error);) {
    out += "; ";
    for (const std::string& part : error.context) out += part;
    out += ": " + error.description;
  }
  return out;
}

TEST(SceneSchema, AcceptsWhatTheReaderAccepts) {
  EXPECT_EQ(verdict(base), "");
  const Scene scene = read_scene_text(base, "base");
  EXPECT_EQ(verdict(scene.filled_in), "") << scene.filled_in;
}

TEST(SceneSchema, AcceptsEveryExample) {
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(PINTLE_SOURCE_DIR) / "examples")) {
    if (entry.path().extension() != ".yaml" || entry.path().parent_path().filename() == "studies") continue;
    std::ifstream in(entry.path());
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    EXPECT_EQ(verdict(text), "") << entry.path();
    EXPECT_NO_THROW(read_scene(entry.path())) << entry.path();
  }
}

TEST(SceneSchema, RefusesWithTheReader) {
  const std::vector<std::pair<std::string, std::string>> spoiled{
      {"mass: 1 kg", "mas: 1 kg"},
      {"mass: 1 kg", "mass: -1 kg"},
      {"mass: 1 kg", "mass: [1, 2]"},
      {"[10 mm, 0]", "[10 mm, 0, 0]"},
      {"revolute: [ground", "revolt: [ground"},
      {"length: 1}", "angle: 1}"},
      {"length: 1}", "length: 1, slot: [ground, crank]}"},
      {"restitution: 0.5", "restitution: 1.5"},
      {"flores", "hertz"},
      {"radii: external", "radii: outer"},
      {"geometric", "geometrical"},
      {"young: 2e11, ", ""},
      {"young: 2e11", "stiffness: 1, young: 2e11"},
      {"law: 3*t", "low: 3*t"},
      {"law: 3*t", "law: {file: a.csv}"},
      {"follows: true", "follows: 3"},
      {", at: crank.A", ""},
      {", free length: 0", ""},
      {"damping: 10", "stiffness: 0"},
      {"at: [0, 0], vx", "at: [0, 0], x: 1, vx"},
      {"until: 1", "until: 0"},
      {"method: dopri5", "method: euler"},
      {"{cut: 1 nm}", "later"},
      {"frames: 3", "frames: -3"},
      {"deformation: auto", "deformation: 0"},
      {"points: [crank.A, ground.C, rod]", "points: crank.A"},
      {"points: [crank.A, ground.C, rod]", "points: [rod, rod]"},
      {"stress: [rod.A]", "stress: [rod]"},
      {"stress: [rod.A]", "stress: []"},
      {"pieces: 2", "pieces: 0"},
      {"theory: timoshenko, shear factor: 5/6, rotary inertia: false, elements", "theory: bar, elements"},
      {"    modes: {frame: {chord: [A, B]}, below: 5 kHz}\n    damping: {rayleigh: {ratios: [0.01, 0.02], modes: [1, 3]}}\n    stiffening: "
       "axial\n",
       ""},
      {"    modes: {frame: tangent, keep: all, boundary: massless}\n", "    stiffening: axial\n"},
      {"stiffening: axial", "stiffening: all"},
      {"free: {keep: auto}", "free: {keep: auto, count: 3}"},
      {"  crank: {rigid", "  crank: {stiffening: none, rigid"},
      {"max steps: 10", "max steps: 1.5"},
      {"output:", "outputs:"},
      {"crank.A]", "crank.A.B]"},
      {"young: 2e11, poisson: 0.3, density", "young: 2e11, density"},
      {"poisson: 0.3, density", "poisson: 0.5, density"},
      {"density: 7850", "density: -7850"},
      {"young: [1e11, 1e10]", "young: 1e11"},
      {"shear: 5e9, ", ""},
      {"from: A, ", ""},
      {"through: [A, B, C]", "through: [A]"},
      {"to: B, section", "to: B, through: [A, B], section"},
      {"section: {tube", "section: {pipe"},
      {"section: {tube: [0.02, 0.01]}", "section: {tube: [0.02, 0.01], circle: 1}"},
      {"section: {tube: [0.02, 0.01]}", "section: {tube: 0.02}"},
      {"web: 0.004, ", ""},
      {"material: ply, mass: 1", "material: ply, young: 1e9, mass: 1"},
      {"mass: 1,\n", "mass: 1, density: 2,\n"},
      {"theory: euler", "theory: bernoulli"},
      {"shear factor: 5/6", "shear factor: 0.83"},
      {"elements: 4", "elements: 0"},
      {"below: 5 kHz", "below: 5 kHz, count: 3"},
      {"below: 5 kHz", "below: -5"},
      {"{effective mass: 0.9}", "{effective mass: 1.5}"},
      {"keep: all", "keep: some"},
      {"keep: all", "keep: all, free: {}"},
      {"frame: tangent", "frame: chordal"},
      {"modes: [1, 3]", "modes: [0, 3]"},
      {"ratios: [0.01, 0.02]}", "ratios: [0.01, 2]}"},
      {"alpha: 3 1/s", "ratios: [0.1, 0.1]"},
      {"mass matrix: lumped", "mass matrix: diagonal"},
      {"lumps: {B: {mass: 0.1, inertia: 0.01}}", "lumps: {B: {}}"},
      {"A: fixed", "A: clamped"},
      {"  crank: {rigid", "  crank: {supports: {}, rigid"},
      {"    plate: {grid", "    beam: {}\n    plate: {grid"},
      {"link: {triangle", "link: {triangel"},
      {"thickness: 0.008", "thickness: 0"},
      {"plane: strain", "plane: shear"},
      {"quadrilateral8-reduced", "quad8"},
      {"      size: 3 mm\n", "      size: 3 mm\n      scale: 2\n"},
      {"cells: [4, 2]", "cells: [4, 0]"},
      {"{hole: eye 1, coupling: average}", "{coupling: average}"},
      {"{hole: eye 1, coupling: average}", "{hole: eye 1, coupling: soft}"},
      {"torque: 1, at: foot", "torque: 1"},
      {"torque: 1, at", "torque: 1, on"},
      {"pressure: 1, on: eye 2", "pressure: [1, 2], on: eye 2"},
      {"between: [crank.pin, ground.socket]", "between: [crank.pin]"},
      {"hole: D, radius: 20 mm", "hole: D"},
      {"material: right", "material: up"},
      {"closed: true", "closed: maybe"},
      {"damping: 15", "damping: -1"},
      {"second: {young: 1 GPa, ", "second: {"},
      {"length: 20 mm, ", ""},
      {"length: 20 mm", "length: 0"},
      {"hysteresis: flores", "hysteresis: hertz"},
      {", restitution: 0.7", ""},
      {"johnson: {length: 20 mm", "johnson: {length: 20 mm, exponent: 1.1"},
      {"[1 um, 50 N], ", "[1 um], "},
      {"points: [[0, 0], [1 um, 50 N], [5 um, 400 N]], ", ""},
      {"restitution: 0.5}}}\ndrivers", "restitution: 0.5, force unit: N}}}\ndrivers"},
      {"{arc: 2 m}", "{ark: 2 m}"},
      {"round: 1 mm", "round: 0"},
      {"  body: bracket\n  loads:", "  body: bracket\n  load:"},
      {"of: cell, ", ""},
      {"of: cell, repeat: 2", "of: cell, repeat: -1"},
      {"mirror: y", "mirror: z"},
      {"world: [w, 0]", "world: w"},
      {"ports: [on]", "ports: on"},
      {"colour: teal", "colour: 7"}};
  for (const auto& [from, to] : spoiled) {
    std::string text = base;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    EXPECT_THROW(read_scene_text(text, "spoiled"), SceneError) << to;
    EXPECT_NE(verdict(text), "") << to;
  }
}

}  // namespace
}  // namespace pintle::scene_schema_test
