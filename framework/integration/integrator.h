#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/integration/law_changes.h"
#include "framework/integration/counts.h"
#include "framework/integration/error_norm.h"
#include "framework/integration/events/contact_events.h"
#include "framework/integration/events/events.h"
#include "framework/integration/events/law_events.h"
#include "framework/integration/scheme.h"
#include "framework/integration/step_control.h"
#include "framework/integration/stepper.h"
#include "framework/integration/switching.h"

namespace pintle {

/// Integrates a system in time: adaptive steps of a Stepper, constraints enforced, events located, contacts opened and closed. Each call of
/// `advance` makes one accepted step, which an event may shorten.
class Integrator {
 public:
  /// @pre start nearly satisfies the constraints; it is projected onto them here, and contacts that overlap are closed
  Integrator(const System&, const Scheme&, State start);

  /// One step towards `until`, ending there at the latest. @returns false when it fails, see failure(), or has ended, see ended()
  bool advance(double until);
  /// If no step follows: lets the next event act that has occurred at the last step's end but would act only when the following step
  /// begins.
  /// @returns false if there is none, or it cannot act; see failure()
  bool act_at_end();
  /// Changes the state between steps, as an event would. @returns false when it cannot continue from there; see failure()
  bool change(const std::function<void(State&)>& act);
  /// Dense output inside the last step or at its end, fully evaluated in `sampled()`. For an explicit step it is projected onto the
  /// constraints; for an implicit one, whose a and λ are those of the scheme, it is not. Does not affect the steps, and depends only on the
  /// last one, not on previous samples. @returns false if it cannot be projected
  bool sample(double t, State& out);
  /// The equations at the state that `sample` returned last. @pre there was one
  const Equations& sampled() const { return *sampled_; }

  const State& state() const { return step_.to.state; }
  const Equations& equations() const { return eq_; }  ///< at the present state, as long as steps succeed
  const Step& last() const { return step_; }
  const std::vector<Impact>& impacts() const { return contacts_->impacts(); }  ///< in order of their begin
  const std::vector<Happening>& happenings() const { return happenings_; }     ///< record of the events of the scene
  bool asks_for_row() const { return row_; }    ///< an event at the last step's end requests a row of results
  bool asks_for_save() const { return save_; }  ///< likewise, that the state is saved
  const std::string& failure() const { return failure_; }
  const std::string& ended() const { return ended_; }  ///< why an event has ended the integration; otherwise empty
  Counts counts() const;
  double worst_position() const { return worst_position_; }  ///< largest scaled |C| at a step's end
  double worst_velocity() const { return worst_velocity_; }
  bool implicit() const { return stepper_->traits().implicit; }  ///< at present
  bool was_implicit() const { return implicit() || switching_.went_implicit(); }
  double held_by_stability() const { return switching_.held_share(); }  ///< share of the explicit steps limited by stability
  const std::string& switched() const { return switching_.why(); }      ///< when and why another method took over; otherwise empty

  /// Everything the following steps depend on, and the impacts and counts so far, exact to the bit. Valid only for this System, scheme and
  /// program.
  std::string save() const;
  /// Continues exactly as the saved integrator would have. If it throws, the integrator is invalid.
  /// @throws std::invalid_argument saying why this was not made by `save` of an integrator of this system
  void load(const std::string& saved);

 private:
  friend class Writer;
  friend class Reader;
  template <class A>
  void archive(A&);
  const char* fault_of_loaded() const;
  bool may_step(double until);
  bool begin_step(double until);
  bool pass_law_change();
  double first_wish(double left) const;
  double kink_ahead(double wish) const;
  bool step_to(double left);
  bool end_at_first_event(std::optional<EventInStep>&);
  bool act_on(const EventInStep&, double wish);
  void hold_laws();
  void look_at_end();
  bool switch_method();
  bool go_back();
  bool take(std::string_view method, Instant&);
  long cost() const;
  bool sees_ends_alone() const;
  void look_inside();
  DenseOutput motion() { return {*stepper_, step_, held_, dense_}; }
  const Equations* evaluated_at_end() const { return stepper_->traits().ends_evaluated && step_.h > 0 ? &eq_ : nullptr; }
  double least_part() const;
  std::string trouble() const;
  bool stop(const std::string& reason);
  bool stop(const std::string& reason, double t);

  const System& system_;
  Scheme scheme_;
  Equations eq_;
  std::unique_ptr<Stepper> stepper_;
  ErrorNorm norm_;
  StepControl control_;
  Switching switching_;
  ContactEvents* contacts_;  ///< member of the events
  LawEvents* laws_;          ///< likewise; nullptr: no law has sides
  Events events_;
  TurnAhead turn_ahead_;
  std::unique_ptr<Equations> sampled_;  ///< created at the first sample
  Step step_;
  HeldForces held_;  ///< used while searching for events
  StateInside dense_;
  Counts counts_;
  std::vector<Happening> happenings_;
  bool row_ = false, save_ = false;
  std::string failure_, ended_;
  double worst_position_ = 0, worst_velocity_ = 0;
  double last_tenth_ = 0;       ///< when the last tenth of the allowed steps began [s]
  bool near_singular_ = false;  ///< at the step's start
};

}  // namespace pintle
