#pragma once

#include <vector>

#include "framework/component/fe/fe_model.h"

namespace pintle {

enum class MassKind { consistent, lumped };

/// Sparse matrices of a model, N × N in nodal freedoms, both triangles stored. Which nodes meet is
/// found once; each matrix is then a pass over the elements that only adds values. K, M, G and K_g
/// have one pattern, zeros of it included, rows ascending. Time and memory are linear in elements.
class Assembler {
 public:
  explicit Assembler(const FeModel&);  ///< the model must outlive it
  Sparse stiffness() const;            ///< symmetric
  /// Symmetric, with the lumps. Lumped: the diagonal alone is stored.
  Sparse mass(MassKind = MassKind::consistent) const;
  Sparse skew_mass() const;  ///< G, skew, with the lumps
  /// K_g of the stress that nodal displacement u, N, causes. Symmetric.
  Sparse geometric_stiffness(const Eigen::VectorXd& u) const;

 private:
  Sparse zeros() const;

  const FeModel& model_;
  std::vector<int> neighbour_begin_,
      neighbour_;  ///< nodes that share an element with each, ascending
};

/// LᵀAL; A itself where nothing is coupled. Matrices of one pattern keep one pattern.
Sparse independent(const FeModel&, Sparse A);

/// Rows and columns of A in `keep`, which ascends.
Sparse restricted(const Sparse& A, const std::vector<int>& keep);

}  // namespace pintle
