#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/integration/events/event.h"
#include "framework/integration/stepper.h"

namespace pintle {

/// An event that a step passes or ends at.
struct EventInStep {
  std::size_t at;  ///< index over all groups
  WatchedGuard watch;
  double t;  ///< by dense output [s]
};

/// All events of an integration: finds the first in a step and ends the step there.
class Events {
 public:
  /// The order of the groups is their order of action at one instant.
  explicit Events(std::vector<std::unique_ptr<EventGroup>>);

  bool empty() const { return places_.empty(); }
  void start(Step&);
  void begin_step(const State& from);
  /// Time until a force has a kink, at the rates at the step's start; infinite if `wish` need not be shortened for one [s].
  double kink_ahead(double wish) const;

  /// The first event in the step. @param evaluated  the equations, if they are evaluated at the step's end; otherwise nullptr
  std::optional<EventInStep> first(const Step&, const DenseOutput&, const Equations* evaluated);
  enum class Ending { there, missed, impossible };
  /// Ends the step at the event by true steps of the method instead of dense output. If it is missed, step.h is as before; impossible: the
  /// method cannot step there.
  Ending end_at(const EventInStep&, Stepper&, const ErrorNorm&, Step&, Equations&);
  /// Whether the step, ended at the event that `first` has found, has passed another one: dense output put them in the wrong order.
  bool passes_another(const Step&) const;
  /// Whether an event that had not come at the last step's end has come at a later state.
  bool comes_by(const State& later) const;
  /// An event that has occurred exactly at a step's end, or was passed by the action of another event there.
  std::optional<EventInStep> due(const State& end) const;
  /// Evaluates the guards where the step really ended.
  void look_at_end(const Step&, const Equations* evaluated);

  /// Called after each accepted step. @returns why its end is impossible; empty: it is not
  std::string follow(Step&, const DenseOutput&);
  /// Acts at the step's end. @param wish  the step's length without the event [s]
  EventOutcome act(const EventInStep&, Step&, double wish);
  /// The desired step length when the event's group was last in its present mode; 0 if it never was [s].
  double remembered_wish(const EventInStep&) const;
  void forget_wishes();
  /// keep_end: the next step begins at the end as events have left it; forget_end: its guards are evaluated again.
  void keep_end() { known_ = true; }
  void forget_end() { known_ = false; }
  /// Counts events at one instant, and events between which almost no time passes or nothing moves. @param wish  the step's length without
  /// an event [s]   @returns false if they recur endlessly
  bool count(const Step&, const std::optional<EventInStep>&, const DenseOutput&, double wish);
  /// Which events recur, and the remedy.
  std::string again_and_again() const;

  std::string name(const EventInStep& e) const { return group(e.at).name(places_[e.at].event); }
  const char* fault() const;
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(to_, known_, spent_, here_, still_, crowd_, crowded_));
    for (auto& w : wishes_) x(PINTLE_MEMBERS(w.of_rising, w.of_falling));
    for (auto& g : groups_) {
      if constexpr (A::loading)
        g->load(x);
      else
        g->save(x);
    }
  }

 private:
  struct Place {
    std::size_t group;
    int event;
  };
  struct Wishes {
    double of_rising = 0, of_falling = 0;  ///< of the mode that a rising or a falling event ends
  };
  EventGroup& group(std::size_t at) { return *groups_[places_[at].group]; }
  const EventGroup& group(std::size_t at) const { return *groups_[places_[at].group]; }
  WatchedGuard ask(std::size_t at) const { return group(at).watch(places_[at].event); }
  Guard guard(std::size_t at, const State& state) const { return group(at).guard(places_[at].event, state); }
  std::optional<EventInStep> passed_by_end(const Step&) const;
  Ending bisect(const EventInStep&, double low, double high, Stepper&, const ErrorNorm&, Step&, Equations&);
  std::optional<double> passage(std::size_t at, const Step&, const DenseOutput&, double until) const;

  std::vector<std::unique_ptr<EventGroup>> groups_;
  std::vector<std::size_t> begin_;  ///< index of the first event of each group; one past
  std::vector<Place> places_;
  std::vector<WatchedGuard> watched_;   ///< during the present step
  std::vector<Guard> from_, to_;        ///< at the step's start and end
  bool known_ = false;                  ///< `to_` belongs to the state that the next step starts from
  bool still_ = false;                  ///< nothing has moved between the last two events counted
  std::vector<unsigned char> spent_;    ///< the event has acted and its guard has not returned since
  std::vector<Wishes> wishes_;          ///< of each group
  double second_ = 0;                   ///< when the second event of the step occurs, by dense output, if it is known so far [s] …
  double together_ = 0;                 ///< … and how long before the first it may really be [s]
  int here_ = 0;                        ///< events at the present instant
  int crowd_ = 0;                       ///< events with hardly any time passing or nothing moving between them …
  std::vector<unsigned char> crowded_;  ///< … which ones
};

}  // namespace pintle
