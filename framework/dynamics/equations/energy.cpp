#include "framework/dynamics/equations/energy.h"

#include "framework/dynamics/model/flexible.h"

namespace pintle {

double kinetic_energy(const System& system, const Eigen::VectorXd& y) {
  double sum = 0;
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) sum += kinetic_energy(system, y, b);
  return sum;
}

Energies energies(const System& system, const State& state, const Equations& eq) {
  Energies e;
  e.kinetic = kinetic_energy(system, state.y);
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) {
    e.gravity -= system.bodies[static_cast<std::size_t>(b)].m * system.gravity.dot(mass_centre(system, state.y, b));
    e.strain += strain_energy(system, state.y, b);
  }
  for (const ForceEffect& f : eq.force) e.springs += f.stored;
  for (const ContactEffect& c : eq.contact) e.contacts += c.normal.stored;
  for (int i = 0; i < system.n_z(); ++i) {
    const Account account = system.integrals[static_cast<std::size_t>(i)].account;
    const bool input = account == Account::load || account == Account::driver;
    (input ? e.input : e.lost) += state.y[system.z_begin() + i];
  }
  return e;
}

}  // namespace pintle
