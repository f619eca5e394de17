#include "framework/component/fe/statics.h"

#include "framework/common/dense.h"
#include "framework/component/eigen/factor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace pintle {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Rank tolerance for restrained rigid motions, relative to the middle and size of their part. Its square is above rounding; supports closer
// together than this do not restrain rotation.
constexpr double held_rank = 1e-7;
// Smallest eigenvalue of K relative to its diagonal. For a mechanism it is below rounding; for a cantilever of N beams it is 1/N⁴, below
// which a solution has no accurate digit.
constexpr double mechanism = 1e-15;

template <class Error, class... Parts>
[[noreturn]] void fail(const Parts&... parts) {
  std::ostringstream words;
  words.precision(4);
  (words << ... << parts);
  throw Error(words.str());
}

void hold_dofs(Supports& supports, const int (&dof)[3], const bool (&held)[3]) {
  for (int d = 0; d < 3; ++d)
    if (held[d]) supports.dofs.push_back(dof[d]);
}

// Connected parts of the free body: part of each dof of A.
int parts(const Sparse& A, std::vector<int>& part) {
  part.assign(static_cast<std::size_t>(A.cols()), -1);
  std::vector<int> open;
  int count = 0;
  for (int start = 0; start < A.cols(); ++start) {
    if (part[static_cast<std::size_t>(start)] >= 0) continue;
    open.push_back(start);
    part[static_cast<std::size_t>(start)] = count;
    while (!open.empty()) {
      const int j = open.back();
      open.pop_back();
      for (Sparse::InnerIterator a(A, j); a; ++a) {
        int& other = part[static_cast<std::size_t>(a.row())];
        if (other >= 0) continue;
        other = count;
        open.push_back(static_cast<int>(a.row()));
      }
    }
    ++count;
  }
  return count;
}

// Position of each independent dof: that of its node or port.
Eigen::Matrix2Xd places(const FeModel& model) {
  Eigen::Matrix2Xd at(2, model.n());
  for (Eigen::Index i = 0; i < model.x.cols(); ++i)
    for (int f = model.begin[static_cast<std::size_t>(i)]; f < model.begin[static_cast<std::size_t>(i) + 1]; ++f)
      if (const int k = model.independent_of(f); k >= 0) at.col(k) = model.x.col(i);
  for (const Port& port : model.ports)
    for (const int f : port.dof)
      if (f >= 0) at.col(f) = port.x;
  return at;
}

// Describes a motion [x, y, rotation about `middle`] that the supports allow, the rotation in units of `size`.
std::string name_of(const Vector3d& motion, const Vector2d& middle, double size) {
  std::ostringstream words;
  words.precision(4);
  if (std::abs(motion[2]) < 1e-6) {
    if (std::abs(motion[1]) < 1e-6) return "to move along x";
    if (std::abs(motion[0]) < 1e-6) return "to move along y";
    words << "to move along (" << motion[0] << ", " << motion[1] << ")";
    return words.str();
  }
  Vector2d at = middle + size / motion[2] * Vector2d(-motion[1], motion[0]);
  for (double& c : at)
    if (std::abs(c) < 1e-9 * size) c = 0;
  words << "to turn about (" << at.x() << ", " << at.y() << ")";
  return words.str();
}

// The rigid motions of a part that `held` (rows of three, scaled) leaves free, in words; empty: none.
std::string free_motions(const Eigen::MatrixX3d& held, const Vector2d& middle, double size) {
  if (held.rows() == 0) return "to move along x, to move along y and to turn";
  const Eigen::Matrix3d gram = held.transpose() * held;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(gram);
  const Vector3d least = eigen.eigenvalues() / eigen.eigenvalues()[2];
  if (least[0] > held_rank * held_rank) return "";
  if (least[1] > held_rank * held_rank) return name_of(eigen.eigenvectors().col(0), middle, size);
  // Two motions are left: a translation and a rotation, unless the rotation is restrained.
  const Vector3d h = eigen.eigenvectors().col(2);
  if (h.head<2>().norm() < 1e-6) return "to move along x and to move along y";
  const Vector3d slide = Vector3d(-h[1], h[0], 0).normalized();
  return name_of(slide, middle, size) + " and " + name_of(h.cross(slide), middle, size);
}

