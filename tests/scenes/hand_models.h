#pragma once

// What models written by hand share: a step of Runge and Kutta, and a table read from a file. Nothing of the library's.
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace pintle_hand {

/// The state after a step h of x' = rate(t, x), by the classic fourth-order method.
template <std::size_t n, class Rate>
std::array<double, n> runge_kutta(const std::array<double, n>& x, double t, double h, const Rate& rate) {
  const auto ahead = [&](const std::array<double, n>& slope, double by) {
    std::array<double, n> out = x;
    for (std::size_t i = 0; i < n; ++i) out[i] += by * slope[i];
    return out;
  };
  const auto a = rate(t, x), b = rate(t + h / 2, ahead(a, h / 2)), c = rate(t + h / 2, ahead(b, h / 2)), d = rate(t + h, ahead(c, h));
  std::array<double, n> out = x;
  for (std::size_t i = 0; i < n; ++i) out[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  return out;
}

/// The h in (0, most] at which value(h) passes through zero, which it does once, to rounding.
template <class Value>
double crossing(double most, const Value& value) {
  double low = 0, high = most;
  const bool ends_above = value(most) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((value(middle) > 0) == ends_above ? high : low) = middle;
  }
  return high;
}

/// Straight lines between the rows "x,y" of a file; beyond them the values at the ends.
struct Lines {
  std::vector<double> x, y;
  double at(double place) const {
    if (place <= x.front()) return y.front();
    for (std::size_t i = 1; i < x.size(); ++i)
      if (place < x[i]) return y[i - 1] + (y[i] - y[i - 1]) * (place - x[i - 1]) / (x[i] - x[i - 1]);
    return y.back();
  }
};
inline Lines read_lines(const std::string& file) {
  Lines out;
  std::ifstream in(file);
  for (std::string row; std::getline(in, row);) {
    std::istringstream words(row);
    double x = 0, y = 0;
    char comma = 0;
    if (words >> x >> comma >> y) out.x.push_back(x), out.y.push_back(y);
  }
  return out;
}

}  // namespace pintle_hand
