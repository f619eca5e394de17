#include "contact/cylinder_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace pintle {

namespace {

using std::numbers::pi;
constexpr std::string_view wide =
    "the contact spans more than 30 degrees to either side, where half-spaces no longer approximate the bodies; use a table";

/// ΔR, the difference of the radii of pin and hole or the sum of those of two round cylinders, and R = R_i R_j/ΔR [m].
double difference(const Cylinders& c) { return std::abs(c.a + c.b); }
double reduced_radius(const Cylinders& c) { return std::abs(c.a * c.b) / difference(c); }

/// The force at which Hertz's half-width 2√(F R/(π E* L)) spans 30° of the smaller cylinder [N].
double force_of_half_angle(const Cylinders& c) {
  const double half_width = pi / 6 * std::min(std::abs(c.a), std::abs(c.b));
  return pi * c.modulus * c.length * half_width * half_width / (4 * reduced_radius(c));
}

double depth_under(const LogarithmicForce& law, double force) { return force / law.S * std::log(law.G / force); }

/// δ = F/(πE*L) [ln(4πE*L ΔR/F) + C], for half-spaces; the authors differ in the depth below the surface to which δ refers, that is in C.
DampedLaw of_half_spaces(const Cylinders& c, double C) {
  const double S = pi * c.modulus * c.length;
  const LogarithmicForce line{S, 4 * S * difference(c) * std::exp(C)};
  return {.elastic = line, .deepest = depth_under(line, force_of_half_angle(c)), .limit = wide};
}

DampedLaw johnson(const Cylinders& c) { return of_half_spaces(c, -1); }
DampedLaw esdu(const Cylinders& c) { return of_half_spaces(c, 1); }
/// δ = F/(πE*L) [⅔ + ln(4R_i/b) + ln(4R_j/b)], where b is the full width, rounded in the source to 1.60 √(2 F R/(E*L)).
DampedLaw radzimovsky(const Cylinders& c) {
  constexpr double width = 1.6;
  return of_half_spaces(c, 2.0 / 3 + std::log(2 / (pi * width * width)));
}

/// δ = F/(πE*L) [ln(πE*L³/(F R)) + 1]: the length replaces the radii. Valid for half-widths up to the length.
DampedLaw goldsmith(const Cylinders& c) {
  const double S = pi * c.modulus * c.length, R = reduced_radius(c), L = c.length;
  const LogarithmicForce line{S, S * L * L / R * std::numbers::e};
  const double by_angle = force_of_half_angle(c), by_length = S * L * L / (4 * R);
  return {.elastic = line,
          .deepest = depth_under(line, std::min(by_angle, by_length)),
          .limit = by_angle < by_length ? wide : "the contact is wider than it is long; use johnson"};
}

DampedLaw liu(const Cylinders& c) {
  const double k = pi * c.modulus * c.length / std::sqrt(8.0), clearance = difference(c);
  return {.elastic = WideningForce{k, clearance},
          .deepest = clearance,
          .limit = "the contact spans more than 60 degrees to either side; use a table"};
}

/// F = (a ΔR + b) E*L/ΔR δⁿ in N and mm.
DampedLaw pereira(const Cylinders& c) {
  constexpr double mm = 1e-3, changes = 0.34954;
  const double D = difference(c) / mm;
  const double Y = D < changes ? 1.51 * std::pow(std::log(1000 * D), -0.151) : 0.0151 * D + 1.151;
  const double n = c.internal() ? Y * std::pow(D, -0.005) : 1.094;
  const double factor = c.internal() ? 0.965 * D + 0.0965 : 0.39 * D + 0.85;
  const PowerForce power{factor / D * c.modulus * c.length * std::pow(mm, 1 - n), n};
  return {.elastic = power, .deepest = std::pow(force_of_half_angle(c) / power.k, 1 / n), .limit = wide};
}

/// p = K · local depth: for a pin in a hole with exact arcs, otherwise with parabolas, F = (4√2/3) K L √R δ^1.5.
DampedLaw winkler(const Cylinders& c) {
  constexpr double most_strain = 0.1, small = 0.1;
  const double stiffness = c.foundation * c.length, smaller = std::min(std::abs(c.a), std::abs(c.b)), strained = most_strain * c.layer;
  const double R = 1 / std::abs(1 / c.a + 1 / c.b), as_parabola = smaller * smaller / (8 * R);  // half-width R_i/2
  const double by_shape = c.internal() ? small * smaller : as_parabola;
  DampedLaw out{};
  out.deepest = std::min(strained, by_shape);
  if (c.internal())
    out.elastic = FoundationForce{stiffness * std::sqrt(std::abs(c.a * c.b)), difference(c)};
  else
    out.elastic = PowerForce{4 * std::numbers::sqrt2 / 3 * stiffness * std::sqrt(R), 1.5};
  out.limit = strained < by_shape ? "the layer is compressed by more than a tenth of its thickness; use a thicker layer, or a table"
              : c.internal()      ? "the depth is no longer small compared with the radius; use a table"
                                  : "the contact is wider than the smaller radius, where parabolas no longer approximate arcs; use a table";
  return out;
}

constexpr double any = std::numeric_limits<double>::infinity();
constexpr std::array laws{
    CylinderLaw{"johnson", true, 0, any, johnson, "Johnson 1985"},
    CylinderLaw{"radzimovsky", true, 0, any, radzimovsky, "Radzimovsky 1953"},
    CylinderLaw{"goldsmith", true, 0, any, goldsmith, "Goldsmith 1960, m = 3"},
    CylinderLaw{"esdu", false, 0, any, esdu, "ESDU 78035, 1978"},
    CylinderLaw{"liu", false, 0, any, liu, "Liu, Zhang and Yang 2007"},
    CylinderLaw{"pereira", true, 5e-6, 1e-2, pereira, "Pereira, Ramalho and Ambrósio 2011"},
    CylinderLaw{"winkler", true, 0, any, winkler, "Johnson 1985, §4.3", true},
};

}  // namespace

double foundation_modulus(double young, double poisson, double thickness) {
  return (1 - poisson) * young / ((1 + poisson) * (1 - 2 * poisson) * thickness);
}

std::span<const CylinderLaw> cylinder_laws() { return laws; }

const CylinderLaw* find_cylinder_law(std::string_view name) {
  const auto found = std::ranges::find(laws, name, &CylinderLaw::name);
  return found == laws.end() ? nullptr : &*found;
}

}  // namespace pintle
