#include "framework/dynamics/equations/sticking.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/common/dense.h"
#include "framework/common/index.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool sticks(const System& system, const State& state, std::size_t c) {
  return !state.friction.empty() && state.friction[c].direction == 0 && state.impact_rate[c] > 0 && dry_friction(system.contacts[c]);
}

double holds_at_most(const System& system, const Equations& eq, std::size_t c) {
  return dry_friction(system.contacts[c])->mu_static * eq.contact[c].normal.force;
}

void list_sticking(const System& system, const State& state, Equations& eq) {
  Sticking& s = eq.sticking;
  s.contact.clear();
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (sticks(system, state, c)) s.contact.push_back(c);
  s.J.resize(system.n(), static_cast<Index>(s.contact.size()));
  VectorXd column(system.n());
  for (Index i = 0; i < s.J.cols(); ++i) {
    const ContactPair& pair = system.contacts[s.contact[static_cast<std::size_t>(i)]];
    const std::array<Wrench, 2> unit = unit_friction(pair, eq.contact[s.contact[static_cast<std::size_t>(i)]].gap);
    column.setZero();
    add_wrench(system, eq, pair.a, unit[0], column);
    add_wrench(system, eq, pair.b, unit[1], column);
    s.J.col(i) = column;
  }
}

namespace {

// @returns W = Jᵀ a, the slip's acceleration by the forces
MatrixXd respond_to_sticking(const System& system, Equations& eq) {
  Sticking& s = eq.sticking;
  s.a.resize(s.J.rows(), s.J.cols());
  s.lambda.resize(system.n_rows(), s.J.cols());
  VectorXd a, lambda;
  for (Index i = 0; i < s.J.cols(); ++i) {
    a = s.J.col(i);
    respond(system, eq, a, lambda);
    s.a.col(i) = a;
    s.lambda.col(i) = lambda;
  }
  return s.J.transpose() * s.a;
}

}  // namespace

VectorXd share_out_friction(const System& system, const Equations& eq, const MatrixXd& W, const VectorXd& rhs) {
  constexpr double least = 1e-9;
  constexpr double dependent = 1e-4;  // of unit slips: where feet differ in height by a hundredth, their give decides, not their lever
  const Index m = rhs.size();
  if (m == 1) return W(0, 0) > 0 ? VectorXd(rhs / W(0, 0)) : VectorXd(VectorXd::Zero(1));
  VectorXd weight(m);
  for (Index i = 0; i < m; ++i) weight[i] = holds_at_most(system, eq, eq.sticking.contact[static_cast<std::size_t>(i)]);
  const double most = weight.maxCoeff();
  weight = most > 0 ? VectorXd(weight.cwiseMax(least * most).cwiseSqrt()) : VectorXd(VectorXd::Ones(m));
  // The rows that count, U, are those of W between unit slips; among their solutions the least.
  const VectorXd unit = W.diagonal().cwiseAbs().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  const Eigen::JacobiSVD<MatrixXd> svd(unit.asDiagonal() * W * unit.asDiagonal(), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Index rank = (svd.singularValues().array() > dependent * svd.singularValues()[0]).count();
  const MatrixXd rows = svd.singularValues().head(rank).asDiagonal() * svd.matrixV().leftCols(rank).transpose() *
                        unit.cwiseInverse().cwiseProduct(weight).asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> least_norm(rank, m);
  least_norm.compute(rows);
  return weight.cwiseProduct(least_norm.solve(svd.matrixU().leftCols(rank).transpose() * unit.cwiseProduct(rhs)));
}

void hold_sticking(const System& system, const State& state, Equations& eq) {
  list_sticking(system, state, eq);
  const Sticking& s = eq.sticking;
  const auto m = static_cast<Index>(s.contact.size());
  if (m == 0) return;
  const MatrixXd W = respond_to_sticking(system, eq);
  VectorXd rhs = -s.J.transpose() * eq.a, before(m);
  for (Index i = 0; i < m; ++i) {
    const std::size_t c = s.contact[static_cast<std::size_t>(i)];
    const ContactPair& pair = system.contacts[c];
    rhs[i] -= slip_acceleration(pair, eq.contact[c], eq.motion[at(pair.a)], eq.motion[at(pair.b)]);
    before[i] = eq.contact[c].friction;
  }
  const VectorXd change = share_out_friction(system, eq, W, rhs + W * before) - before;
  eq.a += s.a * change;
  eq.lambda += s.lambda * change;
  eq.f += s.J * change;
  for (Index i = 0; i < m; ++i) {
    const std::size_t c = s.contact[static_cast<std::size_t>(i)];
    add_friction(system.contacts[c], change[i], eq.contact[c]);
  }
}

void keep_holding_forces(const Equations& eq, State& state) {
  if (state.friction.empty()) return;
  for (const std::size_t c : eq.sticking.contact) state.friction[c].force = eq.contact[c].friction;
}

void remove_slip(const System& system, State& state, Equations& eq) {
  if (state.friction.empty()) return;
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& pair = system.contacts[c];
    if (sticks(system, state, c))
      eq.contact[c] = evaluate(pair, eq.motion[at(pair.a)], eq.motion[at(pair.b)], state.impact_rate[c], state.friction[c]);
  }
  list_sticking(system, state, eq);
  const Sticking& s = eq.sticking;
  if (s.contact.empty()) return;
  const MatrixXd W = respond_to_sticking(system, eq);
  auto speeds = state.y.segment(system.n(), system.n());
  speeds -= s.a * share_out_friction(system, eq, W, s.J.transpose() * speeds);
  speed(system, state.t, state.y, eq);
}

VectorXd slips(const Equations& eq) {
  VectorXd out(static_cast<Index>(eq.sticking.contact.size()));
  for (Index i = 0; i < out.size(); ++i) out[i] = eq.contact[eq.sticking.contact[static_cast<std::size_t>(i)]].gap.material_slip;
  return out;
}

}  // namespace pintle
