#include "framework/scene/keys.h"

#include <algorithm>

#include "framework/scene/nearest.h"

namespace pintle {

namespace {

constexpr bool required = true, optional = false;

const std::vector<KeyTable>& tables() {
  static const std::vector<KeyTable> all{
      {"",
       {{"title"},
        {"gravity"},
        {"parameters"},
        {"ground"},
        {"bodies", required, "{crank: {rigid: {mass: 0.3 kg, inertia: 1e-4 kg m^2}}}"},
        {"joints"},
        {"drivers"},
        {"forces"},
        {"start"},
        {"run", required, "{until: 1 s}"},
        {"output"}}},
      {"ground", {{"points"}}},
      {"ground.points.*", {{"at", required, "[10 mm, 0]"}, {"angle"}}},
      {"bodies.*",
       {{"rigid", required, "{mass: 0.3 kg, inertia: 1e-4 kg m^2}"}, {"points"}, {"pose"}}},
      {"bodies.*.rigid",
       {{"mass", required, "0.3 kg"}, {"inertia", required, "1e-4 kg m^2"}, {"center"}}},
      {"bodies.*.points.*", {{"at", required, "[10 mm, 0]"}, {"angle"}}},
      {"bodies.*.pose", {{"at"}, {"angle"}}},
      {"joints.*",
       {{"revolute"},
        {"prismatic"},
        {"slot"},
        {"weld"},
        {"distance"},
        {"angle"},
        {"length"},
        {"clearance"}}},
      {"joints.*.clearance",
       {{"radial", required, "0.1 mm"},
        {"bearing radius", required, "10 mm"},
        {"bearing", required, "slider"},
        {"normal", required,
         "{lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}"},
        {"friction"}}},
      {"joints.*.clearance.normal.*",
       {{"restitution"},
        {"young"},
        {"poisson"},
        {"stiffness"},
        {"exponent"},
        {"radii", optional, "", {"internal", "external"}},
        {"slowest impact"},
        {"journal"}}},
      {"joints.*.clearance.normal.*.journal",
       {{"young", required, "207 GPa"}, {"poisson", required, "0.3"}}},
      {"joints.*.clearance.friction", {{"ambrosio", required, "{coefficient: 0.1}"}}},
      {"joints.*.clearance.friction.ambrosio",
       {{"coefficient", required, "0.1"},
        {"v0"},
        {"v1"},
        {"sliding", optional, "", {"material", "geometric"}}}},
      {"drivers.*", {{"angle"}, {"distance"}, {"law", required, "150 rad/s*t"}}},
      {"drivers.*.law",
       {{"table", required, "motion.csv"},
        {"interpolation", optional, "", {"spline", "linear"}},
        {"time unit"},
        {"value unit"}}},
      {"forces.*",
       {{"force"},
        {"at"},
        {"follows", optional, "", {"true", "false"}},
        {"torque"},
        {"on"},
        {"from"},
        {"spring"},
        {"torsion spring"},
        {"stiffness"},
        {"damping"},
        {"free length"},
        {"free angle"}}},
      {"forces.*.torque",
       {{"table", required, "torque.csv"},
        {"interpolation", optional, "", {"spline", "linear"}},
        {"time unit"},
        {"value unit"}}},
      {"start.*",
       {{"at"},
        {"x"},
        {"y"},
        {"angle"},
        {"velocity"},
        {"vx"},
        {"vy"},
        {"speed"},
        {"eccentricity"}}},
      {"run",
       {{"until", required, "0.1 s"},
        {"method", optional, "", {"rkf45", "dopri5"}},
        {"tolerance"},
        {"constraints", optional, "", {"projection", "partitioning"}},
        {"onset", optional, "", {"locate"}},
        {"max step"},
        {"max steps"},
        {"ledger bound"}}},
      {"run.onset", {{"cut", required, "1e-8 m"}}},
      {"output", {{"every"}, {"frames"}, {"exaggerate"}}}};
  return all;
}

const KeyTable& table_at(std::string_view path) {
  return *std::ranges::find(tables(), path, &KeyTable::path);
}

std::vector<std::string> names(const KeyTable& table) {
  std::vector<std::string> out;
  for (const Key& key : table.keys) out.push_back(key.name);
  return out;
}

}  // namespace

std::span<const KeyTable> key_tables() {
  return tables();
}

std::span<const std::string> choices(std::string_view path, std::string_view key) {
  return std::ranges::find(table_at(path).keys, key, &Key::name)->choices;
}

void check_keys(const Node& group, std::string_view path) {
  const KeyTable& table = table_at(path);
  const std::vector<std::string> known = names(table);
  for (const Node& entry : group.entries("keys and values: " + listed(known)))
    if (std::ranges::find(known, entry.name()) == known.end())
      entry.fail("unknown key \"" + entry.name() + "\"." +
                 (entry.is_nothing() ? std::string(" ") + hint_about_commas
                                     : did_you_mean(entry.name(), known)));
  std::string missing;
  for (const Key& key : table.keys)
    if (key.required && !group.has(key.name))
      missing += (missing.empty() ? "" : ", and ") + key.name + ": " + key.example;
  if (!missing.empty()) group.fail("lacks a required key; add for example " + missing);
}

std::size_t which_kind(const Node& group, std::span<const KindKeys> kinds) {
  std::vector<std::string> all, found;
  std::size_t which = 0;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    all.push_back(kinds[i].kind);
    if (!group.has(kinds[i].kind)) continue;
    found.push_back(kinds[i].kind);
    which = i;
  }
  if (found.empty()) group.fail("does not say what it is; add one of " + listed(all));
  if (found.size() > 1) group.fail("is " + listed(found, "and") + " at once; keep one of them");
  const KindKeys& kind = kinds[which];
  for (const std::string& key : group.keys()) {
    if (key == kind.kind || std::ranges::find(kind.beside, key) != kind.beside.end()) continue;
    std::vector<std::string> owners;
    for (const KindKeys& other : kinds)
      if (std::ranges::find(other.beside, key) != other.beside.end()) owners.push_back(other.kind);
    group.at(key).fail("does not belong to " + kind.kind + " but to " + listed(owners) +
                       "; leave it out");
  }
  return which;
}

}  // namespace pintle
