#pragma once

#include "framework/integration/events/event.h"
#include "framework/integration/events/impact_log.h"
#include "framework/integration/scheme.h"

namespace pintle {

/// Onset and loss of contact in clearance joints: the guard is the overlap. Onset latches the approach speed in
/// State::impact_rate, loss clears it.
class ContactEvents final : public EventGroup {
 public:
  ContactEvents(const System&, const Scheme&);

  const std::vector<Impact>& impacts() const { return log_.impacts(); }

  int order() const override { return 0; }
  int size() const override { return static_cast<int>(system_.contacts.size()); }
  std::string name(int contact) const override;
  WatchedGuard watch(int contact) const override;
  Guard guard(int contact, const State& state) const override { return gap_of(system_, contact, state); }
  Guard guard(int contact, const State&, const Equations&) const override;
  bool met(int contact, const Guard&) const override;
  void start(Step&) override;
  void follow(const Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) override;
  EventOutcome act(int contact, Step&, const Guard&) override;
  void save(Writer&) const override;
  void load(Reader&) override;
  const char* fault() const override { return log_.fault(); }

 private:
  void begin(int contact, Step&, double rate);
  void end(int contact, Step&);
  double moment(const Step&, const Guard& gap) const;
  double speed_to_reach(int contact, double depth) const;
  double onset_step(int contact, double rate, double t) const;

  const System& system_;
  double tolerance_, onset_cut_;
  ImpactLog log_;
};

}  // namespace pintle
