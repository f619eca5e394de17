// Every way to get the shape or material of a body of elements wrong, and the one line that says
// where and what to do.
#include "tests/unit/scene/elastic_text.h"

namespace pintle::bad_elastic_test {
namespace {

TEST(BadElastic, BodyIsOneThingOnly) {
  expect_refused({
      {"  coupler:\n    beam", "  coupler:\n    beem", "scene.yaml:8: bodies.coupler.beem: ", {"Did you mean \"beam\"?"}},
      {"    points: {A: [0, 0], B: [120 mm, 0]}", "    plate: {}", "scene.yaml:7: bodies.coupler: ", {"is beam and plate at once"}},
      {"  coupler:\n", "  dead: {points: {}}\n  coupler:\n", "scene.yaml:7: bodies.dead: ", {"rigid, beam or plate"}},
      {"  coupler:\n",
       "  dead: {rigid: {mass: 1, inertia: 1}, modes: {}}\n  coupler:\n",
       "scene.yaml:7: bodies.dead.modes: ",
       {"does not belong to rigid but to beam or plate"}},
  });
}

TEST(BadElastic, MaterialsAreJudged) {
  expect_refused({
      {"density: 7850", "density: -7850", "scene.yaml:3: materials.steel.density: ", {"\"-7850 kg/m^3\" must be greater than 0"}},
      {"density: 7850 kg/m^3", "density: 7850 kg", "scene.yaml:3: materials.steel.density: ", {"a mass [kg]; expected a density [kg/m^3]"}},
      {"young: 207 GPa", "young: 0", "scene.yaml:3: materials.steel.young: ", {"greater than 0"}},
      {"poisson: 0.3, density", "density", "scene.yaml:3: materials.steel: ", {"poisson: 0.3"}},
      {"poisson: 0.49", "poisson: 0.5", "scene.yaml:5: materials.rubber.poisson: ", {"less than 0.5", "0.4999"}},
      {"poisson: 0.49", "poisson: -1", "scene.yaml:5: materials.rubber.poisson: ", {"greater than -1"}},
      {"young: 10 MPa, poisson: 0.49", "density: 1", "scene.yaml:5: materials.rubber: ", {"how stiff it is", "young or orthotropic"}},
      {"young: 10 MPa", "young: 10 MPa, orthotropic: {}", "scene.yaml:5: materials.rubber: ", {"young and orthotropic at once"}},
      {"material: steel",
       "material: steal",
       "scene.yaml:22: bodies.mast.beam.material: ",
       {"no material \"steal\"", "Did you mean \"steel\"?"}},
      {"material: steel", "material: steel, poisson: 0.3", "scene.yaml:", {"not YAML"}},
      {"material: steel",
       "material: steel\n      poisson: 0.3",
       "scene.yaml:23: bodies.mast.beam.poisson: ",
       {"given by the material already"}},
      {"material: steel",
       "material: steel\n      density: 1",
       "scene.yaml:23: bodies.mast.beam.density: ",
       {"given by the material already", "mass"}},
      {"material: steel", "material: steel\n      young: 1 GPa", "scene.yaml:16: bodies.mast.beam: ", {"by material and young at once"}},
      {"      material: steel\n", "", "scene.yaml:16: bodies.mast.beam: ", {"what it is made of", "material, young or orthotropic"}},
      {"mass: 0.21 kg", "mass: 0.21 kg, density: 7850", "scene.yaml:8: bodies.coupler.beam.mass: ", {"combined with density", "keep one"}},
      {"mass: 0.21 kg, ", "", "scene.yaml:8: bodies.coupler.beam: ", {"neither density nor mass", "density: 7850 kg/m^3"}},
      {"material: rubber, mass: 2 kg", "material: rubber", "scene.yaml:41: bodies.sheet.plate: ", {"neither density nor mass"}},
  });
}

TEST(BadElastic, OrthotropicConstantsMustBeThoseOfASolid) {
  expect_refused({
      {"young: [140 GPa, 10 GPa]", "young: 140 GPa", "scene.yaml:4: materials.ply.orthotropic.young: ", {"[E1, E2]"}},
      {"young: [140 GPa, 10 GPa]",
       "young: [140 GPa, 10 GPa, 10 GPa]",
       "scene.yaml:4: materials.ply.orthotropic.poisson: ",
       {"1 value for 3", "[12, 13, 23]"}},
      {"poisson: 0.3, shear", "poisson: 4, shear", "scene.yaml:4: materials.ply.orthotropic: ", {"poisson_12"}},
      {", shear: 5 GPa", "", "scene.yaml:4: materials.ply.orthotropic: ", {"shear: 5 GPa"}},
      {"      element: quadrilateral8",
       "      plane: strain",
       "scene.yaml:31: bodies.rocker.plate.material: ",
       {"plane strain", "lacks young_3"}},
  });
}

TEST(BadElastic, BeamsAreJudged) {
  expect_refused({
      {"from: A", "from: X", "scene.yaml:8: bodies.coupler.beam.from: ", {"coupler has no point \"X\"", "Known here: A or B"}},
      {"from: A, ", "", "scene.yaml:8: bodies.coupler.beam: ", {"from: A and to: B, or through: [A, B]"}},
      {"from: A, to: B", "from: A, to: A", "scene.yaml:8: bodies.coupler.beam: ", {"no length from A to A"}},
      {"[foot, knee, head]", "[foot, knea, head]", "scene.yaml:17: bodies.mast.beam.through[2]: ", {"Did you mean \"knee\"?"}},
      {"[foot, knee, head]", "[foot]", "scene.yaml:17: bodies.mast.beam.through: ", {"two or more points"}},
      {"from: A, to", "through: [A, B], to", "scene.yaml:8: bodies.coupler.beam.to: ", {"combined with through"}},
      {"    points: {A: [0, 0], B: [120 mm, 0]}\n",
       "",
       "scene.yaml:8: bodies.coupler.beam.from: ",
       {"coupler has none; add points: {A: [0, 0]}"}},
      {"{circle: 10 mm}", "{circel: 10 mm}", "scene.yaml:8: bodies.coupler.beam.section.circel: ", {"Did you mean \"circle\"?"}},
      {"{circle: 10 mm}", "{circle: 0}", "scene.yaml:8: bodies.coupler.beam.section.circle: ", {"greater than 0"}},
      {"{circle: 10 mm}",
       "{tube: [8 mm, 10 mm]}",
       "scene.yaml:8: bodies.coupler.beam.section.tube[2]: ",
       {"less than the outer diameter", "first"}},
      {"{circle: 10 mm}", "{}", "scene.yaml:8: bodies.coupler.beam.section: ", {"rectangle, circle, tube, i or area"}},
      {"{circle: 10 mm}", "{area: 1 cm^2}", "scene.yaml:8: bodies.coupler.beam.section: ", {"second moment: "}},
      {"{circle: 10 mm}",
       "{area: 1 cm, second moment: 1 cm^4}",
       "scene.yaml:8: bodies.coupler.beam.section.area: ",
       {"a length [m]; expected an area"}},
      {"{circle: 10 mm}", "{circle: 10 mm, fibre: 1 mm}", "scene.yaml:8: bodies.coupler.beam.section.fibre: ", {"to area"}},
      {"web: 4 mm", "web: 60 mm", "scene.yaml:18: bodies.mast.beam.section.i.web: ", {"less than the width"}},
      {"flange: 6 mm", "flange: 60 mm", "scene.yaml:18: bodies.mast.beam.section.i.flange: ", {"times two", "less than the height"}},
      {"taper to: {i: {height: 50 mm, width: 30 mm, web: 3 mm, flange: 4 mm}}",
       "taper to: {circle: 5 mm}",
       "scene.yaml:19: bodies.mast.beam.taper to: ",
       {"is circle, but section is i"}},
      {"theory: euler", "theory: euller", "scene.yaml:20: bodies.mast.beam.theory: ", {"Did you mean \"euler\"?"}},
      {"rotary inertia: false", "shear factor: 5/6", "scene.yaml:21: bodies.mast.beam.shear factor: ", {"not belong to the theory euler"}},
      {"elements: 1}", "elements: 1.5}", "scene.yaml:8: bodies.coupler.beam.elements: ", {"whole number"}},
  });
}

TEST(BadElastic, PlatesAreJudged) {
  expect_refused({
      {"thickness: 8 mm", "thickness: 0 mm", "scene.yaml:30: bodies.rocker.plate.thickness: ", {"greater than 0"}},
      {"      thickness: 8 mm\n", "", "scene.yaml:28: bodies.rocker.plate: ", {"thickness: 8 mm"}},
      {"element: quadrilateral8",
       "element: quadrilateral88",
       "scene.yaml:32: bodies.rocker.plate.element: ",
       {"Did you mean \"quadrilateral8\"?"}},
      {"eye bar:", "eyebar:", "scene.yaml:29: bodies.rocker.plate.link.eyebar: ", {"Did you mean \"eye bar\"?"}},
      {"bore: 24 mm",
       "bore: 40 mm",
       "scene.yaml:29: bodies.rocker.plate.link.eye bar.eyes[1].bore: ",
       {"less than the outer diameter \"38 mm\""}},
      {"bore: 24 mm", "boar: 24 mm", "scene.yaml:29: bodies.rocker.plate.link.eye bar.eyes[1].boar: ", {"Known here: bore or outer"}},
      {", {bore: 12 mm, outer: 22 mm}]", "]", "scene.yaml:29: bodies.rocker.plate.link.eye bar.eyes: ", {"two eyes"}},
      {"size: 3 mm", "size: -3 mm", "scene.yaml:33: bodies.rocker.plate.size: ", {"greater than 0"}},
      {"size: 3 mm", "scale: 3", "scene.yaml:33: bodies.rocker.plate.scale: ", {"does not belong to link but to file"}},
      {"      link: {eye", "      disc: {eye", "scene.yaml:29: bodies.rocker.plate.disc: ", {"unknown key"}},
      {"[[0, 0], [2 m, 0], [2 m, 1 m], [0, 1 m]]",
       "[[0, 0], [0, 1 m], [2 m, 1 m], [2 m, 0]]",
       "scene.yaml:41: bodies.sheet.plate.grid.corners: ",
       {"counter-clockwise"}},
      {"cells: [20, 10]", "cells: [20, 0]", "scene.yaml:41: bodies.sheet.plate.grid.cells[2]: ", {"at least 1"}},
      {"plane: strain", "plane: strane", "scene.yaml:41: bodies.sheet.plate.plane: ", {"Did you mean \"strain\"?"}},
      {"{hole: eye 2}", "{hole: eye 2, at: [0, 0]}", "scene.yaml:35: bodies.rocker.points.D.at: ", {"combined with hole"}},
      {"coupling: average", "coupling: soft", "scene.yaml:35: bodies.rocker.points.C.coupling: ", {"rigid or average"}},
      {"{hole: eye 2}", "{coupling: rigid}", "scene.yaml:35: bodies.rocker.points.D.coupling: ", {"is for hole only"}},
      {"B: [120 mm, 0]}", "B: {hole: bore}}", "scene.yaml:9: bodies.coupler.points.B.hole: ", {"for plates"}},
  });
}

TEST(BadElastic, LinksThatDoNotHoldTogetherAreRefusedInPlace) {
  const std::string link = "scene.yaml:3: bodies.part.plate.link.";
  expect_one_line(refusal_of(with_plate("link: {disc: {diameter: 1 cm, bore: 2 cm}}")), link + "disc.bore: ", {"less than the diameter"});
  expect_one_line(refusal_of(with_plate("link: {eye bar: {length: 1 cm, width: 1 cm, eyes: [{bore: 1 "
                                        "cm, outer: 3 cm}, {bore: 1 cm, outer: 3 cm}]}}")),
                  link + "eye bar: ", {"overlap"});
}

TEST(BadElasticFile, IsJudgedByNameAndPlace) {
  const Folder folder;
  folder.write("part.geo", "// a drawing");
  folder.write("part.inp", "*NODE");
  folder.write("part.step", "ISO-10303-21;");
  const auto said = [&](const std::string& keys) { return refusal_by([&] { read_scene(folder.write("s.yaml", with_plate(keys))); }); };
  const std::string place = (folder.path / "s.yaml").string() + ":3: bodies.part.plate";
  expect_one_line(said("file: none.step"), place + ".file: ", {"there is no file", "none.step"});
  expect_one_line(said("file: part.stl"), place + ".file: ", {".step", ".inp"});
  expect_one_line(said("file: part.geo, unit: inch"), place + ".unit: ", {"m, km, cm, mm"});
  expect_one_line(said("file: part.geo, unit: mm, scale: 2"), place + ".unit: ", {"combined with scale"});
  expect_one_line(said("file: part.step, unit: mm"), place + ".unit: ", {"STEP file itself"});
  expect_one_line(said("file: part.inp, size: 1 mm"), place + ".size: ", {"already a mesh"});
  expect_one_line(said("file: part.geo, grid: {}"), place + ": ", {"file and grid at once"});
}

}  // namespace
}  // namespace pintle::bad_elastic_test
