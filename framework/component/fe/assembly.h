#pragma once

#include <vector>

#include "framework/component/fe/fe_model.h"

namespace pintle {

enum class MassKind { consistent, lumped };

/// Sparse matrices of a model, N × N in nodal dofs, both triangles stored. The pattern is found once; each matrix is then a pass over
/// the elements that only adds values. K, M, G and K_g have the same pattern, including its zeros, with ascending rows. Time and memory are
/// linear in the number of elements.
class Assembler {
 public:
  explicit Assembler(const FeModel&);  ///< the model must outlive it
  Sparse stiffness() const;            ///< symmetric
  /// Symmetric, including the lumps. Lumped: only the diagonal is stored.
  Sparse mass(MassKind = MassKind::consistent) const;
  Sparse skew_mass() const;  ///< G, skew-symmetric, including the lumps
  /// K_g for the stress caused by nodal displacements u, N. Symmetric.
  Sparse geometric_stiffness(const Eigen::VectorXd& u) const;

 private:
  Sparse zeros() const;

  const FeModel& model_;
  std::vector<int> neighbour_begin_,
      neighbour_;  ///< nodes that share an element with each node, ascending
};

/// LᵀAL; A itself where nothing is coupled. Matrices with the same pattern keep a common pattern.
Sparse independent(const FeModel&, Sparse A);

/// Rows and columns of A in `keep`, which ascends.
Sparse restricted(const Sparse& A, const std::vector<int>& keep);

}  // namespace pintle
