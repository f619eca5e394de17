#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/equations/tangent.h"

namespace pintle {

class Writer;
class Reader;

/// The matrix of Newton's method on r = 0, C = 0:  K = [J Cqᵀ; Cq 0], J a weighted sum of tangents, not
/// symmetric in general. Dense if a third of the entries or more may be other than zero, up to `dense_size`
/// unknowns; else KLU, ordered and analysed once, here.
/// Unknowns and equations are brought to like size by what J and Cq hold, so conditioning follows neither
/// units nor the weights (nor the step). Theory: docs/theory/solvers.md.
class Kkt {
 public:
  static constexpr int dense_size = 80;

  Kkt(const System&, const Equations&, const Tangent&);
  ~Kkt();
  Kkt(Kkt&&) noexcept;

  /// @param J  the summands of Tangent::evaluate. After pose. Nothing of ours allocates; KLU does at the
  ///           first call and when its pivots have become bad.
  /// Of a row that is released −y = y of the right-hand side.
  /// @returns false if singular to working precision though dependent rows are allowed for
  bool factor(const System&, const Equations&, const std::vector<double>& J);
  /// x, y of  J x + Cqᵀ y = x,  Cq x = y, in place: n and n_rows. Of dependent rows y is the solution of
  /// least norm, rows in metres counted over the mechanism's length; of contradictory ones, x misses
  /// them by the least sum of squares. @pre factor returned true
  void solve(Eigen::VectorXd& x, Eigen::VectorXd& y);

  /// The next factorization is as the first.
  void forget();

  bool dependent() const;        ///< the last factorization met dependent rows
  double inconsistency() const;  ///< of the last solve: residual over right-hand side, both scaled; 0 if independent
  bool sparse() const;
  const char* solver() const;  ///< "dense LU" or "sparse LU (KLU)"
  long nonzeros() const;       ///< of the factors; size² when dense

  /// All that the next solve, and the next factorization, depend on; binary, for the same System and machine.
  void save(Writer&) const;
  /// @returns false if the stream holds something else; the matrix is then as if never factored
  bool load(Reader&);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pintle
