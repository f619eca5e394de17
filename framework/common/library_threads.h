#pragma once

#include <string>

namespace pintle {

/// Limits BLAS, in the whole process, and OpenMP, in this thread, to one thread each, from their next use in this thread on. Otherwise sums
/// would be formed in an order that depends on the number of cores, as would the results, and other cases running at the same time would be
/// slowed down.
void hold_library_threads();

/// Does what hold_library_threads has asked for in this thread: before each use of the libraries (solver_libraries.cpp).
void apply_library_threads();

/// To be called first in a program: if the system limits the memory of processes (ulimit -v or -d), lets OpenBLAS start no threads. It starts
/// them when it is loaded, and a thread that gets no memory retries for ever, even when the program ends.
void shed_library_threads();

/// The BLAS kernels that are used and their number of threads: "Haswell, 1 thread". "unknown" if BLAS does not report it.
std::string library_text();

}  // namespace pintle
