#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "framework/dynamics/equations/equations.h"
#include "framework/common/members.h"
#include "framework/integration/step.h"

namespace pintle {

class DenseOutput;
class Reader;
class Writer;

/// A continuous function of the state whose zero is an event, and its rate where known.
struct Guard {
  double value;
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(value, rate));
  }
};

enum class Direction { none, rising, falling };

/// How a guard is watched in its present mode.
struct WatchedGuard {
  Direction direction = Direction::none;  ///< none: it is not watched
  double zero = 0;                        ///< a guard nearer to zero than this counts as zero
  double overshoot = 0;  ///< 0: steps end where the guard is zero. Positive: they end where it is at most this far past zero
  bool at_once = false;  ///< may occur at the same instant as the previous event
  bool level = false;    ///< also occurs at the start of a step that begins with the guard past zero
  bool kink = false;     ///< a force has a kink there: a step that would cross it ends there instead
};

/// Result of an event's action.
struct EventOutcome {
  /// jump: forces or the state jump; rows: in addition, constraint rows have appeared or disappeared.
  enum class Change { nothing, forces, jump, rows } change = Change::forces;
  double first_step = std::numeric_limits<double>::infinity();  ///< accuracy bound of the next step, for methods that follow impacts [s]
  bool of_every_method = false;                                 ///< the bound holds for every method
  std::string end = {};                                         ///< reason why the integration ends here; empty: it continues
  std::string failure = {};                                     ///< reason why it cannot continue
  std::string did = {};                                         ///< description for the list of happenings; empty: not listed
  bool save = false, row = false;                               ///< the state must be saved, a row of results written
};

/// Record of an event of the scene.
struct Happening {
  double t = 0;  ///< [s]
  std::string event, did;
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(t, event, did));
  }
};

/// Reported if the modes of a saved state do not fit the system.
inline constexpr const char* foreign_modes = "it belongs to another system, or has invalid numbers";

/// Events of one kind: guards with directions, and what happens where they pass zero. A group owns the modes between its
/// events. The integrator finds the first event in a step, ends the step there and has the group act. At one instant
/// groups act in their `order`, a group's events in that of their indices, one after another, with the equations
/// evaluated again between them.
class EventGroup {
 public:
  virtual ~EventGroup() = default;

  virtual int order() const = 0;
  virtual int size() const = 0;
  /// For messages: contact "pin".
  virtual std::string name(int event) const = 0;
  /// Advice if its events recur with little or no time passing; empty: only recurrence without time passing is an error.
  virtual std::string remedy() const { return {}; }

  /// Called as a step begins: modes change only in `act`.
  virtual WatchedGuard watch(int event) const = 0;
  virtual Guard guard(int event, const State&) const = 0;
  /// The same, with the equations evaluated at the state.
  virtual Guard guard(int event, const State&, const Equations&) const = 0;
  /// For a guard that is negative at both ends of a step: a time inside at which it is positive, where the guard's rates at the ends do not
  /// reveal it. @param until  later times need not be examined
  virtual std::optional<double> positive_inside(int, const Step&, const DenseOutput&, double /*until*/) const { return std::nullopt; }
  /// Called before events in an attempted step are searched for. If the guard stays at zero, decides on which side of zero it counts, and
  /// shifts the guards of the step's two ends accordingly.
  virtual void decide_at_zero(int /*event*/, const Step&, const DenseOutput&, Guard& /*from*/, Guard& /*to*/) {}
  /// Whether the event occurs as soon as its guard is zero, without passing it.
  virtual bool comes_at_zero(int, const State&) const { return false; }
  /// Whether its guard has stayed within rounding of zero since its last occurrence.
  virtual bool hardly_left(int, const Step&, const DenseOutput&) const { return false; }
  /// Whether the guard at the end of the step is so near zero that ending the step elsewhere would not improve it.
  virtual bool met(int event, const Guard&) const = 0;

  /// Sets the modes at a start; only the step's end is valid.
  virtual void start(Step&) = 0;
  /// Called before guards of the step's start are evaluated.
  virtual void begin_step(const State&) {}
  /// Called after each accepted step, before any event that ends it acts. Guards are those of the step's two ends. May change the modes of
  /// the step's end where forces there stay the same. @returns why its end is impossible; empty: it is not
  virtual std::string follow(Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) = 0;
  /// Called at the step's end. May change modes and the state there.
  virtual EventOutcome act(int event, Step&, const Guard&) = 0;

  /// Modes and everything else the following steps depend on.
  virtual void save(Writer&) const = 0;
  virtual void load(Reader&) = 0;
  /// Why loaded data cannot belong to this group; nullptr if it can.
  virtual const char* fault() const = 0;
};

/// A group of one event without modes. It occurs each time its guard passes zero in its direction.
struct Event {
  std::string name;
  std::function<Guard(const State&)> guard;
  Direction direction = Direction::rising;
  std::function<EventOutcome(State&)> act;
  double zero = 1e-12;  ///< a guard nearer to zero than this counts as zero
  int order = 1;        ///< at one instant lower ones act first; contacts are 0
};
std::unique_ptr<EventGroup> single_event(Event);

}  // namespace pintle
