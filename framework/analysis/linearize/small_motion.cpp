#include "framework/analysis/linearize/small_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/common/dense.h"
#include "framework/dynamics/equations/tangent.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The columns of A for translations, rotated: A T, with T = R(angle) for each body.
MatrixXd turned(const System& system, const MatrixXd& A, double angle) {
  MatrixXd out = A;
  const double c = std::cos(angle), s = std::sin(angle);
  for (Index i = 0; i < system.n_rigid(); i += 3) {
    out.col(i) = c * A.col(i) + s * A.col(i + 1);
    out.col(i + 1) = c * A.col(i + 1) - s * A.col(i);
  }
  return out;
}
// T X
MatrixXd turned_rows(const System& system, double angle, const MatrixXd& X) { return turned(system, X.transpose(), -angle).transpose(); }
// J X: translations rotated by a quarter turn, zero elsewhere. A J is −(J Aᵀ)ᵀ.
MatrixXd quarter(const System& system, const MatrixXd& X) {
  MatrixXd out = MatrixXd::Zero(X.rows(), X.cols());
  for (Index i = 0; i < system.n_rigid() && X.cols() > 0; i += 3) {
    out.row(i) = -X.row(i + 1);
    out.row(i + 1) = X.row(i);
  }
  return out;
}
MatrixXd times_quarter(const System& system, const MatrixXd& A) { return -quarter(system, A.transpose()).transpose(); }
// E X: translations alone.
MatrixXd translations(const System& system, MatrixXd X) {
  if (X.cols() == 0) return X;
  for (Index i = 2; i < system.n_rigid(); i += 3) X.row(i).setZero();
  X.bottomRows(system.n() - system.n_rigid()).setZero();
  return X;
}

void fill_jacobian(const Equations& eq, MatrixXd& Cq) {
  visit_jacobian(eq, [&](int row, int column, double value) { Cq(row, column) += value; });
}

// The dependent coordinates: as many well-conditioned columns as P has independent rows, which the other coordinates then determine.
// Columns of frames are preferred, so that shapes stay independent where possible.
std::vector<int> dependent_columns(const System& system, MatrixXd P) {
  constexpr double rank_threshold = 1e-9, of_shapes = 1e-3;
  if (P.rows() == 0) return {};
  P.rightCols(system.n() - system.n_rigid()) *= of_shapes;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(P.rows(), P.cols());
  qr.setThreshold(rank_threshold);
  qr.compute(P);
  const auto& order = qr.colsPermutation().indices();
  std::vector<int> out(order.data(), order.data() + qr.rank());
  std::ranges::sort(out);
  return out;
}

std::vector<int> others(Index n, const std::vector<int>& some) {
  std::vector<int> out;
  for (int i = 0; i < n; ++i)
    if (!std::ranges::binary_search(some, i)) out.push_back(i);
  return out;
}

}  // namespace

SmallMotion without_held(SmallMotion s, Index first, std::vector<int>& held) {
  std::vector<int> moving(static_cast<std::size_t>(s.G_x.rows()));
  std::iota(moving.begin(), moving.end(), 0);
  const auto is_held = [&](int i) {
    const bool unchanged = s.G_p.row(i).isZero(0) && s.G_v.row(i).isZero(0) && s.G_x(i, moving).isZero(0);
    return i >= first && (unchanged || (s.F.col(i).isZero(0) && s.G_x(moving, i).isZero(0)));
  };
  for (auto one = std::ranges::find_if(moving, is_held); one != moving.end(); one = std::ranges::find_if(moving, is_held))
    moving.erase(one);  // a state that changes only with this one is then held too
  held = others(s.G_x.rows(), moving);
  if (held.empty()) return s;
  return {s.M,
          s.D,
          s.K,
          MatrixXd(s.F(Eigen::all, moving)),
          MatrixXd(s.G_p(moving, Eigen::all)),
          MatrixXd(s.G_v(moving, Eigen::all)),
          MatrixXd(s.G_x(moving, moving))};
}

MotionAt::MotionAt(const System& system, const State& at) : state(at), eq(system) {
  VectorXd dy(system.n_y());
  if (std::ranges::any_of(system.frictions, [](const JointFriction& f) { return bristle_states(f.law) > 0; }))
    state.friction.resize(dry_states(system));
  regular = evaluate(system, state, eq, dy);
  if (!regular) return;
  Tangent tangent(system);
  std::vector<double> values(tangent.places().size());
  const auto matrix = [&](const Tangent::Weights& w) {
    tangent.evaluate(system, state, eq, eq.a, eq.lambda, w, values);
    return dense(system, tangent, values);
  };
  M = matrix({.a = 1});
  D = matrix({.s = 1});
  K = matrix({.q = 1});
  x = tangent.internal(system, state, eq);
  leave_out_open(system);
}

