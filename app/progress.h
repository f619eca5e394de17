#pragma once

#include <chrono>
#include <string>

namespace pintle::app {

/// At the start of the program: makes a broken pipe or the file-size limit an error of the write concerned, instead of a signal.
void leave_failed_writes_to_us();

/// At the start of the program: Ctrl-C, a request to terminate and the end of the terminal end it with a message and exit code 6. Signals
/// ignored by the caller remain ignored.
void end_on_signals();

/// At the start of the program: reserves a megabyte that is released when memory first runs out, so that libraries that do not check for
/// this (JSON's and VTK's) get what they request and the program reaches a place that does check.
void keep_memory_in_reserve();

/// At the start of the program: if a crash of the program, or of a library that lacks memory, ends it, it reports what it was doing and
/// where the results are. The signal still ends it.
void tell_of_crashes();

/// From now on, Ctrl-C, a request to terminate and the end of the terminal do not end the program, but are reported by asked_to_stop; the
/// second one ends it. Signals ignored by the caller (nohup) remain ignored.
void handle_signals();
bool asked_to_stop();
/// "stopped by the user (Ctrl-C)", or the signal received.
std::string stopped_by();

/// Sets what the program is doing, for a message if memory runs out: "building the model". The text must stay valid.
void now_doing(const char* what);
const char* what_is_done();
double doing_since();  ///< duration of the present activity [s]
/// Sets the folder of the results, for a message if the program ends early. Empty: none.
void results_are_in(const std::string& folder);
/// Sets what a message says instead of "there are no results yet" if the program is stopped. The text must stay valid.
void is_lost_if_stopped(const char* what);
/// "; what was computed is in …", if there is a folder.
const char* where_results_are();

/// A progress line on stderr for a long command, updated several times a second and removed at its end; no line if quiet or stderr is not a
/// terminal. Once the first one is created, Ctrl-C and a request to terminate ask to stop instead of ending the program.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  bool due() const;  ///< there is a line, and it is at least a fifth of a second old
  void show(const std::string& text);

 private:
  bool on_, shown_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The same for a study; without a terminal, a line every half minute.
class StudyLine {
 public:
  explicit StudyLine(bool quiet);
  /// Shows the text that `say` returns, if an update is due.
  template <class Say>
  void tell(const Say& say) {
    if (line_.due()) line_.show(say());
    if (log_due()) log(say());
  }

 private:
  bool log_due() const;
  void log(const std::string& text);

  bool logs_;
  StatusLine line_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string span_text(double seconds);  ///< "8.3 s", "32 s", "5 min 2 s"
/// ", 32 s left" if `done` of `all` took `seconds`; empty if none is done.
std::string time_left(double done, double all, double seconds);

/// Progress of a run, by the time reached, and the time left at the mean pace so far.
class Progress {
 public:
  Progress(double until, bool quiet) : until_(until), line_(quiet) {}
  bool operator()(double t);  ///< @returns false: the user wants to stop

 private:
  double until_, from_ = 0;
  std::chrono::steady_clock::time_point begin_;
  bool begun_ = false;
  StatusLine line_;
};

}  // namespace pintle::app
