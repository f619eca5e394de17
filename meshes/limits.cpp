#include "meshes/limits.h"

#include <mutex>

namespace pintle {

namespace {
std::mutex mutex;
MesherLimits current;
}  // namespace

void set_mesher_limits(const MesherLimits& limits) {
  const std::lock_guard lock(mutex);
  current = limits;
}

MesherLimits mesher_limits() {
  const std::lock_guard lock(mutex);
  return current;
}

}  // namespace pintle
