#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "framework/scene/error.h"
#include "framework/scene/units/table.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/targets.h"

namespace pintle {

void fuzz_table(std::string_view bytes) {
  try {
    const Samples s = read_samples(fuzz_folder().write("table.csv", bytes));
    const auto finite = [](double x) { return std::isfinite(x); };
    if (s.t.size() < 2 || s.t.size() != s.value.size()) std::abort();
    if (!std::ranges::all_of(s.t, finite) || !std::ranges::all_of(s.value, finite)) std::abort();
    if (std::ranges::adjacent_find(s.t, std::ranges::greater_equal{}) != s.t.end()) std::abort();
    const Spline spline(s);
    for (const double t : {s.t.front(), s.t.back(), (s.t.front() + s.t.back()) / 2, -1.0}) static_cast<void>(spline(t));
  } catch (const SceneError&) {
  }
}

}  // namespace pintle
