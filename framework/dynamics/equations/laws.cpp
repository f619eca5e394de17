#include "framework/dynamics/equations/laws.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "framework/common/dense.h"
#include "framework/dynamics/model/contact_pair.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MovingPoint point_a(const MotionSignal& signal, const Equations& eq) { return moving_point(eq.motion[at(signal.a)]); }
MovingPoint point_b(const MotionSignal& signal, const Equations& eq) {
  return moving_point(eq.motion[at(of_two(signal.kind) ? signal.b : signal.a)]);
}

double sized_by(const SignalLaw& law, const Equations& eq, double t, const double* in, double* slope) {
  const bool held = law.sided && !eq.law_sides.empty();
  return held ? law.sided->value(t, in, slope, eq.law_sides.data() + law.first_side) : law.of(t, in, slope);
}

// g_x: the columns of own states among the laws' slopes.
void own_slopes(const System& system, const MatrixXd& slopes, MatrixXd& g_x) {
  g_x.setZero();
  for (std::size_t k = 0; k < system.signals.size(); ++k) {
    if (system.signals[k].kind != MotionSignal::state) continue;
    for (std::size_t i = 0; i < system.states.size(); ++i)
      g_x(static_cast<Index>(i), system.signals[k].a) += slopes(system.states[i].rate, static_cast<Index>(k));
  }
}

}  // namespace

void evaluate_laws(const System& system, double t, const double* x, Equations& eq) {
  for (std::size_t k = 0; k < system.signals.size(); ++k) {
    const MotionSignal& signal = system.signals[k];
    eq.signals[k] = signal.kind == MotionSignal::state ? x[system.own_x + signal.a] - signal.offset
                                                       : signal_value(signal, point_a(signal, eq), point_b(signal, eq));
  }
  std::array<double, most_law_inputs> in;
  for (std::size_t l = 0; l < system.laws.size(); ++l) {
    const SignalLaw& law = system.laws[l];
    for (std::size_t i = 0; i < law.in.size(); ++i) in[i] = eq.signals[at(law.in[i])];
    eq.laws[l] = sized_by(law, eq, t, in.data(), nullptr);
  }
}

void law_slopes(const System& system, const Equations& eq, double t, MatrixXd& slopes) {
  slopes.setZero();
  std::array<double, most_law_inputs> in, slope{};
  for (std::size_t l = 0; l < system.laws.size(); ++l) {
    const SignalLaw& law = system.laws[l];
    for (std::size_t i = 0; i < law.in.size(); ++i) in[i] = eq.signals[at(law.in[i])];
    sized_by(law, eq, t, in.data(), slope.data());
    for (std::size_t i = 0; i < law.in.size(); ++i) slopes(static_cast<Index>(l), law.in[i]) += slope[i];
  }
}

void follow_own_states(const System& system, Equations& eq, double t, double weight, const double* base, double* x) {
  constexpr int most = 20;
  constexpr double rounding = 1e-15;
  const auto n = static_cast<Index>(system.states.size());
  Eigen::Map<VectorXd> own(x + system.own_x, n);
  OwnScratch& with = eq.own;
  for (int i = 0; i < most; ++i) {
    evaluate_laws(system, t, x, eq);
    law_slopes(system, eq, t, with.slopes);
    own_slopes(system, with.slopes, with.A);
    with.A = -with.A;
    with.A.diagonal().array() += 1 / weight;
    for (Index k = 0; k < n; ++k)
      with.left[k] = eq.laws[at(system.states[at(k)].rate)] - (std::isinf(weight) ? 0 : (own[k] - base[system.own_x + k]) / weight);
    with.lu.compute(with.A);
    with.change = with.lu.solve(with.left);
    if (!with.change.allFinite()) return;
    own += with.change;
    if (((with.change.cwiseAbs() - rounding * own.cwiseAbs()).array() <= 0).all()) return;
  }
}

