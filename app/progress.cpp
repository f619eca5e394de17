#include "app/progress.h"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <csignal>
#include <ctime>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <new>

#include "framework/common/work_done.h"
#include "meshes/limits.h"

namespace pintle::app {

namespace {

volatile std::sig_atomic_t asked_by = 0;
using clock = std::chrono::steady_clock;
std::atomic<const char*> activity = "starting";
std::atomic<const char*> lost = "there are no results yet";
std::atomic<clock::rep> activity_begin = clock::now().time_since_epoch().count();
std::string kept, kept_note;  // prepared in advance, since memory may be lacking later

const char* stop_words(int signal) {
  switch (signal) {
    case SIGTERM: return "stopped by SIGTERM, a request to end the program";
    case SIGHUP: return "stopped by SIGHUP: its terminal or session ended";
    default: return "stopped by the user (Ctrl-C)";
  }
}

/// Uses only functions that a signal handler may call.
void say(const char* words) {
  for (std::size_t left = std::strlen(words); left > 0;) {
    const ssize_t n = ::write(STDERR_FILENO, words, left);
    if (n <= 0) return;
    words += n, left -= static_cast<std::size_t>(n);
  }
}

extern "C" void end_at_once(int signal) {
  if (::isatty(STDERR_FILENO)) say("\r\033[K");  // a progress line may be there
  say("pintle: "), say(stop_words(signal)), say(" while "), say(activity);
  const char* where = where_results_are();
  if (*where != '\0')
    say(where);
  else
    say("; "), say(lost);
  say("\n");
  constexpr int stopped = 6;
  ::_exit(stopped);
}

const char* crash_words(int signal) {
  switch (signal) {
    case SIGSEGV: return "SIGSEGV";
    case SIGBUS: return "SIGBUS";
    case SIGFPE: return "SIGFPE";
    case SIGILL: return "SIGILL";
    default: return "SIGABRT";
  }
}

extern "C" void tell_of_crash(int signal) {
  say("pintle: crashed ("), say(crash_words(signal)), say(") while "), say(activity);
  say(": an error in the program, or in a library that ran out of memory; please report it"), say(where_results_are()), say("\n");
  ::raise(signal);  // ends as it would have without the handler, which is called only once
}

/// Seconds of a clock that a signal handler may read.
double seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// `timeout` sends its signal to the program and again to the group of the program: such a pair is one request.
extern "C" void ask_to_stop(int signal) {
  constexpr double one_request = 0.5;
  static double asked_at = 0;
  if (asked_by == 0) {
    asked_by = signal;
    asked_at = seconds();
    return;
  }
  if (seconds() - asked_at < one_request) return;
  struct sigaction otherwise {};
  otherwise.sa_handler = SIG_DFL;
  ::sigaction(signal, &otherwise, nullptr);
  ::raise(signal);
}

void handle(int signal) {
  struct sigaction before {};
  ::sigaction(signal, nullptr, &before);
  if (signal == SIGHUP && before.sa_handler == SIG_IGN) return;  // nohup
  struct sigaction asks {};
  asks.sa_handler = ask_to_stop;
  asks.sa_flags = SA_RESTART;
  for (const int other : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&asks.sa_mask, other);
  ::sigaction(signal, &asks, nullptr);
}

}  // namespace

void leave_failed_writes_to_us() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void keep_memory_in_reserve() {
  static std::atomic<void*> reserve = std::malloc(std::size_t{1} << 20);
  std::set_new_handler([] {
    void* const kept_back = reserve.exchange(nullptr);
    if (!kept_back) throw std::bad_alloc();
    std::free(kept_back);
  });
}

void tell_of_crashes() {
  static char stack[1 << 14];  // the crash may be a stack overflow
  stack_t own{};
  own.ss_sp = stack, own.ss_size = sizeof stack;
  ::sigaltstack(&own, nullptr);
  struct sigaction tells {};
  tells.sa_handler = tell_of_crash;
  tells.sa_flags = SA_RESETHAND | SA_ONSTACK | SA_NODEFER;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_DFL) ::sigaction(signal, &tells, nullptr);  // the handler of a sanitizer or debugger is kept
  }
}

void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal);
  MesherLimits limits = mesher_limits();
  limits.stop = asked_to_stop;
  set_mesher_limits(limits);
}

bool asked_to_stop() { return asked_by != 0; }

std::string stopped_by() { return stop_words(asked_by); }

void end_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;  // nohup, or a background job of a script
    struct sigaction ends {};
    ends.sa_handler = end_at_once;
    ::sigaction(signal, &ends, nullptr);
  }
}

void now_doing(const char* what) {
  activity_begin = clock::now().time_since_epoch().count();
  work_done = -1;
  activity = what;
}
const char* what_is_done() { return activity; }
double doing_since() {
  return std::chrono::duration<double>(clock::now().time_since_epoch() - clock::duration(activity_begin.load())).count();
}

void results_are_in(const std::string& folder) {
  kept_note = folder.empty() ? "" : "; what was computed is in " + folder;
  kept = folder;
}

void is_lost_if_stopped(const char* what) { lost = what; }

const char* where_results_are() { return !kept.empty() && ::access(kept.c_str(), F_OK) == 0 ? kept_note.c_str() : ""; }

StatusLine::StatusLine(bool quiet) : on_(!quiet && ::isatty(STDERR_FILENO)) { handle_signals(); }

StatusLine::~StatusLine() {
  if (shown_) std::cerr << "\r\033[K" << std::flush;
}

bool StatusLine::due() const { return on_ && clock::now() - last_ > std::chrono::milliseconds(200); }

void StatusLine::show(const std::string& text) {
  std::cerr << "\r  " << text << "\033[K" << std::flush;
  last_ = clock::now(), shown_ = true;
}

StudyLine::StudyLine(bool quiet) : logs_(!quiet && !::isatty(STDERR_FILENO)), line_(quiet) {}

bool StudyLine::log_due() const { return logs_ && clock::now() - last_ > std::chrono::seconds(30); }

void StudyLine::log(const std::string& text) {
  last_ = clock::now();
  std::cerr << text << std::endl;
}

std::string span_text(double seconds) {
  std::ostringstream s;
  const long whole = std::lround(seconds);
  if (seconds < 10)
    s << std::setprecision(2) << seconds << " s";
  else if (whole < 120)
    s << whole << " s";
  else if (whole < 7200)
    s << whole / 60 << " min " << whole % 60 << " s";
  else
    s << whole / 3600 << " h " << whole % 3600 / 60 << " min";
  return s.str();
}

std::string time_left(double done, double all, double seconds) {
  return done > 0 && seconds > 0 ? ", " + span_text((all - done) / done * seconds) + " left" : "";
}

bool Progress::operator()(double t) {
  if (!begun_) begun_ = true, from_ = t, begin_ = clock::now();
  if (line_.due()) {
    std::ostringstream s;
    s << std::fixed << std::setprecision(1) << 100 * t / until_ << " %  t = " << std::defaultfloat << std::setprecision(6) << t << " s"
      << time_left(t - from_, until_ - from_, std::chrono::duration<double>(clock::now() - begin_).count());
    line_.show(s.str());
  }
  return !asked_to_stop();
}

}  // namespace pintle::app
