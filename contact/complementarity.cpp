#include "contact/complementarity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Lemke's method for w = q + M z + d z₀, d > 0, with pivots on the tableau [w z z₀ | right-hand side]. Variables are numbered
// w: 0 … n − 1, z: n … 2n − 1, z₀: 2n.
class Lemke {
 public:
  enum class Ties { largest_pivot, ordered };  ///< largest_pivot loses fewer digits; ordered cannot cycle
  /// @param least_pivot  relative to the largest entry of the column; smaller entries are rounding
  Lemke(const MatrixXd& M, const VectorXd& q, const VectorXd& d, Ties ties, double least_pivot)
      : n_(q.size()),
        table_(n_, 2 * n_ + 2),
        most_(q.cwiseAbs().maxCoeff()),
        basic_(static_cast<std::size_t>(n_)),
        ties_(ties),
        least_pivot_(least_pivot) {
    table_ << MatrixXd::Identity(n_, n_), -M, -d, q;
    for (Index i = 0; i < n_; ++i) basic(i) = i;
  }

  std::optional<VectorXd> solve() {
    if (table_.col(rhs()).minCoeff() >= 0) return VectorXd(VectorXd::Zero(n_));
    Index row = first(), enters = z0();
    for (Index pivots = 0; pivots < 50 * (n_ + 1); ++pivots) {
      const Index leaves = basic(row);
      pivot(row, enters);
      if (leaves == z0()) return solution();
      enters = leaves < n_ ? leaves + n_ : leaves - n_;
      const std::optional<Index> blocks = blocking(enters);
      if (!blocks) return is_solved() ? std::optional(solution()) : std::nullopt;
      row = *blocks;
    }
    return std::nullopt;
  }

 private:
  Index z0() const { return 2 * n_; }
  Index rhs() const { return 2 * n_ + 1; }
  Index& basic(Index row) { return basic_[static_cast<std::size_t>(row)]; }

  // Sets differences of nearly equal numbers, which are rounding, to 0; otherwise they would break the ties of degenerate problems at
  // random.
  void pivot(Index row, Index enters) {
    constexpr double rounding = 4e-15;
    table_.row(row) /= table_(row, enters);
    for (Index i = 0; i < n_; ++i) {
      const double times = table_(i, enters);
      if (i == row || times == 0) continue;
      const auto terms = (times * table_.row(row)).eval();
      const auto left = (table_.row(i) - terms).eval();
      table_.row(i) = (left.array().abs() > rounding * terms.array().abs()).select(left, 0);
      table_(i, enters) = 0;
    }
    basic(row) = enters;
  }

  // The first row to leave the basis, for z₀ to enter: the one that needs the largest z₀; among equal rows the last.
  Index first() {
    constexpr double tie = 1e-12;
    const VectorXd ratio = table_.col(rhs()).cwiseQuotient(-table_.col(z0()));
    const double least = ratio.minCoeff();
    Index row = n_ - 1;
    while (ratio[row] > (1 - tie) * least) --row;
    return row;
  }

  // Ratio test: the row whose basic variable reaches 0 first as the entering variable grows. Ties: the row of z₀; otherwise the largest
  // pivot, or the lexicographic order of the rows of the inverse basis, with which pivots cannot cycle [CottlePangStone1992, 4.9].
  std::optional<Index> blocking(Index enters) {
    const double size = std::max(table_.col(enters).cwiseAbs().maxCoeff(), 1.0);
    std::optional<Index> best;
    for (Index i = 0; i < n_; ++i)
      if (table_(i, enters) > least_pivot_ * size && (!best || comes_before(i, *best, enters))) best = i;
    return best;
  }

  bool comes_before(Index i, Index best, Index enters) {
    constexpr double tie = 1e-12;
    const auto order = [&](double a, double b) { return std::abs(a - b) <= tie * (std::abs(a) + std::abs(b)) ? 0 : a < b ? -1 : 1; };
    const double slope = table_(i, enters), slope_best = table_(best, enters);
    if (const int o = order(std::max(table_(i, rhs()), 0.0) / slope, std::max(table_(best, rhs()), 0.0) / slope_best); o != 0) return o < 0;
    if (basic(i) == z0() || basic(best) == z0()) return basic(i) == z0();
    if (ties_ == Ties::largest_pivot) return slope > slope_best;
    for (Index j = 0; j < n_; ++j)
      if (const int o = order(table_(i, j) / slope, table_(best, j) / slope_best); o != 0) return o < 0;
    return false;
  }

  // Whether z₀ is 0 within rounding, as when forces balance only within rounding.
  bool is_solved() {
    constexpr double rounding = 1e-12;
    for (Index i = 0; i < n_; ++i)
      if (basic(i) == z0()) return table_(i, rhs()) <= rounding * most_;
    return true;
  }

