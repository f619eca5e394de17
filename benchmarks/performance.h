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
  std::function<pintle::Scene(double tolerance)> scene;  ///< the caller sets `run.method`
  std::function<double(const pintle::Run&)> error;
  std::function<Judged(double tolerance)> by_hand = {};  ///< the minimal-coordinate oracle; may be empty
};
/// A mechanism, from one start or several: times are means and errors root mean squares over them.
struct Problem {
  std::string name, title;  ///< of its figure; of its section
  std::string text;         ///< the mechanism, the meaning of its error, the source of the reference
  std::vector<Start> starts;
  std::vector<double> tolerances = {};
  bool by_hand() const { return static_cast<bool>(starts.front().by_hand); }
};

/// All of them; the references are computed here. `quick`: shorter runs where these are long.
std::vector<Problem> problems(bool quick);

/// The paper's slider-crank with a given number of shapes of the coupler and clearance at the gudgeon pin [m], 0: ideal; default settings.
pintle::Scene flexible(double until, int shapes, double clearance);
/// The section on this mechanism with a clearance, run for one second with default settings.
std::string flexible_second();

/// The section on chains, ladders and grids, from a JSON file of bench_chains. @throws std::runtime_error  it cannot be read
std::string links_section(const std::string& file);

/// Processor time of this thread [s], without other load of the machine.
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
