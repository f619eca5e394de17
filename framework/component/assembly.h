#pragma once

#include "framework/component/fe_model.h"

namespace pintle {

enum class MassKind { consistent, lumped };

/// Sparse matrices of a model, N × N in nodal freedoms, both triangles stored. The pattern is found
/// once; each matrix is then a pass over the elements that only adds values. Linear in elements.
class Assembler {
 public:
  explicit Assembler(const FeModel&);  ///< the model must outlive it
  Sparse stiffness() const;
  Sparse mass(MassKind = MassKind::consistent) const;
  Sparse skew_mass() const;
  /// K_g of the stress that nodal displacement u causes.
  Sparse geometric_stiffness(const Eigen::VectorXd& u) const;

 private:
  const FeModel& model_;
  Sparse pattern_;  ///< zeros
};

/// LᵀAL; A itself where nothing is coupled.
Sparse independent(const FeModel&, Sparse A);

}  // namespace pintle
