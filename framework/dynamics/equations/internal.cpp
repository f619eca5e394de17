#include "framework/dynamics/equations/internal.h"

#include <algorithm>

#include "framework/common/index.h"
#include "framework/dynamics/equations/laws.h"
#include "framework/dynamics/model/signal_values.h"

namespace pintle {

namespace {

bool has_released_owner(const System& system, const InternalStates& of, const Eigen::VectorXd& y) {
  switch (of.owner) {
    case InternalStates::force: return is_released(system, Switch::force, of.index, y);
    case InternalStates::contact: return is_released(system, Switch::contact, of.index, y);
    case InternalStates::friction: return is_released(system, Switch::joint, system.frictions[at(of.index)].joint, y);
  }
  return false;
}

// g of one owner and its derivatives with respect to x.
struct OwnRates {
  std::array<double, most_internal> rate{};
  InternalMatrix g_x;
};

// The motion that the rates of an owner's states depend on, evaluated once.
class OwnMotion {
 public:
  OwnMotion(const System& system, const Equations& eq, const State& state, const InternalStates& of)
      : system_(system),
        of_(of),
        t_(state.t),
        markers_(markers_of(system, of)),
        a_(eq.motion[at(markers_[0])]),
        b_(eq.motion[at(markers_[1])]) {
    const std::size_t k = at(of.index);
    if (of.owner == InternalStates::friction) {
      const JointFriction& rub = system.frictions[k];
      law_ = &rub.law, slip_ = slip(system.joints[at(rub.joint)], rub, a_, b_);
    } else if (of.owner == InternalStates::contact) {
      const ContactPair& pair = system.contacts[k];
      law_ = &*pair.friction, open_ = !(state.impact_rate[k] > 0);
      if (!open_) slip_ = sliding_speed(pair, gap_between(pair, moving_point(a_), moving_point(b_)));
    }
    open_ = open_ || has_released_owner(system, of, state.y);
  }
  OwnRates at_states(const double* x) const {
    OwnRates out{{}, InternalMatrix::Zero(of_.n, of_.n)};
    if (open_) return out;
    if (law_) {
      const BristleForce now = bend(*law_, slip_, x);
      out.rate = now.rate;
      for (int i = 0; i < of_.n; ++i)
        for (int j = 0; j < of_.n; ++j) out.g_x(i, j) = now.rate_d_state[at(i)][at(j)];
      return out;
    }
    const Force& force = system_.forces[at(of_.index)];
    const ForceEffect now = evaluate(force, a_, b_, t_, x);
    out.rate = now.x_rate;
    out.g_x = internal_tangent(force, now, a_, b_).g_x;
    return out;
  }

 private:
  const System& system_;
  const InternalStates& of_;
  double t_, slip_ = 0;
  bool open_ = false;                 ///< its owner is inactive
  const FrictionLaw* law_ = nullptr;  ///< of bristles
  std::array<int, 2> markers_;
  const MarkerMotion &a_, &b_;
};

}  // namespace

std::array<int, 2> markers_of(const System& system, const InternalStates& of) {
  const std::size_t k = at(of.index);
  if (of.owner == InternalStates::force) return {marker_a(system.forces[k]), marker_b(system.forces[k])};
  if (of.owner == InternalStates::contact) return {system.contacts[k].a, system.contacts[k].b};
  const JointEnds ends = ends_of(system.joints[at(system.frictions[k].joint)]);
  return {ends.marker[0], ends.marker[1]};
}

InternalTangent internal_tangent(const System& system, const State& state, const Equations& eq, const InternalStates& of) {
  const std::size_t k = at(of.index);
  const std::array<int, 2> markers = markers_of(system, of);
  const MarkerMotion &a = eq.motion[at(markers[0])], &b = eq.motion[at(markers[1])];
  const double* x = state.y.data() + system.x_begin() + of.begin;
  if (has_released_owner(system, of, state.y)) return InternalTangent(2, of.n);
  switch (of.owner) {
    case InternalStates::force: return internal_tangent(system.forces[k], eq.force[k], a, b);
    case InternalStates::contact:
      return state.impact_rate[k] > 0 ? internal_tangent(system.contacts[k], eq.contact[k], a, b, x) : InternalTangent(2, of.n);
    case InternalStates::friction: break;
  }
  const JointFriction& rub = system.frictions[k];
  return internal_tangent(unit_friction(system.joints[at(rub.joint)], rub, a, b), rub, eq.friction[k], x);
}

void follow_internal_states(const System& system, Equations& eq, const State& state, double weight, const double* base, double* x) {
  constexpr int most = 20;
  constexpr double rounding = 1e-15;
  for (const InternalStates& owner : system.internal) {
    const OwnMotion motion(system, eq, state, owner);
    double* own = x + owner.begin;
    for (int i = 0; i < most; ++i) {
      const OwnRates now = motion.at_states(own);
      InternalVector left(owner.n);
      for (int k = 0; k < owner.n; ++k) left[k] = now.rate[at(k)] - (base ? (own[k] - base[owner.begin + k]) / weight : 0);
      const InternalVector change = internal_change(now.g_x, weight, left);
      double largest = 0;
      for (int k = 0; k < owner.n; ++k) {
        own[k] += change[k];
        largest = std::max(largest, std::abs(change[k]) - rounding * std::abs(own[k]));
      }
      if (!(largest > 0)) break;
    }
  }
  if (!system.states.empty()) follow_own_states(system, eq, state.t, weight, base, x);
}

void relax_internal_states(const System& system, double t, Eigen::VectorXd& y) {
  if (system.n_x() == 0) return;
  Equations eq(system);
  State still{.t = t, .y = y, .impact_rate = std::vector<double>(system.contacts.size(), 0.0)};
  still.y.segment(system.n(), system.n()).setZero();
  pose(system, t, still.y, eq);
  speed(system, t, still.y, eq);
  follow_internal_states(system, eq, still, internal_at_rest, nullptr, y.data() + system.x_begin());
  start_own_states(system, y);
}

void filter_internal_states(const System& system, const State& state, Equations& eq, double weight, double* v) {
  for (const InternalStates& owner : system.internal) {
    Eigen::Map<InternalVector> own(v + owner.begin, owner.n);
    own = internal_change(internal_tangent(system, state, eq, owner).g_x, weight, own / weight);
  }
  if (!system.states.empty()) filter_own_states(system, state, eq, weight, v);
}

void straighten_bristles(const System& system, int contact, State& state) {
  const ContactPair& pair = system.contacts[at(contact)];
  if (has_bristles(pair)) state.y.segment(system.x_begin() + system.contact_x[at(contact)], bristle_states(*pair.friction)).setZero();
}

void exchange_bristles(const System& system, int contact, int other, State& state) {
  const ContactPair& pair = system.contacts[at(contact)];
  if (!has_bristles(pair)) return;
  double* x = state.y.data() + system.x_begin();
  std::swap_ranges(x + system.contact_x[at(contact)], x + system.contact_x[at(contact)] + bristle_states(*pair.friction),
                   x + system.contact_x[at(other)]);
}

}  // namespace pintle