void validate_supports(const FeModel& model, const Sparse& A, const std::vector<bool>& held) {
  std::vector<int> part;
  const int count = parts(A, part);
  const Eigen::Matrix2Xd at = places(model);
  const Eigen::MatrixX3d motions = rigid_motions(model);
  std::vector<std::vector<int>> members(static_cast<std::size_t>(count));
  for (int i = 0; i < model.n(); ++i) members[static_cast<std::size_t>(part[static_cast<std::size_t>(i)])].push_back(i);
  for (const std::vector<int>& dofs : members) {
    Vector2d low = at.col(dofs[0]), high = low;
    std::vector<int> rows;
    for (const int i : dofs) {
      low = low.cwiseMin(at.col(i));
      high = high.cwiseMax(at.col(i));
      if (held[static_cast<std::size_t>(i)]) rows.push_back(i);
    }
    const Vector2d middle = (low + high) / 2;
    const double size = high == low ? 1 : (high - low).norm() / 2;
    Eigen::MatrixX3d scaled(static_cast<Eigen::Index>(rows.size()), 3);
    for (Eigen::Index r = 0; r < scaled.rows(); ++r) {
      const auto motion = motions.row(rows[static_cast<std::size_t>(r)]);
      const double turn = motion[2] + middle.y() * motion[0] - middle.x() * motion[1];
      const bool rotation = motion[0] == 0 && motion[1] == 0;
      scaled.row(r) << motion[0], motion[1], rotation ? motion[2] : turn / size;
    }
    const std::string motion = free_motions(scaled, middle, size);
    if (motion.empty()) continue;
    if (count == 1) fail<std::runtime_error>("the supports leave the body free ", motion, "; add a support against this motion");
    fail<std::runtime_error>("the body is in ", count, " parts that no element joins; the supports leave the ", "one between (", low.x(),
                             ", ", low.y(), ") and (", high.x(), ", ", high.y(), ") free ", motion, "; join the parts or hold each");
  }
}

// Inverse iteration on K φ = λ diag(K) φ from a fixed start: the motion with the least stiffness.
struct Loosest {
  double lambda;
  Eigen::Index dof;
};
Loosest loosest(const Factor& factor, const VectorXd& scale, double shift) {
  VectorXd z(scale.size());
  for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = 1 + std::sin(1.0 + 0.7 * static_cast<double>(i));
  double lambda = 0;
  for (int k = 0; k < 3; ++k) {
    z /= std::sqrt(z.dot(scale.cwiseProduct(z)));
    const VectorXd rhs = scale.cwiseProduct(z);
    z = factor.solve(rhs);
    lambda = 1 / std::sqrt(z.dot(scale.cwiseProduct(z))) - shift;
  }
  Eigen::Index worst = 0;
  z.cwiseAbs().maxCoeff(&worst);
  return {lambda, worst};
}

[[noreturn]] void fail_mechanism(const FeModel& model, int dof) {
  const Vector2d at = places(model).col(dof);
  const Eigen::RowVector3d motion = rigid_motions(model).row(dof);
  const char* name = motion[0] == 1 ? "x" : motion[1] == 1 ? "y" : "rotation";
  fail<std::runtime_error>("the body is supported as a whole, but a part of it moves without resistance, most at (", at.x(), ", ", at.y(),
                           ") in ", name, "; use beams instead of hinged bars, or more bars");
}

// Factors A, or throws an error that names the motion.
Factor factored(const FeModel& model, Sparse A, const std::vector<int>& free) {
  const double largest = A.diagonal().maxCoeff();
  const VectorXd scale = A.diagonal().cwiseMax(largest * std::numeric_limits<double>::epsilon());
  Factor factor;
  if (factor.compute(A)) {
    const Loosest l = loosest(factor, scale, 0);
    if (l.lambda > mechanism) return factor;
    fail_mechanism(model, free[static_cast<std::size_t>(l.dof)]);
  }
  constexpr double shift = 1e-8;
  for (Eigen::Index i = 0; i < A.cols(); ++i) A.coeffRef(i, i) += shift * scale[i];
  if (!factor.compute(A)) fail<std::runtime_error>("the stiffness of the body is not positive; check its material and mesh");
  fail_mechanism(model, free[static_cast<std::size_t>(loosest(factor, scale, shift).dof)]);
}

VectorXd picked(const VectorXd& all, const std::vector<int>& at) {
  VectorXd some(static_cast<Eigen::Index>(at.size()));
  for (Eigen::Index i = 0; i < some.size(); ++i) some[i] = all[at[static_cast<std::size_t>(i)]];
  return some;
}

}  // namespace

