// Sections and materials, against closed forms, Cowper's own integral and the solid in space.

#include "elements/section.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "elements/material.h"
#include "tests/refusal.h"

namespace pintle::section_test {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double rounding = 1e-12;

/// ∫ from a to b, exact for polynomials of degree 5: three points of Gauss.
double integral(double a, double b, const std::function<double(double)>& f) {
  const double middle = (a + b) / 2, half = (b - a) / 2, at = half * std::sqrt(0.6);
  return half * (5 * f(middle - at) + 8 * f(middle) + 5 * f(middle + at)) / 9;
}
/// Cowper's κ = 2(1 + ν) I / [½ν(I_across − I) − A/I ∫∫ x(χ + xy²) dA], x along the load, χ
/// Saint-Venant's function of bending under it; `moment` is that integral.
double cowper(double nu, double A, double I, double I_across, double moment) {
  return 2 * (1 + nu) * I / (nu / 2 * (I_across - I) - A / I * moment);
}

// ---- sections ----

TEST(Section, AreasAndSecondMomentsAreIntegralsOfTheWidth) {
  const auto expect = [](const SectionShape& shape, double A, double I, double fibre) {
    const Section s = section(shape, ShearFactor::five_sixths, 0.3);
    EXPECT_NEAR(s.A, A, rounding * A);
    EXPECT_NEAR(s.I, I, rounding * I);
    EXPECT_EQ(s.fibre, fibre);
  };
  const auto strips = [](double a, double b, double width) { return integral(a, b, [&](double y) { return width * y * y; }); };
  expect(RectangleSection{0.2, 0.05}, 0.01, strips(-0.1, 0.1, 0.05), 0.1);
  const double r = 0.03, q = 0.02;
  expect(CircleSection{2 * r}, M_PI * r * r, M_PI * std::pow(r, 4) / 4, r);
  expect(TubeSection{2 * r, 2 * q}, M_PI * (r * r - q * q), M_PI * (std::pow(r, 4) - std::pow(q, 4)) / 4, r);
  expect(ISection{0.2, 0.1, 0.008, 0.012}, 2 * 0.1 * 0.012 + 0.176 * 0.008, 2 * strips(0.088, 0.1, 0.1) + strips(-0.088, 0.088, 0.008),
         0.1);
  expect(GivenSection{2e-4, 3e-9, 0.01, {}}, 2e-4, 3e-9, 0.01);
}

TEST(Section, CowpersFactorsOfSolidSectionsAreThePublishedOnes) {
  for (double nu : {0.0, 0.3, 0.5}) {
    EXPECT_NEAR(section(RectangleSection{0.2, 0.05}, ShearFactor::cowper, nu).kappa, 10 * (1 + nu) / (12 + 11 * nu), rounding);
    EXPECT_NEAR(section(CircleSection{0.2}, ShearFactor::cowper, nu).kappa, 6 * (1 + nu) / (7 + 6 * nu), rounding);
  }
}

// On a ring b < r < a: χ = (αr + β/r) cos θ + ¼r³ cos 3θ meets its wall conditions with p = ¾ + ½ν,
// α = −p(a² + b²), β = −pa²b², and ∫∫ x(χ + xy²) = π(¼α(a⁴ − b⁴) + ½β(a² − b²) + (a⁶ − b⁶)/24).
TEST(Section, CowpersFactorOfATubeIsHisIntegralOverTheRing) {
  const double a = 0.03;
  for (double ratio : {0.01, 0.5, 0.9, 0.999})
    for (double nu : {0.0, 0.3, 0.5}) {
      const double b = ratio * a, p = 0.75 + nu / 2, alpha = -p * (a * a + b * b);
      const double beta = -p * a * a * b * b, fourth = std::pow(a, 4) - std::pow(b, 4);
      const double moment = M_PI * (alpha / 4 * fourth + beta / 2 * (a * a - b * b) + (std::pow(a, 6) - std::pow(b, 6)) / 24);
      const double A = M_PI * (a * a - b * b), I = M_PI * fourth / 4;
      // A thin ring is a difference: 1e-3 of it costs three digits.
      EXPECT_NEAR(section(TubeSection{2 * a, 2 * b}, ShearFactor::cowper, nu).kappa, cowper(nu, A, I, I, moment), 1000 * rounding);
    }
}

TEST(Section, CowpersFactorOfAThinTubeIsThePublishedOne) {
  for (double nu : {0.0, 0.3, 0.5})
    EXPECT_NEAR(section(TubeSection{1, 1 - 1e-6}, ShearFactor::cowper, nu).kappa, 2 * (1 + nu) / (4 + 3 * nu),
                1e-11);  // of second order in the thickness
}

// Thin walls: shear flow by balance gives χ's slope along them. Web at y = 0, flanges at x = ±h/2.
TEST(Section, CowpersFactorOfAnIIsHisIntegralOverThinWalls) {
  for (double nu : {0.0, 0.3, 0.5})
    for (double b : {0.02, 0.1, 0.3})
      for (double flange : {0.004, 0.012}) {
        const double web = 0.008, h = 0.2;
        const double A = web * h + 2 * b * flange;
        const double I = web * h * h * h / 12 + b * flange * h * h / 2;
        const double I_across = flange * b * b * b / 6;
        const auto web_slope = [&](double x) {
          const double beyond = b * flange * h / 2 + web * (h * h / 4 - x * x) / 2;
          return -2 * (1 + nu) * beyond / web - nu * x * x / 2;
        };
        const auto chi_web = [&](double x) { return integral(0, x, web_slope); };
        const auto flange_slope = [&](double y) { return -2 * (1 + nu) * h / 2 * (b / 2 - y) - (2 + nu) * h / 2 * y; };
        const auto chi_flange = [&](double y) { return chi_web(h / 2) + integral(0, y, flange_slope); };
        const double moment = 2 * web * integral(0, h / 2, [&](double x) { return x * chi_web(x); }) +
                              4 * flange * integral(0, b / 2, [&](double y) { return h / 2 * (chi_flange(y) + h / 2 * y * y); });
        EXPECT_NEAR(section(ISection{h + flange, b, web, flange}, ShearFactor::cowper, nu).kappa, cowper(nu, A, I, I_across, moment),
                    rounding);
      }
}

TEST(Section, FiveSixthsIsFiveSixthsAndAGivenFactorIsKept) {
  for (const SectionShape& s : {SectionShape{RectangleSection{2, 1}}, SectionShape{CircleSection{1}}, SectionShape{TubeSection{2, 1}},
                                SectionShape{ISection{2, 1, .1, .1}}, SectionShape{GivenSection{1, 1, 0, {}}}})
    EXPECT_EQ(section(s, ShearFactor::five_sixths, 0.3).kappa, 5.0 / 6);
  const GivenSection given{1, 1, 0, 0.44};
  EXPECT_EQ(section(given, ShearFactor::cowper, 0.3).kappa, 0.44);
  EXPECT_EQ(section(given, ShearFactor::five_sixths, 0.3).kappa, 0.44);
}

TEST(Section, BetweenTwoSectionsSizesRunStraight) {
  const auto cut = std::get<ISection>(between(ISection{4, 3, 2, 1}, ISection{8, 7, 6, 5}, 0.25));
  EXPECT_EQ(cut.height, 5);
  EXPECT_EQ(cut.width, 4);
  EXPECT_EQ(cut.web, 3);
  EXPECT_EQ(cut.flange, 2);
  const GivenSection a{2, 8, 1, {}}, b{6, 4, 3, 0.5};
  const auto given = std::get<GivenSection>(between(a, b, 0.5));
  EXPECT_EQ(given.area, 4);
  EXPECT_EQ(given.second_moment, 6);
  EXPECT_EQ(given.fibre, 2);
  EXPECT_NEAR(given.shear_factor.value(), (5.0 / 6 + 0.5) / 2, rounding);
  EXPECT_FALSE(std::get<GivenSection>(between(a, a, 0.5)).shear_factor.has_value());
  EXPECT_EQ(std::get<TubeSection>(between(TubeSection{2, 1}, TubeSection{4, 3}, 1)).inner, 3);
  EXPECT_EQ(std::get<CircleSection>(between(CircleSection{2}, CircleSection{4}, 0)).diameter, 2);
}

void expect_refusal(const std::function<void()>& act, const std::string& words) {
  pintle_test::expect_refused<std::invalid_argument>(act, {words});
}

TEST(Section, ImpossibleSizesAreRefusedByName) {
  const auto reject = [](const SectionShape& s, const std::string& words, double nu = 0.3) {
    expect_refusal([&] { section(s, ShearFactor::cowper, nu); }, words);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  reject(RectangleSection{0, 1}, "rectangle section: height = 0");
  reject(RectangleSection{1, nan}, "rectangle section: width = nan");
  reject(CircleSection{-1}, "circle section: diameter = -1");
  reject(TubeSection{1, 0}, "tube section: inner = 0");
  reject(TubeSection{1, 1}, "tube section: inner = 1, must be below outer");
  reject(ISection{1, 0.2, 0.3, 0.1}, "I section: web = 0.3");
  reject(ISection{1, 0.2, 0.1, 0.5}, "I section: flange = 0.5");
  reject(GivenSection{-1, 1, 0, {}}, "given section: area = -1");
  reject(GivenSection{1, 0, 0, {}}, "given section: second_moment = 0");
  reject(GivenSection{1, 1, 0.1, {}}, "at most area·fibre²");
  reject(GivenSection{1, 1, 2, -1.0}, "given section: shear_factor = -1");
  reject(CircleSection{1}, "circle section: poisson = -1", -1);
  expect_refusal([] { between(CircleSection{1}, TubeSection{2, 1}, 0.5); }, "from circle to tube; both ends must be of one kind");
}

// ---- materials ----

/// Compliance of [ε₁ ε₂ ε₃ γ₁₂] of the solid in space.
Eigen::Matrix4d compliance(const Orthotropic& m) {
  Eigen::Matrix4d S = Eigen::Matrix4d::Zero();
  S.diagonal() << 1 / m.young_1, 1 / m.young_2, 1 / *m.young_3, 1 / m.shear_12;
  S(0, 1) = S(1, 0) = -m.poisson_12 / m.young_1;
  S(0, 2) = S(2, 0) = -*m.poisson_13 / m.young_1;
  S(1, 2) = S(2, 1) = -*m.poisson_23 / m.young_2;
  return S;
}
const Orthotropic spruce{.young_1 = 11e9,
                         .young_2 = 0.9e9,
                         .poisson_12 = 0.37,
                         .shear_12 = 0.7e9,
                         .angle = 0.4,
                         .young_3 = 0.5e9,
                         .poisson_13 = 0.42,
                         .poisson_23 = 0.47};
Orthotropic isotropic_as_orthotropic(double E, double nu) {
  return {.young_1 = E,
          .young_2 = E,
          .poisson_12 = nu,
          .shear_12 = E / (2 * (1 + nu)),
          .angle = 0.8,
          .young_3 = E,
          .poisson_13 = nu,
          .poisson_23 = nu};
}

TEST(Material, IsotropicIsTheOrthotropicSolidWithEqualAxesWhateverItsAngle) {
  for (double nu : {-0.5, 0.0, 0.3, 0.49})
    for (PlaneState state : {PlaneState::stress, PlaneState::strain}) {
      const PlaneMaterial a = plane_material({Isotropic{70e9, nu}, 1}, state);
      const PlaneMaterial b = plane_material({isotropic_as_orthotropic(70e9, nu), 1}, state);
      const double size = a.D.cwiseAbs().maxCoeff();
      EXPECT_LT((a.D - b.D).cwiseAbs().maxCoeff(), 100 * rounding * size);  // 1/(1 − 2ν) is 50
      EXPECT_LT((a.Dz - b.Dz).cwiseAbs().maxCoeff(), 100 * rounding * size);
    }
}

// Any strain, its stress put through the solid in space: out of the plane no stress, or no strain.
TEST(Material, PlaneStressAndStrainAreTheSolidInSpace) {
  const double c = std::cos(spruce.angle), s = std::sin(spruce.angle);
  const Matrix2d A = (Matrix2d() << c, -s, s, c).finished();  // solid to body axes
  for (PlaneState state : {PlaneState::stress, PlaneState::strain}) {
    const PlaneMaterial m = plane_material({spruce, 450}, state);
    for (int k = 0; k < 3; ++k) {
      const Vector3d strain = Vector3d::Unit(k), stress = m.D * strain;
      const Matrix2d sigma = A.transpose() * (Matrix2d() << stress[0], stress[2], stress[2], stress[1]).finished() * A;
      const Matrix2d epsilon = A.transpose() * (Matrix2d() << strain[0], strain[2] / 2, strain[2] / 2, strain[1]).finished() * A;
      const Eigen::Vector4d in_space = compliance(spruce) * Eigen::Vector4d(sigma(0, 0), sigma(1, 1), m.Dz[k], sigma(0, 1));
      EXPECT_NEAR(in_space[0], epsilon(0, 0), 10 * rounding);
      EXPECT_NEAR(in_space[1], epsilon(1, 1), 10 * rounding);
      EXPECT_NEAR(in_space[3], 2 * epsilon(0, 1), 10 * rounding);
      if (state == PlaneState::strain)
        EXPECT_NEAR(in_space[2], 0, 10 * rounding);
      else
        EXPECT_EQ(m.Dz[k], 0);
    }
    EXPECT_EQ(m.D, m.D.transpose());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix3d>(m.D).eigenvalues()[0], 0);
  }
}

TEST(Material, NearlyIncompressibleKeepsItsShearAndItsBulk) {
  const double E = 1e6, nu = 0.4999, G = E / (2 * (1 + nu)), bulk = E / (3 * (1 - 2 * nu));
  const PlaneMaterial m = plane_material({Isotropic{E, nu}, 1}, PlaneState::strain);
  EXPECT_NEAR(m.D(2, 2), G, rounding * G);
  EXPECT_NEAR((m.D(0, 0) - m.D(0, 1)) / (2 * G), 1, 1e4 * rounding);  // 1/(1 − 2ν)
  EXPECT_NEAR((m.D(0, 0) + m.D(0, 1) + m.Dz[0]) / 3 / bulk, 1, 1e4 * rounding);
}

// A beam pulled along its axis and free sideways stretches by 1/E; sheared, by 1/G.
TEST(Material, ABeamFeelsTheModuliAlongItsAxis) {
  for (double direction : {-2.0, 0.0, 0.4, 1.0, 0.4 + M_PI / 2}) {
    Orthotropic seen = spruce;
    seen.angle -= direction;
    const Matrix3d S = plane_material({seen, 1}, PlaneState::stress).D.inverse();
    const BeamModuli m = beam_moduli({spruce, 1}, direction);
    EXPECT_NEAR(m.E * S(0, 0), 1, 100 * rounding);
    EXPECT_NEAR(m.G * S(2, 2), 1, 100 * rounding);
    EXPECT_NEAR(m.nu, m.E / (2 * m.G) - 1, 100 * rounding);
  }
  EXPECT_NEAR(beam_moduli({spruce, 1}, spruce.angle).E / spruce.young_1, 1, rounding);
  EXPECT_NEAR(beam_moduli({spruce, 1}, spruce.angle + M_PI / 2).E / spruce.young_2, 1, rounding);
  const BeamModuli steel = beam_moduli({Isotropic{207e9, 0.3}, 7800}, 1.1);
  EXPECT_EQ(steel.E, 207e9);
  EXPECT_NEAR(steel.G / (207e9 / 2.6), 1, rounding);
  EXPECT_EQ(steel.nu, 0.3);
}

TEST(Material, WhatIsNoStableSolidIsRefusedByName) {
  const auto reject = [](const Material& m, const std::string& words) {
    expect_refusal([&] { plane_material(m, PlaneState::strain); }, words);
  };
  reject({Isotropic{-1, 0.3}, 1}, "material: young = -1");
  reject({Isotropic{1, 0.5}, 1}, "material: poisson = 0.5");
  reject({Isotropic{1, -1}, 1}, "material: poisson = -1");
  reject({Isotropic{1, 0.3}, -7800}, "material: density = -7800");
  const auto changed = [](auto change) {
    Orthotropic m = spruce;
    change(m);
    return Material{m, 1};
  };
  reject(changed([](Orthotropic& m) { m.young_1 = 0; }), "young_1 = 0");
  reject(changed([](Orthotropic& m) { m.young_2 = -1; }), "young_2 = -1");
  reject(changed([](Orthotropic& m) { m.shear_12 = 0; }), "shear_12 = 0");
  reject(changed([](Orthotropic& m) { m.poisson_12 = 4; }), "poisson_12 = 4");
  reject(changed([](Orthotropic& m) { m.young_3.reset(), m.poisson_23.reset(); }), "lacks young_3 poisson_23");
  reject(changed([](Orthotropic& m) { m.poisson_23 = 1.5; }), "poisson_23 = 1.5");
  reject(changed([](Orthotropic& m) { m.poisson_12 = 3.4, m.poisson_13 = 2; }), "poisson_12 = 3.4");
  Orthotropic flat = spruce;
  flat.young_3.reset();
  EXPECT_NO_THROW(plane_material({flat, 1}, PlaneState::stress));
  expect_refusal([] { beam_moduli({Isotropic{0, 0.3}, 1}, 0); }, "young = 0");
}

}  // namespace
}  // namespace pintle::section_test
