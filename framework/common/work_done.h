#pragma once

#include <atomic>

namespace pintle {

/// How far the computation at hand is, 0 to 1, for whoever shows it to someone who waits; below 0: it does not tell. Long computations
/// set it now and then. Where several run at once it is of any of them.
inline std::atomic<double> work_done{-1};

}  // namespace pintle
