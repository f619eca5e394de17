#include "app/progress.h"

#include <unistd.h>

#include <csignal>
#include <iomanip>
#include <iostream>

#include "meshes/limits.h"

namespace pintle::app {

namespace {
volatile std::sig_atomic_t interrupted = 0;
extern "C" void interrupt(int) { interrupted = 1; }
}  // namespace

void heed_signals() {
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  MesherLimits limits = mesher_limits();
  limits.stop = asked_to_stop;
  set_mesher_limits(limits);
}

bool asked_to_stop() {
  return interrupted;
}

Progress::Progress(double until, bool quiet) : until_(until), on_(!quiet && ::isatty(STDERR_FILENO)) {
  heed_signals();
}

Progress::~Progress() {
  if (shown_) std::cerr << "\r\033[K" << std::flush;
}

bool Progress::operator()(double t) {
  const auto now = std::chrono::steady_clock::now();
  if (on_ && now - last_ > std::chrono::milliseconds(200)) {
    last_ = now;
    shown_ = true;
    std::cerr << "\r  " << std::fixed << std::setprecision(1) << 100 * t / until_ << " %  t = " << std::defaultfloat
              << std::setprecision(6) << t << " s\033[K" << std::flush;
  }
  return !interrupted;
}

}  // namespace pintle::app