void filter_own_states(const System& system, const State& state, Equations& eq, double weight, double* v) {
  OwnScratch& with = eq.own;
  law_slopes(system, eq, state.t, with.slopes);
  own_slopes(system, with.slopes, with.A);
  with.A *= -weight;
  with.A.diagonal().array() += 1;
  with.lu.compute(with.A);
  Eigen::Map<VectorXd> own(v + system.own_x, static_cast<Index>(system.states.size()));
  with.left = own;
  with.change = with.lu.solve(with.left);
  own = with.change;
}

LawTangent::LawTangent(const System& system)
    : slopes_(MatrixXd::Zero(static_cast<Index>(system.laws.size()), static_cast<Index>(system.signals.size()))),
      row_(VectorXd::Zero(system.laws.empty() ? 0 : system.n())),
      d_(row_),
      jacobian_(system) {
  const auto add = [](std::vector<int>& bodies, int body) {
    if (body != ground && std::ranges::find(bodies, body) == bodies.end()) bodies.push_back(body);
  };
  const auto seen_by = [&](int law, std::vector<int>& bodies) {
    bool states = false;
    for (const int k : system.laws[at(law)].in) {
      const MotionSignal& signal = system.signals[at(k)];
      states = states || signal.kind == MotionSignal::state;
      if (signal.kind == MotionSignal::state) continue;
      add(bodies, system.markers[at(signal.a)].body);
      if (of_two(signal.kind)) add(bodies, system.markers[at(signal.b)].body);
    }
    return states;
  };
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const auto* force = std::get_if<SizedForce>(&system.forces[k]);
    if (!force) continue;
    for (const bool other : {false, true}) {
      const int law = other ? force->other : force->size;
      if (law < 0) continue;
      Sized one{k, other, law, {}, {}, {}};
      if (force->way > SizedForce::follows) add(one.on, system.markers[at(force->a)].body);
      add(one.on, system.markers[at(force->b)].body);
      if (seen_by(law, one.by))
        for (const OwnState& state : system.states) seen_by(state.rate, one.by);
      one.block.assign(one.on.size(), std::vector<int>(one.by.size(), 0));
      if (!one.by.empty()) sized.push_back(std::move(one));
    }
  }
  const auto n = static_cast<Index>(system.states.size());
  g_signals_.setZero(n, slopes_.cols());
  follow_ = g_signals_;
  A_.setZero(n, n);
}

// F_σ ← F_σ + F_x (1/weight − g_x)⁻¹ g_σ; no second term where g at rest does not depend on x.
void LawTangent::condense(const System& system, double weight) {
  if (system.states.empty()) return;
  own_slopes(system, slopes_, A_);
  A_ = -A_;
  A_.diagonal().array() += 1 / weight;
  for (Index i = 0; i < A_.rows(); ++i) g_signals_.row(i) = slopes_.row(system.states[at(i)].rate);
  for (std::size_t k = 0; k < system.signals.size(); ++k)
    if (system.signals[k].kind == MotionSignal::state) g_signals_.col(static_cast<Index>(k)).setZero();
  lu_.compute(A_);
  follow_ = lu_.solve(g_signals_);
  if (!follow_.allFinite()) return;
  for (const Sized& one : sized)
    for (std::size_t k = 0; k < system.signals.size(); ++k)
      if (const MotionSignal& signal = system.signals[k]; signal.kind == MotionSignal::state)
        slopes_.row(one.law) += slopes_(one.law, static_cast<Index>(k)) * follow_.row(signal.a);
}

