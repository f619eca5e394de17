// What a scene may say of dry friction: laws by their names, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/refusal.h"
#include "tests/scenes/friction/friction_scenes.h"

namespace pintle::friction_input_test {
namespace {

using pintle_scenes::block_on_ramp, pintle_scenes::dopri5, pintle_scenes::expect_sound, pintle_scenes::Oscillator, pintle_scenes::run,
    pintle_scenes::Whole;
using pintle_test::expect_refused;

TEST(BadFriction, IsRefusedInOneLineWithKeyAndRemedy) {
  struct Bad {
    const char *law, *key, *says;
  };
  for (const Bad& bad :
       std::vector<Bad>{{"coulomb: {coefficient: 0.3, static: 0.2}", "friction.coulomb.static", "must be coefficient, 0.3, or above"},
                        {"coulomb: {static: 0.2}", "friction.coulomb", "add for example coefficient"},
                        {"coulomb: {coefficient: -1}", "friction.coulomb.coefficient", "must not be negative"},
                        {"coulomb: {coefficient: 0.3, stribeck speed: 0}", "friction.coulomb.stribeck speed", "greater than 0"},
                        {"coulomb: {coefficient: 0.3, stribeck speed: 1 mm/s}", "friction.coulomb.stribeck speed", "needs `static`"},
                        {"coulomb: {coefficient: 0.3, v0: 1}", "friction.coulomb.v0", "unknown key"},
                        {"coulomb: {coefficient: 0.3}, tanh: {coefficient: 0.3}", "contacts.rest.friction", "one"},
                        {"columb: {coefficient: 0.3}", "friction.columb", "Did you mean \"coulomb\""},
                        {"lugre: {coefficient: 0.3}", "friction.lugre", "add for example bristle stiffness: 1e5 1/m"},
                        {"lugre: {coefficient: 0, static: 0.3, bristle stiffness: 1e5}", "friction.lugre.coefficient", "above 0"},
                        {"lugre: {coefficient: 0.3, bristle stiffness: 1e5 N/m}", "friction.lugre.bristle stiffness", "1/m"},
                        {"lugre: {coefficient: 0.3, bristle stiffness: 1e5, dwell time: 1 s}", "friction.lugre.dwell time", "unknown key"},
                        {"lugre: {coefficient: 0.3, bristle stiffness: 1e5, viscous: -1}", "friction.lugre.viscous", "not be negative"},
                        {"gonthier: {coefficient: 0.3, bristle stiffness: 1e5}", "friction.gonthier", "add for example dwell time: 2 s"},
                        {"gonthier: {coefficient: 0.3, bristle stiffness: 1e5, bristle damping: 0, dwell time: 1}",
                         "friction.gonthier.bristle damping", "greater than 0"},
                        {"tanh: {coefficient: 0.3, v1: 0}", "friction.tanh.v1", "greater than 0"},
                        {"threlfall: {coefficient: 0.3, static: 0.4}", "friction.threlfall.static", "unknown key"},
                        {"bengisu-akay: {coefficient: 0.3, static: 0.1}", "friction.bengisu-akay.static", "or above"},
                        {"bengisu-akay: {coefficient: 0.3, v0: 0}", "friction.bengisu-akay.v0", "greater than 0"}}) {
    SCOPED_TRACE(bad.law);
    expect_refused([&] { read_scene_text(block_on_ramp(0, 1, "", bad.law), "scene.yaml"); }, {bad.key, bad.says});
  }
}

// Each law by its name gives the force that its formula says, and creeps where it does.
TEST(FrictionLaws, ActAsTheirFormulasSay) {
  struct Law {
    const char* words;
    double at_2cm_per_s;  ///< of N
  };
  for (const Law& law :
       std::vector<Law>{{"ambrosio: {coefficient: 0.3, v0: 10 mm/s, v1: 30 mm/s}", 0.15},
                        {"threlfall: {coefficient: 0.3, v1: 30 mm/s}", 0.3 * (1 - std::exp(-2.0))},
                        {"tanh: {coefficient: 0.3, v1: 20 mm/s}", 0.3 * std::tanh(1.0)},
                        {"bengisu-akay: {coefficient: 0.3, static: 0.5, v0: 10 mm/s, v1: 10 mm/s}", 0.3 + 0.2 * std::exp(-1.0)},
                        {"coulomb: {coefficient: 0.3, static: 0.5, stribeck speed: 20 mm/s}", 0.3 + 0.2 * std::exp(-1.0)}}) {
    std::string text = Oscillator{.k = 1e-3, .V = 0.02, .until = 1e-3, .law = law.words}.text();
    text.replace(text.find("vx: 0.02"), 8, "vx: 0.0");
    const Whole w = run(text, dopri5);
    expect_sound(w);
    EXPECT_NEAR(std::abs(w.column("rub.friction [N]").front()), law.at_2cm_per_s * Oscillator{}.N, 1e-6) << law.words;
  }
}

}  // namespace
}  // namespace pintle::friction_input_test
