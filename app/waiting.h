#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace pintle::app {

/// From a second after its construction on a line of stderr says what the program does, since when and, where the computation tells
/// how far it is, how long it will still take; nothing if it is to be quiet or stderr is no terminal. The line goes at its end.
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
