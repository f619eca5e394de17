#pragma once

#include <cstddef>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace pintle {

/// Thread-safe cache of expensive results. The least recently used are dropped above a limit of size; a holder of a result
/// keeps it.
template <class T>
class MadeOnce {
 public:
  MadeOnce(std::size_t most_bytes, std::size_t (*bytes_of)(const T&)) : most_bytes_(most_bytes), bytes_of_(bytes_of) {}
  MadeOnce(const MadeOnce&) = delete;

  /// The result stored under `key`, or otherwise what `make()` returns. A thread that requests a result being made by another waits for it.
  /// A failure is not stored; each waiting thread then makes its own result, and gets its own error.
  template <class Make>
  std::shared_ptr<const T> get(const std::string& key, Make make) {
    std::promise<Result> promise;
    if (const std::shared_future<Result> known = find_or_begin(key, promise); known.valid()) {
      if (Result result = known.get()) return result;
      return std::make_shared<const T>(make());
    }
    Result result;
    try {
      result = std::make_shared<const T>(make());
    } catch (...) {
      forget(key);
      promise.set_value(nullptr);
      throw;
    }
    record_size(key, bytes_of_(*result) + key.size());
    promise.set_value(result);
    return result;
  }

  std::size_t bytes() const {  ///< of all stored results
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  using Result = std::shared_ptr<const T>;
  struct Entry {
    std::shared_future<Result> result;
    std::size_t bytes = 0;  ///< 0: being made
    std::list<const std::string*>::iterator turn;
  };

  /// The result to wait for; none if there is no such entry: then one is created, which `promise` must fill.
  std::shared_future<Result> find_or_begin(const std::string& key, std::promise<Result>& promise) {
    const std::lock_guard lock(mutex_);
    const auto [found, is_new] = entries_.try_emplace(key);
    Entry& entry = found->second;
    if (!is_new) {
      turns_.splice(turns_.begin(), turns_, entry.turn);
      return entry.result;
    }
    entry.result = promise.get_future().share();
    turns_.push_front(&found->first);
    entry.turn = turns_.begin();
    return {};
  }

  void record_size(const std::string& key, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    entries_.at(key).bytes = bytes;
    bytes_ += bytes;
    for (auto turn = turns_.end(); bytes_ > most_bytes_ && turn != turns_.begin();) {
      const auto oldest = entries_.find(**--turn);
      if (oldest->second.bytes == 0) continue;
      bytes_ -= oldest->second.bytes;
      turn = turns_.erase(turn);
      entries_.erase(oldest);
    }
  }

  void forget(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(key);
    turns_.erase(found->second.turn);
    entries_.erase(found);
  }

  const std::size_t most_bytes_;
  std::size_t (*const bytes_of_)(const T&);
  mutable std::mutex mutex_;  ///< for the following
  std::map<std::string, Entry> entries_;
  std::list<const std::string*> turns_;  ///< keys, the most recently used one first
  std::size_t bytes_ = 0;
};

}  // namespace pintle
