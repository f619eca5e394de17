#pragma once

// Pencils K φ = λ M φ with known spectra, and small bodies, assembled without anything of ours.

#include <Eigen/Dense>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pintle::bodies {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;
constexpr double pi = std::numbers::pi;

struct Pencil {
  Sparse K, M;
};

inline Sparse from(const Triplets& t, int n) {
  Sparse A(n, n);
  A.setFromTriplets(t.begin(), t.end());
  return A;
}

/// Unit masses and springs in a row; walls at both ends, or free. λ_k = 4 sin²: k = 1…n of (n + 1),
/// or k = 0…n−1 of n.
inline Pencil chain(int n, bool walls) {
  Triplets k, m;
  for (int i = 0; i < n; ++i) {
    const bool end = i == 0 || i == n - 1;
    k.emplace_back(i, i, !walls && end ? 1 : 2);
    m.emplace_back(i, i, 1);
    if (i > 0) k.emplace_back(i, i - 1, -1), k.emplace_back(i - 1, i, -1);
  }
  return {from(k, n), from(m, n)};
}
inline VectorXd chain_lambda(int n, bool walls) {
  return VectorXd::NullaryExpr(n, [&](Index i) {
    const double s = walls ? std::sin(pi * static_cast<double>(i + 1) / (2 * (n + 1))) : std::sin(pi * static_cast<double>(i) / (2 * n));
    return 4 * s * s;
  });
}

/// Membrane of c × c points between walls: every λ_i + λ_j with i ≠ j is double.
inline Pencil membrane(int c) {
  Triplets k, m;
  const auto id = [&](int i, int j) { return i * c + j; };
  for (int i = 0; i < c; ++i)
    for (int j = 0; j < c; ++j) {
      k.emplace_back(id(i, j), id(i, j), 4);
      m.emplace_back(id(i, j), id(i, j), 1);
      const auto couple = [&](int other) { k.emplace_back(id(i, j), other, -1), k.emplace_back(other, id(i, j), -1); };
      if (i + 1 < c) couple(id(i + 1, j));
      if (j + 1 < c) couple(id(i, j + 1));
    }
  return {from(k, c * c), from(m, c * c)};
}
inline VectorXd membrane_lambda(int c) {
  const VectorXd one = chain_lambda(c, true);
  VectorXd all(c * c);
  for (int i = 0; i < c; ++i)
    for (int j = 0; j < c; ++j) all[i * c + j] = one[i] + one[j];
  std::sort(all.begin(), all.end());
  return all;
}

