// Bodies of elements that are made once for many scenes: to the bit what each scene would make for itself.
#include "framework/bodies/body_store.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "framework/build/build.h"
#include "framework/common/library_threads.h"
#include "framework/scene/yaml/reader.h"
#include "framework/study/case.h"

namespace pintle::body_store_test {
namespace {

namespace fs = std::filesystem;
using std::string;

/// Numbers and words one after the other, as bytes.
struct Bits {
  string out;
  void add(double x) { out.append(reinterpret_cast<const char*>(&x), sizeof x); }
  void add(const string& s) { out += s + "\n"; }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& m) {
    add(static_cast<double>(m.rows()));
    for (Eigen::Index k = 0; k < m.cols(); ++k)
      for (Eigen::Index i = 0; i < m.rows(); ++i) add(m(i, k));
  }
};

/// All that a model has of its bodies of elements.
string bits(const Model& model) {
  Bits b;
  for (const Body& body : model.system.bodies) {
    b.add(body.m), b.add(body.J), b.add(body.x_BO);
    if (!body.flex) continue;
    const FlexInertia& f = *body.flex;
    b.add(f.S), b.add(f.j), b.add(f.h), b.add(f.G), b.add(f.omega), b.add(f.zeta);
    if (f.second) b.add(f.second->S[0]), b.add(f.second->S[1]), b.add(f.second->j), b.add(f.second->h);
  }
  for (const Marker& m : model.system.markers) {
    b.add(m.x_BP), b.add(m.shape), b.add(m.slope);
    for (const auto& second : m.second) b.add(second);
  }
  for (const RecordedStress& s : model.stresses)
    for (const StressProbe::Side& side : s.probe.sides) b.add(side.rows), b.add(side.A), b.add(side.I), b.add(side.distance);
  for (const FlexibleReport& r : model.flexible) {
    b.add(r.basis), b.add(r.compliance), b.add(r.compliance_at), b.add(r.lowest);
    if (r.mass) b.add(*r.mass);
  }
  for (const BendingProbe& p : model.bending) b.add(p.displacement), b.add(p.slope);
  for (const string& w : model.warnings) b.add(w);
  return b.out;
}

const string rest = R"(
joints: {pin: {revolute: [ground, rod.A]}}
run: {until: 10 ms}
output: {stress: [rod.M]}
)";
const string plate = R"(
bodies:
  rod:
    plate: {link: {eye bar: {length: 100 mm, width: 12 mm, eyes: [{bore: 10 mm, outer: 20 mm}, {bore: 10 mm, outer: 20 mm}]}},
            thickness: 5 mm, young: 200 GPa, poisson: 0.3, density: 7800 kg/m^3, element: triangle3, size: 10 mm, hole size: 5 mm}
    points: {A: {hole: eye 1, coupling: rigid}, B: {hole: eye 2, coupling: rigid}, M: [50 mm, 6 mm]}
    modes: {frame: {chord: [A, B]}, craig-bampton: {count: 2}})" +
                     rest;
const string grid = R"(
bodies:
  rod:
    plate: {grid: {corners: [[0, 0], [100 mm, 0], [100 mm, 10 mm], [0, 10 mm]], cells: [10, 2]},
            thickness: 5 mm, young: 200 GPa, poisson: 0.3, density: 7800 kg/m^3}
    points: {A: [0, 0], B: [100 mm, 0], M: [50 mm, 0]}
    modes: {frame: {chord: [A, B]}, free: {count: 2}})" +
                    rest;
const string beam = R"(
bodies:
  rod:
    beam: {from: A, to: B, section: {rectangle: [10 mm, 5 mm]}, young: 200 GPa, poisson: 0.3, density: 7800 kg/m^3, elements: 8}
    points: {A: [0, 0], M: [50 mm, 0], B: [100 mm, 0]}
    modes: {frame: {chord: [A, B]}, craig-bampton: {count: 2}})" +
                    rest;
/// The grid of another material, the plate of another shape.
string ply(const string& constants) {
  return "{grid: {corners: [[0, 0], [100 mm, 0], [100 mm, 10 mm], [0, 10 mm]], cells: [10, 2]}, thickness: 5 mm, density: 1600 kg/m^3, "
         "orthotropic: " +
         constants + "}";
}
string link(const string& shape) {
  return "{link: {" + shape + "}, thickness: 5 mm, young: 200 GPa, poisson: 0.3, density: 7800 kg/m^3, element: triangle3, size: 10 mm}";
}

