#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "framework/component/eigen/eigen_lowest.h"
#include "framework/component/eigen/factor.h"
#include "framework/component/fe/assembly.h"
#include "framework/component/reduction/reduction.h"
#include "meshes/reject.h"

namespace pintle {
namespace {

/// Kφ = λMφ with `rigid` leading rigid motions, which are not counted.
struct Problem {
  const Sparse &K, &M;
  int rigid;
  std::string whose;
};

void check(const Keep& keep) {
  const int wishes = keep.count.has_value() + keep.below.has_value() + keep.effective_mass.has_value() + keep.all;
  if (wishes != 1) reject("keep: ", wishes, " rules are set; set exactly one of count, below, effective mass, all");
  if (keep.count && *keep.count < 0) reject("keep: count = ", *keep.count, ", must be at least 0");
  if (keep.below && !(*keep.below > 0)) reject("keep: below = ", *keep.below, " Hz, must be positive");
  if (const auto share = keep.effective_mass; share && !(*share > 0 && *share < 1))
    reject("keep: effective mass = ", *share, ", must lie between 0 and 1");
}

std::vector<int> dofs_with_mass(const Sparse& M) {
  const Eigen::VectorXd diagonal = M.diagonal();
  std::vector<int> found;
  for (int i = 0; i < diagonal.size(); ++i)
    if (diagonal[i] > 0) found.push_back(i);
  return found;
}

int available(const Problem& p) { return std::max(0, static_cast<int>(dofs_with_mass(p.M).size()) - p.rigid); }

Modes elastic(const EigenPairs& pairs, const Problem& p) {
  if (!pairs.converged) throw std::runtime_error("modes of " + p.whose + ": " + pairs.reason);
  if (pairs.zero > p.rigid) {
    std::ostringstream text;
    text << "modes of " << p.whose << ": " << pairs.zero << " motions cause no strain, expected " << p.rigid
         << "; its parts are not joined, or one is more than ten thousand times as long as thick";
    throw std::runtime_error(text.str());
  }
  const Eigen::Index k = std::max<Eigen::Index>(0, pairs.lambda.size() - p.rigid);
  Modes modes{pairs.shapes.rightCols(k), pairs.lambda.tail(k), {}};
  if (pairs.checked) modes.sturm = static_cast<int>(k) + pairs.missed;
  return modes;
}

Modes lowest(const Problem& p, int count) {
  if (count == 0) return {Eigen::MatrixXd(p.K.rows(), 0), Eigen::VectorXd(0), {}};
  return elastic(eigen_lowest(p.K, p.M, {.count = count + p.rigid}), p);
}

Modes below(const Problem& p, double frequency) {
  const double omega = 2 * M_PI * frequency;
  const auto pairs = [&]() -> EigenPairs {
    try {
      return eigen_below(p.K, p.M, omega * omega);
    } catch (const std::runtime_error& e) {
      reject("keep: below = ", frequency, " Hz is too close to a mode of ", p.whose, " (", e.what(),
             "); use another frequency, or a count");
    }
  };
  return elastic(pairs(), p);
}

/// The columns of `carried` are Mr/‖r‖_M for the rigid motions r: the shares are the squares of their products with modes. The sum over all
/// modes is diag(carriedᵀ M⁻¹ carried).
void reject_unreachable(const Problem& p, double share, const Eigen::MatrixX3d& carried) {
  const std::vector<int> massive = dofs_with_mass(p.M);
  Eigen::Vector3d reach = Eigen::Vector3d::Zero();
  if (!massive.empty()) {
    const Eigen::MatrixXd part = carried(massive, Eigen::all);
    Factor mass;
    if (!mass.compute(restricted(p.M, massive)))
      throw std::runtime_error("effective mass of " + p.whose + ": the mass matrix is not positive definite");
    reach = part.cwiseProduct(mass.solve(part)).colwise().sum();
  }
  if (reach.minCoeff() <= share)
    reject("keep: effective mass = ", share, " cannot be reached: all modes of ", p.whose, " together have the shares ", reach.transpose(),
           " in x, y and rotation; the rest moves with the held points; reduce it, or refine the mesh there");
}

Modes by_effective_mass(const Problem& p, double share, const Eigen::MatrixX3d& carried) {
  reject_unreachable(p, share, carried);
  const int most = std::min(available(p), most_for_all);
  for (int count = 8;; count *= 2) {
    Modes modes = lowest(p, std::min(count, most));
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (Eigen::Index k = 0; k < modes.lambda.size(); ++k) {
      sum += (carried.transpose() * modes.shapes.col(k)).array().square();
      if (sum.minCoeff() <= share) continue;
      if (modes.sturm) *modes.sturm -= static_cast<int>(modes.lambda.size() - (k + 1));
      return {modes.shapes.leftCols(k + 1), modes.lambda.head(k + 1), modes.sturm};
    }
    if (count >= most)
      reject("keep: effective mass = ", share, ": the first ", most, " modes of ", p.whose, " have the shares ", sum.transpose(),
             " in x, y and rotation; reduce it");
  }
}

Modes kept(const Problem& p, const Keep& keep, const Eigen::MatrixX3d& carried) {
  check(keep);
  if (keep.below) return available(p) > 0 ? below(p, *keep.below) : lowest(p, 0);
  if (keep.effective_mass) return by_effective_mass(p, *keep.effective_mass, carried);
  const int there = available(p);
  const int wanted = keep.all ? there : *keep.count;
  if (wanted > there) reject(wanted, " modes asked for, ", p.whose, " has ", there, "; ask for at most this number, or refine the mesh");
  if (keep.all && there > most_for_all)
    reject("keep: all ", there, " modes of ", p.whose, " are too many: at most ", most_for_all,
           " are allowed, because the shapes are a dense matrix; use count, below or effective mass");
  return lowest(p, wanted);
}

/// Mr/‖r‖_M for the translations and the rotation about the mass centre.
Eigen::MatrixX3d carried_mass(const Component& c) {
  Eigen::MatrixX3d Mr = reference_condition_rows(c, {ReferenceConditions::mean_axes}).transpose();
  const Eigen::Matrix3d inertia = rigid_motions(c.model).transpose() * Mr;
  for (int k = 0; k < 3; ++k) Mr.col(k) /= std::sqrt(inertia(k, k));
  return Mr;
}

/// VᵀAV, where V has at most one entry per row: one pass over A.
Sparse restricted(const Sparse& A, const Sparse& V) {
  std::vector<int> to(static_cast<std::size_t>(A.cols()), -1);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(A.cols());
  for (int q = 0; q < V.cols(); ++q)
    for (Sparse::InnerIterator v(V, q); v; ++v) {
      to[static_cast<std::size_t>(v.row())] = q;
      weight[v.row()] = v.value();
    }
  Sparse B(V.cols(), V.cols());
  B.reserve(A.nonZeros());
  std::vector<std::pair<int, double>> column;
  for (int q = 0; q < V.cols(); ++q) {
    column.clear();
    for (Sparse::InnerIterator v(V, q); v; ++v)
      for (Sparse::InnerIterator a(A, v.row()); a; ++a)
        if (const int row = to[static_cast<std::size_t>(a.row())]; row >= 0)
          column.emplace_back(row, v.value() * weight[a.row()] * a.value());
    const auto by_row = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (!std::is_sorted(column.begin(), column.end(), by_row)) std::stable_sort(column.begin(), column.end(), by_row);
    B.startVec(q);
    double* last = nullptr;
    for (std::size_t k = 0; k < column.size(); ++k) {
      if (k == 0 || column[k].first != column[k - 1].first) last = &(B.insertBack(column[k].first, q) = 0);
      *last += column[k].second;
    }
  }
  B.finalize();
  return B;
}

}  // namespace

Modes held_modes(const Component& c, const Sparse& V, const Keep& keep, const std::string& whose) {
  const Sparse K = restricted(c.K, V), M = restricted(c.M, V);
  Eigen::MatrixX3d carried;
  if (keep.effective_mass) carried = V.transpose() * carried_mass(c);
  Modes modes = kept({K, M, 0, whose}, keep, carried);
  modes.shapes = V * modes.shapes;
  return modes;
}

Modes elastic_modes(const Component& c, const Keep& keep) {
  if (keep.effective_mass)
    reject("keep: effective mass = ", *keep.effective_mass,
           ": modes of a free body carry no momentum, so none has effective mass; use count or below");
  return kept({c.K, c.M, 3, "the body"}, keep, {});
}

}  // namespace pintle
