#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/equations/tangent.h"

namespace pintle {

class Writer;
class Reader;

/// The matrix of Newton's method on r = 0, C = 0:  K = [J Cqᵀ; Cq 0], where J is a weighted sum of tangents, in general not symmetric.
/// Dense up to `dense_size` unknowns if a third of the entries or more may be nonzero; otherwise KLU, ordered and analysed once, here.
/// Unknowns and equations are scaled to similar size by the entries of J and Cq, so conditioning depends neither on units nor on the
/// weights or the step size. Theory: docs/theory/solvers.md.
class Kkt {
 public:
  static constexpr int dense_size = 80;

  Kkt(const System&, const Equations&, const Tangent&);
  ~Kkt();
  Kkt(Kkt&&) noexcept;

  /// @param J  the summands of Tangent::evaluate. After pose. Allocates only in KLU: at the first call, and when its pivots have become
  /// bad.
  /// The equation of a released row is −y = right-hand side.
  /// @returns false if singular to working precision, although dependent rows are allowed for
  bool factor(const System&, const Equations&, const std::vector<double>& J);
  /// Replaces the right-hand sides x, y (n, n_rows) by the solution of  J x' + Cqᵀ y' = x,  Cq x' = y. For dependent rows, y is the
  /// solution of least norm, with rows in metres scaled by the mechanism's length; contradictory rows are satisfied by x in the
  /// least-squares sense. @pre factor returned true
  void solve(Eigen::VectorXd& x, Eigen::VectorXd& y);

  /// Discards all results: the next factorization starts from scratch.
  void forget();

  bool dependent() const;        ///< whether the last factorization found dependent rows
  double inconsistency() const;  ///< of the last solve: residual over right-hand side, both scaled; 0 if independent
  bool sparse() const;
  const char* solver() const;  ///< "dense LU" or "sparse LU (KLU)"
  long nonzeros() const;       ///< of the factors; size² when dense

  /// Everything that the next solve and the next factorization depend on; binary, for the same System and machine.
  void save(Writer&) const;
  /// @returns false if the stream holds something else; the matrix is then as before the first factorization
  bool load(Reader&);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pintle