/// Builds the scene, then with one key changed after the other, and each twice, all from one store.
void expect_the_same(const string& text, const std::vector<std::pair<string, string>>& changes) {
  BodyStore store;
  std::set<string> seen;
  const auto compare = [&](const Overrides& set) {
    const string what = set.empty() ? "as it is" : set.back().first + ": " + set.back().second;
    const Scene scene = read_scene_text(text, "scene.yaml", set);
    const string fresh = bits(build(scene));
    EXPECT_TRUE(seen.insert(fresh).second) << what << ": changes nothing";
    EXPECT_TRUE(bits(build(scene, store)) == fresh) << what;
    const long bodies = store.bodies_made(), reductions = store.reductions_made();
    EXPECT_TRUE(bits(build(scene, store)) == fresh) << what << ", once more";
    EXPECT_EQ(store.bodies_made(), bodies) << what;
    EXPECT_EQ(store.reductions_made(), reductions) << what;
  };
  compare({});
  for (const auto& [key, value] : changes) {
    Overrides set{{(key.starts_with("joints") ? "" : "bodies.rod.") + key, value}};
    if (key.ends_with(".mass")) set.insert(set.begin(), {"bodies.rod." + key.substr(0, key.find('.')) + ".density", "null"});
    compare(set);
  }
}

const std::vector<std::pair<string, string>> modes{{"modes.frame", "mean axes"},
                                                   {"modes.frame", "{tangent: A}"},
                                                   {"modes.frame", "{chord: [B, A]}"},
                                                   {"modes.craig-bampton", "{count: 3}"},
                                                   {"modes.craig-bampton", "{below: 200 kHz}"},
                                                   {"modes.craig-bampton", "{effective mass: 0.9}"},
                                                   {"modes", "{frame: {chord: [A, B]}, count: 2}"},
                                                   {"modes", "{frame: {chord: [A, B]}, free: {count: 2}}"},
                                                   {"stiffening", "rotation"},
                                                   {"stiffening", "axial"},
                                                   {"damping", "{ratios: 0.01}"},
                                                   {"mass matrix", "lumped"},
                                                   {"joints.pin", "{revolute: [ground, rod.B]}"}};

TEST(BodyStore, EachKeyOfALinkMakesItsOwnBody) {
  expect_the_same(plate, {{"plate.link.eye bar.length", "101 mm"},
                          {"plate.link.eye bar.width", "14 mm"},
                          {"plate.link.eye bar.eyes.1.outer", "22 mm"},
                          {"plate.link.eye bar.eyes.2.bore", "11 mm"},
                          {"plate.size", "9 mm"},
                          {"plate.hole size", "4 mm"},
                          {"points.B.coupling", "average"},
                          {"modes.frame", "{tangent: A}"}});
}

TEST(BodyStore, EachKeyOfAPlateMakesItsOwnBody) {
  expect_the_same(grid, {{"plate.grid.cells", "[12, 2]"},
                         {"plate.grid.cells", "[10, 3]"},
                         {"plate.grid.corners", "[[0, 0], [100 mm, 0], [100 mm, 11 mm], [0, 10 mm]]"},
                         {"plate.element", "quadrilateral4"},
                         {"plate.element", "quadrilateral4-plain"},
                         {"plate.element", "quadrilateral8"},
                         {"plate.element", "quadrilateral8-reduced"},
                         {"plate.thickness", "6 mm"},
                         {"plate.plane", "strain"},
                         {"plate.young", "201 GPa"},
                         {"plate.poisson", "0.31"},
                         {"plate.density", "7801 kg/m^3"},
                         {"plate.mass", "0.1 kg"},
                         {"points.M", "[40 mm, 0]"},
                         {"lumps", "{M: {mass: 0.1 kg}}"},
                         {"lumps", "{B: {mass: 0.1 kg}}"},
                         {"mass matrix", "lumped"},
                         {"stiffening", "axial"},
                         {"plate", ply("{young: [140 GPa, 10 GPa], poisson: 0.3, shear: 5 GPa}")},
                         {"plate", ply("{young: [141 GPa, 10 GPa], poisson: 0.3, shear: 5 GPa}")},
                         {"plate", ply("{young: [140 GPa, 11 GPa], poisson: 0.3, shear: 5 GPa}")},
                         {"plate", ply("{young: [140 GPa, 10 GPa], poisson: 0.2, shear: 5 GPa}")},
                         {"plate", ply("{young: [140 GPa, 10 GPa], poisson: 0.3, shear: 6 GPa}")},
                         {"plate", ply("{young: [140 GPa, 10 GPa], poisson: 0.3, shear: 5 GPa, angle: 30 deg}")},
                         {"plate", link("bar: {length: 100 mm, width: 10 mm}")},
                         {"plate", link("bar: {length: 100 mm, width: 11 mm}")},
                         {"plate", link("tapered bar: {length: 100 mm, widths: [10 mm, 8 mm]}")},
                         {"plate", link("tapered bar: {length: 100 mm, widths: [8 mm, 10 mm]}")}});
}

