#pragma once

namespace pintle::app {

/// Prints the exception being handled as one line on stderr, for every program of the command line.
/// @pre called in a catch block  @returns the exit code
int report_failure();

/// Prints that memory ran out, during which activity, and where the results are. Allocates no memory.
void report_lack_of_memory();

/// The common main function of the command-line programs: prepares the handling of signals and failed writes, and the threads of libraries.
/// @returns the exit code of carry_out, or that of the exception that it throws, which is reported
int run_program(int argc, char** argv, int (*carry_out)(int, char**));

}  // namespace pintle::app
