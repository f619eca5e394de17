#pragma once

#include <utility>
#include <vector>

#include "framework/dynamics/equations/equations.h"

namespace pintle {

/// A combination of rows of Cq that vanishes: Nᵀ diag(row_scale) Cq = 0. docs/theory/constraints.md
struct Dependence {
  std::vector<std::pair<int, double>> N;  ///< row and weight, rows ascending; the last weight is 1
};

/// What the rows of Cq are worth at a pose.
struct RowSpace {
  int rank = 0;
  std::vector<Dependence> dependences;  ///< a basis, each ending in a row of its own: the idle one
};

/// The rank of Cq and a basis of the combinations of its rows that vanish, by a sparse QR of Cqᵀ, rows brought to
/// one length. Rows of released joints are none. After pose.
/// @param tolerance  what of a row of length 1 counts as nothing
RowSpace row_space(const System&, const Equations&, double tolerance = 1e-7);

}  // namespace pintle
