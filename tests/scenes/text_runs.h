#pragma once

// Whole runs of scenes given as text.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <sstream>
#include <string>

#include "framework/scene/yaml/reader.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes {

struct Method {
  const char* name;
  std::string words;
  double tolerance, near;  ///< of the run; of what it shows, relative
};
inline void PrintTo(const Method& m, std::ostream* out) { *out << m.name; }
inline std::string name_of(const testing::TestParamInfo<Method>& i) { return i.param.name; }

inline Whole run(const std::string& text) { return run(pintle::read_scene_text(text, "scene.yaml")); }
/// By this method and to its tolerance, whatever the text asks for.
inline Whole run(pintle::Scene s, const Method& method) {
  s.run.method = method.words;
  s.run.tolerance = method.tolerance;
  return run(s);
}
inline Whole run(const std::string& text, const Method& method) { return run(pintle::read_scene_text(text, "scene.yaml"), method); }

/// It has finished and its books close.
/// @param rounding  what may be unexplained where no energy is in play [J]
inline void expect_sound(const Whole& w, double rounding = 0) {
  ASSERT_EQ(w.run.status, pintle::Status::finished) << w.run.reason;
  EXPECT_LT(std::abs(w.run.unexplained), 1e-5 * w.run.energy_in_play + rounding);
}

/// To write in a scene: read back, it is the same.
inline std::string number(double x) {
  std::ostringstream s;
  s.precision(17);
  s << x;
  return s.str();
}

}  // namespace pintle_scenes
