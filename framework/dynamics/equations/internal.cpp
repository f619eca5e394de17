#include "framework/dynamics/equations/internal.h"

#include "framework/common/index.h"

namespace pintle {

namespace {

InternalTangent tangent_of(const System& system, const Equations& eq, const InternalStates& owner, const ForceEffect& now) {
  const Force& force = system.forces[at(owner.force)];
  return internal_tangent(force, now, eq.motion[at(marker_a(force))], eq.motion[at(marker_b(force))]);
}

}  // namespace

void follow_internal_states(const System& system, const Equations& eq, double t, double weight, const double* base, double* x) {
  constexpr int most = 20;
  constexpr double rounding = 1e-15;
  for (const InternalStates& owner : system.internal) {
    const Force& force = system.forces[at(owner.force)];
    double* own = x + owner.begin;
    for (int i = 0; i < most; ++i) {
      const ForceEffect now = evaluate(force, eq.motion[at(marker_a(force))], eq.motion[at(marker_b(force))], t, own);
      InternalVector left(owner.n);
      for (int k = 0; k < owner.n; ++k)
        left[k] = now.x_rate[at(k)] - (weight == internal_at_rest ? 0 : (own[k] - base[owner.begin + k]) / weight);
      const InternalVector change = internal_change(tangent_of(system, eq, owner, now).g_x, weight, left);
      double largest = 0;
      for (int k = 0; k < owner.n; ++k) {
        own[k] += change[k];
        largest = std::max(largest, std::abs(change[k]) - rounding * std::abs(own[k]));
      }
      if (!(largest > 0)) break;
    }
  }
}

void relax_internal_states(const System& system, double t, Eigen::VectorXd& y) {
  if (system.n_x() == 0) return;
  Equations eq(system);
  Eigen::VectorXd still = y;
  still.segment(system.n(), system.n()).setZero();
  pose(system, t, still, eq);
  speed(system, t, still, eq);
  follow_internal_states(system, eq, t, internal_at_rest, nullptr, y.data() + system.x_begin());
}

void filter_internal_states(const System& system, const Equations& eq, double weight, double* v) {
  for (const InternalStates& owner : system.internal) {
    Eigen::Map<InternalVector> own(v + owner.begin, owner.n);
    own = internal_change(tangent_of(system, eq, owner, eq.force[at(owner.force)]).g_x, weight, own / weight);
  }
}

}  // namespace pintle
