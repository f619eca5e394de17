#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "elements/line.h"

/// Straight chains of line elements and their dense matrices, for tests.
namespace pintle {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

template <class E>
struct Chain {
  std::vector<E> elements;
  Eigen::Matrix2Xd x;
  int dofs() const { return static_cast<int>(x.cols()) * E::dofs_per_node; }
  Coords<E> coords(int i) const { return x.middleCols(i, 2); }

  template <class F>
  MatrixXd assembled(F matrix) const {
    MatrixXd sum = MatrixXd::Zero(dofs(), dofs());
    for (int i = 0; i < static_cast<int>(elements.size()); ++i)
      sum.block(i * E::dofs_per_node, i * E::dofs_per_node, E::dofs, E::dofs) += matrix(elements[static_cast<std::size_t>(i)], coords(i));
    return sum;
  }
  MatrixXd K() const {
    return assembled([](const E& e, const Coords<E>& c) -> MatrixXd { return stiffness(e, c); });
  }
  MatrixXd M() const {
    return assembled([](const E& e, const Coords<E>& c) -> MatrixXd { return mass(e, c); });
  }
  MatrixXd lumped() const {
    return assembled([](const E& e, const Coords<E>& c) -> MatrixXd { return lumped_mass(e, c).asDiagonal(); });
  }
  /// K_g of a pull that varies along the chain, s from its first node.
  MatrixXd K_g(const std::function<double(double)>& pull) const {
    return assembled([&](const E& e, const Coords<E>& c) -> MatrixXd {
      Stress<E> f = Stress<E>::Zero();
      f(0, 0) = pull((c.col(0) - x.col(0)).norm());
      f(0, 1) = pull((c.col(1) - x.col(0)).norm());
      return geometric_stiffness(e, c, f);
    });
  }
};

template <class E>
Chain<E> chain(const E& e, int n, double length, double angle = 0) {
  Chain<E> c{std::vector<E>(static_cast<std::size_t>(n), e), Eigen::Matrix2Xd(2, n + 1)};
  for (int i = 0; i <= n; ++i) c.x.col(i) = length * i / n * Vector2d(std::cos(angle), std::sin(angle));
  return c;
}

using Dofs = std::vector<int>;
inline MatrixXd kept(const MatrixXd& A, const Dofs& free) { return A(free, free); }
/// Which dofs remain; `held` counts from the end when negative.
inline Dofs all_but(int n, std::vector<int> held) {
  Dofs free;
  for (int i = 0; i < n; ++i) {
    bool is_free = true;
    for (int h : held) is_free = is_free && i != (h < 0 ? n + h : h);
    if (is_free) free.push_back(i);
  }
  return free;
}
/// Only u_y and φ of a chain along x, without the dofs held.
inline Dofs bending(int n, std::vector<int> held) {
  for (int i = 0; i < n; i += 3) held.push_back(i);
  return all_but(n, held);
}
inline VectorXd frequencies(const MatrixXd& K, const MatrixXd& M) {
  // Of the inverse pencil, so that M may have zeros; largest first there is lowest first here.
  const VectorXd inverse = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(M, K).eigenvalues().reverse();
  return inverse.cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
}

}  // namespace pintle
