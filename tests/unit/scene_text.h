#pragma once

// A scene that uses all of the language, and what the tests of the reader do to it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"

namespace pintle {

namespace fs = std::filesystem;

// Line numbers below count from the line after R"(.
inline const std::string slider_crank = R"(title: Slider-crank
gravity: [0, -9.81]
parameters:
  clearance: 0.01 mm
  speed: 150 rad/s
bodies:
  crank:
    rigid: {mass: 0.30 kg, inertia: 1.0e-4}
    points: {O: [-25 mm, 0], A: {at: [25 mm, 0], angle: 30 deg}}
    pose: {at: [1 cm, 0], angle: 2*pi/3}
  slider: {rigid: {mass: 0.14 kg, inertia: 1.0e-4, center: [1 mm, 2 mm]}}
joints:
  main: {revolute: [ground, crank.O]}
  pin:
    revolute: [crank.A, slider]
    clearance:
      radial: clearance
      bearing radius: 10 mm
      bearing: slider
      normal: {lankarani-nikravesh: {restitution: 0.8, young: 207 GPa, poisson: 0.3}}
      friction: {ambrosio: {coefficient: 0.1, v0: 1 mm/s, v1: 10 mm/s}}
  guide: {prismatic: [ground, slider], angle: 90 deg}
  rod: {distance: [ground, slider], length: 120 mm}
drivers:
  motor: {angle: [ground, crank], law: speed*t}
forces:
  push: {force: [0, 5 N*sin(10*t)], at: crank.A, follows: true}
  brake: {torque: -2 N m, on: crank}
  coil: {spring: [ground, slider], stiffness: 3 N/mm, damping: 5 N s/m, free length: 50 mm}
  hair: {torsion spring: [ground, crank], stiffness: 7 N m/rad, free angle: 10 deg}
start:
  crank: {angle: 0 deg, speed: speed, x: 1 mm}
  pin: {eccentricity: [1 um, 0], speed: [0, 1 mm/s]}
run: {until: 0.05 s, method: rkf45, tolerance: 1e-9, onset: {cut: 1e-8 m}, max step: 1 ms}
output: {every: 10 us, frames: 200}
)";

inline std::string with(const std::string& from, const std::string& to) {
  std::string text = slider_crank;
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no \"" + from + "\" in the scene");
  return text.replace(at, from.size(), to);
}

inline std::string refusal_of(const std::string& text, const Overrides& overrides = {}) {
  return pintle_test::refusal_by([&] { read_scene_text(text, "scene.yaml", overrides); });
}

using pintle_test::expect_one_line, pintle_test::expect_says, pintle_test::refusal_by;

/// A change that spoils the scene, where the message must point, and its remedy.
struct Spoiled {
  std::string from, to, place;
  std::vector<std::string> says;
};

/// @param spoiled  the scene with the one text in place of the other
template <class Change>
void expect_each_refused(const std::vector<Spoiled>& all, const Change& spoiled) {
  for (const Spoiled& s : all) {
    SCOPED_TRACE(s.to);
    expect_one_line(refusal_of(spoiled(s.from, s.to)), s.place, s.says);
  }
}

// A directory that lives as long as the test.
struct Folder {
  Folder()
      : path(fs::temp_directory_path() / (std::string("pintle_reader_") + testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
  fs::path path;
};

}  // namespace pintle
