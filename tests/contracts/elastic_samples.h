#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "contact/cylinder_law.h"

/// Laws without power for the exam of normal laws, each beside its force as its author prints it: implicit ones by bisection.
namespace pintle::elastic_samples {

constexpr double young = 207e9, poisson = 0.3, length = 15e-3;
/// Of both bodies together.
inline double modulus() { return 1 / (2 * (1 - poisson * poisson) / young); }

/// The root of a rising function between low and high, to the last bit.
template <class F>
double bisect(double low, double high, F f) {
  for (;;) {
    const double middle = low + (high - low) / 2;
    if (middle <= low || middle >= high) return middle;
    (f(middle) < 0 ? low : high) = middle;
  }
}

/// The force of a published depth(force) up to the force where its last slope is taken, straight from there.
template <class Depth>
double force_of(double depth, double last, double slope, Depth published) {
  if (const double end = published(last); depth >= end) return last + slope * (depth - end);
  return bisect(0, last, [&](double f) { return published(f) - depth; });
}

struct Geometry {
  double a, b;  ///< radii, < 0 of a hole [m]
  double D, R;  ///< ΔR, and R_i R_j/ΔR [m]
};
inline Geometry pin_in_hole(double clearance) { return {10e-3 - clearance, -10e-3, clearance, (10e-3 - clearance) * 10e-3 / clearance}; }
inline Geometry discs() { return {10e-3, 20e-3, 30e-3, 10e-3 * 20e-3 / 30e-3}; }
/// Of the layer of winkler: pressure over local depth, and thickness.
constexpr double foundation = 4e12, layer = 1e-3;
inline Cylinders cylinders(const Geometry& g) { return {g.a, g.b, length, modulus(), foundation, layer}; }
inline DampedLaw law(const char* name, const Geometry& g) { return find_cylinder_law(name)->law(cylinders(g)); }

/// Johnson 1985 (5.57) of both bodies, with Hertz's half-width a.
inline double johnson(const Geometry& g, double depth) {
  const double S = M_PI * modulus() * length;
  return force_of(depth, S * g.D * 4 * std::exp(-3.0), S, [&](double f) {
    const double a = std::sqrt(4 * f * g.R / S);
    return f > 0 ? f / S * (std::log(4 * std::abs(g.a) / a) + std::log(4 * std::abs(g.b) / a) - 1) : 0;
  });
}
/// Radzimovsky 1953 as Roark prints it, with diameters and the width b of the contact.
inline double radzimovsky(const Geometry& g, double depth) {
  const double E = modulus(), S = M_PI * E * length;
  const double last = 2 * E * length * g.D * 4 / 2.56 * std::exp(2.0 / 3 - 2);
  return force_of(depth, last, S, [&](double f) {
    const double K_D = 2 * g.R, b = 1.60 * std::sqrt(f / length * K_D / E);
    return f > 0 ? f / S * (2.0 / 3 + std::log(2 * 2 * std::abs(g.a) / b) + std::log(2 * 2 * std::abs(g.b) / b)) : 0;
  });
}
/// Goldsmith 1960, with σ = (1 − ν²)/(πE) of each and L³ within the logarithm.
inline double goldsmith(const Geometry& g, double depth) {
  const double sigma = (1 - poisson * poisson) / (M_PI * young);
  return force_of(depth, std::pow(length, 3) / (g.R * 2 * sigma) / M_E, length / (2 * sigma), [&](double f) {
    return f > 0 ? f * 2 * sigma / length * (std::log(std::pow(length, 3) / (f * g.R * 2 * sigma)) + 1) : 0;
  });
}
/// ESDU 78035.
inline double esdu(const Geometry& g, double depth) {
  const double sigma = (1 - poisson * poisson) / (M_PI * young);
  return force_of(depth, 4 * length * g.D / (2 * sigma) / M_E, length / (2 * sigma),
                  [&](double f) { return f > 0 ? f * 2 * sigma / length * (std::log(4 * length * g.D / (f * 2 * sigma)) + 1) : 0; });
}
/// Liu, Zhang and Yang 2007.
inline double liu(const Geometry& g, double depth) {
  return 0.5 * M_PI * depth * modulus() * length * std::sqrt(depth / (2 * (g.D + depth)));
}
/// Pereira, Ramalho and Ambrósio 2011, in N and mm.
inline double pereira_exponent(const Geometry& g) {
  const double D = 1e3 * g.D, Y = D < 0.34954 ? 1.51 * std::pow(std::log(1000 * D), -0.151) : 0.0151 * D + 1.151;
  return g.b < 0 ? Y * std::pow(D, -0.005) : 1.094;
}
inline double pereira(const Geometry& g, double depth) {
  const double D = 1e3 * g.D, E = 1e-6 * modulus(), L = 1e3 * length, a = g.b < 0 ? 0.965 : 0.39, b = g.b < 0 ? 0.0965 : 0.85;
  return (a * D + b) * L * E / D * std::pow(1e3 * depth, pereira_exponent(g));
}

/// ∫ f over −1 … 1 by Gauss and Legendre with sixteen points, the roots of P₁₆ by Newton's method.
template <class F>
double gauss(F f) {
  constexpr int n = 16;
  static const auto rule = [] {
    std::array<std::array<double, 2>, n> out;
    for (int i = 0; i < n; ++i) {
      double x = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 1;
      for (int k = 0; k < 10; ++k) {
        double before = 1, now = x;
        for (int j = 2; j <= n; ++j) before = std::exchange(now, ((2 * j - 1) * x * now - (j - 1) * before) / j);
        slope = n * (x * now - before) / (x * x - 1);
        x -= now / slope;
      }
      out[static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
    }
    return out;
  }();
  double sum = 0;
  for (const auto& [x, weight] : rule) sum += weight * f(x);
  return sum;
}
/// Winkler's foundation: the pressure K · local depth summed over where that is above 0. In a hole the local depth is
/// (ΔR + δ) cos φ − ΔR = 2 (ΔR + δ) sin((φ₀ − φ)/2) sin((φ₀ + φ)/2), between parabolas δ − y²/(2R).
inline double winkler(const Geometry& g, double depth) {
  if (g.b > 0) {
    const double a = std::sqrt(2 * g.R * depth);
    return foundation * length * a * gauss([&](double x) { return depth * (1 - x * x); });
  }
  const double e = g.D + depth, end = std::atan2(std::sqrt(depth * (2 * g.D + depth)), g.D);
  return foundation * length * std::sqrt(std::abs(g.a * g.b)) * end *
         gauss([&](double x) { return 2 * e * std::sin(end * (1 - x) / 2) * std::sin(end * (1 + x) / 2) * std::cos(end * x); });
}

inline const std::vector<std::array<double, 2>>& points() {
  static const std::vector<std::array<double, 2>> all{{0, 0}, {1.3e-6, 40}, {2.1e-6, 90}, {7e-6, 800}, {3e-5, 2600}, {4e-5, 9000}};
  return all;
}
/// Cubics in Hermite's basis, slopes of Fritsch and Butland.
inline double table(double depth) {
  const auto& p = points();
  const std::size_t n = p.size();
  const auto h = [&](std::size_t i) { return p[i + 1][0] - p[i][0]; };
  const auto s = [&](std::size_t i) { return (p[i + 1][1] - p[i][1]) / h(i); };
  const auto end = [](double h0, double h1, double s0, double s1) {
    const double d = s0 + h0 / (h0 + h1) * (s0 - s1);
    return d < 0 ? 0 : d > 3 * s0 ? 3 * s0 : d;
  };
  const auto slope = [&](std::size_t i) {
    if (i == 0) return end(h(0), h(1), s(0), s(1));
    if (i == n - 1) return end(h(n - 2), h(n - 3), s(n - 2), s(n - 3));
    const double alpha = (1 + h(i) / (h(i - 1) + h(i))) / 3;
    return s(i - 1) * s(i) / (alpha * s(i) + (1 - alpha) * s(i - 1));
  };
  if (depth >= p.back()[0]) return p.back()[1] + slope(n - 1) * (depth - p.back()[0]);
  std::size_t i = 0;
  while (depth >= p[i + 1][0]) ++i;
  const double t = (depth - p[i][0]) / h(i), r = 1 - t;
  return p[i][1] * r * r * (1 + 2 * t) + h(i) * slope(i) * t * r * r + p[i + 1][1] * t * t * (3 - 2 * t) - h(i) * slope(i + 1) * t * t * r;
}

struct Sample {
  std::string name;
  DampedLaw law;
  std::function<double(double)> force;  ///< as published
  double exponent = 1;                  ///< at touch
};
template <class F>
Sample of(const char* name, const Geometry& g, F published, double exponent = 1) {
  return {name, law(name, g), [g, published](double depth) { return published(g, depth); }, exponent};
}
inline const std::vector<Sample>& all() {
  static const std::vector<Sample> samples{
      of("johnson", pin_in_hole(1e-4), johnson),
      of("johnson", discs(), johnson),
      of("radzimovsky", pin_in_hole(5e-5), radzimovsky),
      of("radzimovsky", discs(), radzimovsky),
      of("goldsmith", pin_in_hole(1e-4), goldsmith),
      of("goldsmith", discs(), goldsmith),
      of("esdu", pin_in_hole(5e-4), esdu),
      of("liu", pin_in_hole(1e-4), liu, 1.5),
      of("pereira", pin_in_hole(1e-4), pereira, pereira_exponent(pin_in_hole(1e-4))),
      of("pereira", pin_in_hole(5e-4), pereira, pereira_exponent(pin_in_hole(5e-4))),
      of("pereira", discs(), pereira, 1.094),
      of("winkler", pin_in_hole(1e-4), winkler, 1.5),
      of("winkler", pin_in_hole(2e-3), winkler, 1.5),
      of("winkler", discs(), winkler, 1.5),
      {"table", {.elastic = force_table(points()), .deepest = points().back()[0], .name = "table"}, table},
  };
  return samples;
}

}  // namespace pintle::elastic_samples
