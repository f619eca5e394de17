// Statics of beams in chains, against closed forms; lumps.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "elements/point_mass.h"
#include "elements/section.h"
#include "tests/unit/elements/beam_chain.h"

namespace pintle::beam_test {
namespace {

// Solving a few elements loses a digit or two of fifteen, more for every power of the slenderness
// that stands between stretch and bending.
constexpr double rounding = 1e-12;
// A slope between two meshes whose error is still three or more digits above rounding.
constexpr double order = 0.1;
const BeamEuler euler{.EA = 3e6, .EI = 200, .rhoA = 0.8};
const BeamTimoshenko timoshenko{.EA = 3e6, .EI = 200, .kGA = 1e4, .rhoA = 0.8, .rhoI = 0.01};

// ---- statics ----

template <class E>
VectorXd cantilever(const Chain<E>& c, const VectorXd& force) {
  const Eigen::Index free = c.dofs() - 3;  // the first node is held
  VectorXd u = VectorXd::Zero(c.dofs());
  u.tail(free) = c.K().bottomRightCorner(free, free).llt().solve(force.tail(free));
  return u;
}
template <class E>
void expect_cantilever_closed_forms(const E& e, double shear_flexibility) {
  const double L = 1.7, EI = e.EI, angle = 0.7;
  const Vector2d t(std::cos(angle), std::sin(angle)), n(-t.y(), t.x());
  for (int elements : {1, 3}) {
    const Chain<E> c = chain(e, elements, L, angle);
    VectorXd f = VectorXd::Zero(c.dofs());
    const auto expect_tip = [&](double along, double across, double rotation) {
      const VectorXd u = cantilever(c, f);
      EXPECT_NEAR(t.dot(u.tail<3>().head<2>()), along, 100 * rounding * std::abs(across));
      EXPECT_NEAR(n.dot(u.tail<3>().head<2>()), across, 100 * rounding * std::abs(across));
      EXPECT_NEAR(u.tail<1>()[0], rotation, 100 * rounding * std::abs(rotation));
    };
    f.tail<3>() << 5 * n + 70 * t, 0;
    expect_tip(70 * L / e.EA, 5 * (L * L * L / (3 * EI) + shear_flexibility * L), 5 * L * L / (2 * EI));
    f.tail<3>() << 0, 0, 5;
    expect_tip(0, 5 * L * L / (2 * EI), 5 * L / EI);
    f.setZero();
    for (int i = 0; i < elements; ++i) f.segment<6>(3 * i) += line_load(e, c.coords(i), Vector2d(5 * n + 70 * t));
    expect_tip(70 * L * L / (2 * e.EA), 5 * (std::pow(L, 4) / (8 * EI) + shear_flexibility * L * L / 2), 5 * L * L * L / (6 * EI));
  }
}
TEST(Beam, CantileverTipsAreExactForForceMomentAndUniformLoad) {
  expect_cantilever_closed_forms(euler, 0);
  expect_cantilever_closed_forms(timoshenko, 1 / timoshenko.kGA);
}

// One element, height 1e-4 of the length: an element that locks would be 1e7 times too stiff.
TEST(Beam, SlenderTimoshenkoBeamDoesNotLock) {
  const double h = 1e-4, young = 2e11, b = 0.01, EI = young * b * h * h * h / 12;
  const BeamTimoshenko e{young * b * h, EI, young / 3 * b * h, 7800 * b * h, 7800 * b * h * h * h / 12};
  for (int n : {1, 10}) {
    const Chain<BeamTimoshenko> c = chain(e, n, 1.0);
    VectorXd f = VectorXd::Zero(c.dofs());
    f[c.dofs() - 2] = 1;
    // Elimination loses the square of a hundred elements' worth of slenderness: 1e-16 n⁴.
    EXPECT_NEAR(cantilever(c, f)[c.dofs() - 2] / (1 / (3 * EI) + 1 / e.kGA), 1, 1e-10);
  }
}

TEST(Beam, RigidInShearTimoshenkoIsEulerWithRotaryInertia) {
  const BeamEuler a{.EA = 3e6, .EI = 200, .rhoA = 0.8, .rhoI = 0.01};
  const BeamTimoshenko b{a.EA, a.EI, 1e30, a.rhoA, a.rhoI};
  const Coords<BeamEuler> x = chain(a, 1, 1.7, 0.4).x;
  Stress<BeamEuler> f = Stress<BeamEuler>::Zero();
  f << 30, 40, 5, 6, 7, 8;
  const auto same = [](const auto& p, const auto& q) { EXPECT_LT((p - q).cwiseAbs().maxCoeff(), rounding * p.cwiseAbs().maxCoeff()); };
  same(stiffness(a, x), stiffness(b, x));
  same(mass(a, x), mass(b, x));
  same(skew_mass(a, x), skew_mass(b, x));
  same(geometric_stiffness(a, x, f), geometric_stiffness(b, x, f));
}

// Tip force 5 across and pull 70 along: N = 70, V = 5 throughout, M = 5 (L − s), which stretches
// the right side of an axis that the force bends to its left.
TEST(Beam, SectionForcesOfACantileverAreThoseOfStatics) {
  const double L = 1.7, angle = 2.1;
  const Chain<BeamTimoshenko> c = chain(timoshenko, 4, L, angle);
  const Vector2d t(std::cos(angle), std::sin(angle)), n(-t.y(), t.x());
  VectorXd f = VectorXd::Zero(c.dofs());
  f.tail<3>() << 5 * n + 70 * t, 0;
  const VectorXd u = cantilever(c, f);
  for (int i = 0; i < 4; ++i) {
    const Stress<BeamTimoshenko> s = stress(timoshenko, c.coords(i), NodalVector<BeamTimoshenko>(u.segment<6>(3 * i)));
    for (int end : {0, 1}) {
      EXPECT_NEAR(s(0, end), 70, 70 * 1e-10);  // the axis is 1e3 times stiffer than the bending
      EXPECT_NEAR(s(1, end), 5, 5 * 1e-10);
      EXPECT_NEAR(s(2, end), 5 * (L - L * (i + end) / 4), 5 * L * 1e-10);
    }
    const double xi = 0.5, step = 0.01;
    const double turning =
        (rotation(timoshenko, c.coords(i), xi + step) - rotation(timoshenko, c.coords(i), xi - step)).dot(u.segment<6>(3 * i));
    EXPECT_GT(turning, 0);  // strain −y θ′ at y = −½h is a pull
  }
}

TEST(Beam, LineLoadIsTheLoadsWorkOnTheShapes) {
  const Coords<BeamTimoshenko> x = chain(timoshenko, 1, 1.7, 0.4).x;
  const Vector2d q(3, -2);
  NodalVector<BeamTimoshenko> sum = NodalVector<BeamTimoshenko>::Zero();
  const int n = 1000;  // middle points: 1/24 n² of the change of slope, here below 1e-6
  for (int i = 0; i < n; ++i) sum += shape(timoshenko, x, Vector2d((i + 0.5) / n, 0)).transpose() * q * 1.7 / n;
  EXPECT_LT((sum - line_load(timoshenko, x, q)).cwiseAbs().maxCoeff(), 1e-6);
}

// ---- taper ----

// Height from 0.2 to 0.1: stretch F/(E b) ln(h₀/h₁)/(h₀ − h₁) L; bending in the taper's variable.
TEST(Beam, TaperedCantileverConvergesToTheIntegralOfItsFlexibility) {
  const double L = 2, h0 = 0.2, h1 = 0.1, b = 0.05, young = 7e10, F = 100;
  const double d = (h0 - h1) / L;  // ∫ (L − s)²/h³ ds with L − s = (h − h₁)/d
  const double integral = (std::log(h0 / h1) + 2 * h1 * (1 / h0 - 1 / h1) - h1 * h1 / 2 * (1 / (h0 * h0) - 1 / (h1 * h1))) / (d * d * d);
  const double across = F * 12 / (young * b) * integral;
  const double along = F / (young * b) * std::log(h0 / h1) / d;
  const auto errors = [&](int n) {
    Chain<BeamEuler> c = chain(BeamEuler{}, n, L);
    for (int i = 0; i < n; ++i) {
      const SectionShape cut = between(RectangleSection{h0, b}, RectangleSection{h1, b}, (i + 0.5) / n);
      const Section s = section(cut, ShearFactor::five_sixths, 0.3);
      c.elements[static_cast<std::size_t>(i)] = {young * s.A, young * s.I, 2700 * s.A, 0};
    }
    VectorXd f = VectorXd::Zero(c.dofs());
    f.tail<3>() << F, F, 0;
    const VectorXd u = cantilever(c, f);
    return Vector2d(u[c.dofs() - 3] / along - 1, u[c.dofs() - 2] / across - 1);
  };
  const Vector2d coarse = errors(8), fine = errors(16);
  EXPECT_LT(fine.cwiseAbs().maxCoeff(), 0.01);
  EXPECT_NEAR(std::log2(coarse[0] / fine[0]), 2, order);
  EXPECT_NEAR(std::log2(coarse[1] / fine[1]), 2, order);
}

// ---- lumps ----

// The floating frame's terms of one particle with a spin of its own, by hand: u̇ᵀu̇ m + φ̇² J, and Z's
// product of two displacements.
TEST(PointMass, CarriesItsMassBothWaysItsInertiaInRotationAndNoSkewInertia) {
  const PointMass p{.m = 3, .J = 0.2};
  const Eigen::Vector3d u(0.3, -0.7, 2), v(1.1, 0.4, -5);
  EXPECT_NEAR(u.dot(mass(p) * v), 3 * (0.3 * 1.1 - 0.7 * 0.4) - 0.2 * 10, 10 * rounding);
  EXPECT_NEAR(u.dot(skew_mass(p) * v), 3 * (0.3 * 0.4 + 0.7 * 1.1), 10 * rounding);
  EXPECT_EQ(skew_mass(p), -skew_mass(p).transpose());
}

}  // namespace
}  // namespace pintle::beam_test
