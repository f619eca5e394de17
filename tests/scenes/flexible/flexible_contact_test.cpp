// Surfaces and play at points of flexible bodies, against the same on rigid pieces welded to these points.
#include <gtest/gtest.h>

#include <regex>

#include "framework/bodies/segments.h"
#include "tests/refusal.h"
#include "tests/scenes/text_runs.h"

namespace pintle_scenes::flexible_contact_test {
namespace {

using pintle_test::expect_refused;

std::string with(const std::string& text, const std::string& what, const std::string& by) {
  return std::regex_replace(text, std::regex(what), by);
}

/// A leaf of 0.2 m, clamped at its end A, and 20 g at its end B: a part of it (TIP is the leaf, SHIFT 200 mm), or a rigid piece welded to it
/// (TIP is the piece, SHIFT 0).
struct Leaf {
  std::string nose;         ///< the profile at its end
  std::string bodies;       ///< others
  std::string rest;         ///< of the scene
  std::string joints = "";  ///< others
  std::string beam = "";    ///< more of it
  std::string text(bool welded) const {
    const std::string profile = nose.empty() ? "" : "profiles: {nose: {" + nose + "}}";
    const std::string tip = "B: {at: [SHIFT mm, 0], angle: 30 deg}";
    const std::string out =
        "gravity: [0, -9.81]\nmaterials: {steel: {young: 207 GPa, poisson: 0.3, density: 7850 kg/m^3}}\nbodies:\n"
        "  leaf:\n    beam: {from: A, to: B, section: {rectangle: [20 mm, 2 mm]}, material: steel, elements: 2" +
        beam +
        "}\n"
        "    points: {A: [0, 0], B: {at: [200 mm, 0], angle: 30 deg}}\n    modes: {craig-bampton: {keep: all}, frame: {tangent: A}}\n" +
        (welded ? "  tip:\n    rigid: {mass: 20 g, inertia: 2e-7 kg m^2}\n    points: {" + tip + "}\n    " + profile + "\n"
                : "    lumps: {B: {mass: 20 g, inertia: 2e-7 kg m^2}}\n    " + with(profile, "radius", "on: B, radius") + "\n") +
        bodies + "joints:\n  clamp: {weld: [ground, leaf.A]}\n" + (welded ? "  fix: {weld: [leaf.B, tip.B]}\n" : "") + joints + rest;
    return with(with(out, "TIP", welded ? "tip" : "leaf"), "SHIFT", welded ? "0" : "200");
  }
};

struct Law {
  const char* name;
  std::string words, method;
  double tolerance, near;
};
void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }

class FlexibleContact : public testing::TestWithParam<Law> {
 protected:
  Whole run_by(const std::string& text) const {
    pintle::Scene s = pintle::with_pieces(pintle::read_scene_text(with(text, "LAW", GetParam().words), "scene.yaml"));
    s.run.method = GetParam().method;
    s.run.tolerance = GetParam().tolerance;
    return run(s);
  }
  void expect_as_welded(const Leaf& leaf, const std::vector<std::string>& columns) const {
    const Whole direct = run_by(leaf.text(false)), welded = run_by(leaf.text(true));
    for (const Whole* w : {&direct, &welded}) {
      expect_sound(*w);
      EXPECT_FALSE(w->run.impacts.empty());
    }
    for (const std::string& name : columns)
      EXPECT_LT(relative_difference(direct.column(name), welded.column(name)), GetParam().near) << name;
  }
};

const std::string weight = "  weight: {rigid: {mass: 0.5 kg, inertia: 1e-4 kg m^2}, profiles: {rim: {disc: [0, 0], radius: 20 mm}}}\n";
const std::string falls =
    "contacts: {blow: {between: [weight.rim, TIP.nose], LAW}}\nstart: {weight: {at: [203 mm, 30 mm]}}\n"
    "run: {until: 60 ms}\noutput: {every: 1 ms}\n";

TEST_P(FlexibleContact, AWeightFallsOnARoller) {
  expect_as_welded({.nose = "disc: [SHIFT mm, 0], radius: 5 mm", .bodies = weight, .rest = falls}, {"weight.x [m]", "weight.y [m]"});
}

TEST_P(FlexibleContact, APinIsPlacedInAHole) {
  const std::string pin = "  pin: {rigid: {mass: 0.2 kg, inertia: 1e-4 kg m^2}, profiles: {rim: {disc: [0, 0], radius: 9 mm}}}\n";
  expect_as_welded({.nose = "hole: [SHIFT mm, 0], radius: 10 mm",
                    .bodies = pin,
                    .rest = "contacts: {blow: {between: [pin.rim, TIP.nose], LAW}}\nstart: {pin: {at: [0.2, 0]}}\nrun: {until: 60 ms}\n"
                            "output: {every: 1 ms}\n"},
                   {"pin.x [m]", "pin.y [m]"});
}

TEST_P(FlexibleContact, AWeightFallsOnABeamCutIntoPieces) {
  expect_as_welded({.nose = "disc: [SHIFT mm, 0], radius: 5 mm", .bodies = weight, .rest = falls, .beam = ", pieces: 2"},
                   {"weight.x [m]", "weight.y [m]"});
}

// A block in a guide with play at the leaf's end.
Leaf guide_until(const std::string& until) {
  return {.nose = "",
          .bodies = "  slider: {rigid: {mass: 0.2 kg, inertia: 1e-5 kg m^2}}\n",
          .rest = "start: {slider: {vx: 0.5, vy: -0.3}}\nrun: {until: " + until + "}\noutput: {every: 1 ms}\n",
          .joints = "  guide: {prismatic: [TIP.B, slider], clearance: {gap: 0.1 mm, length: 20 mm, height: 10 mm, LAW}}\n"};
}

TEST_P(FlexibleContact, ABlockBeginsToRattleInItsGuide) { expect_as_welded(guide_until("15 ms"), {"slider.x [m]", "slider.y [m]"}); }

// Where impacts are many, those of rigid surfaces are too sensitive to be compared.
class FlexibleCompliantContact : public FlexibleContact {};

TEST_P(FlexibleCompliantContact, ABlockHasPlayInItsGuide) { expect_as_welded(guide_until("40 ms"), {"slider.x [m]", "slider.y [m]"}); }

const std::string hysteresis =
    "normal: {hunt-crossley: {restitution: 0.6, stiffness: 1e8 N/m^1.5}}, friction: {coulomb: {coefficient: 0.2}}";

const Law compliant{"Compliant", hysteresis, "dopri5", 1e-9, 1e-5}, implicit{"Implicit", hysteresis, "generalized-alpha", 1e-8, 1e-2},
    rigid{"Rigid", "model: impact, restitution: 0, friction: {coulomb: {coefficient: 0.2}}", "dopri5", 1e-9, 1e-5};
INSTANTIATE_TEST_SUITE_P(Laws, FlexibleContact, testing::Values(compliant, implicit, rigid), [](const auto& i) { return i.param.name; });
INSTANTIATE_TEST_SUITE_P(Laws, FlexibleCompliantContact, testing::Values(compliant, implicit), [](const auto& i) { return i.param.name; });

// Of rims: what carries a surface at its own point is what a clearance joint meets there.
TEST(FlexibleContactOfRims, AHoleIsTheBearingOfAClearance) {
  const std::string law = "normal: {hunt-crossley: {restitution: 0.6, stiffness: 1e8 N/m^1.5}}, friction: {ambrosio: {coefficient: 0.1}}";
  const std::string pin = "  pin: {rigid: {mass: 0.2 kg, inertia: 1e-4 kg m^2}, profiles: {rim: {disc: [0, 0], radius: 9 mm}}}\n";
  const std::string rest = "start: {pin: {at: [0.2, 0]}}\nrun: {until: 30 ms, tolerance: 1e-11, method: dopri5}\noutput: {every: 1 ms}\n";
  const auto all = [&](const std::string& nose, const std::string& joint, const std::string& contact) {
    return run(
        pintle::read_scene_text(Leaf{.nose = nose, .bodies = pin, .rest = contact + rest, .joints = joint}.text(false), "scene.yaml"));
  };
  const Whole profiles =
      all("hole: [SHIFT mm, 0], radius: 10 mm", "",
          "contacts: {blow: {between: [pin.rim, TIP.nose], " + with(law, "restitution", "approach speed: onset, restitution") + "}}\n");
  const Whole clearance =
      all("", "  blow: {revolute: [TIP.B, pin], clearance: {radial: 1 mm, bearing radius: 10 mm, bearing: TIP, " + law + "}}\n", "");
  for (const char* name : {"pin.x [m]", "pin.y [m]", "pin.angle [rad]"})
    EXPECT_LT(relative_difference(profiles.column(name), clearance.column(name)), 1e-7) << name;
}

// A leaf that is let go strikes a stop on the ground to which it is clamped; a rigid body needs no such contact.
TEST(FlexibleContactWithItsClamp, ALeafStrikesAStopBesideItsClamp) {
  const std::string
      rest =
          "    profiles: {head: {disc: B, radius: 5 mm}}\n"
          "ground: {profiles: {stop: {path: [[0.15, -6 mm], [0.25, -6 mm]], material: right}}}\njoints: {w: {weld: [ground, leaf.A]}}\n"
          "contacts: {hit: {between: [leaf.head, ground.stop], normal: {hunt-crossley: {restitution: 0.5, stiffness: 1e8 N/m^1.5}}}}\n",
      run_it = "start: {leaf: {deflection: {B: [0, 5 mm]}}}\nrun: {until: 20 ms}\noutput: {every: 1 ms, frames: 0}\n";
  const Whole w =
      run("bodies:\n  leaf:\n    beam: {from: A, to: B, section: {rectangle: [2 mm, 20 mm]}, young: 207 GPa, poisson: 0.3, density: 7850 "
          "kg/m^3, theory: euler}\n    points: {A: [0, 0], B: [0.2, 0]}\n    modes: {frame: {tangent: A}, craig-bampton: {count: 4}}\n" +
          rest + run_it);
  pintle_scenes::expect_sound(w);
  EXPECT_GT(w.run.impacts.size(), 0u);
  expect_refused(
      [&] {
        run("bodies:\n  leaf:\n    rigid: {mass: 1, inertia: 0.01}\n    points: {A: [0, 0], B: [0.2, 0]}\n" + rest + "run: {until: 1}\n");
      },
      {"the weld \"w\" joins these two bodies rigidly"});
}

TEST(FlexibleContactRefusals, NameTheCarrier) {
  const auto of = [](const std::string& nose) {
    return [nose] { run(with(Leaf{.nose = nose, .bodies = weight, .rest = falls}.text(false), "LAW", "model: impact, restitution: 0")); };
  };
  expect_refused(of("path: [A, B]"), {"scene.yaml", "nose", "is flexible", "add `on`"});
  expect_refused(of("path: [A, B], on: [0, 0]"), {"nose.on", "name the point"});
  expect_refused(of("path: [A, B], on: C"), {"nose.on", "no point"});
  const std::string on_rigid = with(weight, "radius", "on: C, radius");
  expect_refused(
      [&] {
        run(with(Leaf{.nose = "disc: B, radius: 5 mm", .bodies = on_rigid, .rest = falls}.text(false), "LAW",
                 "model: impact, restitution: 0"));
      },
      {"rim.on", "weight"});
}

}  // namespace
}  // namespace pintle_scenes::flexible_contact_test
