#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "eigen_layout.h"
#include "framework/component/eigen/factor.h"

namespace pintle {

/// The supernodes of A = L Lᵀ in a given order, found from the pattern of A.
class Symbolic {
 public:
  /// @param A  symmetric; the lower triangle is read
  /// @param order  order[k]: the degree of freedom that is eliminated k-th, a postorder of the elimination tree, as CHOLMOD's are.
  ///     Must outlive this object
  Symbolic(const Eigen::SparseMatrix<double>& A, const int* order);
  Supernodes supernodes() const;

 private:
  int n_;
  const int* order_;
  std::vector<int> first_, row_begin_, row_;
};

}  // namespace pintle
