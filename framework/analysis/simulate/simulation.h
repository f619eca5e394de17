#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/analysis/simulate/slow_contact.h"
#include "framework/analysis/simulate/undecided_contacts.h"
#include "framework/common/processor_time.h"
#include "framework/configuration/deflection_monitor.h"
#include "framework/integration/integrator.h"

namespace pintle {

/// Times k·interval, k = 0, 1, …, the last being `until` itself, and those of `also` between them; none if interval is 0.
class Clock {
 public:
  Clock(double interval, double until, std::vector<double> also = {});
  bool due(double t) const { return next() <= t; }
  double next() const;  ///< infinite after the last
  void tick();
  void pass(double t);

 private:
  double interval_, until_;
  long k_ = 0, last_ = -1;
  std::vector<double> also_;  ///< what is left of it, latest first
};

/// @throws SceneError  the scene asks for more rows than are kept in memory, and no listener takes them
void require_few_rows(const Scene&, const Listeners&);

/// Data kept from the last row of each table, even if a listener takes the rows.
class RowFigures {
 public:
  RowFigures(const System&, Run&);
  void see();

 private:
  Run& run_;
  std::size_t first_integral_, n_z_;
  std::vector<std::pair<std::size_t, std::ptrdiff_t>> normal_;  ///< contact, column
};

/// Detects what a caller may see as an event: an event of the scene has acted, or a contact has begun or ended.
class SeenEvents {
 public:
  /// @returns whether there was one since the last call
  bool look(const std::vector<Happening>&, const std::vector<Impact>&);

 private:
  std::size_t happenings_ = 0, impacts_ = 0;
  std::vector<std::size_t> open_;  ///< impacts that had not ended
};

/// A run in progress, which can be stopped at any time, inspected, given new values of the scene's own states, and continued. `simulate` is
/// a single call of `advance` up to the end of the run.
class Simulation {
 public:
  /// @pre all arguments except the listeners outlive it
  Simulation(const Scene&, const Model&, const Assembly&, const Listeners& = {}, const SavedState* from = nullptr);
  Simulation(const Simulation&) = delete;

  /// Advances to time t, where a step ends, or to an earlier end of the run. @returns false once the run is over
  bool advance(double t);
  /// The same, but stops at the end of the first step in which SeenEvents detects an event; `advance` continues from there.
  bool advance_to_event(double t);
  const std::vector<Happening>& happenings() const { return integrator_.happenings(); }
  const std::vector<Impact>& impacts() const { return integrator_.impacts(); }
  /// The state from which another Simulation of the same model continues exactly as this one.
  SavedState saved() const;
  double time() const { return integrator_.state().t; }
  /// Sets the present value of an own state of the scene, as an event would. @param state  index into System::states
  void set(int state, double value);
  /// The present row of trajectory.csv, in the order of its header. @returns an empty list if it cannot be evaluated
  std::vector<double> now();
  /// Ends the run here, with a last row. The object cannot be used afterwards.
  Run finish();

 private:
  /// Adds the processor time of its lifetime to that of the run: between calls, the caller may do other work or change threads.
  class Computing {
   public:
    explicit Computing(double& seconds) : seconds_(seconds) { seconds_ -= processor_time(); }
    ~Computing() { seconds_ += processor_time(); }
    Computing(const Computing&) = delete;

   private:
    double& seconds_;
  };

  void go_on(const SavedState&);
  bool advance(double t, bool to_event);
  bool goes_on() const { return going_ && run_.status == Status::finished && integrator_.ended().empty(); }
  bool step(double until);
  bool is_stopped(double t);  ///< by the listener, which receives the progress
  bool lacks_rows() const;    ///< rows up to the end of the last step: the run ended within it
  bool after_step();
  bool report();
  void add_row_here();
  void book(const State&);
  void add_row(const State&);
  void save();
  void add_last();
  void explain();
  void end(Status status, const std::string& reason) { run_.status = status, run_.reason = reason; }
  template <class Act>
  void listen(Act);

  const Scene& scene_;
  const Model& model_;
  const System& system_;
  const Listeners listeners_;
  Run run_;
  Clock outputs_, states_, frames_;
  double seconds_ = -processor_time();  ///< processor time of computing; while computing, minus its start time [s]
  const State& start_;
  Integrator integrator_;
  State sampled_;
  double last_row_ = 0, asked_ = 0;  ///< times of the last row and of the output last requested [s]
  double saved_ = -1;                ///< time of the last state saved [s]
  DeflectionMonitor monitor_;
  RowFigures figures_;
  SlowContacts slow_;
  UndecidedContacts undecided_;
  SeenEvents seen_;
  const SavedState* from_;
  bool started_ = false;                ///< the energy balance has begun
  bool opened_ = false, going_ = true;  ///< the start has been reported; steps succeed
  bool countable_;                      ///< the energy at the start is finite
};

}  // namespace pintle
