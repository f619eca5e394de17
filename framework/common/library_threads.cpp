#include "framework/common/library_threads.h"

#include <sys/resource.h>

#include <cstdlib>

#include "framework/common/solver_libraries.h"

namespace pintle {

namespace {

/// Function that the libraries may have: the system determines which BLAS is used, and whether CHOLMOD was built with OpenMP.
template <class Function>
Function* sought(const char* name, bool load = false) {
  return reinterpret_cast<Function*>(solver_function(name, load));
}

bool is_limited(decltype(RLIMIT_AS) resource) {
  struct rlimit limit {};
  return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

thread_local bool held = false;

}  // namespace

void shed_library_threads() {
  if (is_limited(RLIMIT_AS) || is_limited(RLIMIT_DATA)) ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
}

void apply_library_threads() {
  thread_local bool applied = false;  // settings of OpenMP are those of a thread
  if (!held || applied) return;
  applied = true;
  if (auto* set = sought<void(int)>("openblas_set_num_threads")) set(1);
  if (auto* set = sought<void(int)>("omp_set_num_threads")) set(1);
  if (auto* set = sought<void(int)>("omp_set_max_active_levels"))
    set(0);  // CHOLMOD requests four threads, whatever their number was set to
}

void hold_library_threads() { held = true; }

std::string library_text() {
  auto* const core = sought<char*()>("openblas_get_corename", true);
  auto* const threads = sought<int()>("openblas_get_num_threads", true);
  apply_library_threads();
  if (!core || !threads) return "unknown";
  const int n = threads();
  return std::string(core()) + ", " + std::to_string(n) + (n == 1 ? " thread" : " threads");
}

}  // namespace pintle
