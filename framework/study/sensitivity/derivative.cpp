#include "framework/study/sensitivity/derivative.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pintle {

Derivative derivative(double step, const std::vector<double>& plus, const std::vector<double>& minus) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Derivative best{nothing, nothing};
  std::vector<double> above;  // the previous row of Neville's table
  for (std::size_t k = 0; k < plus.size() && std::isfinite(plus[k]) && std::isfinite(minus[k]); ++k) {
    const double h = std::ldexp(step, -static_cast<int>(k));
    std::vector<double> row{(plus[k] - minus[k]) / (2 * h)};
    double four = 1;
    for (std::size_t j = 0; j < above.size(); ++j) {
      four *= 4;
      row.push_back(row[j] + (row[j] - above[j]) / (four - 1));
      const double apart = std::max(std::abs(row[j + 1] - row[j]), std::abs(row[j + 1] - above[j]));
      const double rounding = 2 * std::numeric_limits<double>::epsilon() * std::max(std::abs(plus[k]), std::abs(minus[k])) / h;
      const double error = 2 * apart + rounding;
      if (!(error >= best.error)) best = {row[j + 1], error};
    }
    if (k == 0) best.value = row[0];
    above = row;
  }
  return best;
}

}  // namespace pintle
