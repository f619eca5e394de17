#include "framework/dynamics/energy.h"

namespace pintle {

double kinetic_energy(const System& system, const Eigen::VectorXd& y) {
  double twice = 0;
  const double* s = y.data() + system.n();
  for (const Body& body : system.bodies) {
    twice += body.m * (s[0] * s[0] + s[1] * s[1]) + body.J * s[2] * s[2];
    s += 3;
  }
  return twice / 2;
}

Energies energies(const System& system, const State& state, const Equations& eq) {
  Energies e;
  e.kinetic = kinetic_energy(system, state.y);
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    e.gravity -= system.bodies[b].m * system.gravity.dot(state.y.segment<2>(3 * static_cast<int>(b)));
  for (const ForceEffect& f : eq.force) e.springs += f.stored;
  for (const ContactEffect& c : eq.contact) e.contacts += c.normal.stored;
  for (int i = 0; i < system.n_z(); ++i) {
    const Account account = system.integrals[static_cast<std::size_t>(i)].account;
    const bool input = account == Account::load || account == Account::driver;
    (input ? e.input : e.lost) += state.y[2 * system.n() + i];
  }
  return e;
}

}  // namespace pintle
