// Newton's matrix [J Cqᵀ; Cq 0] against Eigen's fully pivoted LU and orthogonal decomposition.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <sstream>

#include <Eigen/LU>
#include <Eigen/QR>

#include "framework/dynamics/equations/jacobian.h"
#include "framework/dynamics/newton/kkt.h"
#include "framework/common/archive.h"

namespace pintle::kkt_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double length = 0.2;

/// Links in a row from ground, pinned, neighbours sprung to each other; `twice`: every seventh pin is there twice.
struct Chain {
  System system;
  VectorXd y;
  std::vector<int> repeated;  ///< rows that say again what others say
};
Chain chain(int links, bool twice) {
  Chain c;
  System& s = c.system;
  s.markers.push_back({});
  for (int i = 0; i < links; ++i) {
    s.bodies.push_back({"link", 0.1 * (1 + i % 3), 1e-4 * (1 + i % 5), {0, 0}, {}});
    s.markers.push_back({i, {-length / 2, 0}, 0});
    s.markers.push_back({i, {length / 2, 0}, 0});
    s.joints.emplace_back(Revolute{2 * i, 2 * i + 1});
    if (twice && i % 7 == 3) s.joints.emplace_back(Revolute{2 * i, 2 * i + 1});
    s.forces.emplace_back(TorsionSpring{2 * i, 2 * i + 1, 1, 0, 0});
  }
  s.length = length;
  s.joint_names.assign(s.joints.size(), "pin");
  s.force_names.assign(s.forces.size(), "spring");
  number(s);
  for (std::size_t k = 1; k < s.joints.size(); ++k)
    if (ends_of(s.joints[k]).marker == ends_of(s.joints[k - 1]).marker)
      for (int row = s.row_begin[k]; row < s.row_begin[k + 1]; ++row) c.repeated.push_back(row);
  c.y.setZero(s.n_y());
  Eigen::Vector2d end(0, 0);
  for (int i = 0; i < links; ++i) {
    const double angle = 1.3 * std::sin(2.0 * i + 1);
    const Eigen::Vector2d u = length / 2 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    c.y.segment<3>(3 * i) << end + u, angle;
    end += 2 * u;
  }
  return c;
}

/// A system at a pose with a J of its pattern whose symmetric part is positive: `mass` on the diagonal,
/// stiffness as it comes.
struct Posed {
  explicit Posed(const Chain& c) : system(c.system), repeated(c.repeated), eq(c.system), tangent(c.system), J(tangent.places().size()) {
    pose(system, 0, c.y, eq);
    Cq = dense_jacobian(system, eq);
  }
  void fill(double of_mass, double of_speed, double of_place, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    VectorXd diagonal = VectorXd::Zero(system.n()), taken = diagonal;
    for (Index i = 0; i < system.n(); ++i) {
      const Body& b = system.bodies[static_cast<std::size_t>(i / 3)];
      diagonal[i] = (of_mass + of_speed + of_place) * (i % 3 < 2 ? b.m : b.J);
    }
    const std::vector<Tangent::Place>& places = tangent.places();
    std::vector<int> count(static_cast<std::size_t>(system.n()), 0);
    for (const Tangent::Place& p : places) ++count[static_cast<std::size_t>(p.row)];
    for (std::size_t k = 0; k < J.size(); ++k) {
      const auto [r, c] = places[k];
      const double few = 4.0 * count[static_cast<std::size_t>(r)];
      const double size = (of_place + of_speed) * std::sqrt(diagonal[r] * diagonal[c]) / (of_mass + of_speed + of_place);
      J[k] = size * any(random) / few;
      if (r == c && taken[r] == 0) J[k] += diagonal[r], taken[r] = 1;
    }
  }
  MatrixXd whole() const {
    const Index n = system.n(), m = system.n_rows();
    MatrixXd K = MatrixXd::Zero(n + m, n + m);
    for (std::size_t k = 0; k < J.size(); ++k) K(tangent.places()[k].row, tangent.places()[k].column) += J[k];
    K.bottomLeftCorner(m, n) = Cq;
    K.topRightCorner(n, m) = Cq.transpose();
    return K;
  }

  const System& system;
  std::vector<int> repeated;
  Equations eq;
  Tangent tangent;
  std::vector<double> J;
  MatrixXd Cq;
};

/// Solution by the independent rows alone, then y spread over the dependent ones by least norm.
void reference(const Posed& p, VectorXd& x, VectorXd& y) {
  const Index n = p.system.n(), m = p.system.n_rows();
  MatrixXd K = p.whole();
  VectorXd r(n + m);
  r << x, y;
  // Unknowns and equations in like units, so that the pivots are judged rightly.
  VectorXd unit(n + m);
  for (Index i = 0; i < n; ++i) unit[i] = 1 / std::sqrt(K(i, i));
  for (Index i = 0; i < m; ++i) unit[n + i] = 1 / p.Cq.row(i).cwiseProduct(unit.head(n).transpose()).norm();
  K = unit.asDiagonal() * K * unit.asDiagonal();
  r = r.cwiseProduct(unit);
  for (int row : p.repeated) {
    K.row(n + row).setZero();
    K.col(n + row).setZero();
    K(n + row, n + row) = 1;
    r[n + row] = 0;
  }
  const VectorXd z = K.fullPivLu().solve(r).cwiseProduct(unit);
  x = z.head(n);
  y = z.tail(m);
  if (p.repeated.empty()) return;
  const MatrixXd of_y = p.Cq.transpose() * p.system.row_scale.asDiagonal();
  y = of_y.completeOrthogonalDecomposition().solve(p.Cq.transpose() * y).cwiseProduct(p.system.row_scale);
}

