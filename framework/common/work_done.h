#pragma once

#include <atomic>

namespace pintle {

/// Progress of the present computation, 0 to 1, for a progress display; negative: unknown. Long computations update it occasionally. If
/// several run at once, it may belong to any of them.
inline std::atomic<double> work_done{-1};

}  // namespace pintle