  VectorXd solution() {
    VectorXd z = VectorXd::Zero(n_);
    for (Index i = 0; i < n_; ++i)
      if (basic(i) >= n_ && basic(i) < z0()) z[basic(i) - n_] = std::max(table_(i, rhs()), 0.0);
    return z;
  }

  Index n_;
  MatrixXd table_;
  double most_;               ///< largest magnitude of q
  std::vector<Index> basic_;  ///< variable of each row
  Ties ties_;
  double least_pivot_;
};

// Checks a result, because pivots lose digits and a point at which the method ends on a ray need not be a solution.
bool solves(const MatrixXd& M, const VectorXd& q, const VectorXd& z) {
  // Each of some hundred pivots loses a few units of 1e-16 of the largest number in the tableau, which may be 1e6 times q: only half of the
  // digits of q are certain. The sum of n products in a row is accurate to n roundings of its terms.
  constexpr double enough = 1e-8, rounding = 1e-13;
  if (!z.allFinite()) return false;
  const VectorXd w = M * z + q, none = enough * q.cwiseAbs().maxCoeff() + (rounding * (M.cwiseAbs() * z)).array();
  for (Index i = 0; i < q.size(); ++i)
    if (w[i] < -none[i] || (z[i] > 0 && w[i] > none[i])) return false;
  return true;
}

}  // namespace

// If several variables reach 0 at once, as with redundant contacts of bodies at rest, pivots may cycle. Ordered ties cannot cycle, but may
// take small pivots. Another d takes other pivots.
std::optional<VectorXd> solve_complementarity(const MatrixXd& M, const VectorXd& q) {
  constexpr double golden = 0.6180339887498949;
  constexpr int ways = 6;
  if (q.size() == 0) return q;
  VectorXd d = VectorXd::Ones(q.size());
  for (int way = 0; way < ways; ++way) {
    const double least_pivot = way < ways / 2 ? 1e-12 : 1e-15;  // 1e-15: for bodies wedged at an angle of its square root
    for (const Lemke::Ties ties : {Lemke::Ties::largest_pivot, Lemke::Ties::ordered})
      if (auto z = Lemke(M, q, d, ties, least_pivot).solve(); z && solves(M, q, *z)) return z;
    for (Index i = 0; i < d.size(); ++i) {
      const double x = golden * (static_cast<double>(i) + 1) * (way + 1);
      d[i] = 0.5 + x - std::floor(x);
    }
  }
  return std::nullopt;
}

namespace {

// Removes from W = Jᵀ A J and c = Jᵀ v the directions of forces that hardly move anything, such as the one along a row of discs between two
// walls, straight within an angle of 1e-5. @returns false if there are none
bool leave_out_faint(MatrixXd& W, VectorXd& c) {
  // Scaled to a diagonal of 1, W is accurate to 1e-15 to 1e-13: rounding of sums, and the loss in the factor of the joints. So an
  // eigenvalue of 1e-10, and the force along it, is accurate to a thousandth. A row of bodies bent by 1e-5 has this eigenvalue, the square
  // of the angle.
  constexpr double faint = 1e-10;
  const VectorXd unit = W.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(unit.asDiagonal() * W * unit.asDiagonal());
  const Index left_out = (eigen.eigenvalues().array() <= faint * eigen.eigenvalues().maxCoeff()).count();
  if (left_out == 0) return false;
  const auto V = eigen.eigenvectors().rightCols(c.size() - left_out);
  const VectorXd size = unit.cwiseInverse();
  W = size.asDiagonal() * V * eigen.eigenvalues().tail(c.size() - left_out).asDiagonal() * V.transpose() * size.asDiagonal();
  c = size.asDiagonal() * (V * (V.transpose() * unit.cwiseProduct(c)));
  return true;
}

// T = T⁺ − T⁻. The unknowns z = (N, T⁺, T⁻, u) are complementary to (g, u + slip, u − slip, μ(N + N₀) − T⁺ − T⁻), with u the sliding
// speed. Each is scaled by the root of its diagonal entry of W. Without sliding contacts zᵀM z = xᵀW x + uᵀμN ≥ 0, so that Lemke's method
// finds the impulses of an impact [AnitescuPotra1997, theorem 1].
struct Unilateral {
  VectorXd x;
  double greatest;  ///< largest entry of z; 1: the force that alone would stop the largest of c
};
std::optional<Unilateral> solve_unilateral(std::span<const UnilateralContact> contacts, const MatrixXd& W, const VectorXd& c) {
  const auto n = static_cast<Index>(contacts.size());
  const auto m = static_cast<Index>(std::ranges::count_if(contacts, [](const UnilateralContact& k) { return k.tangent >= 0; }));
  const Index size = n + 3 * m;

  // x = X z + x₀
  MatrixXd X = MatrixXd::Zero(c.size(), size);
  VectorXd x0 = VectorXd::Zero(c.size());
  for (Index i = 0, plus = n; i < n; ++i) {
    const UnilateralContact& k = contacts[static_cast<std::size_t>(i)];
    X(k.normal, i) = 1;
    if (k.sliding >= 0) X(k.sliding, i) = -k.direction * k.mu;
    if (k.sliding >= 0) x0[k.sliding] = -k.direction * k.mu * k.preload;
    if (k.tangent < 0) continue;
    X(k.tangent, plus) = 1;
    X(k.tangent, plus++ + m) = -1;
  }
  const MatrixXd respond = W * X;
  const VectorXd at_rest = W * x0 + c;
  const auto unit_of = [&](int of) { return 1 / std::sqrt(std::max(W(of, of), std::numeric_limits<double>::min())); };
  MatrixXd M = MatrixXd::Zero(size, size);
  VectorXd q = VectorXd::Zero(size), unit = VectorXd::Ones(size);
  for (Index i = 0, plus = n; i < n; ++i) {
    const UnilateralContact& k = contacts[static_cast<std::size_t>(i)];
    M.row(i) = respond.row(k.normal);
    q[i] = at_rest[k.normal];
    unit[i] = unit_of(k.normal);
    if (k.tangent < 0) continue;
    const Index minus = plus + m, slip = minus + m;
    M.row(plus) = respond.row(k.tangent), M.row(minus) = -respond.row(k.tangent);
    q[plus] = at_rest[k.tangent], q[minus] = -at_rest[k.tangent], q[slip] = k.mu * k.preload;
    M(plus, slip) = M(minus, slip) = 1;
    M(slip, i) = k.mu, M(slip, plus) = M(slip, minus) = -1;
    unit[plus] = unit[minus] = unit_of(k.tangent);
    unit[slip] = 1 / unit[plus];
    ++plus;
  }
  const double most = q.cwiseProduct(unit).cwiseAbs().maxCoeff();
  if (!(most > 0)) return Unilateral{x0, 0};
  const auto z = solve_complementarity(unit.asDiagonal() * M * unit.asDiagonal(), q.cwiseProduct(unit) / most);
  if (!z) return std::nullopt;
  return Unilateral{X * (most * unit.cwiseProduct(*z)) + x0, z->maxCoeff()};
}

}  // namespace

