#pragma once

#include <cmath>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// How the solvers treat dependent constraint rows: they factor with a small shift on the rows' diagonal and obtain the solution without it
/// by iterative refinement. docs/theory/solvers.md.
namespace dependent_rows {

inline constexpr double lost = 1e-12;    ///< a pivot below this, relative to its original entry, is rounding
inline constexpr double held_up = 1e-8;  ///< the same limit with the shift: a smaller pivot is nonzero only because of the shift
inline constexpr double shift = 1e-10;   ///< relative to the size of the matrix: far above rounding, far below independent pivots

/// Shift of each row: equal for all rows in the given units, so that refinement gives multipliers of least norm in these units; 1e-10 of
/// the matrix, taken as the geometric mean of its largest and smallest diagonal entries.
/// @param diagonal  of the matrix on the multipliers, positive, in its own units
/// @param unit      factor that converts a row to the units in which norms are taken
inline void shifts(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& unit, Eigen::VectorXd& E) {
  if (diagonal.size() == 0) return;
  const auto like = diagonal.array() * unit.array().square();
  const double size = std::sqrt(like.maxCoeff()) * std::sqrt(like.minCoeff());
  E = (shift * size / unit.array().square()).min(1e3 * shift * diagonal.array()).max(1e-3 * shift * diagonal.array());
}

/// Solves K z = b with a solver of the shifted matrix K − Σ ±E_i e_i e_iᵀ over the rows of multipliers, from `rows` on. Consistent rows are
/// satisfied to rounding, with multipliers of least norm; inconsistent rows in the least-squares sense.
class Refinement {
 public:
  Refinement() = default;
  /// @param unit  scales residuals to similar size
  Refinement(const Eigen::VectorXd& unit, Eigen::Index rows)
      : unit_(unit), b_(unit), left_(unit), before_(unit), last_(unit), rows_(rows) {}

  /// z: b on entry. solve(v): v ← shifted⁻¹ v; subtract_product(z, out): out −= K z; shifts_made: signed shifts of the rows of multipliers,
  /// not null if the multipliers themselves are computed and their part that does no work must be removed. No allocation.
  template <class Solve, class SubtractProduct>
  void operator()(Eigen::VectorXd& z, Solve solve, SubtractProduct subtract_product, const Eigen::VectorXd* shifts_made = nullptr) {
    constexpr int most = 8;
    constexpr double rounding = 1e-15;
    b_ = left_ = z;
    z.setZero();
    const double size = norm(b_);
    double change_before = size;
    int sweeps = 0;
    while (sweeps < most) {
      last_ = before_ = left_;
      solve(last_);
      z += last_;
      ++sweeps;
      left_ = b_;
      subtract_product(z, left_);
      before_ -= left_;
      const double change = norm(before_);
      if (sweeps > 1 && (change <= rounding * size || !(change <= 0.5 * change_before))) break;
      change_before = change;
    }
    // The inconsistent part adds the same amount to the multipliers at each sweep: it is subtracted.
    const Eigen::Index m = z.size() - rows_;
    z.tail(m) -= sweeps * last_.tail(m);
    if (shifts_made) take_null_part(z, solve, *shifts_made);
    left_over_ = size > 0 ? left_.tail(m).cwiseProduct(unit_.tail(m)).lpNorm<Eigen::Infinity>() / size : 0;
  }

  /// The rounding of residuals, divided by the shift, leaves a part in the multipliers that does no work: P z, with P = (shifted⁻¹ shift)³
  /// up to the cube of the shift over the independent pivots. The shift is proportional to the inverse squares of the units, so the
  /// remainder has least norm.
  template <class Solve>
  void take_null_part(Eigen::VectorXd& z, Solve solve, const Eigen::VectorXd& shifts_made) {
    const Eigen::Index m = z.size() - rows_;
    last_ = z;
    for (int i = 0; i < 3; ++i) {
      last_.head(rows_).setZero();
      last_.tail(m).array() *= shifts_made.array();
      solve(last_);
    }
    z.tail(m) -= last_.tail(m);
  }

  /// Of the last solve: residual of the rows of multipliers over b, by their largest entries.
  double left_over() const { return left_over_; }

 private:
  double norm(const Eigen::VectorXd& v) const { return v.cwiseProduct(unit_).lpNorm<Eigen::Infinity>(); }

  Eigen::VectorXd unit_, b_, left_, before_, last_;
  Eigen::Index rows_ = 0;
  double left_over_ = 0;
};

}  // namespace dependent_rows
}  // namespace pintle
