#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "framework/common/text.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

const std::array<KindKeys, 2> driver_kinds{{{"angle", {"law", "engaged"}}, {"distance", {"law", "engaged"}}}};

const std::array<KindKeys, 6> force_kinds{{{"force", {"at", "follows", "engaged"}},
                                           {"torque", {"on", "from", "engaged"}},
                                           {"spring", {"stiffness", "damping", "free length", "law", "engaged"}},
                                           {"torsion spring", {"stiffness", "damping", "free angle", "law", "engaged"}},
                                           {"maxwell", {"stiffness", "damping", "engaged"}},
                                           {"belt", {"stiffness", "damping", "radii", "crossed", "pretension"}}}};

void must_have(const Node& node, std::string_view key, const std::string& example) {
  if (!node.has(key)) node.fail("lacks a required key; add for example " + std::string(key) + ": " + example);
}

SceneForce read_force(const Node& node) {
  must_have(node, "at", "crank.A");
  SceneForce force{read_point_ref(node.at("at")), {}, {}};
  if (node.has("follows")) force.follows = node.at("follows").yes();
  return force;
}

SceneTorque read_torque(const Node& node) {
  must_have(node, "on", "crank");
  PointRef from{"ground", "", node.place()};
  if (node.has("from")) from = read_point_ref(node.at("from"));
  return {from, read_point_ref(node.at("on")), {}};
}

// Common part of the two kinds of springs.
template <class Spring>
Spring read_ends_and_rates(const Node& node, std::string_view kind, const Dimension& stiffness, const Dimension& damping) {
  if (node.has("law"))
    for (const char* other : {"stiffness", "damping", "free length", "free angle"})
      if (node.has(other))
        node.at(other).fail("cannot be combined with `law`, which gives the whole force of the spring; keep one of them");
  if (!node.has("stiffness") && !node.has("damping") && !node.has("law"))
    node.fail("has neither stiffness nor damping; add stiffness, damping or both, or a law");
  Spring spring;
  std::tie(spring.a, spring.b) = read_ends(node.at(kind));
  read_optional(node, "stiffness", stiffness, rule::positive, spring.stiffness);
  read_optional(node, "damping", damping, rule::not_negative, spring.damping);
  return spring;
}

SceneSpring read_spring(const Node& node) {
  if (node.has("stiffness")) must_have(node, "free length", "50 mm");
  auto spring = read_ends_and_rates<SceneSpring>(node, "spring", dimension::stiffness, dimension::damping);
  read_optional(node, "free length", dimension::length, rule::not_negative, spring.free_length);
  return spring;
}

SceneTorsionSpring read_torsion_spring(const Node& node) {
  auto spring = read_ends_and_rates<SceneTorsionSpring>(node, "torsion spring", dimension::torsion_stiffness, dimension::torsion_damping);
  read_optional(node, "free angle", dimension::angle, rule::any, spring.free_angle);
  return spring;
}

SceneMaxwell read_maxwell(const Node& node) {
  must_have(node, "stiffness", "200 N/mm");
  must_have(node, "damping", "4 N s/mm");
  SceneMaxwell out;
  std::tie(out.a, out.b) = read_ends(node.at("maxwell"));
  read_optional(node, "stiffness", dimension::stiffness, rule::positive, out.stiffness);
  read_optional(node, "damping", dimension::damping, rule::positive, out.damping);
  return out;
}

SceneBelt read_belt(const Node& node) {
  must_have(node, "radii", "[40 mm, 80 mm]");
  must_have(node, "stiffness", "20 kN (its force over its strain)");
  SceneBelt out;
  const std::vector<Node> pulleys = node.at("belt").list(2, "two pulleys or more in the order in which the belt runs: [motor, drum]");
  for (const Node& p : pulleys) out.pulleys.push_back(read_point_ref(p));
  const std::string remedy = "a radius for each of the " + std::to_string(pulleys.size()) + " pulleys";
  out.radii =
      read_quantities(node.at("radii"), pulleys.size(), dimension::length, {[](double r) { return r != 0; }, "must not be 0"}, remedy);
  if (node.has("crossed") && node.at("crossed").yes()) {
    if (pulleys.size() > 2)
      node.at("crossed").fail("is for two pulleys only; with more, give a negative radius to those that the belt goes round the other way");
    if (out.radii[0] < 0 || out.radii[1] < 0)
      node.at("radii").fail("has a negative radius, which already gives the direction of the belt; leave out crossed, or the sign");
    out.radii[1] = -out.radii[1];
  }
  out.stiffness = node.at("stiffness").quantity(dimension::force, rule::positive);
  read_optional(node, "damping", {1, 1, -1, 0}, rule::not_negative, out.damping);
  read_optional(node, "pretension", dimension::force, rule::not_negative, out.pretension);
  return out;
}

