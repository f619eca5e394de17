// Unilateral forces on random problems: the conditions themselves; and Painlevé's rod, where there are none.

#include "contact/complementarity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/contracts/moving_bodies.h"

namespace pintle::complementarity_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double rounding = 1e-9;  // of the largest term: some 40 pivots, each of which may lose a digit or two of 16

// ---- z ≥ 0, w = M z + q ≥ 0, zᵀw = 0 ----------------------------------------------------------

void expect_complementary(const MatrixXd& M, const VectorXd& q) {
  const auto z = solve_complementarity(M, q);
  ASSERT_TRUE(z);
  const VectorXd w = M * *z + q;
  const double eps = rounding * (q.cwiseAbs() + M.cwiseAbs() * z->cwiseAbs()).maxCoeff();
  EXPECT_GE(z->minCoeff(), 0);
  EXPECT_GE(w.minCoeff(), -eps);
  for (Index i = 0; i < q.size(); ++i) EXPECT_TRUE((*z)[i] == 0 || std::abs(w[i]) <= eps) << i << ": " << (*z)[i] << ", " << w[i];
}

TEST(Complementarity, HoldsForPositiveDefiniteMatricesSymmetricOrNot) {
  Draw draw(1);
  for (int k = 0; k < 400; ++k) {
    const Index n = 1 + k % 12;
    const MatrixXd A = draw.matrix(n, n, 1), B = draw.matrix(n, n, k % 2);
    expect_complementary(A * A.transpose() + 0.01 * MatrixXd::Identity(n, n) + B - B.transpose(), draw.matrix(n, 1, 1));
  }
}

// Of a semidefinite matrix there is a solution wherever some z ≥ 0 makes w ≥ 0 [CottlePangStone1992, 3.1.2].
TEST(Complementarity, HoldsForSemidefiniteMatricesThatHaveASolution) {
  Draw draw(2);
  for (int k = 0; k < 400; ++k) {
    const Index n = 2 + k % 11, rank = 1 + k % (n - 1);
    const MatrixXd A = draw.matrix(n, rank, 1), M = A * A.transpose();
    const VectorXd z = draw.matrix(n, 1, 1).cwiseMax(0), w = draw.matrix(n, 1, 1).cwiseMax(0);
    expect_complementary(M, w - M * z);
  }
}

TEST(Complementarity, SaysWhereThereIsNone) {
  for (const double m : {0.0, -1.0}) EXPECT_FALSE(solve_complementarity(MatrixXd::Constant(1, 1, m), VectorXd::Constant(1, -1)));
  EXPECT_EQ(solve_complementarity(MatrixXd(0, 0), VectorXd(0))->size(), 0);
  EXPECT_EQ(solve_complementarity(MatrixXd::Identity(3, 3), VectorXd::Ones(3))->norm(), 0);
}

// ---- contacts ---------------------------------------------------------------------------------

// Normal forces in the even columns, friction in the odd ones.
struct Problem {
  std::vector<UnilateralContact> contacts;
  MatrixXd W;
  VectorXd c;
};

enum class Rub { none, free, sliding, any };

/// Contacts between bodies of `dofs` speeds u, the rates of which opening and slip are: W = Jᵀ M⁻¹ J, c = Jᵀ u, so that to stop
/// the bodies solves it but for signs. Units of contacts differ a thousandfold.
Problem problem(Index contacts, Index dofs, Rub rub, double mu, double preload, Draw& draw) {
  Problem out;
  const MatrixXd light = VectorXd::NullaryExpr(dofs, [&] { return draw.within(0.2, 2); }).asDiagonal();
  const VectorXd unit = VectorXd::NullaryExpr(2 * contacts, [&] { return std::pow(10, draw.within(-1.5, 1.5)); });
  const MatrixXd J = draw.matrix(dofs, 2 * contacts, 1) * unit.asDiagonal();
  out.W = J.transpose() * light * J;
  out.c = J.transpose() * draw.matrix(dofs, 1, 1);
  for (Index i = 0; i < contacts; ++i) {
    UnilateralContact k{.normal = static_cast<int>(2 * i)};
    const int of = static_cast<int>(2 * i + 1);
    const Rub now = rub == Rub::any ? static_cast<Rub>(static_cast<int>(draw.within(0, 3))) : rub;
    if (now != Rub::none)
      k.mu = mu * draw.within(0, 1) * unit[2 * i] / unit[2 * i + 1], k.preload = preload * draw.within(0, 1) / unit[2 * i];
    if (now == Rub::free) k.tangent = of;
    if (now == Rub::sliding) k.sliding = of, k.direction = draw.within(-1, 1) < 0 ? -1 : 1;
    out.contacts.push_back(k);
  }
  return out;
}

