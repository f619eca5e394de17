#include "framework/dynamics/equations/equations.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/common/worse.h"
#include "framework/dynamics/equations/bifurcation.h"
#include "framework/dynamics/equations/inverse_mass.h"
#include "framework/dynamics/equations/laws.h"
#include "framework/dynamics/equations/sticking.h"

namespace pintle {

using Eigen::Vector2d;
using Eigen::VectorXd;
using Index = Eigen::Index;
using Modal = Eigen::Map<const VectorXd>;

namespace {

// v −= M⁻¹ Cqᵀ x
void subtract_reaction(const System& system, Equations& eq, const VectorXd& x, double* v) {
  eq.g.setZero();
  add_reaction(eq, x, eq.g);
  multiply_inverse_mass(system, eq, eq.g, eq.g);
  Eigen::Map<VectorXd>(v, eq.g.size()) -= eq.g;
}

// out += Cq v
void add_product(const Equations& eq, const double* v, VectorXd& out) {
  for (const Equations::EndRow& r : eq.end_rows) {
    const double *B = eq.B.front().data() + r.at, *x = v + r.q;
    out.data()[r.row] += B[0] * x[0] + B[1] * x[1] + B[2] * x[2];
  }
  if (eq.flexible.empty()) return;
  for (const Equations::End& end : eq.ends) {
    if (!end.bends) continue;
    double* o = out.data() + end.row;
    const FlexibleInertia& body = eq.flexible[at(end.flexible)];
    const Eigen::Map<const VectorXd> eta(v + body.begin, body.n);
    for (int r = 0; r < end.m; ++r) o[r] += eq.B_eta[end.at].row(r).dot(eta);
  }
}

// λ and a from a = M⁻¹ f. If a body has little inertia or a long arm, Cq a − γ stays above rounding; a second solution for this residual
// removes it.
void solve_reactions(const System& system, Equations& eq) {
  constexpr double rounding = 1e-13;
  const int refinements = eq.uneven || eq.schur.weak() ? 2 : 0;
  eq.lambda.setZero();
  if (eq.lambda.size() == 0) return;
  double size = 0;
  for (int i = 0; i <= refinements; ++i) {
    eq.mu = -eq.gamma;
    add_product(eq, eq.a.data(), eq.mu);
    if (refinements > 0) {
      const double residual = largest(eq.mu);
      if (i == 0) size = residual;
      if (i > 0 && residual <= rounding * size) break;
    }
    eq.schur.solve(eq.mu);
    eq.lambda += eq.mu;
    subtract_reaction(system, eq, eq.mu, eq.a.data());
  }
}

// Whether dependent rows are consistent: with the computed λ, Cq a − γ vanishes.
bool agree(const System& system, Equations& eq) {
  constexpr double little = 1e-2;    // relative to γ and a: near singular configurations a speed error of 1e-6 has this much effect
  constexpr double rounding = 1e-8;  // relative to the accelerations that the joints remove
  multiply_inverse_mass(system, eq, eq.f, eq.g);
  const double free = rounding * largest(eq.g);
  eq.mu = -eq.gamma;
  const double size = largest(eq.mu);
  add_product(eq, eq.a.data(), eq.mu);
  return largest(eq.mu) <= little * std::max({size, largest(eq.a), free});
}

// Clears the rows of released joints. The offset that an engaged joint adopted is subtracted from its violation.
void switch_rows(const System& system, const VectorXd& y, Equations& eq) {
  eq.released.clear();
  const double* held = y.data() + system.switch_begin();
  for (const Switch& s : system.switches) {
    const double released = *held++, offset = *held++;
    if (s.of != Switch::joint) continue;
    const std::size_t joint = at(s.index);
    if (!(released > 0.5)) {
      if (offset != 0) eq.rows[joint].C[latched_row(system.joints[joint])] -= offset;
      continue;
    }
    eq.rows[joint].C.setZero();
    for (int end = system.end_begin[joint]; end < system.end_begin[joint + 1]; ++end) eq.L[at(end)].setZero();
    for (int row = system.row_begin[joint]; row < system.row_begin[joint + 1]; ++row) eq.released.push_back(row);
  }
}

}  // namespace

void multiply_inverse_mass(const System& system, Equations& eq, const VectorXd& f, VectorXd& v) {
  const Index n = system.n_rigid();
  if (eq.flexible.empty()) {
    v = eq.W.cwiseProduct(f);
    return;
  }
  v = f;
  for (Index b = 0; b < n / 3; ++b)
    if (eq.flexible_of[static_cast<std::size_t>(b)] < 0) v.segment<3>(3 * b).array() *= eq.W.segment<3>(3 * b).array();
  for (FlexibleInertia& body : eq.flexible) solve(body, v.data());
}

void pose(const System& system, double t, const VectorXd& y, Equations& eq) {
  for (Index b = 0; b < eq.cos_.size(); ++b) {
    const double angle = y[3 * b + 2];
    eq.cos_[b] = std::cos(angle);
    eq.sin_[b] = std::sin(angle);
  }
  for (std::size_t i = 0; i < eq.points.size(); ++i) {
    const Equations::Point& point = eq.points[i];
    if (point.body == ground) continue;
    MarkerMotion& m = eq.motion[i];
    const double c = eq.cos_[point.body], s = eq.sin_[point.body];
    const double* q = y.data() + 3 * point.body;
    if (m.flex.cols() > 0) {
      pose_on_flexible(system, system.markers[i], y, c, s, m);
    } else {
      m.d = {c * point.x - s * point.y, s * point.x + c * point.y};
      m.r = {q[0] + m.d.x(), q[1] + m.d.y()};
      m.angle = q[2] + point.angle;
    }
    if (!eq.directed[i]) continue;
    if (m.angle == q[2])
      m.u = {c, s};
    else
      m.u = {std::cos(m.angle), std::sin(m.angle)};
  }
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    evaluate_pose(system.joints[k], eq.motion.data(), t, eq.rows[k], eq.L.data() + system.end_begin[k]);
  if (!system.switches.empty()) switch_rows(system, y, eq);
  for (Index row = 0; row < eq.C.size(); ++row) {
    const auto [joint, i] = eq.joint_rows[static_cast<std::size_t>(row)];
    eq.C[row] = eq.rows[at(joint)].C[i];
  }
  for (const Equations::EndRow& r : eq.end_rows) {  // B = L J
    const double* L = eq.L.front().data() + r.at;
    const Vector2d& d = eq.motion[at(r.marker)].d;
    double* B = eq.B.front().data() + r.at;
    B[0] = L[0];
    B[1] = L[1];
    B[2] = L[2] - L[0] * d.y() + L[1] * d.x();
  }
  if (eq.flexible.empty()) return;
  for (const Equations::End& end : eq.ends) {
    if (!end.bends) continue;
    const ConstraintRows::Block& L = eq.L[end.at];
    RowBlock& B_eta = eq.B_eta[end.at];
    const Eigen::Matrix2Xd& flex = eq.motion[at(end.marker)].flex;
    for (int i = 0; i < end.m; ++i)
      B_eta.row(i) = L(i, 0) * flex.row(0) + L(i, 1) * flex.row(1) + L(i, 2) * system.markers[at(end.marker)].slope;
  }
}

namespace {

void move_markers(const System& system, double t, const VectorXd& y, Equations& eq) {
  const double* s = y.data() + system.n();
  for (std::size_t i = 0; i < eq.points.size(); ++i) {
    const int body = eq.points[i].body;
    if (body == ground) continue;
    MarkerMotion& m = eq.motion[i];
    m.w = s[3 * body + 2];
    m.v = {s[3 * body] - m.w * m.d.y(), s[3 * body + 1] + m.w * m.d.x()};
    m.a0 = -m.w * m.w * m.d;
    if (m.flex.cols() > 0) move_on_flexible(system, system.markers[i], y, eq.cos_[body], eq.sin_[body], m);
  }
  for (std::size_t k = 0; k < system.joints.size(); ++k) evaluate_speed(system.joints[k], eq.motion.data(), t, eq.rows[k]);
  for (const int row : eq.released) {
    const auto [joint, i] = eq.joint_rows[at(row)];
    eq.rows[at(joint)].Ct[i] = eq.rows[at(joint)].kappa[i] = 0;
  }
}

}  // namespace

void speed(const System& system, double t, const VectorXd& y, Equations& eq) {
  move_markers(system, t, y, eq);
  for (Index row = 0; row < eq.Cdot.size(); ++row) {
    const auto [joint, i] = eq.joint_rows[static_cast<std::size_t>(row)];
    eq.Cdot[row] = eq.rows[at(joint)].Ct[i];
  }
  add_product(eq, y.data() + system.n(), eq.Cdot);
}

void update_mass(const System& system, const VectorXd& y, Equations& eq) {
  for (FlexibleInertia& body : eq.flexible) evaluate_inertia(system, y, eq.cos_[body.body], eq.sin_[body.body], body);
}

void add_mass_times(const System& system, const Equations& eq, const VectorXd& v, VectorXd& out) {
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const auto i = static_cast<Index>(3 * b);
    if (eq.flexible_of[b] >= 0) {
      add_mass_times(eq.flexible[at(eq.flexible_of[b])], v.data(), out.data());
      continue;
    }
    out[i] += system.bodies[b].m * v[i];
    out[i + 1] += system.bodies[b].m * v[i + 1];
    out[i + 2] += system.bodies[b].J * v[i + 2];
  }
}

