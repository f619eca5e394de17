#pragma once

#include <memory>
#include <vector>

#include "framework/integration/events/event.h"
#include "framework/integration/scheme.h"

namespace pintle {

/// Stick and slip of contacts of dry friction. Two events each: sliding ends where the slip comes to 0; sticking ends where the force that
/// holds comes to μ_s N. At either, all contacts that do not slide are looked at together: which of them can hold, and which way the
/// others go. What a contact is doing stands in State::friction.
class FrictionEvents final : public EventGroup {
 public:
  FrictionEvents(const System&, const Scheme&);

  int order() const override { return 1; }
  int size() const override { return 2 * static_cast<int>(dry_.size()); }
  std::string name(int event) const override;
  WatchedGuard watch(int event) const override;
  Guard guard(int event, const State& state) const override;
  Guard guard(int event, const State& state, const Equations&) const override;
  std::optional<double> positive_inside(int event, const Step&, const DenseOutput&) const override;
  bool met(int event, const Guard&) const override;
  void start(Step&) override;
  void follow(Step&, std::span<const Guard>, std::span<const Guard>, const DenseOutput&) override {}
  EventOutcome act(int event, Step&, const Guard&) override;
  void save(Writer&) const override {}
  void load(Reader&) override {}
  const char* fault() const override { return nullptr; }

 private:
  static bool of_sliding(int event) { return event % 2 == 0; }
  std::size_t contact(int event) const { return dry_[static_cast<std::size_t>(event / 2)]; }
  Guard guard(int event, const State&, const ContactEffect&) const;
  void decide(State&, std::optional<std::size_t> slips);

  const System& system_;
  double tolerance_;
  double still_;                   ///< a slip below this is none [m/s]
  std::vector<std::size_t> dry_;   ///< contacts of dry friction
  std::unique_ptr<Equations> eq_;  ///< from the first decision on
};

}  // namespace pintle
