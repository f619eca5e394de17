#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace pintle {

/// Numbers of pending cases, drawn by any number of threads, each once.
class TaskQueue {
 public:
  void add(std::span<const std::size_t> numbers) {
    const std::lock_guard lock(mutex_);
    numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
    drawn_.notify_all();
  }
  /// No more will be added.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    drawn_.notify_all();
  }
  /// Removes all that are left, and closes.
  void clear() {
    const std::lock_guard lock(mutex_);
    numbers_.clear();
    closed_ = true;
    drawn_.notify_all();
  }
  /// Waits for a number; nothing once the queue is closed and empty.
  std::optional<std::size_t> draw() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    drawn_.wait(lock, [&] { return closed_ || !numbers_.empty(); });
    --waiting_;
    if (numbers_.empty()) return {};
    const std::size_t k = numbers_.front();
    numbers_.pop_front();
    return k;
  }
  /// At most n, without waiting.
  std::vector<std::size_t> draw_some(std::size_t n) {
    const std::lock_guard lock(mutex_);
    const auto end = numbers_.begin() + static_cast<std::ptrdiff_t>(std::min(n, numbers_.size()));
    std::vector<std::size_t> out(numbers_.begin(), end);
    numbers_.erase(numbers_.begin(), end);
    return out;
  }
  bool closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
  }
  std::size_t left() const {
    const std::lock_guard lock(mutex_);
    return numbers_.size();
  }
  /// Number of waiting threads.
  int waiting() const {
    const std::lock_guard lock(mutex_);
    return waiting_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable drawn_;
  std::deque<std::size_t> numbers_;
  int waiting_ = 0;
  bool closed_ = false;
};

}  // namespace pintle
