#include "framework/common/library_threads.h"

#include <dlfcn.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>

namespace pintle {

namespace {

/// Function looked up at run time: the system determines which BLAS is used, and whether CHOLMOD was built with OpenMP.
template <class Function>
Function* sought(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

bool is_limited(decltype(RLIMIT_AS) resource) {
  struct rlimit limit {};
  return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

}  // namespace

void shed_library_threads(char** argv) {
  constexpr const char* threads = "OPENBLAS_NUM_THREADS";
  if (std::getenv(threads) || !(is_limited(RLIMIT_AS) || is_limited(RLIMIT_DATA))) return;
  ::setenv(threads, "1", 1);
  ::execv("/proc/self/exe", argv);  // returns only if it fails: the program then continues unchanged
}

void hold_library_threads() {
  static const bool blas = [] {
    if (auto* set = sought<void(int)>("openblas_set_num_threads")) set(1);
    return true;
  }();
  thread_local const bool openmp = [] {  // settings per thread
    if (auto* set = sought<void(int)>("omp_set_num_threads")) set(1);
    if (auto* set = sought<void(int)>("omp_set_max_active_levels"))
      set(0);  // CHOLMOD requests four threads, whatever their number was set to
    return true;
  }();
  static_cast<void>(blas), static_cast<void>(openmp);
}

std::string library_text() {
  auto* const core = sought<char*()>("openblas_get_corename");
  auto* const threads = sought<int()>("openblas_get_num_threads");
  if (!core || !threads) return "unknown";
  const int n = threads();
  return std::string(core()) + ", " + std::to_string(n) + (n == 1 ? " thread" : " threads");
}

}  // namespace pintle