// If contacts are redundant or nearly so, rounding may leave the problem without a solution or with very large forces.
std::optional<VectorXd> unilateral_forces(std::span<const UnilateralContact> contacts, const MatrixXd& W, const VectorXd& c) {
  // Forces of 1e8 that cancel to 1 leave a rounding of 1e-8, which `solves` allows. Larger ones are unreliable.
  constexpr double great = 1e8;
  const auto found = solve_unilateral(contacts, W, c);
  if (found && found->greatest <= great) return found->x;
  MatrixXd strong = W;
  VectorXd of_these = c;
  if (leave_out_faint(strong, of_these))
    if (const auto without = solve_unilateral(contacts, strong, of_these)) return without->x;
  return found ? std::optional(found->x) : std::nullopt;
}

// G x ≥ 0 are the conditions of the normal forces, and of friction slightly below its limit, so that the limit is not reached.
// Minimises ½|y|² + κ s subject to G(x + Z y) + s ≥ 0, s ≥ 0. If some y allows s = 0, s is 0, because κ is larger than the multipliers.
VectorXd admissible_forces(std::span<const UnilateralContact> contacts, const VectorXd& x, const MatrixXd& Z) {
  constexpr double within = 2e-9, kappa = 1e4;
  const double most = x.cwiseAbs().maxCoeff(), reach = Z.size() > 0 ? Z.cwiseAbs().maxCoeff() : 0;
  if (!(most > 0) || !(reach > 0)) return x;
  Index m = 0;
  for (const UnilateralContact& k : contacts) m += k.tangent < 0 ? 1 : 3;
  MatrixXd G = MatrixXd::Zero(m, x.size());
  VectorXd allowed = VectorXd::Ones(m);  // weights of s
  bool meets = true;
  Index row = 0;
  for (const UnilateralContact& k : contacts) {
    meets = meets && x[k.normal] >= 0 && (k.tangent < 0 || std::abs(x[k.tangent]) <= k.mu * x[k.normal]);
    G(row++, k.normal) = 1;
    for (int sign = -1; k.tangent >= 0 && sign <= 1; sign += 2, ++row)
      G(row, k.normal) = (1 - within) * k.mu, G(row, k.tangent) = sign, allowed[row] = k.mu;
  }
  if (meets) return x;
  const MatrixXd by = G * Z / reach;
  MatrixXd M = MatrixXd::Zero(m + 1, m + 1);
  M.topLeftCorner(m, m) = by * by.transpose();
  M.col(m).head(m) = allowed, M.row(m).head(m) = -allowed.transpose();
  VectorXd q(m + 1);
  q << G * x / most, kappa;
  const auto z = solve_complementarity(M, q);
  return z ? VectorXd(x + most / reach * (Z * (by.transpose() * z->head(m)))) : x;
}

}  // namespace pintle
