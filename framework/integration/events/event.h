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

/// A continuous function of the state whose zero is an event, and its rate where that is known.
struct Guard {
  double value;
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(value, rate));
  }
};

enum class Direction { none, rising, falling };

/// What of a guard counts now.
struct WatchedGuard {
  Direction direction = Direction::none;  ///< none: nothing does
  double zero = 0;                        ///< a guard nearer to zero than this is there
  double overshoot = 0;  ///< 0: steps end where the guard is zero. Positive: they end where it is at most this far past zero
  bool at_once = false;  ///< may follow at the instant of the event before
  bool level = false;    ///< comes, too, wherever a step begins with the guard past zero
  bool kink = false;     ///< a force has a kink there: a step that would pass it ends there instead
};

/// What an event's action has done.
struct EventOutcome {
  /// jump: forces jump, or the state does; rows: constraint rows have come or gone besides.
  enum class Change { nothing, forces, jump, rows } change = Change::forces;
  double first_step = std::numeric_limits<double>::infinity();  ///< the next step's bound by accuracy, of methods that follow impacts [s]
  bool of_every_method = false;                                 ///< that bound
  std::string end = {};                                         ///< the integration ends here, and why; empty: it goes on
  std::string failure = {};                                     ///< it cannot go on, and why
  std::string did = {};                                         ///< in words, for the list of happenings; empty: it is not listed there
  bool save = false, row = false;                               ///< the state is to be saved, a row of results to be written
};

/// What an event of the scene has done.
struct Happening {
  double t = 0;
  std::string event, did;
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(t, event, did));
  }
};

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
  /// What to do where its events come again and again without time passing, also where a little passes; empty: none of them may.
  virtual std::string remedy() const { return {}; }

  /// Asked as a step begins: modes change in `act` only.
  virtual WatchedGuard watch(int event) const = 0;
  virtual Guard guard(int event, const State&) const = 0;
  /// The same where the equations are evaluated at the state.
  virtual Guard guard(int event, const State&, const Equations&) const = 0;
  /// A time in a step at both ends of which the guard is below zero, at which it is not: where the guard's own rates at the ends
  /// do not lead there.
  virtual std::optional<double> positive_inside(int, const Step&, const DenseOutput&) const { return std::nullopt; }
  /// Before the passages of a step that was tried are sought: where its guard stands at zero, which side that counts for may be decided here.
  /// The guards of its two ends follow.
  virtual void decide_at_zero(int /*event*/, const Step&, const DenseOutput&, Guard& /*from*/, Guard& /*to*/) {}
  /// Where its guard is zero the event has come already: no more has to follow.
  virtual bool comes_at_zero(int, const State&) const { return false; }
  /// Since it came last, its guard has left zero by no more than rounding can keep up.
  virtual bool hardly_left(int, const Step&, const DenseOutput&) const { return false; }
  /// Steps end so near the guard's zero that nothing can be gained by ending them nearer.
  virtual bool met(int event, const Guard&) const = 0;

  /// Modes as a start has them; the step ends there and begins nowhere.
  virtual void start(Step&) = 0;
  /// Before guards of the step's start are asked.
  virtual void begin_step(const State&) {}
  /// After each accepted step, before any event that ends it acts. Guards are those of the step's two ends. May change the modes of
  /// the step's end where forces there stay the same.
  virtual void follow(Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) = 0;
  /// At the step's end. May change modes and the end's state.
  virtual EventOutcome act(int event, Step&, const Guard&) = 0;

  /// Modes and what else the following steps depend on.
  virtual void save(Writer&) const = 0;
  virtual void load(Reader&) = 0;
  /// What was loaded cannot be of this group, and why; nullptr if it can.
  virtual const char* fault() const = 0;
};

/// A group of one event without modes. It comes once for each time that its guard passes zero in its direction.
struct Event {
  std::string name;
  std::function<Guard(const State&)> guard;
  Direction direction = Direction::rising;
  std::function<EventOutcome(State&)> act;
  double zero = 1e-12;  ///< a guard nearer to zero than this is there
  int order = 1;        ///< at one instant lower ones come first; contacts are 0
};
std::unique_ptr<EventGroup> single_event(Event);

}  // namespace pintle
