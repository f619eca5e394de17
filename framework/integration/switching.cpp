#include "framework/integration/switching.h"

#include <algorithm>

#include "framework/common/text.h"

namespace pintle {

void Switching::add(const std::string& change) {
  constexpr int most_told = 4;
  if (++changes_ <= most_told) why_ += (why_.empty() ? "" : "; ") + change;
  if (changes_ == most_told + 1) why_ += "; and so on";
}

bool Switching::falls_back(const Stepper& stepper, const Scheme& scheme, double t) {
  if (!scheme.fallback || fallen_back_ || !stepper.passed_near_singular()) return false;
  fallen_back_ = true;
  add(std::string(scheme.fallback->name) + " from t = " + number_text(t, 6) + " s on: a singular configuration is near");
  return true;
}

bool Switching::held_by_stability(const Stepper& stepper, const Scheme& scheme, const Step& step, long cost) {
  constexpr int seldom = 16, longest = 7680;
  if (stepper.traits().implicit) return false;
  const bool may_switch = step.h < scheme.switch_below;
  if (!may_switch && ++steps_ % seldom == 0) ++looked_at_, at_limit_ += stepper.stability_limits(step).decay;
  if (!(scheme.switch_below > 0)) return false;
  const StabilityLimits limits = may_switch ? stepper.stability_limits(step) : StabilityLimits{};
  held_ = limits.decay || limits.oscillation ? held_ + 1 : std::max(0, held_ - 2);
  if (held_ <= 1) mark_t_ = step.to.state.t, mark_cost_ = cost;
  if (held_ < patience_) return false;
  pace_ = (step.to.state.t - mark_t_) / static_cast<double>(cost - mark_cost_);
  held_ = 0;
  patience_ = std::min(4 * patience_, longest);
  return true;
}

void Switching::go_implicit(const Stepper& pair, const Step& step, double cheaper, long cost) {
  pair_ = pair.name(), step_of_pair_ = step.h;
  mark_t_ = step.to.state.t, mark_cost_ = cost, implicit_steps_ = 0;
  add("generalized-alpha from t = " + number_text(step.to.state.t, 6) + " s on: stability, not accuracy, limited explicit steps to about " +
      number_text(step.h, 6) + " s, and a trial was " + number_text(cheaper, 2) + " times cheaper");
}

bool Switching::goes_back(const Stepper& stepper, double t, long cost) {
  constexpr double enough = 1.5;                 // times cheaper: less is not worth the accuracy of the pair
  const int many = std::max(64, patience_ / 4);  // as many as the steps before the trial
  if (!stepper.traits().implicit || pair_.empty() || ++implicit_steps_ % many != 0) return false;
  const double pace = (t - mark_t_) / static_cast<double>(cost - mark_cost_);
  mark_t_ = t, mark_cost_ = cost;
  if (pace > enough * pace_) return false;
  held_ = 0;
  add(pair_ + " from t = " + number_text(t, 6) + " s on: accuracy limited generalised-alpha to steps that gain little");
  return true;
}

void Switching::goes_on_with(const std::string& method) {
  if (why_.empty()) why_ = method + " throughout, as in the saved run";
}

}  // namespace pintle
