#pragma once

namespace pintle::app {

/// Prints the exception being handled as one line on stderr, for every program of the command line.
/// @pre called in a catch block  @returns the exit code
int report_failure();

/// Prints that there was not enough memory, for what, and where the results are. Allocates none.
void report_lack_of_memory();

/// @returns the exit code of f(), or that of the exception that it throws, which is reported
template <class F>
int exit_code_of(const F& f) {
  try {
    return f();
  } catch (...) {
    return report_failure();
  }
}

}  // namespace pintle::app
