#include "framework/component/fe/touching.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "contact/complementarity.h"
#include "framework/common/stop_point.h"
#include "framework/component/eigen/factor.h"
#include "framework/component/fe/assembly.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double hardly_held = 1e-4;  // relative size of a motion that contacts or supports restrain

/// Rigid motions, n × r, of similar size, that do not move the fixed dofs.
MatrixXd motions_left(const FeModel& model, const Supports& supports) {
  MatrixXd all = scaled_rigid_motions(model);
  if (supports.dofs.empty()) return all;
  const MatrixXd held = all(supports.dofs, Eigen::all);
  const Eigen::JacobiSVD<MatrixXd> svd(held, Eigen::ComputeFullV);
  const VectorXd& size = svd.singularValues();
  const Index held_motions = (size.array() > 1e-7 * size[0]).count();
  if (held_motions == 3) return MatrixXd(all.rows(), 0);
  MatrixXd left = all * svd.matrixV().rightCols(3 - held_motions);
  for (const int f : supports.dofs) left.row(f).setZero();
  return left;
}

}  // namespace

/// Response of a body to loads in equilibrium, u = G f + Z q, with one additional fixed dof for each remaining motion.
class TouchingBodies::Held {
 public:
  explicit Held(const TouchingBody& b) : model(*b.model), K(independent(*b.model, *b.K)), Z(motions_left(*b.model, b.supports)) {
    Supports all = b.supports;
    if (Z.cols() > 0) {
      const Eigen::ColPivHouseholderQR<MatrixXd> qr(Z.transpose());
      for (Index i = 0; i < Z.cols(); ++i) all.dofs.push_back(qr.colsPermutation().indices()[i]);
    }
    free_ = free_dofs(model, all);
    supported_ = b.supports.dofs;
    if (!factor_.compute(restricted(K, free_)))
      throw std::runtime_error("the stiffness of a body is not positive; check its material, mesh and supports");
  }

  MatrixXd solve(const MatrixXd& f) const {
    MatrixXd u = MatrixXd::Zero(f.rows(), f.cols());
    u(free_, Eigen::all) = factor_.solve(f(free_, Eigen::all));
    return u;
  }

  /// Displacements under forces in equilibrium, refined once, plus the motion q.
  StaticSolution answer(const VectorXd& load, const VectorXd& q) const {
    VectorXd u = solve(load);
    u += solve(load - K * u) + Z * q;
    const VectorXd Ku = K * u;
    StaticSolution s;
    s.reactions = VectorXd::Zero(u.size());
    for (const int f : supported_) s.reactions[f] = Ku[f] - load[f];
    const double size = (load + s.reactions).norm();
    s.residual = size > 0 ? (Ku - load - s.reactions).norm() / size : 0;
    s.strain_energy = u.dot(Ku) / 2;
    s.u = nodal(model, u);
    s.independent = std::move(u);
    return s;
  }

  const FeModel& model;
  Sparse K;    ///< independent dofs
  MatrixXd Z;  ///< remaining motions, n × r

 private:
  std::vector<int> free_, supported_;
  Factor factor_;
};

TouchingBodies::~TouchingBodies() = default;

TouchingBodies::TouchingBodies(const std::vector<TouchingBody>& bodies, std::vector<TouchingPair> pairs) : pairs_(std::move(pairs)) {
  Index rows = 0, motions = 0;
  for (const TouchingPair& p : pairs_) rows += p.rows.gap.size();
  gap_.resize(rows);
  for (const TouchingBody& b : bodies) motions += bodies_.emplace_back(std::make_unique<Held>(b))->Z.cols();
  std::vector<std::vector<Eigen::Triplet<double>>> entries(bodies.size());
  Index at = 0;
  for (const TouchingPair& p : pairs_) {
    gap_.segment(at, p.rows.gap.size()) = p.rows.gap;
    for (const auto& [body, part] : {std::pair(p.first, &p.rows.first), std::pair(p.second, &p.rows.second)})
      for (int c = 0; c < part->outerSize(); ++c)
        for (Sparse::InnerIterator e(*part, c); e; ++e)
          entries[static_cast<std::size_t>(body)].emplace_back(static_cast<int>(at + e.row()), c, e.value());
    at += p.rows.gap.size();
  }

  constexpr Index panel = 64;
  give_ = MatrixXd::Zero(rows, rows);
  motion_.resize(rows, motions);
  Index motion = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Sparse C(rows, bodies_[b]->model.N());
    C.setFromTriplets(entries[b].begin(), entries[b].end());
    if (bodies_[b]->model.L.size() > 0) C = Sparse(C * bodies_[b]->model.L);
    const Sparse Ct = C.transpose();
    for (Index c = 0; c < rows; c += panel) {
      const Index n = std::min(panel, rows - c);
      give_.middleCols(c, n) += C * bodies_[b]->solve(MatrixXd(Ct.middleCols(c, n)));
    }
    motion_.middleCols(motion, bodies_[b]->Z.cols()) = C * bodies_[b]->Z;
    motion += bodies_[b]->Z.cols();
    rows_.push_back(std::move(C));
  }
  give_ = ((give_ + give_.transpose()) / 2).eval();
  if (motions == 0) return;
  const VectorXd held = Eigen::JacobiSVD<MatrixXd>(motion_).singularValues();
  if (!(held[motions - 1] > hardly_held * held[0]))
    throw std::runtime_error(
        "a body can slide along its contacts, so a load would move it without limit; add a support against this motion");
}

