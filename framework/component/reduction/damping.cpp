#include "framework/component/reduction/damping.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace pintle {
namespace {

[[noreturn]] void reject_damping(const char* what, double value, const char* rule) {
  std::ostringstream text;
  text << "rayleigh damping: " << what << " = " << value << ", " << rule;
  throw std::invalid_argument(text.str());
}

}  // namespace

Rayleigh rayleigh(double omega_1, double zeta_1, double omega_2, double zeta_2) {
  for (const double omega : {omega_1, omega_2})
    if (!(omega > 0) || !std::isfinite(omega)) reject_damping("frequency", omega, "must be positive (rad/s)");
  for (const double zeta : {zeta_1, zeta_2})
    if (!(zeta >= 0) || !std::isfinite(zeta)) reject_damping("ratio", zeta, "must not be negative");
  // If they are closer than this, only rounding determines the coefficients.
  if (std::abs(omega_2 - omega_1) <= 1e-9 * omega_1)
    reject_damping("second frequency", omega_2, "must differ from the first; choose two distinct modes");
  const double spread = (omega_2 - omega_1) * (omega_2 + omega_1);
  return {2 * omega_1 * omega_2 * (zeta_1 * omega_2 - zeta_2 * omega_1) / spread, 2 * (zeta_2 * omega_2 - zeta_1 * omega_1) / spread};
}

Eigen::VectorXd ratios(const Rayleigh& r, const Eigen::VectorXd& omega) { return r.alpha / 2 * omega.cwiseInverse() + r.beta / 2 * omega; }

}  // namespace pintle
