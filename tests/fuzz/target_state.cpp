#include <cstdlib>
#include <stdexcept>
#include <string>

#include "framework/analysis/simulate/identity.h"
#include "framework/analysis/simulate/saved_state.h"
#include "framework/build/build.h"
#include "framework/common/sha256.h"
#include "framework/scene/yaml/reader.h"
#include "tests/fuzz/targets.h"

namespace pintle {

namespace {

constexpr const char* scene_text = R"(
gravity: [0, -9.81]
bodies:
  crank: {rigid: {mass: 2, inertia: 0.01}, points: {O: [-0.1, 0], A: [0.1, 0]}, pose: {at: [0.1, 0]}}
  bob: {rigid: {mass: 1, inertia: 1e-3}, pose: {at: [0.2, 0]}}
joints:
  bearing: {revolute: [ground, crank.O]}
  pin: {revolute: [crank.A, bob], clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: crank,
        normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}}}
run: {until: 0.02, method: dopri5}
)";

struct Setting {
  Scene scene = read_scene_text(scene_text, "scene.yaml");
  Model model = build(scene);
  Assembly assembly = assemble(scene, model);
  std::string identity = pintle::identity(scene, model, assembly);
};

const Setting& setting() {
  static const Setting one;
  return one;
}

/// The text with the identity of this scene and its own checksum, so that what is behind these is reached.
std::string forged_state(const std::string& text) {
  std::string said = text.substr(0, text.rfind("\nchecksum "));
  constexpr std::string_view word = "\nof ";
  if (const std::size_t at = said.find(word); at != std::string::npos) {
    const std::size_t begin = at + word.size();
    said.replace(begin, std::min(said.find('\n', begin), said.size()) - begin, setting().identity);
  }
  return said + "\nchecksum " + sha256(said) + "\n";
}

void read_state(const std::string& text) {
  const Setting& s = setting();
  const auto state = [&](const std::string& of) { return state_of(of, "x.state", s.scene, s.model, s.assembly); };
  SavedState taken;
  try {
    taken = state(text);
  } catch (const SceneError&) {
    return;
  }
  // What is taken can be saved and taken again.
  if (state(state_text(s.identity, taken)).memory != taken.memory) std::abort();
}

}  // namespace

void fuzz_state(std::string_view bytes) {
  const std::string text(bytes);
  read_state(text);
  read_state(forged_state(text));
}

}  // namespace pintle
