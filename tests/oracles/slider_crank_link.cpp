#include "slider_crank_link.h"

#include "runge_kutta.h"

namespace pintle_oracle {

std::array<double, 4> link_after(const Params& p, const std::array<double, 4>& y, double span) {
  const auto rates = [&](const Vec<4>& at, Vec<4>& dy) {
    const LinkMotion m = link_motion(p, at);
    dy = {at[2], at[3], m.theta_acceleration, m.psi_acceleration};
  };
  return integrate_tightly<4>(rates, y, span, 1e-13, {1e-3, 1e-3, 1, 1});
}

}  // namespace pintle_oracle