/// The conditions, forces and rates measured by the root of their own W. @returns whether forces were found
bool expect_forces(const Problem& p) {
  const auto x = unilateral_forces(p.contacts, p.W, p.c);
  if (!x) return false;
  const VectorXd unit = p.W.diagonal().cwiseSqrt().cwiseInverse(), force = x->cwiseQuotient(unit), rate = unit.cwiseProduct(p.W * *x + p.c);
  const double eps = rounding * (unit.cwiseProduct(p.c).cwiseAbs() + unit.cwiseProduct(p.W.cwiseAbs() * x->cwiseAbs())).maxCoeff();
  for (const UnilateralContact& k : p.contacts) {
    const double N = force[k.normal], g = rate[k.normal];
    EXPECT_GE(N, 0);
    EXPECT_GE(g, -eps);
    EXPECT_TRUE(N <= eps || g <= eps) << N << ", " << g;
    const int of = std::max(k.tangent, k.sliding);
    if (of < 0) continue;
    const double T = force[of], most = k.mu * ((*x)[k.normal] + k.preload) / unit[of], slip = rate[of];
    const double fine = eps * std::max(1.0, k.mu * unit[k.normal] / unit[of]);  // N is known to eps
    EXPECT_LE(std::abs(T), most + fine);
    const bool slides = k.sliding >= 0 || std::abs(slip) > eps;
    const double against = k.sliding >= 0 ? k.direction : slip;
    if (slides) {
      EXPECT_NEAR(T, -std::copysign(most, against), fine);
    }
  }
  return true;
}

// A row of discs that fills a box from wall to wall has one contact more than speeds. Pressed down by the wall's own rounding it has a
// solution but for the last digits.
TEST(UnilateralForces, OfRowsThatFillABoxAreFoundButForRounding) {
  for (const Index discs : {1, 2, 4, 7, 12})
    for (const double off : {0.0, 1e-13, -1e-13}) {
      MatrixXd J = MatrixXd::Zero(discs, discs + 1);  // opening speeds of the left wall, of the gaps between, of the right wall
      for (Index i = 0; i < discs; ++i) J(i, i) = 1, J(i, i + 1) = -1;
      const VectorXd pushed = VectorXd::LinSpaced(discs, 1, -2);
      Problem p;
      p.W = J.transpose() * J;
      p.c = J.transpose() * pushed;
      p.c[discs] += off;
      for (int k = 0; k <= discs; ++k) p.contacts.push_back({.normal = k});
      const auto x = unilateral_forces(p.contacts, p.W, p.c);
      ASSERT_TRUE(x) << discs << ", " << off;
      EXPECT_GE(x->minCoeff(), 0);
      EXPECT_LT((p.W * *x + p.c).cwiseAbs().maxCoeff(), 1e-8) << discs << ", " << off;  // none can move
    }
}

TEST(UnilateralForces, WithoutFrictionAreFoundAlways) {
  Draw draw(3);
  for (int k = 0; k < 600; ++k) {
    const Index n = 1 + k % 12, dofs = 1 + k % 17;  // fewer than contacts, as many, more
    EXPECT_TRUE(expect_forces(problem(n, dofs, Rub::none, 0, 0, draw))) << k;
  }
}

