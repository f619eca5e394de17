// A stranger's project: finds the installed library, uses a header of a leaf, and reads, builds and runs a scene. Its own
// matrices are multiplied too, which share Eigen's functions with the library.
#include <cmath>
#include <cstdio>
#include <exception>

#include <Eigen/LU>

#include "contact/normal_law.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"

namespace {

// A pendulum of length 1 m about a pin, and a blade clamped to it: g and EI such that nothing moves far in 0.1 s.
constexpr const char* scene_text = R"(
gravity: [0, -9.81]
bodies:
  rod: {rigid: {mass: 1 kg, inertia: 0.1}, points: {O: [-1, 0]}}
  blade:
    beam: {from: A, to: B, section: {rectangle: [10 mm, 10 mm]}, young: 200 GPa, poisson: 0.3, density: 7800, elements: 6}
    points: {A: [0, 0], B: [0.5, 0]}
    modes: {frame: {tangent: A}, count: 2}
joints: {hinge: {revolute: [ground, rod.O]}, root: {weld: [ground, blade.A]}}
start: {rod: {angle: 0 deg}}
run: {until: 0.1 s, tolerance: 1e-10}
)";

double turn_of_the_pendulum() {
  using namespace pintle;
  const Scene scene = read_scene_text(scene_text, "pendulum.yaml");
  const Model model = build(scene);
  const Run run = simulate(scene, model, assemble(scene, model));
  if (run.status != Status::finished) std::printf("%s\n", run.reason.c_str());
  return run.status == Status::finished ? run.trajectory.column("rod.angle [rad]").back() : NAN;
}

// phi'' = -a cos phi from rest at phi = 0, a = m g L/(J + m L^2): phi = -a t^2/2 + a^3 t^6/240 - ...; the next term is 3e-10.
double expected() {
  const double a = 9.81 / 1.1, t = 0.1;
  return -a * t * t / 2 + std::pow(a, 3) * std::pow(t, 6) / 240;
}

}  // namespace

int main() try {
  const pintle::ImpactLaw hertz{.k = 1e9};
  const auto f = pintle::evaluate(hertz, {.depth = 1e-6, .rate = 0, .impact_rate = 1});
  const double turn = turn_of_the_pendulum();
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(100, 100) * 2;
  const double ones = (A * A.inverse()).sum();
  std::printf("%g N at 1 um; %.12g rad, %.12g expected; %g\n", f.force, turn, expected(), ones);
  return f.force > 0 && std::abs(turn - expected()) < 1e-8 && std::abs(ones - 100) < 1e-9 ? 0 : 1;
} catch (const std::exception& error) {
  std::printf("%s\n", error.what());
  return 1;
}
