// Holds docs/study.schema.json against the reader of studies: the same keys, choices and needs, and all examples.
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "framework/scene/yaml/keys.h"

namespace pintle::study_schema_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const Json& schema_json() {
  static const Json json = Json::parse(std::ifstream(fs::path(PINTLE_SOURCE_DIR) / "docs/study.schema.json"));
  return json;
}

/// The schema itself, what it refers to, and its alternatives.
void collect(const Json& schema, std::vector<const Json*>& out) {
  out.push_back(&schema);
  if (schema.contains("$ref")) collect(schema_json().at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1))), out);
  for (const char* word : {"allOf", "anyOf"})
    if (schema.contains(word))
      for (const Json& part : schema[word]) collect(part, out);
}

/// What may stand at a table's path: "study.sweep.grid.*".
std::vector<const Json*> schemas_at(const std::string& path) {
  std::vector<const Json*> at;
  collect(schema_json(), at);
  std::istringstream steps(path);
  std::string step;
  std::getline(steps, step, '.');
  while (std::getline(steps, step, '.')) {
    std::vector<const Json*> inside;
    for (const Json* schema : at) {
      const char* within = step == "*" ? "additionalProperties" : "properties";
      if (!schema->contains(within)) continue;
      const Json& next = (*schema)[within];
      if (step == "*" && next.is_object()) collect(next, inside);
      if (step != "*" && next.contains(step)) collect(next[step], inside);
    }
    at = inside;
  }
  std::erase_if(at, [](const Json* schema) { return !schema->contains("properties"); });
  return at;
}

TEST(StudySchema, KnowsWhatTheReaderKnowsAndRequiresWhatItRequires) {
  for (const KeyTable& table : study_tables()) {
    const std::vector<const Json*> at = schemas_at(table.path);
    ASSERT_EQ(at.size(), 1u) << table.path;
    std::set<std::string> known, required, written, needed;
    for (const Key& key : table.keys) {
      known.insert(key.name);
      if (key.required) required.insert(key.name);
      std::set<std::string> offered;
      for (const Json& word : (*at[0])["properties"].value(key.name, Json::object()).value("enum", Json::array()))
        offered.insert(word.get<std::string>());
      EXPECT_EQ(offered, std::set<std::string>(key.choices.begin(), key.choices.end())) << table.path << "." << key.name;
    }
    for (const auto& [name, unused] : (*at[0])["properties"].items()) written.insert(name);
    for (const Json& name : at[0]->value("required", Json::array())) needed.insert(name.get<std::string>());
    EXPECT_EQ(written, known) << table.path;
    EXPECT_EQ(needed, required) << table.path;
  }
}

/// The tree as an editor sees it: plain scalars that are JSON numbers or truths become those.
Json as_json(const Yaml& yaml) {
  if (yaml.kind == Yaml::Kind::nothing) return nullptr;
  if (yaml.kind == Yaml::Kind::scalar) {
    const Json value = Json::parse(yaml.text, nullptr, false);
    return value.is_number() || value.is_boolean() ? value : Json(yaml.text);
  }
  Json out = yaml.kind == Yaml::Kind::list ? Json::array() : Json::object();
  for (const Yaml& item : yaml.items) {
    if (yaml.kind == Yaml::Kind::list)
      out.push_back(as_json(item));
    else
      out[item.key] = as_json(item);
  }
  return out;
}

bool accepted(const std::string& text) {
  valijson::Schema schema;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_json()), schema);
  const Json study = as_json(parse_yaml(text, "study"));
  return valijson::Validator().validate(schema, valijson::adapters::NlohmannJsonAdapter(study), nullptr);
}

TEST(StudySchema, AcceptsEveryExample) {
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(PINTLE_SOURCE_DIR) / "examples/studies")) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream in(entry.path());
    EXPECT_TRUE(accepted(std::string(std::istreambuf_iterator<char>(in), {}))) << entry.path();
    ++seen;
  }
  EXPECT_GE(seen, 4);
}

TEST(StudySchema, AcceptsAllKindsOfCasesAndRefusesWhatIsNone) {
  const std::string head = "scene: a.yaml\nmeasure: energy lost\n";
  for (const char* good : {"", "sweep: {grid: {c: [1 mm, 2], speed: {from: 1, to: 2 rad/s, count: 4, scale: log}}}",
                           "sweep: {list: [{c: 1}, {run.method: dopri5}]}", "sweep: {list: {c: [1, 2]}, limit: 3 s, most steps: 100}",
                           "sweep: {random: {count: 9, seed: 2, c: {from: 1, to: 2}, d: [a, b]}}",
                           "sweep: {latin hypercube: {count: 9, c: {from: 1, to: 2, scale: linear}}}",
                           "tradeoff: {error: 1%, axes: {t: {run.tolerance: [1e-4, 1e-6]}}}",
                           "analysis: linearize\nequilibrium: true\nat: 1 s\nkeep: [x of slider]\nsituations: {idle: {speed: 1}}",
                           "vary: {a: {from: 1, to: 2 mm, start: 1, scale: log}}\ngoal: {reach: {f: 5 Hz, g: {to: 1, tolerance: 2}}}\n"
                           "subject to: {f: {at most: 1 Hz}}\nfit: {method: slsqp, starts: 2, step: 1e-3}",
                           "goal: {path: {point: a.b, through: [[0, 1], [2 mm, 0]], order: any}}",
                           "sensitivity: {parameters: {a: {uniform: 1}, b: {normal: 1, step: 2, at: 3}}, sobol: {count: 9}}"})
    EXPECT_TRUE(accepted(head + good)) << good;
  for (const char* bad :
       {"sweeps: {}", "sweep: {grd: {}}", "sweep: {grid: {c: 1}}", "sweep: {grid: {c: {from: 1, to: 2}}}",
        "sweep: {grid: {c: {from: 1, to: 2, count: 3, scale: lg}}}", "sweep: {random: {c: {from: 1, to: 2}}}", "tradeoff: {error: 1%}",
        "tradeoff: {axes: {}}", "analysis: running", "goal: {minimise: a, maximise: b}", "goal: {path: {point: a.b}}",
        "vary: {a: {from: 1}}", "fit: {method: newton}", "subject to: {a: {below: 1}}", "sensitivity: {sobol: {count: 9}}"})
    EXPECT_FALSE(accepted(head + bad)) << bad;
  EXPECT_TRUE(accepted("scene: a.yaml\ngoal: {minimise: energy lost}\n"));
  EXPECT_FALSE(accepted("scene: a.yaml\n"));
  EXPECT_FALSE(accepted("scene: a.yaml\nmeasure: {}\n"));
}

}  // namespace
}  // namespace pintle::study_schema_test