void add_reaction(const Equations& eq, const VectorXd& x, VectorXd& out) {
  for (const Equations::EndRow& r : eq.end_rows) {
    const double *B = eq.B.front().data() + r.at, x_r = x.data()[r.row];
    double* o = out.data() + r.q;
    o[0] += B[0] * x_r;
    o[1] += B[1] * x_r;
    o[2] += B[2] * x_r;
  }
  if (eq.flexible.empty()) return;
  for (const Equations::End& end : eq.ends) {
    if (!end.bends) continue;
    const FlexibleInertia& body = eq.flexible[at(end.flexible)];
    for (int r = 0; r < end.m; ++r) out.segment(body.begin, body.n) += x[end.row + r] * eq.B_eta[end.at].row(r).transpose();
  }
}

void factor(const System& system, const VectorXd& y, Equations& eq) {
  ++eq.factorizations;
  update_mass(system, y, eq);
  eq.regular = true;
  for (FlexibleInertia& body : eq.flexible) eq.regular = eq.regular && invert(body);
  if (!eq.regular) return;
  // If C = 0 is not met exactly, redundant rows seem independent: their pivots grow as the square of the violation.
  constexpr double times = 100;
  const double off = eq.permanent > 0 ? std::min(position_violation(system, eq), 1e-4) : 0,
               least = std::max(dependent_rows::lost, times * off * off);
  if (eq.flexible.empty()) {
    eq.regular = eq.schur.factor(eq.B, eq.B_eta_hat, least, eq.released);
    return;
  }
  for (const Equations::End& end : eq.ends) {  // Cq M⁻¹ Cqᵀ = B̂ B̂ᵀ + B̂_η B̂_ηᵀ
    if (end.flexible < 0) {
      eq.B_hat[end.at] = eq.B[end.at];
    } else if (!end.bends) {
      eq.B_hat[end.at].noalias() = eq.B[end.at] * eq.flexible[at(end.flexible)].frame.root;
    } else {
      Eigen::Matrix3d B_hat;
      to_metric(eq.flexible[at(end.flexible)], eq.B[end.at], eq.B_eta[end.at], B_hat, eq.B_eta_hat[end.at]);
      eq.B_hat[end.at] = B_hat;
    }
  }
  eq.regular = eq.schur.factor(eq.B_hat, eq.B_eta_hat, least, eq.released);
}

