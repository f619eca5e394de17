#pragma once

#include <string>

namespace pintle {

/// Holds BLAS, and OpenMP in this thread, to one thread each, in the whole process: what they split among threads is summed in
/// another order, so that results would follow the number of cores; and it gets in the way of other cases that run at once.
void hold_library_threads();

/// Which BLAS kernels round, and by how many threads: "Haswell, 1 thread". "unknown" of one that does not say.
std::string library_text();

}  // namespace pintle
