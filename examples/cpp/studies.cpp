// A sweep over clearances and a search, as study files ask for them. Expect 5, 19 and 18 contacts (docs/paper.md).
#include <cstdio>
#include <filesystem>

#include "framework/study/fit/fit.h"
#include "framework/study/sweep/sweep.h"

int main(int, char** arguments) {
  using namespace pintle;
  const std::filesystem::path studies = std::filesystem::path(arguments[1]) / "studies", out = arguments[2];

  const Sweep sweep = read_sweep(studies / "clearance.yaml");
  const SweepEnd end = run_sweep(sweep, out / "sweep", {.threads = 2});
  std::printf("%s", sweep_csv(sweep, end.rows).c_str());

  const FitPlan plan = read_fit(studies / "fit_frequency.yaml");
  const FitEnd found = run_fit(plan, out / "fit", {});
  std::printf("the goal is met: %s", found.meets(plan) ? "yes" : "no");
  for (const auto& [name, value] : best_point(plan, found)) std::printf(", %s: %s", name.c_str(), value.c_str());
  std::printf("\n");
}
