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

/// Marches a system in time: adaptive steps of a Stepper, constraints kept, events met, contacts opened and closed. Each call of
/// `advance` makes one accepted step, which an event may shorten.
class Integrator {
 public:
  /// @pre start meets the constraints nearly; it is projected onto them here, and contacts begun if it overlaps
  Integrator(const System&, const Scheme&, State start);

  /// One step towards `until`, ending there at the latest. @returns false when it cannot; see failure(), or need not; see ended()
  bool advance(double until);
  /// Where no step is to follow: the next of the events that have come at the last step's end but would act as the following step begins.
  /// @returns false where there is none, or it cannot act; see failure()
  bool act_at_end();
  /// Between steps: the state is changed here, as by an event. @returns false when it cannot go on from there; see failure()
  bool change(const std::function<void(State&)>& act);
  /// Dense output inside the last step or at its end, fully evaluated in `sampled()`. Of an explicit step it is brought
  /// onto the constraints, of an implicit one, whose a and λ are the scheme's, it is not. Changes nothing of the steps and
  /// depends on the last one alone, not on what was sampled before. @returns false if it cannot be projected
  bool sample(double t, State& out);
  /// At the state that `sample` gave last. @pre there was one
  const Equations& sampled() const { return *sampled_; }

  const State& state() const { return step_.to.state; }
  const Equations& equations() const { return eq_; }  ///< at the present state, while steps succeed
  const Step& last() const { return step_; }
  const std::vector<Impact>& impacts() const { return contacts_->impacts(); }  ///< in order of beginning
  const std::vector<Happening>& happenings() const { return happenings_; }     ///< what events of the scene have done
  bool asks_for_row() const { return row_; }                                   ///< an event at the last step's end does
  bool asks_for_save() const { return save_; }                                 ///< likewise, of the state
  const std::string& failure() const { return failure_; }
  const std::string& ended() const { return ended_; }  ///< an event has ended the integration, and why; else empty
  Counts counts() const;
  double worst_position() const { return worst_position_; }  ///< largest scaled |C| at a step's end
  double worst_velocity() const { return worst_velocity_; }
  bool implicit() const { return stepper_->traits().implicit; }         ///< now
  double held_by_stability() const { return switching_.held_share(); }  ///< part of the explicit steps
  const std::string& switched() const { return switching_.why(); }      ///< when and why another method took over in the run; else empty

  /// Everything the following steps depend on, and the impacts and counts so far, as they are to the bit.
  /// For this System, scheme and program only.
  std::string save() const;
  /// Goes on from there as the integrator saved would have. Afterwards it is as saved or, where it throws, of no use.
  /// @throws std::invalid_argument saying why it is not what `save` of an integrator of this system made
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
  ContactEvents* contacts_;  ///< among the events
  LawEvents* laws_;          ///< likewise; nullptr: no law has sides
  Events events_;
  TurnAhead turn_ahead_;
  std::unique_ptr<Equations> sampled_;  ///< from the first sample on
  Step step_;
  HeldForces held_;  ///< while events are sought
  State dense_;
  Counts counts_;
  std::vector<Happening> happenings_;
  bool row_ = false, save_ = false;
  std::string failure_, ended_;
  double worst_position_ = 0, worst_velocity_ = 0;
  double last_tenth_ = 0;       ///< when the last tenth of the steps allowed began [s]
  bool near_singular_ = false;  ///< the step's start is
};

}  // namespace pintle
