#include "tests/unit/scarce_threads.h"

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>

namespace {
std::atomic<bool> scarce = false;
std::atomic<int> left = 0;
}  // namespace

/// Stands before the system's own: std::thread comes here.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*), void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  if (scarce && left-- <= 0) return EAGAIN;
  return create(thread, attributes, start, argument);
}

ScarceThreads::ScarceThreads(int allowed) {
  left = allowed;
  scarce = true;
}
ScarceThreads::~ScarceThreads() { scarce = false; }
