#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/equations/sticking.h"
#include "framework/integration/events/event.h"
#include "framework/integration/scheme.h"

namespace pintle {

/// Stick and slip of dry friction in contacts and joints, and which closed rigid contacts stay closed. Two events each: sliding ends where
/// the slip reaches 0; sticking ends where the holding force reaches μ_s N. At either event everything that does not slide is examined
/// together: what can hold, and in which direction the rest slides. The present modes are in State::friction.
class FrictionEvents final : public EventGroup {
 public:
  FrictionEvents(const System&, const Scheme&);

  int order() const override { return 1; }
  int size() const override { return 2 * static_cast<int>(dry_.size()); }
  std::string name(int event) const override;
  WatchedGuard watch(int event) const override;
  Guard guard(int event, const State& state) const override;
  Guard guard(int event, const State& state, const Equations&) const override;
  std::optional<double> positive_inside(int event, const Step&, const DenseOutput&, double until) const override;
  bool met(int event, const Guard&) const override;
  void start(Step&) override;
  std::string follow(Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) override;
  EventOutcome act(int event, Step&, const Guard&) override;
  void save(Writer&) const override;
  void load(Reader&) override;
  const char* fault() const override;

 private:
  static bool of_sliding(int event) { return event % 2 == 0; }
  std::size_t place(int event) const { return dry_[static_cast<std::size_t>(event / 2)]; }
  double still(int event) const;
  bool moves_nothing(double force, double h) const;
  bool touches(std::size_t at, const State&) const;
  FrictionNow now(std::size_t at, const State&) const;
  Guard guard(int event, const State&, const FrictionNow&) const;
  bool of_rigid(std::size_t at) const;
  /// The frictions that may stick, and the direction in which each slid before.
  struct Resting {
    std::vector<std::size_t> at;
    std::vector<double> came;
    bool rigid = false;  ///< some rigid contact is closed
  };
  Resting classify(State&, std::optional<std::size_t> slips) const;
  void pass_dead_centres(const Resting&, std::optional<std::size_t> ended, State&);
  bool decide_rigid_ones(State&, bool at_limit);
  /// Of which friction the holding force reached its limit, or the sliding ended. @returns false if rigid contacts find no forces
  bool decide(State&, std::optional<std::size_t> slips, std::optional<std::size_t> ended);

  const System& system_;
  double tolerance_;
  std::vector<double> fastest_;    ///< largest slip of each so far [m/s]
  std::vector<std::size_t> dry_;   ///< indices into State::friction
  std::unique_ptr<Equations> eq_;  ///< created at the first decision
};

}  // namespace pintle