/// Plane stress on a grid of bilinear quadrilaterals under a map of the unit square, E = 1, ν =
/// 0.3, ρ = 1, 2 × 2 Gauss points. `wraps`: the last column of nodes is the first. `held`: the
/// first column is fixed.
template <class Map>
Pencil membrane_stress(int nx, int ny, bool wraps, bool held, Map map) {
  const int columns = wraps ? nx : nx + 1;
  Triplets k, m;
  const int off = held ? 2 * (ny + 1) : 0;
  Eigen::Matrix3d D;
  D << 1, 0.3, 0, 0.3, 1, 0, 0, 0, 0.35;
  D /= 0.91;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      const int node[4] = {i * (ny + 1) + j, ((i + 1) % columns) * (ny + 1) + j, ((i + 1) % columns) * (ny + 1) + j + 1,
                           i * (ny + 1) + j + 1};
      Eigen::Matrix<double, 2, 4> x;
      for (int a = 0; a < 4; ++a)
        x.col(a) = map((i + (a == 1 || a == 2)) / static_cast<double>(nx), (j + (a > 1)) / static_cast<double>(ny));
      Eigen::Matrix<double, 8, 8> Ke = Eigen::Matrix<double, 8, 8>::Zero(), Me = Ke;
      for (int g = 0; g < 4; ++g) {
        const double r = (g % 2 ? 1 : -1) / std::sqrt(3.0), s = (g / 2 ? 1 : -1) / std::sqrt(3.0);
        const Eigen::Vector4d N{(1 - r) * (1 - s) / 4, (1 + r) * (1 - s) / 4, (1 + r) * (1 + s) / 4, (1 - r) * (1 + s) / 4};
        Eigen::Matrix<double, 4, 2> d;
        d << s - 1, r - 1, 1 - s, -1 - r, 1 + s, 1 + r, -1 - s, 1 - r;
        const Eigen::Matrix2d jacobian = x * d / 4;
        const Eigen::Matrix<double, 4, 2> gradient = d / 4 * jacobian.inverse();
        Eigen::Matrix<double, 3, 8> B = Eigen::Matrix<double, 3, 8>::Zero();
        Eigen::Matrix<double, 2, 8> n = Eigen::Matrix<double, 2, 8>::Zero();
        for (int a = 0; a < 4; ++a) {
          B(0, 2 * a) = B(2, 2 * a + 1) = gradient(a, 0);
          B(1, 2 * a + 1) = B(2, 2 * a) = gradient(a, 1);
          n(0, 2 * a) = n(1, 2 * a + 1) = N[a];
        }
        Ke += B.transpose() * D * B * jacobian.determinant();
        Me += n.transpose() * n * jacobian.determinant();
      }
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b) {
          const int row = 2 * node[a / 2] + a % 2 - off, column = 2 * node[b / 2] + b % 2 - off;
          if (row < 0 || column < 0) continue;
          k.emplace_back(row, column, Ke(a, b));
          m.emplace_back(row, column, Me(a, b));
        }
    }
  const int n = 2 * columns * (ny + 1) - off;
  return {from(k, n), from(m, n)};
}
inline Pencil square(int c, bool held) {
  return membrane_stress(c, c, false, held, [](double r, double s) { return Eigen::Vector2d(r, s); });
}
inline Pencil strip(bool held) {
  return membrane_stress(100, 8, false, held, [](double r, double s) { return Eigen::Vector2d(10 * r, s); });
}
/// Free ring: modes of two lobes and more come in pairs.
inline Pencil ring(int around, int across) {
  return membrane_stress(around, across, true, false, [](double r, double s) {
    return Eigen::Vector2d((2 + s) * std::cos(-2 * pi * r), (2 + s) * std::sin(-2 * pi * r));
  });
}
/// Hermite beams, EI = ρA = L = 1: free, or clamped at the left.
inline Pencil beam(int elements, bool clamped) {
  const double l = 1.0 / elements;
  Eigen::Matrix4d k, m;
  k << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l, -6 * l, 4 * l * l;
  m << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l, -3 * l * l, -22 * l, 4 * l * l;
  k /= l * l * l;
  m *= l / 420;
  Triplets K, M;
  const int off = clamped ? 2 : 0;
  for (int e = 0; e < elements; ++e)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        if (2 * e + a >= off && 2 * e + b >= off) {
          K.emplace_back(2 * e + a - off, 2 * e + b - off, k(a, b));
          M.emplace_back(2 * e + a - off, 2 * e + b - off, m(a, b));
        }
  return {from(K, 2 * elements + 2 - off), from(M, 2 * elements + 2 - off)};
}

/// The two in one, with no connection.
inline Pencil both(const Pencil& a, const Pencil& b) {
  const auto join = [](const Sparse& A, const Sparse& B) {
    Triplets t;
    for (int j = 0; j < A.outerSize(); ++j)
      for (Sparse::InnerIterator x(A, j); x; ++x) t.emplace_back(x.row(), j, x.value());
    for (int j = 0; j < B.outerSize(); ++j)
      for (Sparse::InnerIterator x(B, j); x; ++x) t.emplace_back(A.rows() + x.row(), A.rows() + j, x.value());
    return from(t, static_cast<int>(A.rows() + B.rows()));
  };
  return {join(a.K, b.K), join(a.M, b.M)};
}

}  // namespace pintle::bodies
