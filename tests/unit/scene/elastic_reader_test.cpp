// Bodies of elements as the reader fills them, and that what it filled reads back.
#include <cmath>
#include <numbers>

#include "tests/unit/scene/elastic_text.h"

namespace pintle::elastic_reader_test {
namespace {

constexpr double pi = std::numbers::pi;

const Scene& whole() {
  static const Scene scene = read_scene_text(elastic_scene, "scene.yaml");
  return scene;
}
const SceneElastic& elastic(const Scene& scene, std::size_t body) { return *scene.bodies.at(body).elastic; }
const SceneBeam& beam(const Scene& scene, std::size_t body) { return std::get<SceneBeam>(elastic(scene, body).shape); }
const ScenePlate& plate(const Scene& scene, std::size_t body) { return std::get<ScenePlate>(elastic(scene, body).shape); }
SceneBeam beam_with(const std::string& keys) {
  const Scene scene = read_scene_text(with_beam(keys + ", " + steel_keys), "scene.yaml");
  return beam(scene, 0);
}
ScenePlate plate_with(const std::string& keys) {
  const Scene scene = read_scene_text(with_plate(keys), "scene.yaml");
  return plate(scene, 0);
}

TEST(ElasticReader, FillsMaterialsInSI) {
  ASSERT_EQ(whole().materials.size(), 3u);
  const Material& steel = whole().materials[0].material;
  EXPECT_EQ(std::get<Isotropic>(steel.elastic).young, 207e9);
  EXPECT_EQ(steel.density, 7850);
  const auto& ply = std::get<Orthotropic>(whole().materials[1].material.elastic);
  EXPECT_EQ(ply.young_1, 140e9);
  EXPECT_EQ(ply.young_2, 10e9);
  EXPECT_EQ(ply.poisson_12, 0.3);
  EXPECT_EQ(ply.shear_12, 5e9);
  EXPECT_DOUBLE_EQ(ply.angle, pi / 6);
  EXPECT_FALSE(ply.young_3);
  EXPECT_EQ(whole().materials[2].material.density, 0);
}

TEST(ElasticReader, FillsABeamWithItsOwnMaterial) {
  const SceneBeam& b = beam(whole(), 0);
  EXPECT_EQ(b.through, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(std::get<CircleSection>(b.section).diameter, 0.01);
  EXPECT_EQ(b.theory, BeamTheory::timoshenko);
  EXPECT_EQ(b.shear, ShearFactor::cowper);
  EXPECT_TRUE(b.rotary);
  EXPECT_FALSE(b.bar);
  EXPECT_EQ(b.mass, 0.21);
  EXPECT_EQ(b.elements, 1);
  EXPECT_TRUE(b.material.name.empty());
  EXPECT_EQ(std::get<Isotropic>(b.material.material.elastic).poisson, 0.3);
}

TEST(ElasticReader, FillsATaperedBeamOfANamedMaterial) {
  const SceneBeam& b = beam(whole(), 1);
  EXPECT_EQ(b.through, (std::vector<std::string>{"foot", "knee", "head"}));
  EXPECT_EQ(std::get<ISection>(b.section).flange, 0.006);
  EXPECT_EQ(std::get<ISection>(b.taper_to.value()).width, 0.03);
  EXPECT_EQ(b.theory, BeamTheory::euler);
  EXPECT_FALSE(b.rotary);
  EXPECT_FALSE(b.mass.has_value());
  EXPECT_EQ(b.material.name, "steel");
  EXPECT_EQ(b.material.material.density, 7850);
}

TEST(ElasticReader, FillsEverySection) {
  const auto section = [](const std::string& keys) { return beam_with("section: {" + keys + "}").section; };
  const auto rectangle = std::get<RectangleSection>(section("rectangle: [20 mm, 5 mm]"));
  EXPECT_EQ(rectangle.height, 0.02);
  EXPECT_EQ(rectangle.width, 0.005);
  const auto tube = std::get<TubeSection>(section("tube: [20 mm, 16 mm]"));
  EXPECT_EQ(tube.outer, 0.02);
  EXPECT_EQ(tube.inner, 0.016);
  const auto given = std::get<GivenSection>(section("area: 2 cm^2, second moment: 1e4 mm^4, shear factor: 0.4"));
  EXPECT_DOUBLE_EQ(given.area, 2e-4);
  EXPECT_DOUBLE_EQ(given.second_moment, 1e-8);
  EXPECT_EQ(given.fibre, 0);
  EXPECT_EQ(given.shear_factor, 0.4);
}

TEST(ElasticReader, FillsEveryTheory) {
  const std::string circle = "section: {circle: 1 mm}, ";
  EXPECT_EQ(beam_with(circle + "shear factor: 5/6").shear, ShearFactor::five_sixths);
  EXPECT_TRUE(beam_with(circle + "theory: bar").bar);
  EXPECT_EQ(beam_with(circle + "theory: euler").theory, BeamTheory::euler);
}

TEST(ElasticReader, FillsAPlate) {
  const ScenePlate& p = plate(whole(), 2);
  const auto& bar = std::get<EyeBar>(std::get<Link>(p.shape));
  EXPECT_EQ(bar.length, 0.12);
  EXPECT_EQ(bar.first.outer, 0.038);
  EXPECT_EQ(bar.second.bore, 0.012);
  EXPECT_EQ(p.thickness, 0.008);
  EXPECT_EQ(p.state, PlaneState::stress);
  EXPECT_EQ(p.element, "quadrilateral8");
  EXPECT_EQ(p.size, 0.003);
  EXPECT_EQ(p.hole_size, 0.001);
  const ScenePlate& sheet = plate(whole(), 3);
  const auto& grid = std::get<SceneGrid>(sheet.shape);
  EXPECT_EQ(grid.corners[2], (Pair{2, 1}));
  EXPECT_EQ(grid.nx, 20);
  EXPECT_EQ(grid.ny, 10);
  EXPECT_EQ(sheet.state, PlaneState::strain);
  EXPECT_EQ(sheet.mass, 2);
  EXPECT_EQ(sheet.element, "");
}

TEST(ElasticReader, FillsEveryLink) {
  const auto link = [](const std::string& keys) { return std::get<Link>(plate_with("link: {" + keys + "}").shape); };
  EXPECT_EQ(std::get<StraightBar>(link("bar: {length: 1 m, width: 2 cm}")).width, 0.02);
  const auto taper = std::get<TaperedBar>(link("tapered bar: {length: 10, widths: [5, 1]}"));
  EXPECT_EQ(taper.width_left, 5);
  EXPECT_EQ(taper.width_right, 1);
  EXPECT_EQ(std::get<Disc>(link("disc: {diameter: 10 cm, bore: 2 cm}")).bore, 0.02);
  const auto triangle =
      std::get<Triangle>(link("triangle: {centers: [[0, 0], [1, 0], [0, 1]], eyes: [{bore: 0.1, outer: 0.2}, "
                              "{bore: 0.1, outer: 0.2}, {bore: 0.15, outer: 0.3}]}"));
  EXPECT_EQ(triangle.center[2], Eigen::Vector2d(0, 1));
  EXPECT_EQ(triangle.eye[2].bore, 0.15);
}

TEST(ElasticReader, FillsPointsInHoles) {
  const std::vector<ScenePoint>& points = whole().bodies[2].points;
  EXPECT_EQ(points[0].hole, "eye 1");
  EXPECT_EQ(points[0].coupling, RimCoupling::average);
  EXPECT_DOUBLE_EQ(points[0].angle, pi / 18);
  EXPECT_EQ(points[1].coupling, RimCoupling::rigid);
  EXPECT_EQ(points[2].hole, "");
  EXPECT_EQ(points[2].coupling, RimCoupling::none);
  EXPECT_EQ(points[2].at, (Pair{0.1, 0}));
  EXPECT_EQ(whole().bodies[2].at, (Pair{1, 0}));
}

TEST(ElasticReader, FillsModes) {
  using Frame = SceneModes::Frame;
  using Method = SceneModes::Method;
  const SceneModes& chord = elastic(whole(), 0).modes.value();
  EXPECT_EQ(chord.frame, Frame::chord);
  EXPECT_TRUE(chord.a.empty());
  EXPECT_FALSE(chord.keep.count || chord.keep.below || chord.keep.effective_mass);
  const SceneModes& tangent = elastic(whole(), 1).modes.value();
  EXPECT_EQ(tangent.frame, Frame::tangent);
  EXPECT_EQ(tangent.a, "foot");
  EXPECT_DOUBLE_EQ(tangent.keep.below.value(), 5000);
  const SceneModes& craig = elastic(whole(), 2).modes.value();
  EXPECT_EQ(craig.method, Method::craig_bampton);
  EXPECT_EQ(craig.a + craig.b, "CD");
  EXPECT_DOUBLE_EQ(craig.keep.below.value(), 8000);
  const SceneModes& mean = elastic(whole(), 3).modes.value();
  EXPECT_EQ(mean.frame, Frame::mean_axes);
  EXPECT_EQ(mean.keep.effective_mass, 0.95);
  const Scene free = read_scene_text(spoiled("effective mass: 0.95", "free: {count: 6}"), "scene.yaml");
  EXPECT_EQ(elastic(free, 3).modes->method, Method::free);
  EXPECT_EQ(elastic(free, 3).modes->keep.count, 6);
}

TEST(ElasticReader, KeepsAutomaticallyOnlyWhereAsked) {
  EXPECT_FALSE(elastic(whole(), 0).modes->keep.automatic) << "keep: all";
  EXPECT_FALSE(elastic(whole(), 1).modes->keep.automatic) << "below";
  const auto keep = [](const std::string& from, const std::string& to, std::size_t body) {
    const Scene scene = read_scene_text(spoiled(from, to), "scene.yaml");
    EXPECT_EQ(read_scene_text(scene.filled_in, "again.json").filled_in, scene.filled_in) << to;
    return elastic(read_scene_text(scene.filled_in, "again.json"), body).modes->keep;
  };
  EXPECT_TRUE(keep("keep: all", "keep: auto", 0).automatic);
  EXPECT_TRUE(keep("craig-bampton: {below: 8 kHz}", "craig-bampton: {keep: auto}", 2).automatic);
  const SceneKeep free = keep("effective mass: 0.95", "free: {keep: auto}", 3);
  EXPECT_TRUE(free.automatic);
  EXPECT_FALSE(free.count || free.below || free.effective_mass);
}

TEST(ElasticReader, FillsStiffeningAndPieces) {
  EXPECT_EQ(elastic(whole(), 0).stiffening, Stiffening::none);
  EXPECT_EQ(beam(whole(), 0).pieces, 1);
  const auto again = [](const std::string& from, const std::string& to) {
    const Scene scene = read_scene_text(spoiled(from, to), "scene.yaml");
    return read_scene_text(scene.filled_in, "again.json");
  };
  const std::string lumped = "mass matrix: lumped";
  EXPECT_EQ(elastic(again(lumped, "stiffening: rotation"), 0).stiffening, Stiffening::rotation);
  EXPECT_EQ(elastic(again(lumped, "stiffening: axial"), 0).stiffening, Stiffening::axial);
  EXPECT_EQ(elastic(again(lumped, "stiffening: none"), 0).stiffening, Stiffening::none);
  EXPECT_EQ(beam(again("elements: 1", "elements: 1, pieces: 8"), 0).pieces, 8);
}

TEST(ElasticReader, FillsThePointsWhoseStressIsRecorded) {
  const Scene scene = read_scene_text(elastic_scene + "output: {stress: [coupler.B, rocker.tip], points: [rocker.C]}\n", "s.yaml");
  ASSERT_EQ(scene.output.stress.size(), 2u);
  EXPECT_EQ(scene.output.stress[1].body + scene.output.stress[1].point, "rockertip");
  EXPECT_EQ(scene.output.stress[1].place.key, "output.stress[2]");
  EXPECT_EQ(scene.output.points[0].point, "C") << "the middle of a hole moves, if without stress";
  EXPECT_EQ(read_scene_text(scene.filled_in, "again.json").filled_in, scene.filled_in);
}

TEST(ElasticReader, TakesAFrequencyInTurnsOrRadiansAndKeepsItInHz) {
  const auto below = [](const std::string& text) {
    const Scene scene = read_scene_text(spoiled("5 kHz", text), "scene.yaml");
    return elastic(scene, 1).modes->keep.below.value();
  };
  EXPECT_DOUBLE_EQ(below("250 Hz"), 250);
  EXPECT_EQ(below("250"), 250);
  EXPECT_DOUBLE_EQ(below("2*0.5 kHz + 1 Hz"), 1001);
  EXPECT_DOUBLE_EQ(below("3000 rpm"), 50);
  EXPECT_DOUBLE_EQ(below("50*rev/s"), 50);
  EXPECT_DOUBLE_EQ(below("314 rad/s"), 157 / pi);
}

TEST(ElasticReader, FillsDampingInEachForm) {
  const SceneDamping& ratios = elastic(whole(), 0).damping.value();
  EXPECT_EQ(ratios.rayleigh_ratios, (std::array<double, 2>{0.04, 0.03}));
  EXPECT_EQ(ratios.rayleigh_modes, (std::array<int, 2>{1, 3}));
  const SceneDamping& factors = elastic(whole(), 1).damping.value();
  EXPECT_FALSE(factors.rayleigh_ratios.has_value());
  EXPECT_EQ(factors.rayleigh, (std::array<double, 2>{3, 1e-5}));
  EXPECT_EQ(elastic(whole(), 2).damping->ratios, (std::vector<double>{0.02}));
  EXPECT_EQ(elastic(whole(), 3).damping->ratios, (std::vector<double>{0.01, 0.02}));
}

TEST(ElasticReader, FillsLumpsAndSupports) {
  const SceneElastic& coupler = elastic(whole(), 0);
  EXPECT_TRUE(coupler.lumped);
  EXPECT_FALSE(elastic(whole(), 1).lumped);
  ASSERT_EQ(coupler.lumps.size(), 1u);
  EXPECT_EQ(coupler.lumps[0].mass, 0.1);
  EXPECT_EQ(coupler.lumps[0].inertia, 1e-5);
  const auto held = [](const SceneSupport& s) { return std::string(s.x ? "x" : "") + (s.y ? "y" : "") + (s.rotation ? "r" : ""); };
  EXPECT_EQ(held(coupler.supports.at(0)), "xyr");
  EXPECT_EQ(held(coupler.supports.at(1)), "y");
  EXPECT_EQ(held(elastic(whole(), 1).supports.at(1)), "xr");
  EXPECT_EQ(held(elastic(whole(), 2).supports.at(0)), "xy");
  EXPECT_EQ(elastic(whole(), 2).supports.at(1).at, "outline");
}

TEST(ElasticReader, FillsAStaticCase) {
  using Kind = SceneStaticLoad::Kind;
  const SceneStatic& statics = whole().statics.value();
  EXPECT_EQ(statics.body, "rocker");
  ASSERT_EQ(statics.loads.size(), 6u);
  const auto& l = statics.loads;
  EXPECT_EQ(l[0].name, "pull");
  EXPECT_EQ(l[0].kind, Kind::force);
  EXPECT_EQ(l[0].vector, (Pair{1000, 0}));
  EXPECT_EQ(l[0].at, "D");
  EXPECT_EQ(l[1].kind, Kind::torque);
  EXPECT_EQ(l[1].value, 5);
  EXPECT_EQ(l[2].kind, Kind::pressure);
  EXPECT_EQ(l[2].value, 5e6);
  EXPECT_EQ(l[3].kind, Kind::traction);
  EXPECT_EQ(l[3].at, "outline");
  EXPECT_EQ(l[4].kind, Kind::acceleration);
  EXPECT_EQ(l[5].kind, Kind::spin);
  EXPECT_DOUBLE_EQ(l[5].value, 100 * pi);
  EXPECT_EQ(l[5].place.line, 52);
}

TEST(ElasticReader, LoadsTheOnlyBodyOfElementsWithoutItsName) {
  const Scene scene = read_scene_text(
      with_beam("section: {circle: 1 mm}, " + steel_keys) + "static: {loads: {snow: {line load: [0, -100 N/m]}}}\n", "scene.yaml");
  EXPECT_EQ(scene.statics->body, "rod");
  EXPECT_EQ(scene.statics->loads[0].kind, SceneStaticLoad::Kind::line);
  EXPECT_EQ(scene.statics->loads[0].vector, (Pair{0, -100}));
}

TEST(ElasticReader, FilledInSceneReadsBackToTheSameScene) {
  std::vector<std::string> scenes{elastic_scene, spoiled("effective mass: 0.95", "free: {count: 6}"),
                                  spoiled("frame: chord", "frame: tangent"),
                                  spoiled("young: [140 GPa, 10 GPa], poisson: 0.3", "young: [140e9, 10e9, 9e9], poisson: [0.3, 0.2, 0.1]")};
  for (const char* section :
       {"rectangle: [2 cm, 1 cm]", "tube: [2 cm, 1 cm]", "area: 1 cm^2, second moment: 1 cm^4, fibre: 5 mm, shear factor: 0.8"})
    for (const char* theory : {"timoshenko, shear factor: 5/6", "euler", "bar"})
      scenes.push_back(with_beam("section: {" + std::string(section) + "}, theory: " + theory + ", " + steel_keys));
  for (const char* link : {"bar: {length: 1, width: 0.1}", "disc: {diameter: 1, bore: 0.1}", "tapered bar: {length: 10, widths: [5, 1]}",
                           "triangle: {centers: [[0, 0], [1, 0], [0, 1]], eyes: [{bore: 0.1, outer: "
                           "0.2}, {bore: 0.1, outer: 0.2}, {bore: 0.15, outer: 0.3}]}"})
    scenes.push_back(with_plate("link: {" + std::string(link) + "}"));
  for (const std::string& text : scenes) {
    const Scene scene = read_scene_text(text, "scene.yaml");
    const Scene again = read_scene_text(scene.filled_in, "again.json");
    EXPECT_EQ(again.filled_in, scene.filled_in) << text;
  }
}

// Equal JSON could hide a part that is written nowhere.
TEST(ElasticReader, FilledInSceneKeepsEveryPartOfABody) {
  const Scene again = read_scene_text(whole().filled_in, "again.json");
  EXPECT_EQ(again.materials.size(), 3u);
  EXPECT_EQ(beam(again, 0).elements, 1);
  EXPECT_EQ(beam(again, 0).mass, 0.21);
  EXPECT_EQ(std::get<ISection>(beam(again, 1).taper_to.value()).web, 0.003);
  EXPECT_FALSE(beam(again, 1).rotary);
  EXPECT_EQ(plate(again, 2).hole_size, 0.001);
  EXPECT_EQ(plate(again, 3).state, PlaneState::strain);
  EXPECT_EQ(plate(again, 3).mass, 2);
  EXPECT_TRUE(elastic(again, 0).lumped);
  EXPECT_EQ(elastic(again, 0).lumps[0].inertia, 1e-5);
  EXPECT_TRUE(elastic(again, 1).supports[1].rotation);
  EXPECT_EQ(elastic(again, 2).modes->method, SceneModes::Method::craig_bampton);
  EXPECT_EQ(elastic(again, 2).modes->keep.below, elastic(whole(), 2).modes->keep.below);
  EXPECT_EQ(elastic(again, 0).damping->rayleigh_modes[1], 3);
  EXPECT_EQ(again.bodies[2].points[0].coupling, RimCoupling::average);
  EXPECT_EQ(again.statics->loads.size(), 6u);
  EXPECT_EQ(again.statics->loads[5].at, "C");
}

TEST(ElasticReader, ASceneOfBodiesAloneIsWholeButCannotBeRun) {
  EXPECT_FALSE(whole().has_run);
  EXPECT_TRUE(read_scene_text(slider_crank, "scene.yaml").has_run);
  EXPECT_NO_THROW(require_run(read_scene_text(slider_crank, "scene.yaml")));
  pintle_test::expect_refused([] { require_run(whole()); }, {"scene.yaml: run: is missing", "run: {until: 1 s}"});
}

TEST(ElasticReader, LawsOfASceneWithoutARunAreReadAllTheSame) {
  const std::string text = with_beam("section: {circle: 1 mm}, " + steel_keys) +
                           "drivers: {motor: {angle: [ground, rod], law: 3*t}}\n"
                           "output: {every: 1 s}\n";
  const Scene scene = read_scene_text(text, "scene.yaml");
  EXPECT_EQ(scene.drivers[0].law.at(2).value, 6);
  EXPECT_EQ(read_scene_text(scene.filled_in, "again.json").filled_in, scene.filled_in);
}

TEST(ElasticFile, IsSoughtBesideTheSceneAndScaledByItsUnit) {
  const Folder folder;
  folder.write("part.geo", "// a drawing");
  folder.write("part.inp", "*NODE");
  const auto file = [&](const std::string& keys) {
    const Scene scene = read_scene(folder.write("s.yaml", with_plate(keys)));
    EXPECT_EQ(read_scene(folder.write("again.json", scene.filled_in)).filled_in, scene.filled_in);
    return std::get<SceneFile>(plate(scene, 0).shape);
  };
  EXPECT_EQ(file("file: part.geo").scale, 1);
  EXPECT_EQ(file("file: part.geo, unit: mm").scale, 1e-3);
  EXPECT_EQ(file("file: part.geo, scale: 0.0254").scale, 0.0254);
  EXPECT_EQ(file("file: part.inp").path, "part.inp");
}

}  // namespace
}  // namespace pintle::elastic_reader_test
