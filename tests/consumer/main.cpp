// A stranger's project: finds the installed library, uses a header of a leaf and one of the
// framework.
#include <cstdio>

#include "contact/normal_law.h"
#include "framework/run/vtk.h"

int main() {
  const pintle::ImpactLaw hertz{.k = 1e9};
  const auto f = pintle::evaluate(hertz, {.depth = 1e-6, .rate = 0, .impact_rate = 1});
  std::printf("%g N at 1 um\n", f.force);
  return f.force > 0 && pintle::Drawing{}.lines.empty() ? 0 : 1;
}
