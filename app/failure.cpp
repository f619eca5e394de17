#include "app/failure.h"

#include <sys/resource.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include "app/options.h"
#include "app/progress.h"
#include "framework/common/library_threads.h"
#include "framework/scene/error.h"
#include "meshes/limits.h"

namespace pintle::app {

namespace {

/// Largest memory that the program has used.
long most_megabytes() {
  struct rusage used {};
  ::getrusage(RUSAGE_SELF, &used);
  return used.ru_maxrss >> 10;
}

int failed_with(const char* what, int exit) {
  std::cerr << "pintle: " << what << "\n";
  return exit;
}

}  // namespace

void report_lack_of_memory() {
  std::fprintf(stderr,
               "pintle: there was not enough memory while %s (the program held %ld MB); end other programs, raise the limit (ulimit -v), "
               "or make the model or its outputs smaller%s\n",
               what_is_done(), most_megabytes(), where_results_are());
}

int report_failure() {
  try {
    throw;
  } catch (const SceneError& e) {
    return failed_with(e.what(), bad_scene);
  } catch (const AssemblyError& e) {
    return failed_with(e.what(), no_assembly);
  } catch (const MeshingStopped&) {
    return failed_with("stopped while a body was being meshed", stopped);
  } catch (const std::bad_alloc&) {
    report_lack_of_memory();
    return trouble;
  } catch (const std::filesystem::filesystem_error& e) {
    const bool denied = e.code() == std::errc::permission_denied || e.code() == std::errc::operation_not_permitted;
    const std::string why = denied ? "cannot be read (" + e.code().message() + "); check its permissions and those of the folders above it"
                                   : e.code().message();
    return failed_with((e.path1().string() + ": " + why + where_results_are()).c_str(), trouble);
  } catch (const std::exception& e) {
    const bool says_where = std::strstr(e.what(), "the results are in") != nullptr;
    const auto* of_system = dynamic_cast<const std::system_error*>(&e);
    const bool no_thread = of_system && of_system->code() == std::errc::resource_unavailable_try_again;
    std::cerr << "pintle: " << e.what() << (no_thread ? "; allow more processes (ulimit -u) or memory" : "")
              << (says_where ? "" : where_results_are()) << "\n";
    return trouble;
  }
}

int run_program(int argc, char** argv, int (*carry_out)(int, char**)) {
  shed_library_threads();
  leave_failed_writes_to_us();
  end_on_signals();
  try {
    return carry_out(argc, argv);
  } catch (...) {
    return report_failure();
  }
}

}  // namespace pintle::app
