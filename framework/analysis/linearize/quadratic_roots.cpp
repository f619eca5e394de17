#include "framework/analysis/linearize/quadratic_roots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "framework/common/dense.h"
#include "framework/common/lapack.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

namespace {

// Relative to the terms summed for each coefficient: rounding of some ten terms, and of derivatives along the motion.
constexpr double rounding = 1e-13;

double bilinear(const VectorXcd& y, const MatrixXd& A, const VectorXcd& x) { return y.cwiseAbs().dot(A * x.cwiseAbs()); }

bool conservative(const SmallMotion& s, const SmallMotion& size) {
  const auto within = [](const MatrixXd& A, const MatrixXd& of) { return (A.cwiseAbs().array() <= rounding * of.array()).all(); };
  return s.G_x.size() == 0 && within(s.D, size.D) && within(s.K - s.K.transpose(), size.K + size.K.transpose());
}

// ω² of a symmetric problem: pairs on the imaginary axis, or ± pairs on the real axis where it is negative.
std::vector<QuadraticRoot> symmetric_roots(const SmallMotion& s, const MatrixXd& L) {
  const MatrixXd half = L.triangularView<Eigen::Lower>().solve((s.K + s.K.transpose()) / 2);
  const MatrixXd K = L.triangularView<Eigen::Lower>().solve(half.transpose());
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver((K + K.transpose()) / 2);
  if (solver.info() != Eigen::Success) throw std::runtime_error("the natural frequencies cannot be found: the iteration does not converge");
  const MatrixXd shapes = L.transpose().triangularView<Eigen::Upper>().solve(solver.eigenvectors());
  std::vector<QuadraticRoot> out;
  for (Index i = 0; i < shapes.cols(); ++i) {
    const VectorXd x = shapes.col(i);
    const double square = x.dot(s.K * x) / x.dot(s.M * x);
    const Complex root = square >= 0 ? Complex(0, std::sqrt(square)) : Complex(std::sqrt(-square), 0);
    for (const Complex& r : {root, -root}) out.push_back({r, x.cast<Complex>(), x.cast<Complex>()});
  }
  return out;
}

// The root of a λ² + b λ + c nearest to `near`.
Complex nearest_root(Complex a, Complex b, Complex c, Complex near) {
  Complex d = std::sqrt(b * b - 4.0 * a * c);
  if ((std::conj(b) * d).real() < 0) d = -d;
  const Complex q = -0.5 * (b + d);  // the one of larger magnitude: no cancellation
  if (q == 0.0) return 0;
  const Complex one = q / a, two = c / q;
  return std::abs(one - near) < std::abs(two - near) ? one : two;
}

// All eigenvalues of A by LAPACK, with balancing, and their vectors.
struct Eigenpairs {
  VectorXcd value;
  Eigen::MatrixXcd right, left;
};
Eigenpairs eigenpairs(MatrixXd A) {
  const int n = static_cast<int>(A.rows());
  VectorXd re(n), im(n), scale(n), unused(n);
  MatrixXd left(n, n), right(n, n);
  int low = 0, high = 0, info = 0, more = -1, no_integers = 0;
  double norm = 0, wanted = 0;
  const auto solve = [&](double* work) {
    dgeevx_("B", "V", "V", "N", &n, A.data(), &n, re.data(), im.data(), left.data(), &n, right.data(), &n, &low, &high, scale.data(), &norm,
            unused.data(), unused.data(), work, &more, &no_integers, &info);
  };
  solve(&wanted);
  more = static_cast<int>(wanted);
  std::vector<double> work(static_cast<std::size_t>(more));
  solve(work.data());
  if (info != 0) throw std::runtime_error("the natural frequencies cannot be found: the iteration does not converge");
  Eigenpairs out{VectorXcd(n), Eigen::MatrixXcd(n, n), Eigen::MatrixXcd(n, n)};
  for (Index i = 0; i < n; ++i) {
    out.value[i] = {re[i], im[i]};
    const Index first = im[i] < 0 ? i - 1 : i;  // a pair: real and imaginary part in adjacent columns
    const Complex j(0, im[i] > 0 ? 1 : im[i] < 0 ? -1 : 0);
    const Index second = im[i] == 0 ? i : first + 1;
    out.right.col(i) = right.col(first).cast<Complex>() + j * right.col(second).cast<Complex>();
    out.left.col(i) = left.col(first).cast<Complex>() + j * left.col(second).cast<Complex>();
  }
  return out;
}

// The equations in coordinates with unit mass matrix, in first-order form in [σ p; ṗ; x]:
//   [0 σ 0; −K̃/σ −D̃ F̃; G̃_p/σ G̃_v G_x].
struct Companion {
  Companion(const SmallMotion& s, const MatrixXd& L) : m(s.M.rows()), x(s.G_x.rows()), A(MatrixXd::Zero(2 * m + x, 2 * m + x)) {
    const auto lower = L.triangularView<Eigen::Lower>();
    const auto mass_normalised = [&](const MatrixXd& of) -> MatrixXd {
      const MatrixXd half = lower.solve(of);
      return lower.solve(half.transpose()).transpose();
    };
    const MatrixXd K = mass_normalised(s.K), D = mass_normalised(s.D);
    if (m > 0) sigma = std::max({std::sqrt(K.cwiseAbs().maxCoeff()), D.cwiseAbs().maxCoeff(), 1e-150});
    A.block(0, m, m, m).diagonal().setConstant(sigma);
    A.block(m, 0, m, m) = -K / sigma;
    A.block(m, m, m, m) = -D;
    if (x == 0) return;
    A.topRightCorner(2 * m, x).bottomRows(m) = lower.solve(s.F);
    A.bottomLeftCorner(x, 2 * m) << MatrixXd(lower.solve(s.G_p.transpose())).transpose() / sigma,
        MatrixXd(lower.solve(s.G_v.transpose())).transpose();
    A.bottomRightCorner(x, x) = s.G_x;
  }
  Index m, x;
  double sigma = 1;
  MatrixXd A;
};

std::vector<QuadraticRoot> companion_roots(const SmallMotion& s, const SmallMotion& size, const MatrixXd& L) {
  const Companion of(s, L);
  const Eigenpairs pairs = eigenpairs(of.A);
  const auto back = L.transpose().triangularView<Eigen::Upper>();
  std::vector<QuadraticRoot> out;
  for (Index i = 0; i < pairs.value.size(); ++i) {
    QuadraticRoot& root = out.emplace_back();
    root.lambda = pairs.value[i];
    const VectorXcd x = pairs.right.col(i), y = pairs.left.col(i);
    root.right = back.solve(x.head(of.m)), root.left = back.solve(y.segment(of.m, of.m));
    if (of.x > 0) {  // effect of the rounding of A's entries, of the terms that K and D are sums of, and of the iteration
      const VectorXcd speed = back.solve(x.segment(of.m, of.m));
      const double l = std::abs(root.lambda), of_pair = std::abs(y.dot(x));
      const double noise =
          bilinear(y, of.A.cwiseAbs(), x) + bilinear(root.left, size.K, root.right) / of.sigma + bilinear(root.left, size.D, speed);
      const double iteration = std::numeric_limits<double>::epsilon() * of.A.norm() * y.norm() * x.norm();
      root.uncertainty = of_pair > 0 ? std::min((rounding * noise + iteration) / of_pair, l) : l;
      root.zero = l <= root.uncertainty;
      continue;
    }
    const Complex a = root.left.dot(s.M * root.right), b = root.left.dot(s.D * root.right), c = root.left.dot(s.K * root.right);
    if (a == 0.0) continue;
    const Complex better = nearest_root(a, b, c, root.lambda);
    if (std::abs(better - root.lambda) <= 1e-6 * of.sigma && (root.lambda.imag() != 0 || better.imag() == 0)) root.lambda = better;
  }
  return out;
}

}  // namespace

