#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "framework/integration/events/engagement.h"
#include "framework/integration/events/event.h"

namespace pintle {

/// Actions of an event of the scene. All its switching happens at one instant, before the rest.
struct StopRun {
  std::string reason;
};
/// A change of the state: one of the scene's own states gets a value.
struct SetState {
  std::string name;
  std::function<void(const System&, const State& seen, State&)> set;
  std::function<std::string(const System&, const State&)> seen = {};  ///< the values that it receives, in words
};
enum class Record { state, row };
using EventAction = std::variant<SwitchOver, SetState, StopRun, Record>;

/// Results of a comparison requested besides its difference, all from one evaluation of the state.
struct Wanted {
  bool rate = false;                     ///< of the difference, where known
  double* size = nullptr;                ///< ← size of the compared quantities, the scale of the difference
  std::vector<double>* kinks = nullptr;  ///< appended: numbers at whose zeros the difference has a kink or jump
};

/// One comparison of an event's condition: greater side minus lesser side, positive where it holds.
struct SceneComparison {
  std::function<Guard(const System&, const State&, const Wanted&)> difference;
  bool at_zero = false;                                               ///< true where both are equal
  bool of_speeds = false;                                             ///< compares speeds of the motion, or quantities that depend on them
  std::function<std::string(const System&, const State&)> seen = {};  ///< the compared values, in words
};

/// An event as the scene describes it: it occurs when all of its comparisons have become true, and acts once, or each time they do.
struct SceneEventRule {
  std::string name;
  std::vector<SceneComparison> when;
  std::vector<EventAction> actions;
  std::vector<EventAction> otherwise = {};  ///< when they are no longer true
  bool once = false;
  bool from_start = true;  ///< if they are true at the start, it acts there
};

/// The events of a scene, in their order. At one instant they act after those of contacts and of friction.
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
  std::optional<double> positive_inside(int event, const Step&, const DenseOutput&, double until) const override;
  void decide_at_zero(int event, const Step&, const DenseOutput&, Guard& from, Guard& to) override;
  bool comes_at_zero(int event, const State&) const override;
  bool met(int event, const Guard&) const override;
  bool hardly_left(int event, const Step&, const DenseOutput&) const override;
  void start(Step&) override;
  void begin_step(const State& from) override;
  std::string follow(Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) override;
  EventOutcome act(int event, Step&, const Guard&) override;
  void save(Writer&) const override;
  void load(Reader&) override;
  const char* fault() const override;

 private:
  /// What an event waits for: to become true or, after acting, false; no_more: it acts only once, and has acted.
  enum class Waits : unsigned char { for_true, for_false, no_more };
  bool believed(int event) const { return waits_[static_cast<std::size_t>(event)] == Waits::for_false; }
  Guard all_of(int event, const State&) const;
  /// Each comparison relative to its size; if wanted, also its kinks. @returns the smallest of them
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
  std::vector<std::size_t> first_;  ///< index in `size_` of each event's first comparison
  std::vector<double> size_;        ///< largest value of each comparison so far, its scale
  bool any_of_speeds_ = false;
  State faster_;                   ///< workspace: the last state, with every speed as fast as the fastest
  std::vector<double> away_;       ///< largest distance of each guard from zero since its event last occurred
  std::vector<double> shift_;      ///< of each guard since it last reached zero, so that its event occurs only once there
  std::unique_ptr<Equations> eq_;  ///< created at the first switching
};

}  // namespace pintle
