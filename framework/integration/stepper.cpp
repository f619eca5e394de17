#include "framework/integration/stepper.h"

#include "framework/integration/explicit/runge_kutta.h"
#include "framework/integration/implicit/generalized_alpha.h"

namespace pintle {

std::unique_ptr<Stepper> make_stepper(std::string_view name, const System& system, const Scheme& scheme, const Equations& eq) {
  if (name == GeneralizedAlpha::method) return std::make_unique<GeneralizedAlpha>(system, eq, scheme.rho, scheme.tolerance);
  if (const Tableau* tableau = find_tableau(name))
    return std::make_unique<RungeKutta>(system, *tableau, scheme.constraints, scheme.tolerance);
  return nullptr;
}

}  // namespace pintle
