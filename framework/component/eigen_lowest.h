#pragma once

#include <string>

#include <Eigen/SparseCore>

namespace pintle {

struct EigenOptions {
  int count = 6;            ///< p: how many pairs
  double tolerance = 1e-9;  ///< on the residual ‖Kφ − λMφ‖ / (‖Kφ‖ + |λ|‖Mφ‖ + shift's share): docs/theory/modes.md
  double shift = 0;         ///< μ ≤ 0: K − μM is factored. 0: chosen (0 for a held body, else below the first bending mode)
  int max_iterations = 200;
  bool check = true;        ///< Sturm: count the eigenvalues below the last one and compare
  unsigned seed = 1;        ///< of the random starting vectors
};

/// The lowest pairs of K φ = λ M φ, K and M symmetric, K positive semidefinite, M positive semidefinite.
struct EigenPairs {
  Eigen::VectorXd lambda;    ///< ascending, p [rad²/s²]; rigid motions are ~0, of either sign
  Eigen::MatrixXd shapes;    ///< n × p, ΦᵀMΦ = I
  Eigen::VectorXd residual;  ///< p
  int zero = 0;              ///< how many are rigid motions (λ = 0 to rounding)
  int missed = 0;            ///< by the Sturm check; 0 after a check that holds
  bool checked = false;
  bool converged = false;
  int iterations = 0;
  long solves = 0;           ///< right-hand sides solved
  std::string reason;        ///< when not converged, in words
};

/// Bathe's subspace iteration with enrichment; small or nearly complete problems are solved densely.
/// Sources: [Bathe2014], [KimBathe2017], [Bathe2013]. Theory: docs/theory/modes.md.
/// @throws std::invalid_argument  count < 1 or count > n (rank of M): "9 modes asked for, there are 6"
/// @throws std::runtime_error     K − μM cannot be factored
EigenPairs eigen_lowest(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M,
                        const EigenOptions& = {});

/// All pairs with λ < `limit`; count is ignored. Found by Sturm count, then `eigen_lowest`.
EigenPairs eigen_below(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M,
                       double limit, const EigenOptions& = {});

}  // namespace pintle
