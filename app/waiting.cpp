#include "app/waiting.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <string>
#include <system_error>

#include "app/progress.h"
#include "framework/common/work_done.h"

namespace pintle::app {

namespace {

std::string duration(double seconds) {
  const long s = std::lround(seconds);
  if (s < 100) return std::to_string(s) + " s";
  if (s < 6000) return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
  return std::to_string(s / 3600) + " h " + std::to_string(s / 60 % 60) + " min";
}

}  // namespace

Waiting::Waiting(bool quiet) {
  if (quiet || !::isatty(STDERR_FILENO)) return;
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);  // the computing thread handles signals
  try {
    shower_ = std::thread([this] { show(); });
  } catch (const std::system_error&) {  // without a thread there is no line
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void Waiting::end() {
  if (!shower_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  shower_.join();
}

void Waiting::show() {
  using std::chrono::milliseconds;
  std::unique_lock lock(mutex_);
  const auto ended = [this] { return over_; };
  bool shown = false;
  for (milliseconds wait{1000}; !changed_.wait_for(lock, wait, ended); wait = milliseconds{250}) {
    const double since = doing_since(), done = work_done.load(std::memory_order_relaxed);
    std::string line = std::string("\r  ") + what_is_done() + ": " + duration(since);
    if (done > 0.02 && done <= 1) {
      char percent[16];
      std::snprintf(percent, sizeof percent, "%.0f", 100 * done);
      line += std::string(", ") + percent + " %, about " + duration(since * (1 - done) / done) + " left";
    }
    line += "\033[K";
    std::fputs(line.c_str(), stderr);
    shown = true;
  }
  if (shown) std::fputs("\r\033[K", stderr);
}

}  // namespace pintle::app