// Bristles of open contacts have no effect, and would only add roots at 0.
void MotionAt::leave_out_open(const System& system) {
  std::vector<int> kept;
  for (const InternalStates& owner : system.internal) {
    if (owner.owner == InternalStates::contact && !(eq.contact[static_cast<std::size_t>(owner.index)].normal.force > 0)) continue;
    for (const InternalState& s : states_of(system, owner)) {
      const auto named = [&](const std::string& which) { return owner_name(system, owner) + which + s.name + " [" + s.unit + "]"; };
      const bool known = std::ranges::find(x_names, named("")) != x_names.end();  // where several pairs of one contact are closed
      x_names.push_back(
          named(known ? " (pair " + std::to_string(system.contacts[static_cast<std::size_t>(owner.index)].pair + 1) + ")" : ""));
    }
    for (int i = 0; i < owner.n; ++i) kept.push_back(owner.begin + i);
  }
  for (std::size_t i = 0; i < system.states.size(); ++i) {
    x_names.push_back(system.states[i].name + " [" + (system.states[i].unit.empty() ? "1" : system.states[i].unit) + "]");
    kept.push_back(system.own_x + static_cast<int>(i));
  }
  if (static_cast<int>(kept.size()) == system.n_x()) return;
  x = {MatrixXd(x.f_x(Eigen::all, kept)), MatrixXd(x.g_q(kept, Eigen::all)), MatrixXd(x.g_s(kept, Eigen::all)),
       MatrixXd(x.g_x(kept, kept))};
}

double MotionAt::rate(const System& system) const {
  const Index n = system.n();
  if (n == 0) return 0;
  double speed = state.y.segment(n, n).cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>();
  for (const InternalStates& owner : system.internal)
    for (int i = 0; i < owner.n; ++i) {
      const double scale = system.x_scale[owner.begin + i];
      speed = std::max(speed, std::abs(internal_rates(eq, owner)[static_cast<std::size_t>(i)]) / (scale > 0 ? scale : system.length));
    }
  for (const OwnState& own : system.states) speed = std::max(speed, std::abs(eq.laws[static_cast<std::size_t>(own.rate)]) / own.scale);
  return std::max(speed, std::sqrt(eq.a.cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>()));
}

// With P = Cq T made dimensionless: P X = E, with unit offsets E, holds along the motion, so that P X1 = −Ṗ X and P X2 = −P̈ X − 2 Ṗ X1,
// with zeros in the independent rows.
FreeMotion::FreeMotion(const System& system, const MotionAt& at, const Axes& axes, const std::vector<int>& offset_rows,
                       const std::vector<int>* chosen) {
  const Index n = system.n(), rows = system.n_rows();
  const Derivatives jacobian = along(system, at, rows, n, fill_jacobian);
  Cq = jacobian.value, Cq_rate = jacobian.rate, Cq_accel = jacobian.accel;

  const double w = axes.rate;
  const auto scaled = [&](const MatrixXd& A) -> MatrixXd {
    return system.row_scale.asDiagonal() * turned(system, A, axes.phase) * system.scale.asDiagonal();
  };
  const MatrixXd P = scaled(Cq), P1 = scaled(Cq_rate + w * times_quarter(system, Cq)),
                 P2 = scaled(Cq_accel + 2 * w * times_quarter(system, Cq_rate) - w * w * translations(system, Cq.transpose()).transpose());

  dependent = chosen ? others(n, *chosen) : dependent_columns(system, P);
  independent = others(n, dependent);
  const Index free = m(), offsets = static_cast<Index>(offset_rows.size()), bound = static_cast<Index>(dependent.size());
  full_rank = bound == rows;
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  if (bound > 0) qr.compute(P(Eigen::all, dependent));
  const auto solve = [&](const MatrixXd& right) -> MatrixXd {
    if (bound == 0) return MatrixXd::Zero(0, right.cols());
    return qr.solve(right);
  };
  MatrixXd right = MatrixXd::Zero(rows, free + offsets);
  right.leftCols(free) = -P(Eigen::all, independent);
  for (Index k = 0; k < offsets; ++k) {
    const int row = offset_rows[static_cast<std::size_t>(k)];
    right(row, free + k) = system.row_scale[row];
  }
  X.setZero(n, free + offsets);
  for (Index i = 0; i < free; ++i) X(independent[static_cast<std::size_t>(i)], i) = 1;
  X(dependent, Eigen::all) = solve(right);
  for (Index k = 0; k < offsets; ++k) left.push_back((P * X.col(free + k) - right.col(free + k)).norm() / right.col(free + k).norm());
  X1.setZero(n, free + offsets);
  X1(dependent, Eigen::all) = solve(-P1 * X);
  X2.setZero(n, free + offsets);
  X2(dependent, Eigen::all) = solve(-P2 * X - 2 * P1 * X1);

  VectorXd measure = VectorXd::Ones(free + offsets);
  for (Index i = 0; i < free; ++i) measure[i] = 1 / system.scale[independent[static_cast<std::size_t>(i)]];
  for (MatrixXd* each : {&X, &X1, &X2}) *each = system.scale.asDiagonal() * *each * measure.asDiagonal();
  const MatrixXd x2 = X2 + 2 * w * quarter(system, X1) - w * w * translations(system, X);
  X1 += w * quarter(system, X);
  X2 = x2;
  for (MatrixXd* each : {&X, &X1, &X2}) *each = turned_rows(system, axes.phase, *each);
}

SmallMotion FreeMotion::project(const MotionAt& at) const {
  const auto Z = X.leftCols(m()), Z1 = X1.leftCols(m()), Z2 = X2.leftCols(m());
  return {Z.transpose() * at.M * Z,
          Z.transpose() * (2 * at.M * Z1 + at.D * Z),
          Z.transpose() * (at.M * Z2 + at.D * Z1 + at.K * Z),
          Z.transpose() * at.x.f_x,
          at.x.g_q * Z + at.x.g_s * Z1,
          at.x.g_s * Z,
          at.x.g_x};
}

}  // namespace pintle
