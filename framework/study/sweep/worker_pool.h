#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "framework/bodies/body_store.h"
#include "framework/study/sweep/task_queue.h"
#include "framework/study/sweep/sweep.h"

namespace pintle {

/// Worker threads of one process that draw cases from a task queue, run them and write them to a journal. If the system cannot start some
/// of them, the others do the work; if it can start none, the caller does (`work_here`).
class WorkerPool {
 public:
  struct Tally {
    std::size_t done = 0, trouble = 0;
    double busy = 0;  ///< [s]
  };

  /// @param folder  for the curves of cases
  WorkerPool(const Sweep&, Journal&, const std::filesystem::path& folder, int rank, int threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;

  TaskQueue& queue() { return queue_; }
  bool home() const;    ///< all threads have ended, or without threads: all cases are done
  int workers() const;  ///< threads, or the caller
  int idle() const;     ///< number of these without a case
  /// Why there are fewer threads than requested; empty if there are not.
  const std::string& shortage() const { return shortage_; }
  /// Without threads: runs a case of the task queue, if there is one, and calls `poll` often during it.
  void work_here(const std::function<void()>& poll);
  bool troubled();  ///< a thread failed; finish() says why
  /// Aborts the running cases; they are not recorded.
  void stop();
  Tally tally();  ///< since the last call
  /// Waits until a thread has drawn the last case of the queue or ended, at most this long.
  void wait(std::chrono::milliseconds);
  /// Joins the threads. @throws what stopped a thread
  void finish();

 private:
  void start(int threads);
  void work(int thread);
  void run(std::size_t number, int thread);
  void news();

  const Sweep& sweep_;
  Journal& journal_;
  std::filesystem::path folder_;
  int rank_;
  TaskQueue queue_;
  BodyStore bodies_;  ///< of all its cases
  std::atomic<bool> stopped_ = false;
  std::atomic<int> out_ = 0;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable news_;
  long changes_ = 0, seen_ = 0;
  Tally tally_;
  std::exception_ptr trouble_;
  std::string shortage_;
  std::function<void()> poll_ = [] {};
  std::vector<std::thread> threads_;
};

}  // namespace pintle