// Time up to which laws are checked.
double end_of_run(const Scene& scene) { return scene.has_run ? scene.run.until : 0; }

// The laws of a force, which may name anything in the scene.
void read_laws_of(const Node& node, const std::filesystem::path& folder, double until, ActingSignals& signals, SceneLoad& load) {
  const auto law = [&](const Node& at, std::string_view keys, const Dimension& d) {
    return read_load_law(at, keys, d, folder, until, signals);
  };
  if (auto* force = std::get_if<SceneForce>(&load.what)) {
    const auto parts = node.at("force").items(2, "two components [x, y], each a force or a law in t and signals");
    force->x = law(parts[0], "forces.*.force.*", dimension::force);
    force->y = law(parts[1], "forces.*.force.*", dimension::force);
  } else if (auto* torque = std::get_if<SceneTorque>(&load.what)) {
    torque->law = law(node.at("torque"), "forces.*.torque", dimension::torque);
  } else if (auto* spring = std::get_if<SceneSpring>(&load.what); spring && node.has("law")) {
    spring->law = law(node.at("law"), "forces.*.law", dimension::force);
  } else if (auto* torsion = std::get_if<SceneTorsionSpring>(&load.what); torsion && node.has("law")) {
    torsion->law = law(node.at("law"), "forces.*.law", dimension::torque);
  }
}

// "90 + t", which may be meant in degrees.
void doubt_bare_law(const Node& law, const Law& read) {
  constexpr double turn = 2 * std::numbers::pi;
  if (!law.source().doubts || !law.is_scalar() || !read.at || !(std::abs(read.at(0).value) > turn)) return;
  const auto named = [](const Word& w) { return w.kind == Word::Kind::name && w.text != "t"; };
  if (std::ranges::any_of(spell(read.text, {law.source().parameters}), named)) return;
  law.source().doubts->push_back(SceneError(law.source().file, law.place(),
                                            law.shown() + " without units is in rad, " + number_text(read.at(0).value / turn, 3) +
                                                " turns at the start; if degrees are meant, write deg after its numbers, otherwise rad")
                                     .what());
}

}  // namespace

void read_drivers(const Node& root, const std::filesystem::path& folder, Scene& scene) {
  if (!root.has("drivers")) return;
  for (const Node& node : root.at("drivers").entries("names and drivers: {motor: {angle: [ground, crank], law: 150 rad/s*t}}")) {
    SceneDriver driver;
    driver.name = checked_name(node);
    driver.place = node.place();
    check_keys(node, "drivers.*");
    const std::size_t kind = which_kind(node, driver_kinds);
    driver.kind = kind == 0 ? DriverKind::angle : DriverKind::distance;
    std::tie(driver.a, driver.b) = read_ends(node.at(driver_kinds[kind].kind));
    driver.engaged = read_engaged(node);
    const Node law = node.at("law");
    const Dimension imposed = kind == 0 ? dimension::angle : dimension::length;
    driver.from_present = says_present(law);
    driver.law = driver.from_present ? read_after_present(law, imposed, end_of_run(scene))
                                     : read_time_law(law, imposed, Smoothness::driver, folder, end_of_run(scene));
    if (kind == 0 && !driver.from_present) doubt_bare_law(law, driver.law);
    scene.drivers.push_back(std::move(driver));
  }
}

void read_forces(const Node& root, Scene& scene) {
  if (!root.has("forces")) return;
  for (const Node& node : root.at("forces").entries("names and forces: {load: {force: [0, -10 N], at: crank.A}}")) {
    SceneLoad load{checked_name(node), {}, node.place()};
    check_keys(node, "forces.*");
    switch (which_kind(node, force_kinds)) {
      case 0: load.what = read_force(node); break;
      case 1: load.what = read_torque(node); break;
      case 2: load.what = read_spring(node); break;
      case 3: load.what = read_torsion_spring(node); break;
      case 4: load.what = read_maxwell(node); break;
      default: load.what = read_belt(node);
    }
    load.engaged = read_engaged(node);
    scene.loads.push_back(std::move(load));
  }
}

void read_force_laws(const Node& root, const std::filesystem::path& folder, Scene& scene) {
  if (!root.has("forces")) return;
  ActingSignals signals(root, scene);
  const std::vector<Node> entries = root.at("forces").entries("");
  for (std::size_t i = 0; i < entries.size(); ++i)
    read_laws_of(entries[i], folder, end_of_run(scene), signals, scene.loads[scene.loads.size() - entries.size() + i]);
}

}  // namespace pintle
