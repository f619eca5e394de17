#pragma once

#include <algorithm>
#include <array>
#include <cmath>

/// Embedded Runge–Kutta pairs of order 5(4) for small autonomous systems; fixed size, no
/// allocation. The fifth-order result is carried on. The first `D` of `N` components are dynamic;
/// the other ones are integrals on whose values the right-hand side does not depend.
namespace pintle_oracle {

template <int N>
using Vec = std::array<double, N>;

/// Fehlberg, 6 stages.
struct Rkf45 {
  static constexpr bool fsal = false;
  static constexpr double a[6][5] = {{},
                                     {1.0 / 4},
                                     {3.0 / 32, 9.0 / 32},
                                     {1932.0 / 2197, -7200.0 / 2197, 7296.0 / 2197},
                                     {439.0 / 216, -8, 3680.0 / 513, -845.0 / 4104},
                                     {-8.0 / 27, 2, -3544.0 / 2565, 1859.0 / 4104, -11.0 / 40}};
  static constexpr double b[6] = {16.0 / 135, 0, 6656.0 / 12825, 28561.0 / 56430, -9.0 / 50, 2.0 / 55};
  static constexpr double e[7] = {1.0 / 360, 0, -128.0 / 4275, -2197.0 / 75240, 1.0 / 50, 2.0 / 55, 0};  ///< fifth less fourth order
};

/// Dormand–Prince, 6 stages and the first of the next step.
struct Dopri54 {
  static constexpr bool fsal = true;
  static constexpr double a[6][5] = {{},
                                     {1.0 / 5},
                                     {3.0 / 40, 9.0 / 40},
                                     {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                     {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                     {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656}};
  static constexpr double b[6] = {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84};
  static constexpr double e[7] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
};

/// One step of size h from y, where k1 = f(y). @returns the number of evaluations of f.
/// `k_end` = f(y_new) is filled by pairs that need it (fsal).
template <class Pair, int D, int N, class F>
int embedded_step(const F& f, const Vec<N>& y, const Vec<N>& k1, double h, Vec<N>& y_new, Vec<N>& k_end, Vec<N>& error) {
  Vec<N> k[6];
  k[0] = k1;
  Vec<N> stage{};
  for (int s = 1; s < 6; ++s) {
    for (int i = 0; i < D; ++i) {
      double sum = 0;
      for (int j = 0; j < s; ++j) sum += Pair::a[s][j] * k[j][i];
      stage[i] = y[i] + h * sum;
    }
    f(stage, k[s]);
  }
  for (int i = 0; i < N; ++i) {
    double sum = 0, difference = 0;
    for (int s = 0; s < 6; ++s) {
      sum += Pair::b[s] * k[s][i];
      difference += Pair::e[s] * k[s][i];
    }
    y_new[i] = y[i] + h * sum;
    error[i] = h * difference;
  }
  if constexpr (Pair::fsal) {
    f(y_new, k_end);
    for (int i = 0; i < N; ++i) error[i] += h * Pair::e[6] * k_end[i];
    return 6;
  }
  return 5;
}

/// Greatest of |error| / (tolerance · scale); a step is accepted at 1 or less.
template <int N>
double error_ratio(const Vec<N>& error, const Vec<N>& scale, double tolerance) {
  double worst = 0;
  for (int i = 0; i < N; ++i) worst = std::max(worst, std::abs(error[i]) / scale[i]);
  return worst / tolerance;
}

/// Factor for the next step size after a step of that error ratio.
inline double step_factor(double ratio) { return ratio > 0 ? std::clamp(0.9 * std::pow(ratio, -0.2), 0.2, 5.0) : 5.0; }

/// Plain adaptive integration of y′ = f(y) over a span, by Dormand–Prince. Scale of component i:
/// scale[i] + |y[i]|.
template <int N, class F>
Vec<N> integrate_tightly(const F& f, Vec<N> y, double span, double tolerance, const Vec<N>& scale) {
  Vec<N> k{}, y_new{}, k_end{}, error{};
  f(y, k);
  double t = 0, h = span * 1e-4;
  while (t < span) {
    const bool last = t + h >= span;
    if (last) h = span - t;
    embedded_step<Dopri54, N, N>(f, y, k, h, y_new, k_end, error);
    Vec<N> weight;
    for (int i = 0; i < N; ++i) weight[i] = scale[i] + std::abs(y[i]);
    const double ratio = error_ratio<N>(error, weight, tolerance);
    if (ratio <= 1) {
      t = last ? span : t + h;
      y = y_new;
      k = k_end;
    }
    h *= step_factor(ratio);
  }
  return y;
}

}  // namespace pintle_oracle
