#include "framework/study/sweep/worker_pool.h"

#include <algorithm>
#include <new>

#include "framework/study/share_out.h"
#include "framework/study/sweep/curves.h"

namespace pintle {

WorkerPool::WorkerPool(const Sweep& sweep, Journal& journal, const std::filesystem::path& folder, int rank, int threads)
    : sweep_(sweep), journal_(journal), folder_(folder), rank_(rank) {
  if (!sweep.keep.empty()) make_curves_folder(folder_);
  try {
    start(threads);
  } catch (const std::exception& error) {
    shortage_ = shortage_of_threads(threads_.size(), static_cast<std::size_t>(threads), error.what());
  }
}

void WorkerPool::start(int threads) {
  for (int k = 0; k < threads; ++k) {
    ++out_;
    try {
      threads_.emplace_back([this, k] { work(k); });
    } catch (...) {
      --out_;
      throw;
    }
  }
}

WorkerPool::~WorkerPool() {
  stop();
  for (std::thread& t : threads_)
    if (t.joinable()) t.join();
}

bool WorkerPool::home() const { return threads_.empty() ? queue_.closed() && queue_.left() == 0 : out_ == 0; }

int WorkerPool::workers() const { return std::max(1, static_cast<int>(threads_.size())); }

int WorkerPool::idle() const { return threads_.empty() ? queue_.left() == 0 : queue_.waiting(); }

bool WorkerPool::troubled() {
  const std::lock_guard lock(mutex_);
  return trouble_ != nullptr;
}

void WorkerPool::stop() {
  stopped_ = true;
  queue_.clear();
}

WorkerPool::Tally WorkerPool::tally() {
  const std::lock_guard lock(mutex_);
  return std::exchange(tally_, {});
}

void WorkerPool::wait(std::chrono::milliseconds most) {
  if (threads_.empty()) return;  // no other thread will notify
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, most, [&] { return changes_ != seen_; });
  seen_ = changes_;
}

void WorkerPool::finish() {
  for (std::thread& t : threads_) t.join();
  if (trouble_) std::rethrow_exception(trouble_);
}

void WorkerPool::news() {
  const std::lock_guard lock(mutex_);
  ++changes_;
  news_.notify_all();
}

void WorkerPool::work(int thread) {
  try {
    while (const std::optional<std::size_t> number = queue_.draw()) {
      if (queue_.left() == 0) news();  // the only event that the caller waits for
      run(*number, thread);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    trouble_ = std::current_exception();
  }
  --out_;
  news();
}

void WorkerPool::work_here(const std::function<void()>& poll) {
  if (!threads_.empty() || queue_.left() == 0) return;
  poll_ = poll;
  try {
    run(*queue_.draw(), 0);
  } catch (...) {
    trouble_ = std::current_exception();
  }
}

void WorkerPool::run(std::size_t number, int thread) {
  const auto begin = std::chrono::steady_clock::now();
  CaseLimits limits = sweep_.limits;
  limits.bodies = &bodies_;
  limits.curves = &sweep_.keep;
  limits.go_on = [this] {
    poll_();
    return !stopped_;
  };
  Outcome outcome;
  try {
    outcome = run_case(sweep_.study.scene, sweep_.cases.overrides(number - 1), sweep_.study.measures, limits);
  } catch (const std::bad_alloc&) {
    outcome.status = status_text(Status::out_of_memory),
    outcome.reason = "there was not enough memory; run fewer cases at once (--threads)";
  }
  if (stopped_ || outcome.status == status_text(Status::interrupted)) return;
  Row row = row_of(number, outcome, std::to_string(rank_) + "." + std::to_string(thread));
  write_curves(outcome.curves, folder_, row);
  journal_.append(row);
  const std::lock_guard lock(mutex_);
  tally_.done += 1;
  tally_.trouble += row.status != "finished";
  tally_.busy += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace pintle
