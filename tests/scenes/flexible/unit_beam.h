#pragma once

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"

/// A uniform beam whose numbers are closed forms, and what a run of a scene with it says.
namespace pintle::unit_beam_scenes {

inline constexpr double pi = std::numbers::pi;

inline Scene scene_of(const std::string& text) { return with_pieces(read_scene_text(text, "scene.yaml")); }

struct Ran {
  Model model;
  Assembly assembly;
  Run run;
  std::vector<double> column(const std::string& name) const { return run.trajectory.column(name); }
};
inline Ran ran(const std::string& text) {
  const Scene scene = scene_of(text);
  Ran r;
  r.model = build(scene);
  r.assembly = assemble(scene, r.model);
  r.run = simulate(scene, r.model, r.assembly);
  return r;
}

inline bool warns(const std::vector<std::string>& warnings, const std::string& of) {
  for (const std::string& w : warnings)
    if (w.find(of) != std::string::npos) return true;
  return false;
}

/// The number that follows `words` in the first warning that has them; NaN: none has.
inline double said(const std::vector<std::string>& warnings, const std::string& words) {
  for (const std::string& w : warnings)
    if (const std::size_t at = w.find(words); at != std::string::npos) return std::atof(w.c_str() + at + words.size());
  return std::nan("");
}
inline constexpr double last_digit = 0.05;  ///< of a percentage, told to one decimal

inline std::string complaint(const std::string& text) {
  return pintle_test::refusal_by<std::exception>([&] { build(scene_of(text)); });
}

/// A beam of EI = ρA = 1 from A to B, 1 m along x, of 20 elements.
inline std::string unit_beam(const std::string& modes, const std::string& more = "", double EA = 1e6) {
  return "bodies:\n  beam:\n    beam: {from: A, to: B, theory: euler, rotary inertia: false, section: {area: 1, second moment: " +
         std::to_string(1 / EA) + "}, young: " + std::to_string(EA) +
         ", poisson: 0, density: 1}\n    points: {A: [0, 0], B: [1, 0]}\n    modes: " + modes + "\n" + more;
}
inline constexpr const char* clamp = "joints: {root: {weld: [ground, beam.A]}}\n";
inline constexpr double first = 1.8751040687 * 1.8751040687;  ///< of the cantilever [rad/s]: cos β cosh β = −1

}  // namespace pintle::unit_beam_scenes