void hold(Supports& supports, const FeModel& model, int node, bool x, bool y, bool turn) {
  if (node < 0 || node >= model.x.cols())
    fail<std::invalid_argument>("support: node ", node, " does not exist; nodes run from 0 to ", model.x.cols(), " − 1");
  const int at = model.begin[static_cast<std::size_t>(node)];
  const int size = model.begin[static_cast<std::size_t>(node) + 1] - at;
  if (turn && size < 3)
    fail<std::invalid_argument>("support: node ", node, " at (", model.x(0, node), ", ", model.x(1, node),
                                ") has no rotation to hold; hold two nodes apart instead");
  int dof[3] = {-1, -1, -1};
  for (int d = 0; d < size; ++d) dof[d] = model.independent_of(at + d);
  const bool held[3] = {x, y, turn};
  for (int d = 0; d < 3; ++d)
    if (held[d] && dof[d] < 0)
      fail<std::invalid_argument>("support: node ", node, " at (", model.x(0, node), ", ", model.x(1, node),
                                  ") is on a rim that follows its port; hold the port instead");
  hold_dofs(supports, dof, held);
}

void hold(Supports& supports, const FeModel&, const Port& port, bool x, bool y, bool turn) {
  if (turn && port.dof[2] < 0)
    fail<std::invalid_argument>("support: port \"", port.name, "\" at (", port.x.x(), ", ", port.x.y(),
                                ") has no rotation to hold; hold two points instead");
  hold_dofs(supports, port.dof, {x, y, turn});
}

std::vector<int> free_dofs(const FeModel& model, const Supports& supports) {
  std::vector<bool> held(static_cast<std::size_t>(model.n()), false);
  for (const int i : supports.dofs) held.at(static_cast<std::size_t>(i)) = true;
  std::vector<int> free;
  for (int i = 0; i < model.n(); ++i)
    if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
  return free;
}

int rigid_motions_left(const FeModel& model, const Supports& supports) {
  if (supports.dofs.empty()) return 3;
  const Eigen::MatrixX3d held = scaled_rigid_motions(model)(supports.dofs, Eigen::all);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(held);
  const VectorXd& size = svd.singularValues();
  return 3 - static_cast<int>((size.array() > held_rank * size[0]).count());
}

StaticSolution solve_static(const FeModel& model, const Sparse& K, const Supports& supports, const VectorXd& independent_load) {
  if (K.rows() != model.N() || K.cols() != model.N())
    fail<std::invalid_argument>("stiffness: ", K.rows(), " × ", K.cols(), ", must be ", model.N(), " square, in nodal degrees of freedom");
  if (independent_load.size() != model.n())
    fail<std::invalid_argument>("load: ", independent_load.size(), " numbers, must be ", model.n(),
                                ", one per independent degree of freedom");
  if (!independent_load.allFinite()) fail<std::runtime_error>("load: a number in it is not finite");
  const Sparse A = independent(model, K);
  if (!A.coeffs().allFinite()) fail<std::runtime_error>("the stiffness of the body is not finite; check its material and mesh");
  const std::vector<int> free = free_dofs(model, supports);
  std::vector<bool> held(static_cast<std::size_t>(model.n()), true);
  for (const int i : free) held[static_cast<std::size_t>(i)] = false;
  validate_supports(model, A, held);

  VectorXd u = VectorXd::Zero(model.n());
  VectorXd f = independent_load;
  if (!free.empty()) {
    const Factor factor = factored(model, restricted(A, free), free);
    // Refined at most twice: the first refinement reduces the error to rounding, and the second verifies it.
    VectorXd rest = picked(independent_load, free);
    const double start = rest.norm();
    double before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3 && rest.norm() > 1e-14 * start && rest.norm() < before / 2; ++k) {
      before = rest.norm();
      const VectorXd step = factor.solve(rest);
      for (std::size_t i = 0; i < free.size(); ++i) u[free[i]] += step[static_cast<Eigen::Index>(i)];
      rest = picked(independent_load - A * u, free);
    }
  }
  StaticSolution solution;
  const VectorXd Ku = A * u;
  solution.reactions = VectorXd::Zero(model.n());
  double missed = 0;
  for (int i = 0; i < model.n(); ++i) {
    if (held[static_cast<std::size_t>(i)])
      solution.reactions[i] = Ku[i] - f[i];
    else
      missed += (Ku[i] - f[i]) * (Ku[i] - f[i]);
  }
  const double size = (f + solution.reactions).norm();
  solution.residual = size > 0 ? std::sqrt(missed) / size : 0;
  solution.strain_energy = u.dot(Ku) / 2;
  solution.u = nodal(model, u);
  solution.independent = std::move(u);
  return solution;
}

}  // namespace pintle
