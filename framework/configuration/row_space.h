#pragma once

#include <utility>
#include <vector>

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// A combination of rows of Cq that is zero: Nᵀ diag(row_scale) Cq = 0. docs/theory/constraints.md
struct Dependence {
  std::vector<std::pair<int, double>> N;  ///< row and weight, rows ascending; the last weight is 1
};

/// Rank and dependences of the rows of Cq in a configuration.
struct RowSpace {
  int rank = 0;
  std::vector<Dependence> dependences;  ///< a basis, each ending with a row of its own: the redundant one
};

/// The rank of Cq and a basis of the combinations of its rows that are zero, by a sparse QR of Cqᵀ with rows scaled to equal length. Rows
/// of released joints do not count. After pose.
/// @param tolerance  remainder of a row of length 1 that counts as zero
RowSpace row_space(const System&, const Equations&, double tolerance = 1e-7);

}  // namespace pintle
