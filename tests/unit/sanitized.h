#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PINTLE_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define PINTLE_SANITIZED 1
#endif
#endif

namespace pintle_test {

/// How much slower programs run under sanitizers: for limits that only stop endless tests.
#if defined(PINTLE_SANITIZED)
inline constexpr double sanitizer_slowdown = 30;
#else
inline constexpr double sanitizer_slowdown = 1;
#endif

}  // namespace pintle_test
