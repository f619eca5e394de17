#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "framework/integration/events/engagement.h"
#include "framework/integration/events/event.h"

namespace pintle {

/// What an event of the scene does. All that it switches it switches at one instant, before the rest.
struct StopRun {
  std::string reason;
};
/// A change of the state: a number of the scene's own gets a value.
struct SetState {
  std::string name;
  std::function<void(const System&, const State& seen, State&)> set;
  std::function<std::string(const System&, const State&)> seen = {};  ///< what it is told from there, in words
};
enum class Record { state, row };
using EventAction = std::variant<SwitchOver, SetState, StopRun, Record>;

/// What is wanted of a comparison beside its difference, all of one reading of the state.
struct Wanted {
  bool rate = false;                     ///< of the difference, where it is known
  double* size = nullptr;                ///< ← of what is compared: what the difference is small against
  std::vector<double>* kinks = nullptr;  ///< appended: numbers at whose zeros the difference has a kink or jumps
};

/// One comparison of an event's condition: what is greater less what is less, above zero where it holds.
struct SceneComparison {
  std::function<Guard(const System&, const State&, const Wanted&)> difference;
  bool at_zero = false;                                               ///< holds where both are equal
  bool of_speeds = false;                                             ///< compares speeds of the motion, or what follows from these
  std::function<std::string(const System&, const State&)> seen = {};  ///< what it compares there, in words
};

/// An event as the scene describes it: it comes when all of its comparisons have become true, and acts once, or each time that they do.
struct SceneEventRule {
  std::string name;
  std::vector<SceneComparison> when;
  std::vector<EventAction> actions;
  std::vector<EventAction> otherwise = {};  ///< when they no longer are
  bool once = false;
  bool from_start = true;  ///< where they are true at the start, it acts there
};

/// The events of a scene, in their order. At one instant they come after those of contacts and of friction.
class SceneEvents final : public EventGroup {
 public:
  SceneEvents(const System&, std::vector<SceneEventRule>);

  int order() const override { return 2; }
  int size() const override { return static_cast<int>(rules_.size()); }
  std::string name(int event) const override { return rules_[static_cast<std::size_t>(event)].name; }
  std::string remedy() const override;
  WatchedGuard watch(int event) const override;
  Guard guard(int event, const State&) const override;
  Guard guard(int event, const State& state, const Equations&) const override { return guard(event, state); }
  std::optional<double> positive_inside(int event, const Step&, const DenseOutput&) const override;
  void decide_at_zero(int event, const Step&, const DenseOutput&, Guard& from, Guard& to) override;
  bool comes_at_zero(int event, const State&) const override;
  bool met(int event, const Guard&) const override;
  bool hardly_left(int event, const Step&, const DenseOutput&) const override;
  void start(Step&) override;
  void begin_step(const State& from) override;
  void follow(Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) override;
  EventOutcome act(int event, Step&, const Guard&) override;
  void save(Writer&) const override;
  void load(Reader&) override;
  const char* fault() const override;

 private:
  /// What an event is waiting for: to become true or, having acted, false; or nothing any more.
  enum class Waits : unsigned char { for_true, for_false, no_more };
  bool believed(int event) const { return waits_[static_cast<std::size_t>(event)] == Waits::for_false; }
  Guard all_of(int event, const State&) const;
  /// Each comparison over its size; where wanted, its kinks too. @returns the least of them
  double look(int event, const State&, std::vector<double>& out, bool with_kinks = false) const;
  bool holds(int event, const State&) const;
  State extrapolated(const Instant&, double dt) const;
  bool rises(int event, const Instant&) const;
  bool true_at_zero(int event, const State&) const;
  bool on_zero(int event, const State&) const;
  bool stands(int event, const Step&, const DenseOutput&, bool at_end) const;
  void see(const State&);
  void rearm_beside(int event, const Step&);
  void decide_on_level(const std::vector<double>& before, const State&);
  bool switches_all(const std::vector<EventAction>&, State&, EventOutcome&);

  const System& system_;
  std::vector<SceneEventRule> rules_;
  std::vector<Waits> waits_;
  std::vector<std::size_t> first_;  ///< place in `size_` of each event's first comparison
  std::vector<double> size_;        ///< of each comparison so far, the largest, by which it is measured
  bool any_of_speeds_ = false;
  State faster_;                   ///< workspace: what was seen, with all as fast as the fastest
  std::vector<double> away_;       ///< how far each guard has been from zero since its event came last
  std::vector<double> shift_;      ///< of each guard since it was last passed, or stood at zero: so it comes once where it stands
  std::unique_ptr<Equations> eq_;  ///< from the first switching on
};

}  // namespace pintle