TEST(UnilateralForces, WithFrictionMeetItsLaw) {
  Draw draw(4);
  for (int k = 0; k < 1200; ++k) {
    const Index n = 1 + k % 12, dofs = 1 + k % 29;
    const double mu = k % 3 == 0 ? 0.1 : k % 3 == 1 ? 0.5 : 2.0, preload = k % 4 == 0 ? 1 : 0;
    EXPECT_TRUE(expect_forces(problem(n, dofs, Rub::free, mu, preload, draw))) << k;
  }
}

// With friction of fixed direction there need be no forces. Where it is weak beside the coupling there are.
TEST(UnilateralForces, OfWhatSlidesMeetTheLawWhereTheyAreFound) {
  Draw draw(5);
  int found = 0, weak = 0;
  for (int k = 0; k < 1200; ++k) {
    const Index n = 1 + k % 12;
    const bool gentle = k % 2 == 0;
    const bool is = expect_forces(problem(n, 2 * n + k % 3, Rub::any, gentle ? 0.02 : 1, k % 4 == 0 ? 0.5 : 0, draw));
    found += is, weak += gentle && is;
  }
  EXPECT_GT(found, 900);
  EXPECT_GT(weak, 590);
}

// Where no contact presses nothing acts but what friction of preloads holds.
TEST(UnilateralForces, AreNoneWhereNothingPresses) {
  const std::vector<UnilateralContact> one{{.normal = 0, .tangent = 1, .mu = 0.5}};
  const MatrixXd W = MatrixXd::Identity(2, 2);
  EXPECT_EQ(unilateral_forces(one, W, VectorXd::Zero(2))->norm(), 0);
  EXPECT_LT(unilateral_forces(one, W, Eigen::Vector2d(1, 1))->norm(), rounding);
  const std::vector<UnilateralContact> tight{{.normal = 0, .tangent = 1, .mu = 0.5, .preload = 4}};
  EXPECT_NEAR((*unilateral_forces(tight, W, Eigen::Vector2d(1, 1)))[1], -1, rounding);  // held
  EXPECT_NEAR((*unilateral_forces(tight, W, Eigen::Vector2d(1, -3)))[1], 2, rounding);  // at its most
}

// ---- Painlevé's rod: length 2 m, 1 kg, its tip on the ground at θ = 1 rad, slipping at 1 m/s -----------------------

struct Rod {
  double theta = 1, mu, direction = 1;
  MatrixXd W() const {
    const double c = std::cos(theta), s = std::sin(theta), J = 1.0 / 3;
    MatrixXd out(2, 2);
    out << 1 + c * c / J, c * s / J, c * s / J, 1 + s * s / J;
    return out;
  }
  std::optional<VectorXd> forces(double opening) const {
    const std::vector<UnilateralContact> tip{{.normal = 0, .mu = mu, .sliding = 1, .direction = direction}};
    return unilateral_forces(tip, W(), Eigen::Vector2d(opening, 0));
  }
};

TEST(UnilateralForces, PushPainlevesRodAsLongAsItMaySlide) {
  const auto slides = Rod{.mu = 1}.forces(-9.81), back = Rod{.mu = 2, .direction = -1}.forces(-9.81);
  ASSERT_TRUE(slides && back);
  EXPECT_NEAR((*slides)[0], 19.1663851402163, 1e-12 * 20);  // g/(W_NN − μ W_NT)
  EXPECT_NEAR((*slides)[1], -19.1663851402163, 1e-12 * 20);
  EXPECT_NEAR((*back)[0], 2.13090766356263578, 1e-12 * 3);
  EXPECT_NEAR((*back)[1], 2 * 2.13090766356263578, 1e-12 * 5);
}

// W_NN < μ W_NT: the more the ground pushes, the faster the tip goes down.
TEST(UnilateralForces, OfPainlevesJammedRodAreNone) {
  for (const double mu : {1.38, 1.6, 2.0, 5.0}) EXPECT_FALSE(Rod{.mu = mu}.forces(-9.81)) << mu;
  for (const double mu : {1.0, 1.37}) EXPECT_TRUE(Rod{.mu = mu}.forces(-9.81)) << mu;
}

}  // namespace
}  // namespace pintle::complementarity_test
