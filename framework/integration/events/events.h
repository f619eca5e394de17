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
  std::size_t at;  ///< counted through all groups
  WatchedGuard watch;
  double t;  ///< by dense output [s]
};

/// All events of an integration: finds the first in a step and ends the step there.
class Events {
 public:
  /// Takes groups in their order at one instant.
  explicit Events(std::vector<std::unique_ptr<EventGroup>>);

  bool empty() const { return places_.empty(); }
  void start(Step&);
  void begin_step(const State& from);
  /// How long until a force has a kink, at the rates at the step's start; infinite if `wish` is not to be cut short for one [s].
  double kink_ahead(double wish) const;

  /// The first event in the step. @param evaluated  the equations where they are evaluated at the step's end; else nullptr
  std::optional<EventInStep> first(const Step&, const DenseOutput&, const Equations* evaluated);
  enum class Ending { there, missed, impossible };
  /// Ends the step at the event by true steps of the method, not dense output. Where it is missed step.h is as before;
  /// the method cannot step there where it is impossible.
  Ending end_at(const EventInStep&, Stepper&, const ErrorNorm&, Step&, Equations&);
  /// What has come exactly at a step's end, or past it by what another has done there.
  std::optional<EventInStep> due(const State& end) const;
  /// Where the step really ended.
  void look_at_end(const Step&, const Equations* evaluated);

  void follow(Step&, const DenseOutput&);
  /// At the step's end. @param wish  the step's length had no event been near [s]
  EventOutcome act(const EventInStep&, Step&, double wish);
  /// The length of step wished for when the event's group was last in its present mode; 0 if it never was [s].
  double remembered_wish(const EventInStep&) const;
  void forget_wishes();
  /// The end is as events have left it, for the next step to begin there; else its guards are looked at again.
  void keep_end() { known_ = true; }
  void forget_end() { known_ = false; }
  /// Counts events at one instant, and those that let next to no time pass, or nothing move, between them. @param wish  the step's length
  /// had no event been near [s]   @returns false where they come again and again
  bool count(const Step&, const std::optional<EventInStep>&, const DenseOutput&, double wish);
  /// Which do, and what to do about it.
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
    double of_rising = 0, of_falling = 0;  ///< of the mode that a rising, a falling event ends
  };
  EventGroup& group(std::size_t at) { return *groups_[places_[at].group]; }
  const EventGroup& group(std::size_t at) const { return *groups_[places_[at].group]; }
  WatchedGuard ask(std::size_t at) const { return group(at).watch(places_[at].event); }
  Guard guard(std::size_t at, const State& state) const { return group(at).guard(places_[at].event, state); }
  std::optional<EventInStep> passed_by_end(const Step&) const;
  Ending bisect(const EventInStep&, double low, double high, Stepper&, const ErrorNorm&, Step&, Equations&);
  std::optional<double> passage(std::size_t at, const Step&, const DenseOutput&) const;

  std::vector<std::unique_ptr<EventGroup>> groups_;
  std::vector<std::size_t> begin_;  ///< first place of each group; one past
  std::vector<Place> places_;
  std::vector<WatchedGuard> watched_;   ///< in the present step
  std::vector<Guard> from_, to_;        ///< at the step's start and end
  bool known_ = false;                  ///< `to_` is of the state that the next step starts from
  bool still_ = false;                  ///< nothing has moved between the last two of the events counted
  std::vector<unsigned char> spent_;    ///< an event has acted and its guard has not come back since
  std::vector<Wishes> wishes_;          ///< of each group
  int here_ = 0;                        ///< events at the present instant
  int crowd_ = 0;                       ///< events between which hardly any time has passed, or nothing moved …
  std::vector<unsigned char> crowded_;  ///< … which these are
};

}  // namespace pintle
