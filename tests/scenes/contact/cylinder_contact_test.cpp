// Laws of cylinders and tables from a scene's words to a run: what is said, refused, stored, lost and warned of.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "contact/cylinder_law.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/configuration/equilibrium.h"
#include "framework/output/run_files.h"
#include "framework/scene/error.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::cylinder_contact_test {
namespace {

using namespace pintle;

constexpr double mass = 0.2, speed = 0.05, radial = 1e-4;  // [kg], [m/s], [m]
const std::string steel = "length: 15 mm, young: 207 GPa, poisson: 0.3";
const std::string points = "points: [[0, 0], [1 um, 50 N], [5 um, 400 N], [20 um, 2.1 kN]]";

/// A pin flies into the wall of its hole.
Scene flying(const std::string& normal, const std::string& more = "", const std::filesystem::path& folder = {}) {
  return read_scene_text(R"(
ground: {points: {O: [0, 0]}}
bodies: {pin: {rigid: {mass: 0.2 kg, inertia: 1e-5 kg m^2}, points: {P: [0, 0]}}}
joints:
  bush: {revolute: [ground.O, pin.P], clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: ground, normal: )" +
                             normal + more + R"(}}
start: {bush: {speed: [50 mm/s, 0]}}
run: {until: 4 ms, tolerance: 1e-11, method: verner87}
)",
                         "scene", {}, folder);
}
/// Two discs that meet.
Scene rolling(const std::string& normal, const std::string& second = "disc: [0, 0], radius: 20 mm") {
  return read_scene_text(R"(
ground: {profiles: {wheel: {)" +
                             second + R"(}}}
bodies: {roll: {rigid: {mass: 0.2 kg, inertia: 1e-5 kg m^2}, profiles: {rim: {disc: [0, 0], radius: 10 mm}}}}
contacts: {touch: {between: [roll.rim, ground.wheel], normal: )" +
                             normal + R"(}}
start: {roll: {at: [30.1 mm, 0], vx: -50 mm/s}}
run: {until: 4 ms, tolerance: 1e-11, method: verner87}
)",
                         "scene");
}
std::string cylinders(std::string_view law, const std::string& more = "") {
  const std::string layer = find_cylinder_law(law)->of_a_layer ? ", layer: 1 mm" : "";
  return "{" + std::string(law) + ": {" + steel + layer + more + "}}";
}

void expect_one_clean_impact(const Whole& w, double chi, const std::string& law) {
  SCOPED_TRACE(law);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  ASSERT_GE(w.run.impacts.size(), 1u);
  const Impact& first = w.run.impacts[0];
  EXPECT_NEAR(first.approach, speed, 1e-9);
  EXPECT_NEAR(first.separation / first.approach, effective_restitution(chi), 1e-6);
  EXPECT_NEAR(first.lost / (mass * speed * speed / 2), 1 - std::pow(effective_restitution(chi), 2), 1e-6);
  EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-8 * w.run.energy_in_play);
  EXPECT_TRUE(w.run.warnings.empty()) << w.run.warnings[0];
}

TEST(CylinderContact, BooksCloseThroughAnImpactOfEveryLaw) {
  const double lankarani = find_impact_factor("lankarani-nikravesh")->chi(0.8), flores = find_impact_factor("flores")->chi(0.6);
  for (const CylinderLaw& law : cylinder_laws()) {
    const std::string name(law.name);
    expect_one_clean_impact(run(flying(cylinders(name, ", restitution: 0.8"))), lankarani, name);
    expect_one_clean_impact(run(flying(cylinders(name, ", restitution: 0.6, hysteresis: flores"))), flores, name);
    if (law.external) expect_one_clean_impact(run(rolling(cylinders(name))), 0, name + " of discs");
  }
  expect_one_clean_impact(run(flying("{table: {" + points + ", restitution: 0.8}}")), lankarani, "table");
  expect_one_clean_impact(run(rolling("{table: {" + points + "}}")), 0, "table of discs");
}

TEST(CylinderContact, GoesAsDeepAsItsEnergyTakesIt) {
  const Whole w = run(flying(cylinders("johnson")));
  const double deepest = w.run.impacts[0].deepest, S = M_PI * 207e9 / 1.82 * 15e-3, G = 4 * S * radial / M_E;
  const double force = w.run.impacts[0].peak_force;
  EXPECT_NEAR(force / S * std::log(G / force), deepest, 1e-9 * deepest);
  EXPECT_NEAR(force * force / (4 * S) * (2 * std::log(G / force) - 1), mass * speed * speed / 2, 1e-9);
}

TEST(CylinderContact, RestsWhereItsForceCarriesTheLoad) {
  Scene s = flying(cylinders("johnson"));
  s.gravity = {0, -9.81};
  s.start_journals.clear();
  const Scene ready = ready_for_statics(s);
  const Model model = build(ready);
  const Equilibrium rest = find_equilibrium(ready, model, assemble(ready, model), 0);
  ASSERT_TRUE(rest.found) << rest.reason;
  const double F = mass * 9.81, S = M_PI * 207e9 / 1.82 * 15e-3;
  const double depth = F / S * (std::log(4 * S * radial / F) - 1);
  EXPECT_NEAR(rest.table.column("bush.depth [m]").at(0) / depth, 1, 1e-6);
}

/// A pin that lies in its hole.
Whole resting(const std::string& normal) {
  Scene s = flying(normal);
  s.gravity = {0, -9.81};
  s.start_journals.clear();
  s.start_at_rest = true;
  return run(s);
}

// Hertz 1881 of a narrow contact, p = √(F E*/(π R L)); of a layer what K and the depth give. Without a theory there are no columns.
TEST(CylinderContact, SaysHowHardItPresses) {
  const double F = mass * 9.81, R = 10e-3 * 9.9e-3 / 1e-4, E = 207e9 / 1.82;
  for (const char* law : {"johnson", "liu", "pereira"}) {
    const Whole w = resting(cylinders(law));
    EXPECT_NEAR(w.last("bush.pressure [Pa]") / std::sqrt(F * E / (M_PI * R * 15e-3)), 1, 1e-4) << law;
    EXPECT_NEAR(w.last("bush.half angle [rad]") / (2 * std::sqrt(F * R / (M_PI * E * 15e-3)) / 9.95e-3), 1, 1e-4) << law;
  }
  const Whole lined = resting("{winkler: {length: 15 mm, layer: 1 mm, young: 2 GPa, poisson: 0.4}}");
  const double K = 0.6 * 2e9 / (1.4 * 0.2) / 1e-3, depth = lined.last("bush.depth [m]");  // (1 − ν)E/((1 + ν)(1 − 2ν)h)
  EXPECT_NEAR(lined.last("bush.pressure [Pa]") / (K * depth), 1, 1e-6);
  EXPECT_NEAR(std::cos(lined.last("bush.half angle [rad]")), radial / (radial + depth), 1e-9);
  const Whole table = resting("{table: {" + points + "}}");
  EXPECT_TRUE(std::ranges::none_of(table.run.trajectory.header, [](const std::string& h) { return h.find("pressure") != h.npos; }));
}

TEST(CylinderContact, WritesThePressureOfEveryStay) {
  const auto events = [](const std::string& normal) {
    const Scene scene = flying(normal);
    const Whole w = run(scene);
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "pintle_pressure_test";
    std::filesystem::create_directories(folder);
    RunFiles files(folder, scene, w.model);
    files.finish(w.run.impacts, {});
    std::ifstream in(folder / "events.csv");
    std::string heading, row;
    std::getline(in, heading), std::getline(in, row);
    std::filesystem::remove_all(folder);
    return std::tuple(heading, row, w.run.impacts[0].peak_force);
  };
  const auto [heading, row, force] = events(cylinders("johnson"));
  EXPECT_TRUE(heading.ends_with(",energy lost [J],peak pressure [Pa],half angle [rad]")) << heading;
  const double angle = std::stod(row.substr(row.rfind(',') + 1)), b2 = std::pow(std::tan(angle / 2), 2);
  const double q = force / (207e9 / 1.82 * radial * 15e-3);  // Persson 1964
  EXPECT_NEAR((2 - std::log(1 + b2) - 2 * b2 * b2) * q / (2 * M_PI * b2 * (1 + b2)), 1, 1e-9);
  EXPECT_EQ(std::get<0>(events("{table: {" + points + "}}")).find("pressure"), std::string::npos);
}

// A roller on a flat that a layer covers: F = (4√2/3) K L √R δ^1.5.
TEST(CylinderContact, ALayerMayLieOnAFlat) {
  const Whole w = run(rolling("{winkler: {length: 15 mm, stiffness: 4e12 N/m^3}}", "path: [[20 mm, -1], [20 mm, 1]], material: left"));
  ASSERT_GE(w.run.impacts.size(), 1u);
  const double k = 4 * std::sqrt(2.0) / 3 * 4e12 * 15e-3 * std::sqrt(10e-3), energy = mass * speed * speed / 2;
  EXPECT_NEAR(w.run.impacts[0].deepest, std::pow(2.5 * energy / k, 0.4), 1e-9);
  EXPECT_TRUE(w.run.warnings.empty());
}

TEST(CylinderContact, WarnsWhereALawEnds) {
  const auto warned = [](Scene s, const std::string& words) {
    s.start_journals[0].speed = {20, 0};
    s.run.until = 2e-5, s.run.tolerance = 1e-8;
    const Whole w = run(s);
    ASSERT_FALSE(w.run.warnings.empty()) << words;
    EXPECT_NE(w.run.warnings[0].find(words), std::string::npos) << w.run.warnings[0];
  };
  warned(flying(cylinders("johnson")), "\"bush\": its depth reached");
  warned(flying(cylinders("johnson")), "where its law, johnson, ends: the contact spans more than 30 degrees");
  warned(flying("{table: {" + points + "}}"),
         "beyond 2e-05 m where its law, table, ends: the law continues with its last slope there; add points");
}

TEST(CylinderContact, FilledInReadsBackToItself) {
  for (const CylinderLaw& law : cylinder_laws()) {
    const std::string journal = law.of_a_layer ? "" : ", journal: {young: 1 GPa, poisson: 0.2}";
    const Scene s = flying(cylinders(law.name, ", restitution: 0.8, hysteresis: exact" + journal));
    EXPECT_EQ(s.joints[0].clearance->normal.law, law.name);
    EXPECT_EQ(read_scene_text(s.filled_in, "again").filled_in, s.filled_in);
  }
  const Scene given = flying("{winkler: {length: 15 mm, stiffness: 4e12 N/m^3}}");
  EXPECT_EQ(*given.joints[0].clearance->normal.stiffness, 4e12);
  EXPECT_EQ(read_scene_text(given.filled_in, "again").filled_in, given.filled_in);
  const Scene table = flying("{table: {" + points + "}}");
  EXPECT_EQ(read_scene_text(table.filled_in, "again").filled_in, table.filled_in);
}

TEST(CylinderContact, ReadsItsTableFromAFile) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "pintle_cylinder_contact_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "bearing.csv") << "depth, force  # um, kN\n0, 0\n1, 0.05\n5, 0.4\n20, 2.1\n";
  const Scene s = flying("{table: {file: bearing.csv, depth unit: um, force unit: kN}}", "", folder);
  const std::vector<Pair> read = s.joints[0].clearance->normal.points, meant{{0, 0}, {1e-6, 50}, {5e-6, 400}, {20e-6, 2100}};
  ASSERT_EQ(read.size(), meant.size());
  for (std::size_t i = 0; i < meant.size(); ++i)
    for (std::size_t j : {0u, 1u}) EXPECT_NEAR(read[i][j], meant[i][j], 1e-12 * meant[i][j]);
  std::ofstream(folder / "bearing.csv") << "0 0\n2 5\n1 7\n";
  try {
    flying("{table: {file: bearing.csv}}", "", folder);
    ADD_FAILURE() << "was read";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("depths must increase"), std::string::npos) << error.what();
  }
  std::filesystem::remove_all(folder);
}

