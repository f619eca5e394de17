#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace pintle {

/// An explicit Runge–Kutta pair. y₁ = y₀ + h Σ bᵢ kᵢ, error ≈ h Σ eᵢ kᵢ.
/// If `closes`, the last stage is evaluated at y₁ and is also the first stage of the next step.
struct Tableau {
  std::string_view name;
  int order;        ///< of y₁
  int error_order;  ///< of the lower member of the pair
  bool closes;
  std::vector<std::vector<double>> a;  ///< strictly lower triangle, one row per stage, without trailing zeros
  std::vector<double> b, c, e;
  double reach;  ///< stability limit hλ = −reach on the negative real axis
  /// Between the nodes y is its cubic + x²(1 − x)² h Σ dᵢ kᵢ, where the last k is the derivative at the step's end; empty: the cubic.
  std::vector<double> d = {};
  int stages() const { return static_cast<int>(b.size()); }
};

/// All schemes, by their names in scene files: rkf45 (Fehlberg, propagating the fifth order), dopri5 (Dormand and Prince), verner87
/// (Verner's most efficient 8(7), to 20 digits). Sources: [Fehlberg1969], [DormandPrince1980], [Verner2010].
std::span<const Tableau> tableaus();
/// @returns nullptr if there is none of that name
const Tableau* find_tableau(std::string_view name);

}  // namespace pintle