Wrench reaction(const System& system, const Equations& eq, std::size_t joint, std::size_t end) {
  const int row = system.row_begin[joint], m = system.row_begin[joint + 1] - row;
  return -eq.L[at(system.end_begin[joint]) + end].topRows(m).transpose() * eq.lambda.segment(row, m);
}

void acceleration_side(const Equations& eq, VectorXd& gamma) {
  for (Index row = 0; row < gamma.size(); ++row) {
    const auto [joint, i] = eq.joint_rows[static_cast<std::size_t>(row)];
    gamma[row] = -eq.rows[at(joint)].kappa[i];
  }
  for (const Equations::EndRow& r : eq.end_rows) {
    const double* L = eq.L.front().data() + r.at;
    const MarkerMotion& m = eq.motion[at(r.marker)];
    gamma.data()[r.row] -= L[0] * m.a0.x() + L[1] * m.a0.y() + L[2] * m.alpha0;
  }
}

void accelerate(const System& system, const State& state, Equations& eq) {
  apply_forces(system, state, eq);

  // S λ = Cq M⁻¹ f − γ,  a = M⁻¹ (f − Cqᵀ λ)
  multiply_inverse_mass(system, eq, eq.f, eq.a);
  acceleration_side(eq, eq.gamma);
  solve_reactions(system, eq);
  ++eq.evaluations;
  if (eq.schur.lost() > 0) eq.regular = agree(system, eq) && follow_bifurcation_branch(system, state, eq);
  if (!state.friction.empty() && eq.regular) eq.regular = hold_sticking(system, state, eq);
}

bool evaluate(const System& system, const State& state, Equations& eq, VectorXd& dy) {
  pose(system, state.t, state.y, eq);
  factor(system, state.y, eq);
  if (!eq.regular) return false;
  move_markers(system, state.t, state.y, eq);  // Ċ is left: only projections need it
  accelerate(system, state, eq);
  fill_derivative(system, state.y, eq, dy);
  return eq.regular;
}

bool project(const System& system, double t, VectorXd& y, Equations& eq) {
  const auto factored = [&] {
    factor(system, y, eq);
    return eq.regular;
  };
  const auto subtract = [&](const VectorXd& violation, double* x) {
    eq.mu = violation;
    eq.schur.solve(eq.mu);
    subtract_reaction(system, eq, eq.mu, x);
    return largest(eq.g.cwiseQuotient(system.scale));
  };
  return onto_constraints(system, t, y, eq, factored, subtract);
}

void respond(const System& system, Equations& eq, VectorXd& a, VectorXd& lambda) {
  multiply_inverse_mass(system, eq, a, a);
  lambda.setZero(system.n_rows());
  if (system.n_rows() == 0) return;
  add_product(eq, a.data(), lambda);
  eq.schur.solve(lambda);
  subtract_reaction(system, eq, lambda, a.data());
}

void keep_allowed(const System& system, Equations& eq, double* v) {
  eq.mu.setZero();
  add_product(eq, v, eq.mu);
  eq.schur.solve(eq.mu);
  subtract_reaction(system, eq, eq.mu, v);
}

}  // namespace pintle
