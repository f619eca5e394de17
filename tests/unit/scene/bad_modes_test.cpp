// Every way to get modes, damping, supports or loads of a body of elements wrong, and the one line
// that says where and what to do.
#include "tests/unit/scene/elastic_text.h"

namespace pintle::bad_modes_test {
namespace {

TEST(BadModes, ModesAreJudged) {
  expect_refused({
      {"below: 5 kHz", "below: 5 kHz, count: 3", "scene.yaml:24: bodies.mast.modes: ", {"count and below at once"}},
      {"keep: all", "keep: some", "scene.yaml:10: bodies.coupler.modes.keep: ", {"must be all or auto"}},
      {"keep: all", "keep: auto, count: 3", "scene.yaml:10: bodies.coupler.modes: ", {"keep and count at once"}},
      {"craig-bampton: {below: 8 kHz}",
       "craig-bampton: {below: 8 kHz, keep: auto}",
       "scene.yaml:37: bodies.rocker.modes.craig-bampton: ",
       {"keep and below at once"}},
      {"below: 5 kHz", "below: -5 kHz", "scene.yaml:24: bodies.mast.modes.below: ", {"greater than 0"}},
      {"below: 5 kHz", "below: 5000/s", "scene.yaml:24: bodies.mast.modes.below: ", {"turns or radians", "Hz or rad/s"}},
      {"below: 5 kHz", "below: 5 mm", "scene.yaml:24: bodies.mast.modes.below: ", {"a length [m]; expected a frequency [Hz]"}},
      {"below: 5 kHz", "count: 0", "scene.yaml:24: bodies.mast.modes.count: ", {"at least 1"}},
      {"effective mass: 0.95", "effective mass: 95", "scene.yaml:42: bodies.sheet.modes.effective mass: ", {"between 0 and 1"}},
      {"{tangent: foot}",
       "{tangent: food}",
       "scene.yaml:24: bodies.mast.modes.frame.tangent: ",
       {"mast has no point \"food\"", "\"foot\""}},
      {"{chord: [C, D]}", "{chord: [C, C]}", "scene.yaml:37: bodies.rocker.modes.frame.chord: ", {"from C to itself"}},
      {"frame: chord", "frame: cord", "scene.yaml:10: bodies.coupler.modes.frame: ", {"Did you mean \"chord\"?"}},
      {"craig-bampton: {below: 8 kHz}",
       "craig-bampton: {}, below: 8 kHz",
       "scene.yaml:37: bodies.rocker.modes.below: ",
       {"craig-bampton: {below: …}"}},
      {"craig-bampton: {below: 8 kHz}",
       "craig-bampton: {}, free: {}",
       "scene.yaml:37: bodies.rocker.modes: ",
       {"craig-bampton and free at once"}},
      {"craig-bampton: {below: 8 kHz}", "craig bampton: {}", "scene.yaml:37: bodies.rocker.modes.craig bampton: ", {"\"craig-bampton\""}},
  });
}

TEST(BadModes, StiffeningAndPiecesAreForBodiesThatBend) {
  const std::string rod = with_beam("section: {circle: 1 mm}, " + steel_keys);
  const std::string modes = "    modes: {count: 2}\n";
  const std::string stiffening = "scene.yaml:5: bodies.rod.stiffening: ";
  expect_one_line(refusal_of(rod + "    stiffening: axial\n"), stiffening, {"needs a flexible body", "craig-bampton: {count: 2}"});
  expect_one_line(refusal_of(rod + "    stiffening: axail\n" + modes), stiffening, {"none, rotation or axial", "Did you mean \"axial\"?"});
  expect_one_line(refusal_of("bodies: {b: {rigid: {mass: 1, inertia: 1}, stiffening: axial}}\n"),
                  "scene.yaml:1: bodies.b.stiffening: ", {"does not belong to rigid"});
  const auto pieces = [&](const std::string& keys) { return with_beam("section: {circle: 1 mm}, " + keys + ", " + steel_keys); };
  const std::string place = "scene.yaml:3: bodies.rod.beam.pieces: ";
  expect_one_line(refusal_of(pieces("pieces: 8")), place, {"needs a flexible body", "modes"});
  expect_one_line(refusal_of(pieces("pieces: 0") + modes), place, {"at least 1"});
  expect_one_line(refusal_of(pieces("pieces: 2.5") + modes), place, {"whole number"});
  expect_one_line(refusal_of(pieces("pieces: 20000") + modes), place, {"ten thousand"});
  expect_one_line(refusal_of(pieces("pieces: 8, theory: bar") + modes), place, {"hinged at every node", "euler or timoshenko"});
}

TEST(BadModes, StressIsRecordedWhereMaterialDeforms) {
  const auto said = [](const std::string& point) { return refusal_of(elastic_scene + "output: {stress: [coupler.B, " + point + "]}\n"); };
  const std::string place = "scene.yaml:53: output.stress[2]: ";
  expect_one_line(said("coupler.Q"), place, {"coupler has no point \"Q\"", "A or B"});
  expect_one_line(said("couple.A"), place, {"Did you mean \"coupler\"?"});
  expect_one_line(said("rocker.C"), place, {"centre of a hole", "of the plate itself"});
  expect_one_line(said("mast"), place, {"is a body", "mast.foot"});
  expect_one_line(said("ground"), place, {"the ground has no stress"});
  expect_one_line(said("coupler.B"), place, {"is listed twice"});
  const auto of_rigid = [](const std::string& body) {
    return refusal_of("bodies:\n  b: {" + body + ", points: {A: [0, 0], B: [1, 0]}}\n" + "output: {stress: [b.A]}\n");
  };
  const std::string first = "scene.yaml:3: output.stress[1]: ";
  expect_one_line(of_rigid("rigid: {mass: 1, inertia: 1}"), first, {"b is rigid", "a beam or a plate, and modes"});
  expect_one_line(of_rigid("beam: {from: A, to: B, section: {circle: 1}, " + steel_keys + "}"), first, {"b is rigid", "give it modes"});
}

TEST(BadModes, HzStaysRefusedWhereRadiansCount) {
  expect_refused({{"spin: 3000 rpm", "spin: 50 Hz", "scene.yaml:52: static.loads.spin.spin: ", {"Hz counts turns, not radians"}},
                  {"alpha: 3 1/s", "alpha: 3 Hz", "scene.yaml:25: bodies.mast.damping.rayleigh.alpha: ", {"Hz counts turns"}}});
}

TEST(BadModes, DampingIsJudged) {
  expect_refused({
      {"ratios: 0.02}",
       "ratios: 2}",
       "scene.yaml:38: bodies.rocker.damping.ratios: ",
       {"between 0 and 1", "4 % is 0.04", "rayleigh: {alpha:"}},
      {"ratios: [0.04, 0.03]", "ratios: [4, 3]", "scene.yaml:11: bodies.coupler.damping.rayleigh.ratios[1]: ", {"4 % is 0.04"}},
      {"ratios: [0.01, 0.02]", "ratios: [0.01, 1.2]", "scene.yaml:43: bodies.sheet.damping.ratios[2]: ", {"4 % is 0.04"}},
      {"ratios: 0.02}", "}", "scene.yaml:38: bodies.rocker.damping: ", {"rayleigh or ratios"}},
      {"modes: [1, 3]", "modes: [3, 3]", "scene.yaml:11: bodies.coupler.damping.rayleigh.modes: ", {"one mode twice"}},
      {"modes: [1, 3]", "modes: [0, 3]", "scene.yaml:11: bodies.coupler.damping.rayleigh.modes[1]: ", {"at least 1"}},
      {"modes: [1, 3]", "alpha: 3 1/s", "scene.yaml:11: bodies.coupler.damping.rayleigh: ", {"either by ratios"}},
      {"ratios: [0.04, 0.03]", "ratios: 0.04", "scene.yaml:11: bodies.coupler.damping.rayleigh.ratios: ", {"two damping ratios"}},
      {"beta: 1e-5 s", "beta: -1e-5 s", "scene.yaml:25: bodies.mast.damping.rayleigh.beta: ", {"not be negative"}},
  });
}

TEST(BadModes, LumpsAndSupportsAreJudged) {
  expect_refused({
      {"lumps: {B: {mass: 0.1 kg", "lumps: {E: {mass: 0.1 kg", "scene.yaml:13: bodies.coupler.lumps.E: ", {"coupler has no point \"E\""}},
      {"mass: 0.1 kg, inertia: 1e-5 kg m^2", "", "scene.yaml:13: bodies.coupler.lumps.B: ", {"has no mass and no inertia"}},
      {"mass: 0.1 kg", "mass: -0.1 kg", "scene.yaml:13: bodies.coupler.lumps.B.mass: ", {"not be negative"}},
      {"A: fixed", "A: fixd", "scene.yaml:14: bodies.coupler.supports.A: ", {"Did you mean \"fixed\"?"}},
      {"B: [y]", "B: [z]", "scene.yaml:14: bodies.coupler.supports.B[1]: ", {"x, y, rotation, fixed or pinned"}},
      {"B: [y]", "B: []", "scene.yaml:14: bodies.coupler.supports.B: ", {"a list of x, y and rotation"}},
      {"A: fixed", "right: fixed", "scene.yaml:14: bodies.coupler.supports.right: ", {"coupler has no point \"right\""}},
      {"mass matrix: lumped", "mass matrix: lump", "scene.yaml:12: bodies.coupler.mass matrix: ", {"consistent or lumped"}},
  });
}

TEST(BadModes, StaticCasesAreJudged) {
  expect_refused({
      {"body: rocker", "body: roker", "scene.yaml:45: static.body: ", {"Did you mean \"rocker\"?"}},
      {"  body: rocker\n", "", "scene.yaml:44: static: ", {"which body", "coupler, mast, rocker and sheet"}},
      {"at: D, force", "at: E, force", "scene.yaml:47: static.loads.pull.at: ", {"rocker has no point \"E\""}},
      {"at: D, force", "force", "scene.yaml:47: static.loads.pull: ", {"at: tip"}},
      {"force: [1 kN, 0]", "force: 1 kN", "scene.yaml:47: static.loads.pull.force: ", {"two values [x, y]"}},
      {"force: [1 kN, 0]", "force: [1 kN, 0], torque: 1", "scene.yaml:47: static.loads.pull: ", {"force and torque at once"}},
      {"on: eye 1, pressure",
       "at: C, pressure",
       "scene.yaml:49: static.loads.bearing.at: ",
       {"does not belong to pressure but to force or torque"}},
      {"pressure: 5 MPa", "pressure: 5 N", "scene.yaml:49: static.loads.bearing.pressure: ", {"a force [N]; expected a stress [Pa]"}},
      {"on: outline, ", "", "scene.yaml:50: static.loads.edge: ", {"on: the name of an edge"}},
      {"traction: [0, 1 MPa]", "line load: [0, 1]", "scene.yaml:50: static.loads.edge.on: ", {"line load"}},
      {"about: C", "about: Q", "scene.yaml:52: static.loads.spin.about: ", {"no point \"Q\""}},
      {"    dead weight: {acceleration",
       "    dead weight: {accelaration",
       "scene.yaml:51: static.loads.dead weight.accelaration: ",
       {"\"acceleration\""}},
  });
  expect_one_line(refusal_of(with_beam("section: {circle: 1 mm}, " + steel_keys) + "static: {loads: {push: {on: A, pressure: 1 MPa}}}\n"),
                  "scene.yaml:5: static.loads.push.pressure: ", {"rod is a beam", "line load"});
  expect_one_line(refusal_of("bodies: {b: {rigid: {mass: 1, inertia: 1}}}\nstatic: {loads: {}}\n"),
                  "scene.yaml:2: static: ", {"all are rigid", "a beam or a plate"});
}

TEST(BadModes, UnitsThatAreNoneAreNamedWithAWayOut) {
  const auto said = [](const std::string& mass) { return refusal_of(spoiled("0.21 kg", mass)); };
  const std::string place = "scene.yaml:8: bodies.coupler.beam.mass: ";
  expect_one_line(said("5 lb"), place, {"lb is not a unit here", "0.45359237 kg", "Units: m, km, cm"});
  expect_one_line(said("5 Kg"), place, {"did you mean kg?", "Units: m, km, cm"});
  expect_one_line(said("5 stone"), place, {"stone is not a unit here", "Units: m, km, cm"});
  expect_one_line(said("5 mA"), place, {"\"5 mA\" is a current"});
  expect_one_line(said("5 bar"), place, {"\"5 bar\" is a stress"});
  const auto torque = [](const std::string& text) { return refusal_of(spoiled("5 N m}", text + "}")); };
  expect_one_line(torque("5 Nm"), "scene.yaml:48: ", {"Nm is not a unit here", "N m"});
  expect_one_line(torque("5 kNm"), "scene.yaml:48: ", {"kN m"});
  expect_one_line(refusal_of(spoiled("thickness: 8 mm", "thickness: 5 inch")), "scene.yaml:30: ", {"inch is not a unit here", "25.4 mm"});
}

TEST(BadModes, AParameterBesideANumberIsToldToMultiply) {
  std::string text = spoiled("circle: 10 mm", "circle: 2 d");
  text.insert(0, "parameters: {d: 5 mm}\n");
  expect_one_line(refusal_of(text), "scene.yaml:9: ", {"there is no operator between 2 and d: write 2*d"});
}

}  // namespace
}  // namespace pintle::bad_modes_test
