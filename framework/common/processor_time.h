#pragma once

#include <ctime>

namespace pintle {

/// Processor time of this thread [s], without waiting: the duration of a computation on an otherwise idle machine.
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace pintle
