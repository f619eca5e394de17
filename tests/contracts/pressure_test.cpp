// Pressures and half-angles of cylinders: that they carry the force, that theories agree where contacts are narrow, published values.
#include "contact/pressure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/contracts/elastic_samples.h"

namespace pintle::pressure_test {
namespace {

using namespace elastic_samples;

Pressure under(const char* name, const Geometry& g, double force) {
  return pressure_under(pressure_theory(*find_cylinder_law(name), cylinders(g)), force);
}

// ∫ p cos φ over the contact, by Simpson's rule in an angle that takes the root out of the pressure's ends.
template <class F>
double carried(double half_angle, F pressure) {
  constexpr int parts = 2000;
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const double turn = std::numbers::pi * (static_cast<double>(i) / parts - 0.5), phi = half_angle * std::sin(turn);
    sum += (i == 0 || i == parts ? 1 : i % 2 ? 4 : 2) * pressure(phi) * std::cos(phi) * half_angle * std::cos(turn);
  }
  return sum * std::numbers::pi / parts / 3;
}

TEST(Pressure, OfTwoRoundOnesIsHertzs) {
  for (const double load : {1.0, 1e3, 1e5}) {
    const Pressure p = under("johnson", discs(), load);
    const double a = p.half_angle * 10e-3;
    EXPECT_NEAR(std::numbers::pi / 2 * a * p.greatest * length / load, 1, 1e-13);  // half an ellipse
    EXPECT_NEAR(p.greatest / (modulus() * a / (2 * discs().R)), 1, 1e-13);         // Johnson 1985, (4.44)
    EXPECT_EQ(under("pereira", discs(), load).greatest, p.greatest) << "a theory of force";
  }
}

// Persson 1964 as Ciavarella and Decuzzi (2001) print it, of like materials: y = tan(φ/2), b = tan(ε/2).
double persson(double angle, double half_angle) {
  const double y = std::tan(angle / 2), b = std::tan(half_angle / 2), s = std::sqrt(b * b + 1), r = std::sqrt(std::max(0.0, b * b - y * y));
  return 2 / (std::numbers::pi * s) * r / (1 + y * y) + std::log((s + r) / (s - r)) / (2 * std::numbers::pi * b * b * (1 + b * b));
}
TEST(Pressure, InAHoleIsPerssons) {
  const Geometry g = pin_in_hole(1e-4);
  const double radius = std::sqrt(std::abs(g.a * g.b));
  for (const double load : {1.0, 1e3, 1e4, 1e5, 1e6, 1e8}) {
    const Pressure p = under("johnson", g, load);
    const double b2 = std::pow(std::tan(p.half_angle / 2), 2);
    const double q = load / (modulus() * g.D * length);
    EXPECT_NEAR((2 - std::log(1 + b2) - 2 * b2 * b2) * q, 2 * std::numbers::pi * b2 * (1 + b2), 1e-12 * (q + 1)) << load;
    EXPECT_NEAR(p.greatest * radius * length / load / persson(0, p.half_angle), 1, 1e-9) << load;
    EXPECT_NEAR(carried(p.half_angle, [&](double phi) { return persson(phi, p.half_angle); }), 1, 1e-6) << load;
  }
}
TEST(Pressure, InAHoleIsHertzsWhereTheContactIsNarrow) {
  const Geometry g = pin_in_hole(5e-4);
  const Pressure p = under("johnson", g, 1e-3);
  const double hertz = std::sqrt(1e-3 * modulus() / (std::numbers::pi * g.R * length));  // Johnson 1985, (4.45)
  EXPECT_NEAR(p.greatest / hertz, 1, 1e-6);
  EXPECT_NEAR(p.half_angle * 10e-3, 2 * std::sqrt(1e-3 * g.R / (std::numbers::pi * modulus() * length)), 0.06 * p.half_angle * 10e-3);
}

// The pressure of a foundation is K times the local depth; what that carries is the force.
TEST(Pressure, OfALayerCarriesTheForce) {
  const Geometry hole = pin_in_hole(1e-4);
  for (const double load : {1e-3, 1.0, 1e3, 1e6}) {
    const Pressure p = under("winkler", hole, load);
    const double e = hole.D + p.greatest / foundation;
    EXPECT_NEAR(std::cos(p.half_angle), hole.D / e, 1e-13);
    const double sum = carried(p.half_angle, [&](double phi) {
      return foundation * 2 * e * std::sin((p.half_angle - phi) / 2) * std::sin((p.half_angle + phi) / 2);
    });
    EXPECT_NEAR(sum * length * std::sqrt(std::abs(hole.a * hole.b)) / load, 1, 1e-9) << load;
    const Pressure round = under("winkler", discs(), load);
    EXPECT_NEAR(round.greatest * length * 4 / 3 * round.half_angle * 10e-3 / load, 1, 1e-12);  // a parabola
  }
}

TEST(Pressure, IsNoneWithoutForce) {
  for (const char* name : {"johnson", "winkler"})
    for (const Geometry& g : {pin_in_hole(1e-4), discs()}) {
      EXPECT_EQ(under(name, g, 0).greatest, 0);
      EXPECT_EQ(under(name, g, 0).half_angle, 0);
    }
}

TEST(Pressure, SaysHowWideItHolds) {
  const CylinderLaw& johnson = *find_cylinder_law("johnson");
  EXPECT_NEAR(widest(pressure_theory(johnson, cylinders(discs()))), std::numbers::pi / 6, 1e-15);
  EXPECT_TRUE(std::isinf(widest(pressure_theory(johnson, cylinders(pin_in_hole(1e-4))))));
}

}  // namespace
}  // namespace pintle::pressure_test
