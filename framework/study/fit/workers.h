#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pintle {

/// Executes task(0) … task(count − 1) in several threads, each drawing the next task; the caller calls `poll` about ten times a second. If
/// the system provides no threads, the caller executes the tasks, which must then call `poll` themselves.
/// @returns number of threads that worked, including the caller if it did
/// @throws what a task throws, when all have ended
inline std::size_t share_out(std::size_t count, int threads, const std::function<void(std::size_t)>& task,
                             const std::function<void()>& poll) {
  std::atomic<std::size_t> next = 0;
  std::size_t out = 0;
  std::exception_ptr trouble;
  std::mutex mutex;
  std::condition_variable ended;
  const auto work = [&] {
    try {
      for (std::size_t k; (k = next++) < count;) task(k);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!trouble) trouble = std::current_exception();
      next = count;
    }
    const std::lock_guard lock(mutex);
    --out;
    ended.notify_all();
  };
  std::vector<std::thread> workers;
  try {
    for (std::size_t k = 0; k < std::min(count, static_cast<std::size_t>(threads)); ++k) {
      {
        const std::lock_guard lock(mutex);
        ++out;
      }
      workers.emplace_back(work);
    }
  } catch (const std::exception&) {  // the others do the work
    const std::lock_guard lock(mutex);
    --out;
  }
  if (workers.empty()) out = 1, work();
  for (std::unique_lock lock(mutex); out > 0;) {
    ended.wait_for(lock, std::chrono::milliseconds(100), [&] { return out == 0; });
    lock.unlock();
    poll();
    lock.lock();
  }
  for (std::thread& t : workers) t.join();
  if (trouble) std::rethrow_exception(trouble);
  return std::max<std::size_t>(1, workers.size());
}

}  // namespace pintle
