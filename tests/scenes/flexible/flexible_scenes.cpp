#include "tests/scenes/flexible/flexible_scenes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "framework/bodies/segments.h"
#include "framework/scene/yaml/reader.h"

namespace pintle_scenes {

namespace {

std::string indented(const std::string& lines) {
  std::istringstream in(lines);
  std::string line, out;
  while (std::getline(in, line)) out += "    " + line + "\n";
  return out;
}

}  // namespace

pintle::Scene scene_of(const std::string& text) {
  return pintle::with_pieces(pintle::read_scene_text(text, testing::TempDir() + "/test.yaml", {}, testing::TempDir()));
}

Whole run_text(const std::string& text) { return run(scene_of(text)); }

std::string body_text(const std::string& name, const std::string& keys) { return "  " + name + ":\n" + indented(keys); }

std::string text(const FlexibleCrank& o) {
  const double x = 0.05 * std::cos(o.angle), y = 0.05 * std::sin(o.angle);
  const double phi = -std::asin(y / 0.12);
  std::ostringstream s;
  s.precision(17);
  s << "gravity: [0, -9.81]\n"
       "ground: {points: {O: [0, 0]}}\n"
       "bodies:\n"
       "  crank:\n"
       "    rigid: {mass: 0.3, inertia: 1e-4, center: [0.025, 0]}\n"
       "    points: {O: [0, 0], A: [0.05, 0]}\n"
    << body_text("coupler", o.coupler) << "    pose: {at: [" << x << ", " << y << "], angle: " << phi
    << "}\n"
       "  slider:\n"
       "    rigid: {mass: 0.14, inertia: 1e-4}\n"
       "    pose: {at: ["
    << x + 0.12 * std::cos(phi)
    << ", 0]}\n"
       "joints:\n"
       "  main bearing: {revolute: [ground.O, crank.O]}\n"
       "  crank pin: {revolute: [crank.A, coupler.A]}\n"
       "  gudgeon pin:\n"
       "    revolute: [coupler.B, slider]\n";
  if (o.clearance > 0)
    s << "    clearance:\n"
         "      radial: "
      << o.clearance
      << "\n"
         "      bearing radius: 0.01\n"
         "      bearing: slider\n"
         "      normal: {lankarani-nikravesh: {restitution: 0.9, young: 207e9, poisson: 0.3}}\n";
  s << "  guide: {prismatic: [ground.O, slider]}\n"
       "start: {crank: {angle: "
    << o.angle << ", speed: " << o.speed << "}}\nrun: {until: " << o.until << ", tolerance: " << o.tolerance
    << "}\noutput: {every: " << o.until / o.outputs << ", points: [" << o.points << "]}\n";
  return s.str();
}

std::string text(const FlexibleBeam& o) {
  std::ostringstream s;
  s.precision(17);
  s << "beam: {from: A, to: B, section: {circle: " << o.diameter << "}, elements: " << o.elements
    << ", theory: euler, rotary inertia: false, young: " << o.young << ", poisson: 0.3, mass: " << o.mass << "}\npoints: {A: [0, 0], ";
  if (o.at > 0) s << "M: [" << o.at * o.length << ", 0], ";
  s << "B: [" << o.length << ", 0]}\n";
  if (!o.modes.empty()) s << "modes: " << o.modes << "\n";
  s << o.more;
  return s.str();
}

std::string holed_plate(const std::string& modes, const std::string& more) {
  // Seven by three cells, less two holes and what makes the waist.
  constexpr int columns = 7, rows = 3;
  const auto cell = [](int i, int j) { return j == 1 ? i != 1 && i != columns - 2 : i != columns / 2; };
  const auto node = [](int i, int j) { return 1 + i + (columns + 1) * j; };
  std::ostringstream name;
  name << "pintle_holed_plate_" << testing::UnitTest::GetInstance()->current_test_info()->name() << ".inp";
  std::ofstream file(testing::TempDir() + "/" + name.str());
  file.precision(17);
  file << "*NODE\n";
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) file << node(i, j) << ", " << 0.03 * i - 0.045 << ", " << 0.01 * j - 0.015 << "\n";
  file << "*ELEMENT, TYPE=CPS4\n";
  int number = 0;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      if (cell(i, j))
        file << ++number << ", " << node(i, j) << ", " << node(i + 1, j) << ", " << node(i + 1, j + 1) << ", " << node(i, j + 1) << "\n";
  return "plate: {file: " + name.str() +
         ", element: quadrilateral4, thickness: 0.01, young: 207e9, poisson: 0.3, mass: 0.21}\n"
         "points: {A: {hole: hole 1, coupling: rigid}, B: {hole: hole 2, coupling: average}}\n"
         "modes: " +
         modes + "\n" + more;
}

double apart(const Whole& a, const Whole& b, const std::string& point) {
  const auto ax = a.column(point + ".x [m]"), ay = a.column(point + ".y [m]"), bx = b.column(point + ".x [m]"),
             by = b.column(point + ".y [m]");
  if (ax.size() != bx.size() || ax.empty()) return std::nan("");
  double most = 0;
  for (std::size_t i = 0; i < ax.size(); ++i) most = std::max(most, std::hypot(ax[i] - bx[i], ay[i] - by[i]));
  return most;
}

double deflection(const Whole& w, const std::string& point) {
  const auto x = w.column(point + ".ux [m]"), y = w.column(point + ".uy [m]");
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::hypot(x[i], y[i]));
  return most;
}

std::vector<double> slopes(const std::vector<double>& parameter, const std::vector<double>& value) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < value.size(); ++i)
    out.push_back(std::log(value[i + 1] / value[i]) / std::log(parameter[i + 1] / parameter[i]));
  return out;
}

}  // namespace pintle_scenes