namespace {

/// 0 ≤ λ ⊥ A λ + B q + b ≥ 0, Bᵀλ + h = 0.
struct Balance {
  const MatrixXd &A, &B;
  VectorXd b, h;
  VectorXd lambda = {}, q = {}, gap = {};

  /// By Lemke's method, with q as the difference of two nonnegative vectors. Everything is scaled by A and b.
  bool start(double stiff, double long_one) {
    const Index m = b.size(), r = h.size();
    MatrixXd M = MatrixXd::Zero(m + 2 * r, m + 2 * r);
    M.topLeftCorner(m, m) = A * stiff;
    M.block(0, m, m, r) = B, M.block(0, m + r, m, r) = -B;
    M.block(m, 0, r, m) = -B.transpose(), M.block(m + r, 0, r, m) = B.transpose();
    VectorXd c(m + 2 * r);
    c << b / long_one, -h / (stiff * long_one), h / (stiff * long_one);
    const auto z = solve_complementarity(M, c);
    if (z) lambda = z->head(m) * stiff * long_one;
    return z.has_value();
  }

  /// Solves the linear system of the rows in contact.
  void solve(const std::vector<Index>& touch, double stiff) {
    const auto k = static_cast<Index>(touch.size());
    const Index r = h.size();
    MatrixXd S = MatrixXd::Zero(k + r, k + r);
    S.topLeftCorner(k, k) = A(touch, touch) * stiff;
    S.topRightCorner(k, r) = B(touch, Eigen::all);
    S.bottomLeftCorner(r, k) = S.topRightCorner(k, r).transpose();
    VectorXd c(k + r);
    c << -b(touch), -h / stiff;
    const VectorXd x = S.partialPivLu().solve(c);
    lambda = VectorXd::Zero(b.size());
    lambda(touch) = x.head(k) * stiff;
    q = x.tail(r);
    gap = A * lambda + B * q + b;
    gap(touch).setZero();
  }
};

}  // namespace

TouchingSolution TouchingBodies::solve(const std::vector<VectorXd>& loads) const {
  Balance s{give_, motion_, gap_, VectorXd(motion_.cols())};
  Index motion = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Held& body = *bodies_[b];
    s.b += rows_[b] * body.solve(loads[b]);
    s.h.segment(motion, body.Z.cols()) = body.Z.transpose() * loads[b];
    motion += body.Z.cols();
  }
  const double stiff = static_cast<double>(give_.rows()) / give_.diagonal().sum();
  const double long_one = s.b.cwiseAbs().maxCoeff() + (s.h.size() > 0 ? s.h.cwiseAbs().maxCoeff() / stiff : 0);
  const auto carried_away = [] {
    throw std::runtime_error("the loads pull a body away from all its contacts and supports; add a support, or reverse the load");
  };
  TouchingSolution out;
  s.lambda = s.gap = VectorXd::Zero(s.b.size());
  s.q = VectorXd::Zero(s.h.size());
  if (long_one > 0) {
    if (!s.start(stiff, long_one)) carried_away();
    std::vector<Index> touch, next;
    for (Index i = 0; i < s.b.size(); ++i)
      if (s.lambda[i] > 0) next.push_back(i);
    for (; next != touch && out.iterations < 50; ++out.iterations) {
      stop_point();
      touch = next;
      if (touch.size() < static_cast<std::size_t>(s.h.size())) carried_away();
      s.solve(touch, stiff);
      const double least = -1e-12 * s.lambda.cwiseAbs().maxCoeff(), nearest = -1e-12 * long_one;
      next.clear();
      for (Index i = 0; i < s.b.size(); ++i)
        if (s.lambda[i] != 0 ? s.lambda[i] > least : s.gap[i] < nearest) next.push_back(i);
    }
    if (next != touch)
      throw std::runtime_error(
          "the contact could not be solved: the iteration alternates between sets of touching parts; refine the mesh there");
  }

  motion = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Held& body = *bodies_[b];
    out.bodies.push_back(body.answer(loads[b] + rows_[b].transpose() * s.lambda, s.q.segment(motion, body.Z.cols())));
    motion += body.Z.cols();
  }
  Index at = 0;
  for (const TouchingPair& p : pairs_) {
    out.force.push_back(s.lambda.segment(at, p.rows.gap.size()));
    out.gap.push_back(s.gap.segment(at, p.rows.gap.size()));
    at += p.rows.gap.size();
  }
  return out;
}

}  // namespace pintle
