#include "framework/study/share_out.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pintle {

std::string shortage_of_threads(std::size_t started, std::size_t asked, const char* why) {
  return std::to_string(started) + " of " + std::to_string(asked) + " threads could be started (" + why + "), " +
         (started == 0 ? "the cases are run one by one" : "these run the cases") +
         "; allow more processes (ulimit -u) or memory, or use fewer threads (--threads)";
}

Shared share_out(std::size_t count, int threads, const std::function<void(std::size_t, int)>& task, const std::function<void()>& poll) {
  std::atomic<std::size_t> next = 0;
  std::size_t running = 0;
  std::exception_ptr trouble;
  std::mutex mutex;
  std::condition_variable ended;
  const auto work = [&](int thread) {
    try {
      for (std::size_t k; (k = next++) < count;) task(k, thread);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!trouble) trouble = std::current_exception();
      next = count;
    }
    const std::lock_guard lock(mutex);
    --running;
    ended.notify_all();
  };
  const auto count_one = [&](int change) {
    const std::lock_guard lock(mutex);
    running += static_cast<std::size_t>(change);
  };
  Shared out;
  std::vector<std::thread> workers;
  const std::size_t asked = std::min(count, static_cast<std::size_t>(threads));
  try {
    for (std::size_t k = 0; k < asked; ++k) {
      count_one(1);
      workers.emplace_back(work, static_cast<int>(k));
    }
  } catch (const std::exception& error) {  // the others do the work
    count_one(-1);
    out.shortage = shortage_of_threads(workers.size(), asked, error.what());
  }
  if (workers.empty()) count_one(1), work(0);
  for (std::unique_lock lock(mutex); running > 0;) {
    ended.wait_for(lock, std::chrono::milliseconds(100), [&] { return running == 0; });
    lock.unlock();
    poll();
    lock.lock();
  }
  for (std::thread& t : workers) t.join();
  if (trouble) std::rethrow_exception(trouble);
  out.threads = std::max<std::size_t>(1, workers.size());
  return out;
}

}  // namespace pintle
