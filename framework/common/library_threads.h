#pragma once

#include <string>

namespace pintle {

/// Limits BLAS, in the whole process, and OpenMP, in this thread, to one thread each. Otherwise sums would be formed in an order that
/// depends on the number of cores, as would the results, and other cases running at the same time would be slowed down.
void hold_library_threads();

/// To be called first in a program: if the system limits the memory of processes (ulimit -v or -d), restarts the program without OpenBLAS
/// threads. OpenBLAS starts its threads when it is loaded, and a thread that gets no memory retries for ever, even when the program ends.
void shed_library_threads(char** argv);

/// The BLAS kernels in use and their number of threads: "Haswell, 1 thread". "unknown" if BLAS does not report it.
std::string library_text();

}  // namespace pintle
