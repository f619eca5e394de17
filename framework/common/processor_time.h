#pragma once

#include <ctime>

namespace pintle {

/// Seconds that this thread has computed, waiting left out: what something takes where nothing else keeps the machine busy.
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace pintle
