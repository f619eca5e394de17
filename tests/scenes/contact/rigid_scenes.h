#pragma once

// Rigid bodies that meet: what tests of them share.
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/text_runs.h"

namespace pintle_scenes {

/// Those that take impacts. Falls are integrated exactly by each, so that what is left is rounding.
inline const std::vector<Method> struck_by{
    {"dopri5", "dopri5", 1e-10, 1e-8},
    {"rkf45", "rkf45", 1e-10, 1e-8},
    {"verner87", "verner87", 1e-10, 1e-8},
};

/// A floor at y = 0 and gravity of 9.81 m/s² down a slope, which the floor is.
inline std::string floor_under(double slope = 0) {
  return "gravity: [" + number(9.81 * std::sin(slope)) + ", " + number(-9.81 * std::cos(slope)) +
         "]\nground: {profiles: {floor: {path: [[-50, 0], [50, 0]], material: right}}}\n";
}
/// Of radius 0.1 m, 1 kg, as a cylinder.
inline std::string disc(const std::string& name) {
  return "  " + name + ": {rigid: {mass: 1 kg, inertia: 0.005 kg m^2}, profiles: {rim: {disc: [0, 0], radius: 0.1}}}\n";
}
inline std::string struck(const std::string& name, const std::string& a, const std::string& b, const std::string& laws) {
  return "  " + name + ": {between: [" + a + ", " + b + "], model: impact, " + laws + "}\n";
}
inline std::string run_for(double until, double every) {
  return "run: {until: " + number(until) + " s}\noutput: {every: " + number(every) + " s, frames: 0}\n";
}

/// A column's value in the row of this time.
inline double at(const Whole& w, const std::string& column, double t) {
  const std::vector<double> times = w.column("t [s]"), x = w.column(column);
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - t) < 1e-9) return x[i];
  ADD_FAILURE() << "no row at " << t;
  return 0;
}

/// Those of one contact.
inline std::vector<pintle::Impact> impacts(const Whole& w, const std::string& contact) {
  std::vector<pintle::Impact> out;
  for (const pintle::Impact& i : w.run.impacts)
    if (w.model.system.contact_names[static_cast<std::size_t>(i.contact)] == contact) out.push_back(i);
  return out;
}

}  // namespace pintle_scenes
