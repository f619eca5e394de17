#pragma once

#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "tests/paper/plot.h"

/// The page on error against time: see performance.cpp.
namespace performance {

using pintle::printed;

/// A run of a hand-written model.
struct Judged {
  double error = 0;
  long evaluations = 0;  ///< of its right-hand side, 0: not counted
};

/// A start of a mechanism, and its known state at the end of a run.
struct Start {
  std::function<pintle::Scene(double tolerance)> scene;  ///< `run.method` is set by whom it concerns
  std::function<double(const pintle::Run&)> error;
  std::function<Judged(double tolerance)> by_hand = {};  ///< the minimal-coordinate oracle; may be empty
};
/// A mechanism, from one start or several: times are means and errors root mean squares over them.
struct Problem {
  std::string name, title;  ///< of its figure; of its section
  std::string text;         ///< what it is, what its error means, where the reference comes from
  std::vector<Start> starts;
  std::vector<double> tolerances = {};
  bool by_hand() const { return static_cast<bool>(starts.front().by_hand); }
};

/// All of them; the references are computed here. `quick`: shorter runs where these are long.
std::vector<Problem> problems(bool quick);

/// The paper's slider-crank with a coupler of so many shapes, clearance at the gudgeon pin [m] or 0: ideal; settings are the defaults.
pintle::Scene flexible(double until, int shapes, double clearance);
/// The section on it with a clearance, for a second, by default settings.
std::string flexible_second();

/// The section on chains, ladders and grids, from a JSON file of bench_chains. @throws std::runtime_error  it cannot be read
std::string links_section(const std::string& file);

/// Of this thread's computing [s]: what else the machine does is not in it.
template <class F>
double seconds(F what) {
  const auto now = [] {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double begin = now();
  what();
  return now() - begin;
}

}  // namespace performance
