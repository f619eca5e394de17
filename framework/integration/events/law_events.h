#pragma once

#include <vector>

#include "framework/integration/events/event.h"

namespace pintle {

/// Events where laws of signals change their branch: comparisons, kinks and the marks of tables, as in SidedLaw. Laws are held on their
/// sides within a step, which ends where the first of them reaches the end of its side. Two events: one for exact switches, one for the
/// rest.
class LawEvents final : public EventGroup {
 public:
  explicit LawEvents(const System&);
  /// Whether any law has sides.
  static bool has_any(const System&);

  /// For Equations: the sides on which the laws are held.
  const std::vector<int>& sides() const { return sides_; }
  /// Finds the sides again after a jump of the state.
  void find_sides(const State&);

  int order() const override { return 3; }
  int size() const override { return 2; }
  std::string name(int event) const override;
  std::string remedy() const override;
  WatchedGuard watch(int event) const override;
  Guard guard(int event, const State&) const override;
  Guard guard(int event, const State& state, const Equations&) const override { return guard(event, state); }
  std::optional<double> positive_inside(int event, const Step&, const DenseOutput&, double until) const override;
  bool met(int event, const Guard&) const override;
  void start(Step&) override;
  std::string follow(Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) override;
  EventOutcome act(int event, Step&, const Guard&) override;
  void save(Writer&) const override;
  void load(Reader&) override;
  const char* fault() const override;

 private:
  struct Sided {
    std::size_t law;
    int first, end;  ///< range of its switches among all
  };
  std::vector<double> signals_of(const SignalLaw&, const State&) const;
  /// Positive where a switch is past the end of its side, relative to its largest value.
  std::vector<double> past(const State&) const;
  double value(const Sided&, const State&) const;
  void see(const State&);

  const System& system_;
  std::vector<Sided> laws_;
  std::vector<unsigned char> exact_;       ///< of each switch
  std::vector<int> sides_;                 ///< of each switch
  std::vector<double> size_, lag_, most_;  ///< per switch: largest value, lag since it switched; per law: largest value
  bool any_exact_ = false, any_not_ = false;
  int last_ = 0;  ///< the law that switched last
};

}  // namespace pintle
