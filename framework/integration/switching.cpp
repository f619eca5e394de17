#include "framework/integration/switching.h"

#include <algorithm>

#include "framework/common/text.h"

namespace pintle {

bool Switching::falls_back(const Stepper& stepper, const Scheme& scheme, double t) {
  if (!scheme.fallback || fallen_back_ || !stepper.passed_near_singular()) return false;
  fallen_back_ = true;
  why_ = std::string(scheme.fallback->name) + " from t = " + number_text(t, 6) + " s on: a singular configuration is near";
  return true;
}

bool Switching::held_by_stability(const Stepper& stepper, const Scheme& scheme, const Step& step) {
  constexpr int many = 30, seldom = 16;
  if (stepper.traits().implicit) return false;
  if (!(step.h < scheme.switch_below) && ++steps_ % seldom == 0) ++looked_at_, at_limit_ += stepper.at_stability_limit(step);
  if (!(scheme.switch_below > 0)) return false;
  const bool held = step.h < scheme.switch_below && stepper.at_stability_limit(step);
  held_ = held ? held_ + 1 : std::max(0, held_ - 2);
  if (held_ < many) return false;
  why_ = "generalized-alpha from t = " + number_text(step.to.state.t, 6) + " s on: stability, not accuracy, limited " +
         std::to_string(many) + " explicit steps to about " + number_text(step.h, 6) + " s";
  return true;
}

void Switching::goes_on_with(const std::string& method) {
  if (why_.empty()) why_ = method + " throughout, as in the saved run";
}

}  // namespace pintle
