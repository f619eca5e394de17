#pragma once

#include <cmath>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// What the solvers do where constraint rows are dependent: they factor with a small shift on the rows'
/// diagonal and come to the solution without it by refinement. docs/theory/solvers.md.
namespace dependent_rows {

inline constexpr double lost = 1e-12;    ///< a pivot below this, over the entry it came from, is rounding
inline constexpr double held_up = 1e-8;  ///< the same once shifted: the shift is all that holds it
inline constexpr double shift = 1e-10;   ///< over the size of the matrix: far above rounding, far below what resists

/// Shift of each row: alike for all in the units given, so that refinement comes to multipliers of least
/// norm in these; 1e-10 of the matrix, whose greatest and least diagonal entries meet in the middle.
/// @param diagonal  of the matrix on the multipliers, positive, in its own units
/// @param unit      factor that brings a row to the units that norms are taken in
inline void shifts(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& unit, Eigen::VectorXd& E) {
  if (diagonal.size() == 0) return;
  const auto like = diagonal.array() * unit.array().square();
  const double size = std::sqrt(like.maxCoeff()) * std::sqrt(like.minCoeff());
  E = (shift * size / unit.array().square()).min(1e3 * shift * diagonal.array()).max(1e-3 * shift * diagonal.array());
}

/// z of  K z = b  from a solver of the shifted matrix K − Σ ±E_i e_i e_iᵀ over the rows of multipliers, from
/// `rows` on. What is consistent is met to rounding, by multipliers of least norm; what is not, is missed by
/// least squares.
class Refinement {
 public:
  Refinement() = default;
  /// @param unit  brings residuals to like size
  Refinement(const Eigen::VectorXd& unit, Eigen::Index rows)
      : unit_(unit), b_(unit), left_(unit), before_(unit), last_(unit), rows_(rows) {}

  /// z: b on entry. solve(v): v ← shifted⁻¹ v; subtract_product(z, out): out −= K z; shifts_made: on the rows of multipliers, with
  /// its sign, where the multipliers are found whole and their part that does no work is to be taken off. No allocation.
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
    // What cannot be met adds the same to the multipliers at each sweep: the last one's, taken back.
    const Eigen::Index m = z.size() - rows_;
    z.tail(m) -= sweeps * last_.tail(m);
    if (shifts_made) take_null_part(z, solve, *shifts_made);
    left_over_ = size > 0 ? left_.tail(m).cwiseProduct(unit_.tail(m)).lpNorm<Eigen::Infinity>() / size : 0;
  }

  /// Rounding of residuals, over the shift, stays in the multipliers as a part that does no work: P z, P = (shifted⁻¹ shift)³ up to the
  /// cube of the shift over what resists. The shift is as the inverse squares of the units, so what is left is of least norm.
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

  /// Of the last solve: residual of the rows of multipliers over b, largest entries.
  double left_over() const { return left_over_; }

 private:
  double norm(const Eigen::VectorXd& v) const { return v.cwiseProduct(unit_).lpNorm<Eigen::Infinity>(); }

  Eigen::VectorXd unit_, b_, left_, before_, last_;
  Eigen::Index rows_ = 0;
  double left_over_ = 0;
};

}  // namespace dependent_rows
}  // namespace pintle