TEST(BodyStore, EachKeyOfABeamMakesItsOwnBody) {
  auto changes = modes;
  for (const auto& change :
       std::vector<std::pair<string, string>>{{"beam.section", "{rectangle: [11 mm, 5 mm]}"},
                                              {"beam.section", "{rectangle: [10 mm, 6 mm]}"},
                                              {"beam.section", "{circle: 10 mm}"},
                                              {"beam.section", "{tube: [10 mm, 6 mm]}"},
                                              {"beam.section", "{i: {height: 10 mm, width: 8 mm, web: 1 mm, flange: 2 mm}}"},
                                              {"beam.taper to", "{rectangle: [8 mm, 5 mm]}"},
                                              {"beam.theory", "euler"},
                                              {"beam.shear factor", "5/6"},
                                              {"beam.rotary inertia", "false"},
                                              {"beam.young", "201 GPa"},
                                              {"beam.poisson", "0.31"},
                                              {"beam.density", "7801 kg/m^3"},
                                              {"beam.mass", "0.1 kg"},
                                              {"beam.elements", "9"},
                                              {"points.M", "[40 mm, 0]"},
                                              {"lumps", "{M: {mass: 0.1 kg}}"},
                                              {"lumps", "{M: {mass: 0.1 kg, inertia: 1e-5 kg m^2}}"},
                                              {"lumps", "{B: {mass: 0.1 kg}}"}})
    changes.push_back(change);
  expect_the_same(beam, changes);
}

TEST(BodyStore, WhatIsNoPartOfABodyMakesNoOther) {
  BodyStore store;
  for (const auto& [key, value] : Overrides{{"title", "other"},
                                            {"bodies.rod.pose", "{at: [1 mm, 0]}"},
                                            {"bodies.rod.damping", "{ratios: 0.03}"},
                                            {"run.until", "20 ms"},
                                            {"gravity", "[0, -9.81]"}}) {
    const Scene scene = read_scene_text(beam, "scene.yaml", {{key, value}});
    EXPECT_TRUE(bits(build(scene, store)) == bits(build(scene))) << key;
  }
  EXPECT_EQ(store.bodies_made(), 1);
  EXPECT_EQ(store.reductions_made(), 1);
}

TEST(BodyStore, ModesThatTheMotionChoosesAreThoseOfEachScene) {
  BodyStore store;
  const string set = "bodies.rod.modes", value = "{frame: {chord: [A, B]}, craig-bampton: {keep: auto}}";
  for (const char* until : {"10 ms", "40 ms", "10 ms"}) {
    const Scene scene = read_scene_text(beam, "scene.yaml", {{set, value}, {"gravity", "[0, -9.81]"}, {"run.until", until}});
    EXPECT_TRUE(bits(build(scene, store)) == bits(build(scene))) << until;
  }
  EXPECT_EQ(store.bodies_made(), 1);
}

/// A folder of its own with a drawing of a trapezium, gone at the end.
class Drawn {
 public:
  Drawn()
      : path_(fs::temp_directory_path() / ("pintle-store-" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()))) {
    fs::create_directories(path_);
  }
  ~Drawn() { fs::remove_all(path_); }
  void draw(const string& height, const string& before = "") const {
    std::ofstream(path_ / "part.geo") << before << "Point(1) = {0, 0, 0, 20}; Point(2) = {100, 0, 0, 20}; Point(3) = {100, " << height
                                      << ", 0, 20}; Point(4) = {0, 20, 0, 20};\n"
                                         "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
                                         "Curve Loop(1) = {1:4}; Plane Surface(1) = {1};\n";
  }
  void write(const string& name, const string& text) const { std::ofstream(path_ / name) << text; }
  Scene scene() const {
    string text = grid;
    const std::size_t from = text.find("{grid:"), to = text.find("cells: [10, 2]}");
    text.replace(from, to + 15 - from, "{file: part.geo, unit: mm, element: triangle3");
    return read_scene_text(text, (path_ / "scene.yaml").string(), {}, path_);
  }

 private:
  fs::path path_;
};

