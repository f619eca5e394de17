#pragma once

#include <atomic>
#include <exception>

namespace pintle {

/// Set by whoever started the computation of this thread and may ask it to stop.
inline thread_local const std::atomic<bool>* stop_asked = nullptr;

inline bool is_asked_to_stop() { return stop_asked != nullptr && *stop_asked; }

/// The computation was stopped because it was asked to. Not an error.
struct Stopped : std::exception {
  const char* what() const noexcept override { return "the computation was stopped"; }
};

/// Between the parts of a long computation. @throws Stopped
inline void stop_point() {
  if (is_asked_to_stop()) throw Stopped();
}

}  // namespace pintle
