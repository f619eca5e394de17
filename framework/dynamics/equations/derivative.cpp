#include <algorithm>

#include "framework/common/index.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

using Eigen::VectorXd;
using Index = Eigen::Index;

const std::array<double, most_internal>& internal_rates(const Equations& eq, const InternalStates& of) {
  const std::size_t k = at(of.index);
  return of.owner == InternalStates::contact    ? eq.contact[k].x_rate
         : of.owner == InternalStates::friction ? eq.friction[k].x_rate
                                                : eq.force[k].x_rate;
}

void fill_derivative(const System& system, const VectorXd& y, const Equations& eq, VectorXd& dy) {
  const Index n = system.n();
  dy.head(n) = y.segment(n, n);
  dy.segment(n, n) = eq.a;
  for (const InternalStates& owner : system.internal)
    std::copy_n(internal_rates(eq, owner).begin(), owner.n, dy.data() + system.x_begin() + owner.begin);
  for (std::size_t i = 0; i < system.states.size(); ++i)
    dy[system.x_begin() + system.own_x + static_cast<Index>(i)] = eq.laws[at(system.states[i].rate)];
  for (Index i = 0; i < system.n_z(); ++i) {
    const Integral& z = system.integrals[static_cast<std::size_t>(i)];
    const std::size_t k = at(z.index);
    double rate = 0;
    switch (z.account) {
      case Account::hysteresis:
        rate = eq.contact[k].normal.dissipation;
        for (int p = 1; p < system.contacts[k].pairs; ++p) rate += eq.contact[k + at(p)].normal.dissipation;
        break;
      case Account::friction:
        rate = eq.contact[k].friction_loss;
        for (int p = 1; p < system.contacts[k].pairs; ++p) rate += eq.contact[k + at(p)].friction_loss;
        break;
      case Account::joint_friction: rate = eq.friction[k].sticks ? 0 : -eq.friction[k].force * eq.friction[k].slip; break;
      case Account::damper: rate = eq.force[k].dissipation; break;
      case Account::load: rate = eq.force[k].input; break;
      case Account::driver: rate = eq.lambda[system.row_begin[k]] * eq.rows[k].Ct[0]; break;
      case Account::damping: rate = damping_loss(system, y, z.index); break;
      case Account::switching:
      case Account::scheme: break;  // no rate: added at events and steps
    }
    dy[system.z_begin() + i] = rate;
  }
  if (!system.switches.empty()) dy.tail(system.n_y() - system.switch_begin()).setZero();
}

}  // namespace pintle
