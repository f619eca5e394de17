#pragma once

#include <atomic>

namespace pintle {

/// Progress of the present computation, 0 to 1, for a progress display; negative: unknown. Long computations set it now and then. With
/// several running at once it belongs to any of them.
inline std::atomic<double> work_done{-1};

}  // namespace pintle
