#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

class Writer;
class Reader;

/// A = L U of a sparse matrix without symmetry, by KLU: pivots chosen at the first factorization, on the
/// diagonal where that is not small, and kept while they stay good, so that the next costs numbers only and
/// allocates nothing.
class SparseLu {
 public:
  /// @param order  order[k]: the unknown that is eliminated k-th
  SparseLu(Pattern, std::vector<int> order);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;

  /// @param values  one an entry of the pattern, of like size
  /// @returns false if a pivot is zero
  bool factor(const std::vector<double>& values);
  /// Smallest over largest pivot.
  double pivot_ratio() const;
  /// The next factorization chooses pivots.
  void forget();
  /// x ← A⁻¹ x. @pre factor returned true
  void solve(double* x);

  const Pattern& pattern() const;
  long nonzeros() const;   ///< of L and U; 0 before the first factorization
  long pivotings() const;  ///< how often pivots were chosen

  /// What the choice of pivots followed from; after `load` with the values factored last all goes on bit for
  /// bit. A stream that holds something else is left failed, and nothing factored.
  void save(Writer&) const;
  void load(Reader&, const std::vector<double>& values);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pintle
