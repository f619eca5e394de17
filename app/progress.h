#pragma once

#include <chrono>

namespace pintle::app {

/// From now on, Ctrl-C and a request to terminate do not end the program but are asked for by asked_to_stop.
void heed_signals();
bool asked_to_stop();

/// A line on the terminal that says how far a run is; nothing if stderr is not one. From the first one made on,
/// Ctrl-C and a request to terminate ask the run to stop instead of ending the program.
class Progress {
 public:
  Progress(double until, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  bool operator()(double t);  ///< @returns false: the user wants to stop

 private:
  double until_;
  bool on_, shown_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace pintle::app