std::vector<QuadraticRoot> roots_of(const SmallMotion& s, const SmallMotion& size) {
  if (s.M.rows() == 0 && s.G_x.rows() == 0) return {};
  const Eigen::LLT<MatrixXd> llt((s.M + s.M.transpose()) / 2);
  if (llt.info() != Eigen::Success) throw std::runtime_error("the mass matrix of the free motion is not positive");
  const MatrixXd L = llt.matrixL();
  std::vector<QuadraticRoot> out = conservative(s, size) ? symmetric_roots(s, L) : companion_roots(s, size, L);
  double fastest = 0;
  for (const QuadraticRoot& r : out) fastest = std::max(fastest, std::abs(r.lambda));
  for (QuadraticRoot& r : out) {
    if (s.G_x.size() > 0) {
      r.zero = r.zero || std::abs(r.lambda) <= 1e-10 * fastest;
      continue;
    }
    const double l = std::abs(r.lambda), noise = rounding * bilinear(r.left, size.K, r.right);
    const double inertia = l * l * std::abs(r.left.dot(s.M * r.right)), drag = l * std::abs(r.left.dot(s.D * r.right));
    r.zero = std::max(inertia, drag) <= noise || l <= 1e-10 * fastest;
    const double slope = std::abs(r.left.dot(2.0 * r.lambda * (s.M * r.right) + s.D * r.right));
    const double error = noise + rounding * (l * l * bilinear(r.left, size.M, r.right) + l * bilinear(r.left, size.D, r.right));
    const double curvature = std::abs(r.left.dot(s.M * r.right));  // of a double root, whose slope vanishes
    r.uncertainty = std::min({slope > 0 ? error / slope : l, curvature > 0 ? std::sqrt(error / curvature) : l, l});
  }
  std::ranges::stable_sort(out, {}, [](const QuadraticRoot& r) { return std::abs(r.lambda); });
  return out;
}

}  // namespace pintle
