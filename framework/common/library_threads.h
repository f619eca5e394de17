#pragma once

#include <string>

namespace pintle {

/// Limits BLAS, in the whole process, and OpenMP, in this thread, to one thread each: otherwise sums are formed in another order, so that
/// results would depend on the number of cores, and other cases running at the same time would be slowed down.
void hold_library_threads();

/// For programs, at their begin: where the system limits the memory of processes (ulimit -v or -d), starts the program again without threads
/// of OpenBLAS. It starts them as it is loaded, and a thread that gets no memory asks for it for ever, at the end of the program too.
void shed_library_threads(char** argv);

/// The BLAS kernels in use and their number of threads: "Haswell, 1 thread". "unknown" if BLAS does not report it.
std::string library_text();

}  // namespace pintle
