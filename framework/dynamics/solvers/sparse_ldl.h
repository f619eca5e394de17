#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

/// An elimination order, order[k] eliminated k-th, that gives little fill in a symmetric positive definite matrix with entries at `places`
/// (either triangle, and the whole diagonal): AMD, or for many rows nested dissection where AMD gives much fill.
std::vector<int> fill_reducing_order(int size, std::vector<Pattern::Place> places);

/// S = L D Lᵀ of a sparse symmetric matrix without pivoting. Ordered as above and analysed once. A thin factor is computed
/// column by column by LDL, without allocation; a thick one, with more than `thick` operations per entry of L, in dense blocks by CHOLMOD.
class SparseLdl {
 public:
  static constexpr double thick = 40;
  static constexpr int few = 100;  ///< rows, up to which it is always a thin factor, ordered by AMD alone: CHOLMOD takes time to load

  /// @param places  of the summands, either triangle; `where` ← the entry of `values` that each belongs to
  /// @pre places include every diagonal entry
  SparseLdl(int size, const std::vector<Pattern::Place>& places, std::vector<int>& where);
  ~SparseLdl();
  SparseLdl(SparseLdl&&) noexcept;

  int entries() const;                       ///< number of values
  const std::vector<int>& diagonal() const;  ///< entry of S_ii
  /// @returns the smallest ratio of a pivot to its diagonal entry; 0: not factored, a pivot was not positive
  double factor(const std::vector<double>& values);
  /// Number of pivots below `ratio` times their diagonal entry; lowers `least` to the smallest ratio of the others.
  /// @pre as solve; values as factored
  int below(const std::vector<double>& values, double ratio, double& least) const;
  /// xᵀSx / Σ S_ii x_i² for x = S⁻¹e, where e is for the row of the smallest pivot. @pre as for solve; values as factored
  double smallest_quotient(const std::vector<double>& values);
  /// Largest number of entries in a row of L + Lᵀ: the number of roundings that can add up in a row. @pre as for solve
  int width();
  void solve(double* x);  ///< x ← S⁻¹ x. @pre factor returned a positive number
  /// out −= S x
  void subtract_product(const std::vector<double>& values, const double* x, double* out) const;

  bool thin() const;
  double nonzeros() const;  ///< of L

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace pintle
