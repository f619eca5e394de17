#pragma once

#include <chrono>
#include <string>

namespace pintle::app {

/// At the start of the program: a write that fails by a broken pipe or the limit of a file's size is an error of that write.
void leave_failed_writes_to_us();

/// At the start of the program: Ctrl-C, a request to terminate and the end of the terminal end it with a word and exit code 6.
/// What the caller had ignored stays ignored.
void end_on_signals();

/// At the start of the program: a megabyte, given back where memory first does not suffice, so that libraries which do not look
/// for that (JSON's and VTK's) get what they ask for and the program comes to a place that does.
void keep_memory_in_reserve();

/// At the start of the program: where a fault of it, or of a library that lacks memory, ends it, it says what it was doing and
/// where what was computed is. It still ends by the signal.
void tell_of_crashes();

/// From now on, Ctrl-C, a request to terminate and the end of the terminal do not end the program but are asked for by
/// asked_to_stop; the second of them ends it. What the caller had ignored (nohup) stays ignored.
void heed_signals();
bool asked_to_stop();
/// "stopped by the user (Ctrl-C)", or which signal it was.
std::string stopped_by();

/// What the program does now, for whom memory ends: "building the model". Text that stays.
void now_doing(const char* what);
const char* what_is_done();
double doing_since();  ///< for how long it has done that [s]
/// Where results are being written, for whatever ends the program. Empty: nowhere.
void results_are_in(const std::string& folder);
/// "; what was computed is in …", if it is there.
const char* where_results_are();

/// A line of stderr that says how far a long command is, written over some times a second and gone at its end; nothing if it is to
/// be quiet or stderr is no terminal. From the first one made on, Ctrl-C and a request to terminate ask to stop instead of ending
/// the program.
class StatusLine {
 public:
  explicit StatusLine(bool quiet);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  bool due() const;  ///< there is a line, and it has stood for a fifth of a second
  void show(const std::string& text);

 private:
  bool on_, shown_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Of a study: the same line; where there is no terminal, a line every half minute.
class StudyLine {
 public:
  explicit StudyLine(bool quiet);
  /// Shows the text that `say` makes, if it is time to.
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
/// ", 32 s left" where `done` of `all` took so many seconds; nothing where none is done.
std::string time_left(double done, double all, double seconds);

/// Of a run, by the time that it has reached.
class Progress {
 public:
  Progress(double until, bool quiet) : until_(until), line_(quiet) {}
  bool operator()(double t);  ///< @returns false: the user wants to stop

 private:
  double until_;
  StatusLine line_;
};

}  // namespace pintle::app
