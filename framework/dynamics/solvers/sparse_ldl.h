#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/solvers/pattern.h"

namespace pintle {

/// An order of elimination, order[k] the k-th, that leaves a symmetric positive definite matrix with entries at
/// `places` (either triangle, the diagonal besides) little fill: AMD, nested dissection where that leaves much.
std::vector<int> fill_reducing_order(int size, std::vector<Pattern::Place> places);

/// S = L D Lᵀ of a sparse symmetric matrix without pivoting. Ordered and analysed once, by CHOLMOD (AMD,
/// nested dissection where that leaves much fill). A thin factor is made column by column by LDL, without
/// allocation; a thick one, of more than `thick` operations per entry of L, in dense blocks by CHOLMOD.
class SparseLdl {
 public:
  static constexpr double thick = 40;

  /// @param places  of the summands, either triangle; `where` ← the entry of `values` that each belongs to
  /// @pre every diagonal place among them
  SparseLdl(int size, const std::vector<Pattern::Place>& places, std::vector<int>& where);
  ~SparseLdl();
  SparseLdl(SparseLdl&&) noexcept;

  int entries() const;                       ///< how many values
  const std::vector<int>& diagonal() const;  ///< entry of S_ii
  /// @returns the smallest pivot over the diagonal entry it came from; 0: not factored, a pivot was not positive
  double factor(const std::vector<double>& values);
  /// Pivots below `ratio` of the diagonal entry they came from; `least` ← the smallest ratio of the others, if less.
  /// @pre as solve; values as factored
  int below(const std::vector<double>& values, double ratio, double& least) const;
  /// xᵀSx / Σ S_ii x_i² of x = S⁻¹e for the row of the smallest pivot. @pre as solve; values as factored
  double smallest_quotient(const std::vector<double>& values);
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
