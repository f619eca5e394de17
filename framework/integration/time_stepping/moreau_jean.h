#pragma once

#include "framework/integration/stepper.h"
#include "framework/integration/time_stepping/middle_contacts.h"

namespace pintle {

/// Moreau and Jean's scheme for rigid contacts: steps of fixed length, each from the midpoint of the step before to its own midpoint, over
/// which forces and impacts act together, as impulses by Newton's law of restitution. It does not locate impacts in time and can pass any
/// number of them in a step; its error is of first order in the step. Theory and sources: docs/theory/impact.md.
class MoreauJean final : public Stepper {
 public:
  static constexpr std::string_view method = "moreau";
  MoreauJean(const System&, double step);

  std::string_view name() const override { return method; }
  const StepperTraits& traits() const override { return traits_; }
  bool project(Instant&, Equations&) override;
  bool attempt(double h, const ErrorNorm&, Step&, Equations&) override;
  void accept(Equations&) override { contacts_.keep(), given_ = given_now_; }
  double first_step(const Instant&, const ErrorNorm&, double) const override { return traits_.fixed_step; }
  void interpolate(const Step&, double t, Eigen::VectorXd& y) const override;
  bool sample(const Step&, double t, Equations&, State& out) override;
  bool passed_near_singular() const override { return false; }
  bool near_singular(const Equations&) const override { return false; }
  bool strayed_near_singular(const Step&, const Equations&) const override { return false; }
  StabilityLimits stability_limits(const Step&) const override { return {}; }
  std::string trouble() const override { return trouble_; }
  int partitions() const override { return 0; }
  void save(Writer&) const override;
  void load(Reader&) override;
  bool fits(const Instant&) const override { return contacts_.fits() && given_.size() == given_now_.size(); }
  void evaluate_end(const Step&, Equations&) override;

 private:
  bool evaluate_node(Instant&, Equations&);
  bool put_impulses(double h, const State& from, Eigen::VectorXd& speeds, State& to, Equations&);
  bool push_apart(Instant&, Equations&);
  void book_rates(Step&) const;
  void book_loss(State&, const Equations&) const;

  const System& system_;
  StepperTraits traits_;
  State middle_;
  MiddleContacts contacts_;
  std::string trouble_;
  std::vector<double> given_, given_now_;  ///< closing speeds that correct gaps, in the step before and in this one [m/s]
  std::vector<double> left_;               ///< largest allowed overlap of lasting contacts; the next step corrects it [m]
  double balance_ = 0;                     ///< energy balance kept by the integral of numerical losses [J]
};

}  // namespace pintle
