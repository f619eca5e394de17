#pragma once

#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

/// An order in which the unknowns of [J Cqᵀ; Cq 0] can be eliminated with pivots on the diagonal and little fill: coordinates before the
/// rows that depend on them. order[k] is eliminated k-th; rows are numbered from n on. If J couples no two bodies and no body has very many
/// joints: all coordinates, then the rows in a fill-reducing order of S = Cq J⁻¹ Cqᵀ. Otherwise body by body, each followed by at most as
/// many rows as it has coordinates.
/// @param J  positions of J's entries
std::vector<int> elimination_order(const System&, const Equations&, const std::vector<Pattern::Place>& J);

}  // namespace pintle