double apart(const VectorXd& a, const VectorXd& b, const VectorXd& unit) {
  return (a - b).cwiseQuotient(unit).norm() / b.cwiseQuotient(unit).norm();
}

class KktOf : public testing::TestWithParam<std::tuple<int, bool>> {};
INSTANTIATE_TEST_SUITE_P(Sizes, KktOf, testing::Combine(testing::Values(4, 15, 17, 40), testing::Bool()));

// Weights 1/h² of inertia and 1/h of damping against 1 of stiffness: fifteen decades of h.
TEST_P(KktOf, SolvesWhateverTheStep) {
  const auto [links, twice] = GetParam();
  const Chain c = chain(links, twice);
  Posed p(c);
  Kkt kkt(p.system, p.eq, p.tangent);
  EXPECT_EQ(kkt.sparse(), links > 4) << "both ways sit the exam";
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (double h = 1e-12; h < 1e4; h *= 10) {
    SCOPED_TRACE(h);
    p.fill(1 / (h * h), 1 / h, 1, 3);
    ASSERT_TRUE(kkt.factor(p.system, p.eq, p.J));
    EXPECT_EQ(kkt.dependent(), !p.repeated.empty());
    VectorXd x(p.system.n()), y(p.system.n_rows());
    const VectorXd a = VectorXd::NullaryExpr(x.size(), [&] { return any(random); }).cwiseProduct(p.system.scale);
    y = p.Cq * a;  // consistent
    x = p.whole().topLeftCorner(x.size(), x.size()) * a * 0.5;
    VectorXd x_ref = x, y_ref = y;
    reference(p, x_ref, y_ref);
    kkt.solve(x, y);
    EXPECT_LT(apart(x, x_ref, p.system.scale), 1e-11);
    // What dependent rows share is known to rounding over the shift, 1e-6.
    EXPECT_LT(apart(y, y_ref, p.system.row_scale), twice ? 1e-5 : 1e-10);
    EXPECT_LT(kkt.inconsistency(), 1e-13);
  }
}

class KktOfPinsThereTwice : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Sizes, KktOfPinsThereTwice, testing::Values(4, 15, 17, 40));

TEST_P(KktOfPinsThereTwice, MissesContradictoryRowsByTheLeastSquaresAndSaysSo) {
  const Chain c = chain(GetParam(), true);
  Posed p(c);
  p.fill(1e6, 1e3, 1, 5);
  Kkt kkt(p.system, p.eq, p.tangent);
  ASSERT_TRUE(kkt.factor(p.system, p.eq, p.J));
  VectorXd x = VectorXd::Zero(p.system.n()), y = VectorXd::Zero(p.system.n_rows());
  const int again = p.repeated.front(), first = again - 2;
  y[first] = 1e-3 * length, y[again] = 3e-3 * length;
  kkt.solve(x, y);
  EXPECT_GT(kkt.inconsistency(), 0.1);
  const VectorXd met = p.Cq * x;
  EXPECT_NEAR(met[first], 2e-3 * length, 1e-9 * length) << "each by half";
  EXPECT_NEAR(met[again], 2e-3 * length, 1e-9 * length);
  EXPECT_NEAR(y[first], y[again], 1e-4 * std::abs(y[first])) << "no force grows of what cannot be met";
}

TEST(Kkt, RefusesWhatNothingHolds) {
  for (int links : {4, 40}) {
    const Chain c = chain(links, false);
    Posed p(c);
    Kkt kkt(p.system, p.eq, p.tangent);
    std::fill(p.J.begin(), p.J.end(), 0.0);
    EXPECT_FALSE(kkt.factor(p.system, p.eq, p.J)) << "no stiffness: the chain is free to turn";
    p.fill(1, 0, 0, 1);
    EXPECT_TRUE(kkt.factor(p.system, p.eq, p.J));
    p.J[0] = std::nan("");
    EXPECT_FALSE(kkt.factor(p.system, p.eq, p.J));
  }
}

TEST(Kkt, GoesOnBitForBitFromWhatWasSaved) {
  for (int links : {4, 40})
    for (bool twice : {false, true}) {
      const Chain c = chain(links, twice);
      Posed p(c);
      Kkt one(p.system, p.eq, p.tangent), other(p.system, p.eq, p.tangent);
      for (unsigned i = 1; i < 20; ++i) {
        p.fill(1e6, 1e3 * i, 1, i);
        ASSERT_TRUE(one.factor(p.system, p.eq, p.J));
      }
      std::ostringstream saved;
      Writer out(saved);
      one.save(out);
      std::istringstream stream(saved.str());
      Reader in(stream);
      ASSERT_TRUE(other.load(in));
      for (unsigned i = 20; i < 60; ++i) {
        VectorXd x = VectorXd::LinSpaced(p.system.n(), 1, 2), y = VectorXd::LinSpaced(p.system.n_rows(), -1, 1), u = x, v = y;
        one.solve(x, y);
        other.solve(u, v);
        ASSERT_EQ(x, u);
        ASSERT_EQ(y, v);
        p.fill(1e4, 1e3 * i, 1, i);
        ASSERT_TRUE(one.factor(p.system, p.eq, p.J) && other.factor(p.system, p.eq, p.J));
      }
      std::istringstream foreign("something else");
      Reader wrong(foreign);
      EXPECT_FALSE(other.load(wrong));
    }
}

}  // namespace
}  // namespace pintle::kkt_test
