#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

class Writer;
class Reader;

/// A = L U of a sparse unsymmetric matrix, by KLU. Pivots are chosen at the first factorization, on the diagonal where that is not small,
/// and kept while they remain good, so that later factorizations only recompute numbers and allocate nothing.
class SparseLu {
 public:
  /// @param order  order[k]: the unknown that is eliminated k-th
  SparseLu(Pattern, std::vector<int> order);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;

  /// @param values  one per entry of the pattern, of similar size
  /// @returns false if a pivot is zero
  bool factor(const std::vector<double>& values);
  /// Smallest over largest pivot.
  double pivot_ratio() const;
  /// Makes the next factorization choose pivots again.
  void forget();
  /// x ← A⁻¹ x. @pre factor returned true
  void solve(double* x);

  const Pattern& pattern() const;
  long nonzeros() const;  ///< of L and U; 0 before the first factorization

  /// The data from which the pivots were chosen; after `load` with the values factored last, results continue bit for bit. A stream that
  /// holds something else is left in the failed state, and nothing is factored.
  void save(Writer&) const;
  void load(Reader&, const std::vector<double>& values);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pintle
