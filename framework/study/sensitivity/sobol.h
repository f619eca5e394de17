#pragma once

#include <cstdint>
#include <vector>

/// Shares of inputs in a variance, by Saltelli's sampling: docs/studies.md.
namespace pintle {

/// Values at the points of two independent samples A and B, and of A with coordinate i taken from B, for each i. A row with a NaN is
/// ignored.
struct SobolValues {
  std::vector<double> a, b;
  std::vector<std::vector<double>> mixed;  ///< per input, then per point
};

/// A share and its 95 % confidence interval, by bootstrap.
struct Share {
  double value = 0, low = 0, high = 0;
};

struct SobolIndex {
  Share first;  ///< variance of the mean given this input, as a share of the total: f(B)(f(AB) − f(A)), Saltelli et al. (2010)
  Share total;  ///< share that would remain if all other inputs were known: (f(A) − f(AB))²/2, Jansen (1999)
};

/// For each input; NaN if fewer than two points are left, or nothing varies.
std::vector<SobolIndex> sobol_indices(const SobolValues&, std::uint64_t seed);

/// x with Φ(x) = u, for the standard normal distribution; within ±9. @pre 0 ≤ u < 1
double normal_quantile(double u);

}  // namespace pintle
