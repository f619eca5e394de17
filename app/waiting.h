#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace pintle::app {

/// From a second after construction, a line on stderr says what the program is doing, since when and, if the computation reports its
/// progress, how long it will still take; no line if quiet or stderr is not a terminal. The line is removed at its end.
class Waiting {
 public:
  explicit Waiting(bool quiet);
  ~Waiting() { end(); }
  Waiting(const Waiting&) = delete;
  void end();  ///< before anything else is printed

 private:
  void show();

  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread shower_;
};

}  // namespace pintle::app
