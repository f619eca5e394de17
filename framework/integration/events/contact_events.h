#pragma once

#include "framework/integration/events/event.h"
#include "framework/integration/events/impact_log.h"
#include "framework/integration/scheme.h"

namespace pintle {

/// Onset and loss of contact: the guard is the overlap. Onset latches the approach speed in State::impact_rate, loss clears it. Between
/// profiles, a contact that reaches the end of its pieces continues, with the latched speed, at the pair beyond, or ends: one more event
/// for each pair. For a rigid contact onset is an impact, and loss is where its normal force reaches 0.
class ContactEvents final : public EventGroup {
 public:
  ContactEvents(const System&, const Scheme&);

  const std::vector<Impact>& impacts() const { return log_.impacts(); }

  int order() const override { return 0; }
  int size() const override { return contacts() + static_cast<int>(leaving_.size()); }
  std::string name(int event) const override;
  WatchedGuard watch(int event) const override;
  Guard guard(int event, const State& state) const override;
  Guard guard(int event, const State&, const Equations&) const override;
  std::optional<double> positive_inside(int event, const Step&, const DenseOutput&, double until) const override;
  bool met(int event, const Guard&) const override;
  void start(Step&) override;
  void begin_step(const State&) override;
  std::string follow(Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&) override;
  EventOutcome act(int event, Step&, const Guard&) override;
  void save(Writer&) const override;
  void load(Reader&) override;
  const char* fault() const override { return log_.fault(); }

 private:
  int contacts() const { return static_cast<int>(system_.contacts.size()); }
  /// The pair that leaves its pieces, for the events after those of onset and loss; −1 for others.
  int leaving(int event) const { return event < contacts() ? -1 : leaving_[static_cast<std::size_t>(event - contacts())]; }
  bool continues_another(int contact) const;
  EventOutcome leave(int contact, Step&);
  EventOutcome strike(std::vector<int> touching, Step&);
  EventOutcome part(int contact, Step&);
  Guard pressed(int contact, const State&) const;
  bool time_stepping() const { return fixed_step_ > 0; }
  void write_down(Step&);
  bool touches(int contact, const State&) const;
  void begin(int contact, Step&, double rate);
  void end(int contact, Step&);
  double moment(const Step&, const Guard& gap) const;
  double speed_to_reach(int contact, double depth) const;
  double onset_step(int contact, double rate, double t) const;

  const System& system_;
  double tolerance_, onset_cut_;
  double fixed_step_;         ///< of time-stepping, whose impacts belong to the scheme: they are logged, but are no events; else 0 [s]
  std::vector<int> leaving_;  ///< pairs with pieces of finite extent
  ImpactLog log_;
  std::vector<double> opened_;     ///< when each contact last opened [s]
  double most_pressed_ = 0;        ///< largest normal force of rigid contacts so far [N]
  std::unique_ptr<Equations> eq_;  ///< created at the first impact of rigid bodies
};

}  // namespace pintle
