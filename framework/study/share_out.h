#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace pintle {

/// The message that only some of the requested threads could be started, and why.
std::string shortage_of_threads(std::size_t started, std::size_t asked, const char* why);

struct Shared {
  std::size_t threads = 1;  ///< that worked, including the caller if it did
  std::string shortage;     ///< why there were fewer than requested; empty if there were not
};

/// Executes task(k, thread) for k = 0 … count − 1 in several threads, each drawing the next k; the caller calls `poll` about ten times a
/// second. If the system provides no threads, the caller executes the tasks, which must then call `poll` themselves.
/// @throws what a task throws, when all have ended
Shared share_out(std::size_t count, int threads, const std::function<void(std::size_t k, int thread)>& task,
                 const std::function<void()>& poll);

}  // namespace pintle
