#pragma once

#include <Eigen/SparseCore>
#include <string>

#include "eigen_layout.h"

namespace pintle {

struct EigenOptions {
  int count = 6;  ///< p: how many pairs
  /// The distance of λ to an exact eigenvalue is at most this share of max(|λ|, |μ|).
  double tolerance = 1e-9;
  double shift = 0;  ///< μ < 0: K − μM is factored [rad²/s²]. 0: default, −1e-10 ΣK_ii/ΣM_ii
  int max_iterations = 200;
  bool check = true;  ///< Sturm: count the eigenvalues below the last one and compare
  unsigned seed = 1;  ///< of the random starting vectors
};

/// The lowest pairs of K φ = λ M φ, K and M symmetric, K positive semidefinite, M positive
/// semidefinite.
struct EigenPairs {
  Eigen::VectorXd lambda;    ///< ascending, p [rad²/s²]; rigid motions are ~0, of either sign
  Eigen::MatrixXd shapes;    ///< n × p, ΦᵀMΦ = I; the largest entry of each is positive
  Eigen::VectorXd residual;  ///< ‖Kφ − λMφ‖ / (λ‖Mφ‖); for rigid motions ‖Kφ‖ / ‖|K||φ|‖; p
  int zero = 0;              ///< number of rigid motions (λ = 0 to rounding)
  int missed = 0;            ///< by the Sturm check; 0 if the check succeeded
  bool checked = false;
  bool converged = false;
  int iterations = 0;
  long solves = 0;     ///< right-hand sides solved
  std::string reason;  ///< if not converged, in words; there may then be fewer than p pairs
};

/// Bathe's subspace iteration with all turning vectors kept; small or nearly complete problems are solved densely. Both triangles of K and
/// M are stored. Same input, machine and number of threads give the same bits. Sources: [Bathe2014], [KimBathe2017], [Bathe2013]. Theory:
/// docs/theory/modes.md.
/// @throws std::invalid_argument  K or M not square or of different sizes; count < 1; shift > 0; count > rank of M: "9 modes asked for, the
/// body has 6"
/// @throws std::runtime_error     K − μM cannot be factored: a part without stiffness and mass
EigenPairs eigen_lowest(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, const EigenOptions& = {});

/// All pairs with λ < `limit`; count is ignored. Found by Sturm count, then `eigen_lowest`.
EigenPairs eigen_below(const Eigen::SparseMatrix<double>& K, const Eigen::SparseMatrix<double>& M, double limit, const EigenOptions& = {});

}  // namespace pintle
