#include "framework/integration/stepper.h"

#include "framework/integration/explicit/runge_kutta.h"
#include "framework/integration/implicit/generalized_alpha.h"
#include "framework/integration/time_stepping/moreau_jean.h"

namespace pintle {

std::unique_ptr<Stepper> make_stepper(std::string_view name, const System& system, const Scheme& scheme, const Equations& eq) {
  if (name == GeneralizedAlpha::method) return std::make_unique<GeneralizedAlpha>(system, eq, scheme.rho, scheme.tolerance);
  if (name == MoreauJean::method) return std::make_unique<MoreauJean>(system, scheme.fixed_step);
  if (const Tableau* tableau = find_tableau(name))
    return std::make_unique<RungeKutta>(system, *tableau, scheme.constraints, scheme.tolerance);
  return nullptr;
}

}  // namespace pintle
