#pragma once

// Frames of a run against the columns of its results.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/mechanism/drawing.h"
#include "framework/mechanism/result_tables.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes {

using NamedForces = std::map<std::string, std::array<std::optional<double>, 3>>;

/// The sums of the columns .fx, .fy and .torque of each joint, contact and force, as far as it has them, in the last row.
inline NamedForces written(const pintle::Table& table, const std::set<std::string>& names) {
  const char* const ends[] = {".fx on ", ".fy on ", ".torque on "};
  NamedForces out;
  for (std::size_t c = 0; c < table.columns(); ++c)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = table.header[c].rfind(ends[i]);
      if (at == std::string::npos || !names.contains(table.header[c].substr(0, at))) continue;
      auto& sum = out[table.header[c].substr(0, at)][i];
      sum = sum.value_or(0) + table.data.at((table.rows() - 1) * table.columns() + c);
    }
  return out;
}
inline pintle::Wrench shown(const pintle::Drawing& drawing, const std::string& name) {
  pintle::Wrench out = pintle::Wrench::Zero();
  for (const pintle::DrawnForce& f : drawing.forces)
    if (drawing.owners.at(static_cast<std::size_t>(f.owner)) == name) out += pintle::Wrench(f.force.x(), f.force.y(), f.couple);
  return out;
}

/// Every force and couple that results give is in the frame of that time, on the same body. @returns how many of them are not zero
inline long expect_frames_hold_written_forces(pintle::Scene scene) {
  scene.output.frames = 21;
  const pintle::Model model = pintle::build(scene);
  const pintle::Drafting drafting(scene, model);
  const pintle::System& system = model.system;
  std::set<std::string> names;
  for (const auto& of : {system.joint_names, system.contact_names, system.force_names}) names.insert(of.begin(), of.end());
  pintle::Table table = pintle::trajectory_table(model);
  long count = 0;
  pintle::Listeners listeners;
  listeners.frame = [&](const pintle::State& state, const pintle::Equations& eq) {
    pintle::record(model, state, eq, table);
    const pintle::Drawing drawing = pintle::draw(model, drafting, state, eq);
    double largest = 0;
    for (std::size_t b = 0; b < system.bodies.size(); ++b)
      largest = std::max(largest, system.bodies[b].m * eq.a.segment<2>(static_cast<Eigen::Index>(3 * b)).norm());
    for (const pintle::DrawnForce& f : drawing.forces) largest = std::max({largest, f.force.norm(), std::abs(f.couple) / system.length});
    for (const auto& [name, force] : written(table, names)) {
      const pintle::Wrench drawn = shown(drawing, name);
      // The pairs of a contact may be added up in another order; each may be left out as rounding.
      const double rounding = 1e-15 * static_cast<double>(system.contacts.size()) * drawn.norm();
      const double left_out = 1e-11 * largest * static_cast<double>(system.contacts.size() + 1);
      for (std::size_t i = 0; i < 3; ++i) {
        if (!force[i] || !std::isfinite(*force[i])) continue;
        const double shown_as = drawn[static_cast<Eigen::Index>(i)];
        EXPECT_NEAR(shown_as, *force[i], rounding + (shown_as == 0 ? left_out * (i < 2 ? 1 : system.length) : 0))
            << name << ", component " << i << " at " << state.t << " s";
        count += *force[i] != 0;
      }
    }
  };
  pintle::simulate(scene, model, pintle::assemble(scene, model), listeners);
  return count;
}

}  // namespace pintle_scenes