TEST(BodyStore, ADrawingOfTheSameNameAndOtherContentIsAnotherBody) {
  BodyStore store;
  const Drawn one, two;
  one.draw("20"), two.draw("18");
  const string first = bits(build(one.scene())), second = bits(build(two.scene()));
  EXPECT_FALSE(first == second);
  EXPECT_TRUE(bits(build(one.scene(), store)) == first);
  EXPECT_TRUE(bits(build(two.scene(), store)) == second);
  EXPECT_TRUE(bits(build(one.scene(), store)) == first);
  EXPECT_EQ(store.bodies_made(), 2);
  one.draw("18");
  EXPECT_TRUE(bits(build(one.scene(), store)) == second);
  EXPECT_EQ(store.bodies_made(), 2);
}

TEST(BodyStore, ADrawingThatDrawsOnAnotherFileIsMadeAnew) {
  BodyStore store;
  const Drawn drawn;
  drawn.draw("height", "Include \"sizes.geo\";\n");
  for (const char* height : {"20", "18"}) {
    drawn.write("sizes.geo", string("height = ") + height + ";\n");
    EXPECT_TRUE(bits(build(drawn.scene(), store)) == bits(build(drawn.scene()))) << height;
  }
  EXPECT_EQ(store.bodies_made(), 2);
}

TEST(BodyStore, AWrongBodyIsReportedEachTime) {
  BodyStore store;
  const Scene scene = read_scene_text(beam, "scene.yaml", {{"bodies.rod.modes.craig-bampton", "{count: 900}"}});
  for (int k = 0; k < 2; ++k) EXPECT_THROW(build(scene, store), SceneError);
}

TEST(BodyStore, CasesThatShareBodiesInFourThreadsEndAsCasesAlone) {
  const CaseSource source{"scene.yaml", plate};
  std::vector<Measure> measures(1);
  measures[0].name = "x", measures[0].words = "greatest x of rod.B";
  std::vector<Outcome> alone(6), shared(6);
  const auto set = [](std::size_t k) {
    return Overrides{{"gravity", "[0, -" + std::to_string(k + 5) + "]"}, {"run.until", k == 3 ? "-1" : "1 ms"}};
  };
  for (std::size_t k = 0; k < alone.size(); ++k) alone[k] = run_case(source, set(k), measures);
  BodyStore store;
  CaseLimits limits;
  limits.bodies = &store;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t k = t; k < shared.size(); k += 4) shared[k] = run_case(source, set(k), measures, limits);
    });
  for (std::thread& t : threads) t.join();
  for (std::size_t k = 0; k < alone.size(); ++k) {
    EXPECT_EQ(alone[k].status, k == 3 ? "refused" : "finished") << alone[k].reason;
    EXPECT_EQ(shared[k].status, alone[k].status);
    EXPECT_EQ(shared[k].reason, alone[k].reason);
    if (k != 3) {
      EXPECT_EQ(shared[k].values[0], alone[k].values[0]);
    }
    EXPECT_EQ(shared[k].counts.steps, alone[k].counts.steps);
  }
  EXPECT_EQ(store.bodies_made(), 1);
  EXPECT_EQ(store.reductions_made(), 1);
}

TEST(Case, StartsNoThreadsWhereItMakesBodies) {
  const auto threads = [] { return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator()); };
  const CaseSource source{"scene.yaml", grid};
  std::ptrdiff_t before = 0, after = 0;
  std::thread([&] {
    hold_library_threads();
    library_text();  // loads BLAS, which has its threads from then on
    before = threads();
    const Outcome outcome = run_case(source, {{"bodies.rod.plate.grid.cells", "[60, 12]"}, {"run.until", "1 us"}}, {});
    after = threads();
    EXPECT_EQ(outcome.status, "finished") << outcome.reason;
  }).join();
  EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace pintle::body_store_test