void LawTangent::see(const System& system, const State& state, const Equations& eq, int law, double w_q, double w_s) {
  row_.setZero();
  for (std::size_t k = 0; k < system.signals.size(); ++k) {
    const MotionSignal& signal = system.signals[k];
    const double by = slopes_(law, static_cast<Index>(k));
    if (by == 0 || signal.kind == MotionSignal::state) continue;
    const SignalSlope slope = signal_slope(signal, point_a(signal, eq), point_b(signal, eq));
    const auto through = [&](int marker, const Eigen::Vector3d& pose, const Eigen::Vector3d& rate) {
      const int body = system.markers[at(marker)].body;
      if (body == ground) return;
      move(system, state, eq, marker, jacobian_);
      const Eigen::Vector3d p = by * (w_q * pose + w_s * rate), r = by * w_q * rate;
      row_.segment<2>(3 * body) += p.head<2>();
      row_[3 * body + 2] += p.dot(jacobian_.J_theta) + r.dot(jacobian_.V_theta);
      for (Index i = 0; i < jacobian_.n; ++i)
        row_[system.eta_begin[at(body)] + i] += jacobian_.J_eta.row(i).dot(p) + jacobian_.V_eta.row(i).dot(r);
    };
    through(signal.a, slope.pose_a, slope.rate_a);
    if (of_two(signal.kind)) through(signal.b, slope.pose_b, slope.rate_b);
  }
}

void LawTangent::point(const System& system, const Equations& eq, const Sized& one) {
  const auto& force = std::get<SizedForce>(system.forces[one.force]);
  const UnitWrenches unit = unit_wrenches(force, one.other, eq.motion[at(force.a)], eq.motion[at(force.b)]);
  d_.setZero();
  add_wrench(system, eq, force.a, unit.on_a, d_);
  add_wrench(system, eq, force.b, unit.on_b, d_);
}

void LawTangent::add(const System& system, const State& state, const Equations& eq, const TangentWeights& w, double* values) {
  if (sized.empty()) return;
  law_slopes(system, eq, state.t, slopes_);
  if (w.x != 0) condense(system, w.x);
  for (const Sized& one : sized) {
    if (is_released(system, Switch::force, static_cast<int>(one.force), state.y)) continue;
    see(system, state, eq, one.law, w.q, w.s);
    point(system, eq, one);
    for (std::size_t i = 0; i < one.on.size(); ++i)
      for (std::size_t j = 0; j < one.by.size(); ++j) {
        double* value = values + one.block[i][j];
        for (int c = 0; c < coordinates_of(system, one.by[j]); ++c)
          for (int r = 0; r < coordinates_of(system, one.on[i]); ++r)
            *value++ -= d_[coordinate(system, one.on[i], r)] * row_[coordinate(system, one.by[j], c)];
      }
  }
}

void LawTangent::couple(const System& system, const State& state, const Equations& eq, MatrixXd& f_x, MatrixXd& g_q, MatrixXd& g_s,
                        MatrixXd& g_x) {
  const auto n = static_cast<Index>(system.states.size());
  if (n == 0) return;
  law_slopes(system, eq, state.t, slopes_);
  own_slopes(system, slopes_, A_);
  g_x.block(system.own_x, system.own_x, n, n) = A_;
  for (Index i = 0; i < n; ++i) {
    const int law = system.states[at(i)].rate;
    see(system, state, eq, law, 1, 0);
    g_q.row(system.own_x + i) = row_.transpose();
    see(system, state, eq, law, 0, 1);
    g_s.row(system.own_x + i) = row_.transpose();
  }
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const auto* force = std::get_if<SizedForce>(&system.forces[k]);
    for (const bool other : {false, true}) {
      const int law = !force ? -1 : other ? force->other : force->size;
      if (law < 0 || is_released(system, Switch::force, static_cast<int>(k), state.y)) continue;
      point(system, eq, {k, other, law, {}, {}, {}});
      for (std::size_t s = 0; s < system.signals.size(); ++s)
        if (const MotionSignal& signal = system.signals[s]; signal.kind == MotionSignal::state)
          f_x.col(system.own_x + signal.a) += slopes_(law, static_cast<Index>(s)) * d_;
    }
  }
}

}  // namespace pintle