TEST(CylinderContact, MatchesASpringToWhatALawStores) {
  Scene s = flying(cylinders("johnson", ", restitution: 0.8"), ", model: spring-damper");
  s.loads = {force("press", "pin.P", law(50), law(0))};
  const Model model = build(s);
  const double k = std::get<ImpactLaw>(model.system.contacts[0].normal).k;
  const DampedLaw johnson = find_cylinder_law("johnson")->law({10e-3 - radial, -10e-3, 15e-3, 207e9 / 1.82});
  const double depth = depth_storing(johnson, 50 * radial);
  EXPECT_NEAR(k * depth * depth / 2 / (50 * radial), 1, 1e-6);
}

TEST(CylinderContact, RefusesWhatCannotBe) {
  const auto refused = [](const auto& make, const std::string& words) {
    try {
      build(make());
      ADD_FAILURE() << "accepted; expected: " << words;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const auto pin = [&](const std::string& normal, const std::string& words) { refused([&] { return flying(normal); }, words); };
  const auto roll = [&](const std::string& normal, const std::string& words) { refused([&] { return rolling(normal); }, words); };
  pin("{johnson: {young: 207 GPa, poisson: 0.3}}", "length: 20 mm");
  pin("{johnson: {length: 15 mm}}", "add young and poisson");
  pin(cylinders("johnson", ", exponent: 1.5"), "does not belong to johnson");
  pin(cylinders("johnson", ", radii: external"), "does not belong to johnson");
  pin(cylinders("johnson", ", hysteresis: flores"), "restitution: 0.8");
  pin(cylinders("johnson", ", hysteresis: flores, restitution: 0"), "(0, 1]");
  pin("{flores: {restitution: 0.5, young: 1 GPa, poisson: 0.3, length: 1 mm}}", "does not belong to flores");
  pin("{table: {points: [[0, 0], [2 um, 5 N], [1 um, 7 N]]}}", "point 3 does not");
  pin("{table: {points: [[1 um, 0], [2 um, 5 N]]}}", "must begin with depth 0 and force 0");
  pin("{table: {points: [[0, 0], [5 N, 1 um]]}}", "length");
  pin("{table: {points: [[0, 0], [1 um, 5 N]], force unit: N}}", "is for `file` only");
  pin("{table: {file: ../bearing.csv}}", "bearing.csv");
  pin("{winkler: {length: 15 mm, young: 2 GPa, poisson: 0.4}}", "layer: 1 mm");
  pin("{winkler: {layer: 1 mm, young: 2 GPa, poisson: 0.4}}", "length: 20 mm");
  pin("{winkler: {length: 15 mm, layer: 1 mm}}", "add young and poisson");
  pin("{winkler: {length: 15 mm, layer: 1 mm, young: 2 GPa, poisson: 0.5}}", "less than 0.5");
  pin("{winkler: {length: 15 mm, layer: 1 mm, stiffness: 4e12 N/m^3}}", "give either the stiffness or those");
  pin("{winkler: {length: 15 mm, stiffness: 4e12 N/m}}", "stiffness");
  pin(cylinders("winkler", ", journal: {young: 1 GPa, poisson: 0.2}"), "does not belong to winkler");
  pin(cylinders("johnson", ", layer: 1 mm"), "does not belong to johnson");
  pin("{flores: {restitution: 0.5, young: 1 GPa, poisson: 0.3, layer: 1 mm}}", "does not belong to flores");
  roll(cylinders("liu"), "liu is a law for a pin in a hole");
  roll(cylinders("esdu"), "esdu is a law for a pin in a hole");
  refused([&] { return rolling(cylinders("johnson"), "path: [[-1, 0], [1, 0]], material: right"); }, "a law for two cylinders");
  Scene tight = flying(cylinders("pereira"));
  tight.joints[0].clearance->radial = 1e-6;
  refused([&] { return tight; }, "5e-06 to 0.01 m, not for 1e-06 m");
}

// What a contact of these profiles may miss; a round block fits where the pit is narrower than its sides alone.
TEST(ContactOfProfiles, AHollowTooNarrowAndTwoSharpCornersAreWarnedOf) {
  const auto warned = [](const std::string& under, const std::string& edge) {
    std::string all;
    for (const std::string& w :
         build(read_scene_text("ground: {points: {G: [0, 0]}, profiles: {pit: {" + under +
                                   "}}}\nbodies: {block: {rigid: {mass: 1, inertia: 1e-3}, profiles: {edge: {" + edge +
                                   "}}, pose: {at: [0, 0.2]}}}\ncontacts: {c: {between: [block.edge, ground.pit], normal: "
                                   "{exact: {restitution: 0.5, stiffness: 1e8}}}}\nrun: {until: 1e-3}\n",
                               "scene"))
             .warnings)
      all += w;
    return all;
  };
  const std::string pit = "spline: [[-0.1, 0.05], [-0.05, 0.05], [-0.02, 0], [0, -0.02], [0.02, 0], [0.05, 0.05], [0.1, 0.05]]";
  const std::string stairs = "path: [[1, 0], [0, 0], [0, 0.1], [-1, 0.1]]";
  const std::string box = "path: [[-0.05, -0.05], [0.05, -0.05], [0.05, 0.05], [-0.05, 0.05]], closed: true";
  pintle_test::expect_says(warned(pit, "disc: [0, 0], radius: 60 mm"), {"too narrow", "touch both sides"});
  EXPECT_EQ(warned(pit, "disc: [0, 0], radius: 5 mm").find("too narrow"), std::string::npos);
  pintle_test::expect_says(warned(stairs, box), {"both profiles have sharp corners", "round"});
  EXPECT_EQ(warned(stairs, box + ", round: 5 mm").find("sharp corners"), std::string::npos);
}

}  // namespace
}  // namespace pintle_scenes::cylinder_contact_test
