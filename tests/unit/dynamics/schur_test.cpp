// S μ = r where rows are dependent, by design or at a pose: accelerations and multipliers of least norm against
// Eigen's complete orthogonal decomposition of [M Cqᵀ; Cq 0].

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <Eigen/QR>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/equations/jacobian.h"

namespace pintle::schur_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double half = 0.1;

struct Case {
  System system;
  State state;
};
void finish(Case& c, double length) {
  c.system.gravity = {0.4, -9.81};
  c.system.joint_names.assign(c.system.joints.size(), "joint");
  c.system.length = length;
  number(c.system);
  c.state.y.setZero(c.system.n_y());
}
Body bar(double m) { return {"bar", m, m * half * half / 3, {0, 0}, {}}; }

/// One leaf on two hinges, one above the other: seen from above, the same pin twice; turning.
Case door() {
  Case c;
  c.system.markers = {{}, {0, {-half, 0}, 0, {}, {}, {}}};
  c.system.bodies = {bar(2)};
  c.system.joints = {Revolute{0, 1}, Revolute{0, 1}};
  finish(c, half);
  const Vector2d u(std::cos(0.3), std::sin(0.3));
  c.state.y.segment<3>(0) << half * u, 0.3;
  c.state.y.segment<3>(3) << half * 2 * perp(u), 2;
  return c;
}

/// A bar clamped at both its ends.
Case clamped_twice() {
  Case c;
  c.system.markers = {{ground, {-half, 0}, 0, {}, {}, {}},
                      {ground, {half, 0}, 0, {}, {}, {}},
                      {0, {-half, 0}, 0, {}, {}, {}},
                      {0, {half, 0}, 0, {}, {}, {}}};
  c.system.bodies = {bar(3)};
  c.system.joints = {Weld{0, 2}, Weld{1, 3}};
  finish(c, half);
  return c;
}

/// Links in a row, spinning, every fifth pin there twice.
Case chain(int links) {
  Case c;
  c.system.markers.push_back({});
  for (int i = 0; i < links; ++i) {
    c.system.bodies.push_back(bar(1 + i % 3));
    for (double x : {-half, half}) c.system.markers.push_back({i, {x, 0}, 0, {}, {}, {}});
    for (int k = 0; k < (i % 5 == 1 ? 2 : 1); ++k) c.system.joints.emplace_back(Revolute{2 * i, 2 * i + 1});
  }
  finish(c, half);
  Vector2d end(0, 0), rate(0, 0);
  for (int i = 0; i < links; ++i) {
    const double angle = 1.4 * std::sin(3.0 * i), spin = std::cos(5.0 * i);
    const Vector2d u(std::cos(angle), std::sin(angle));
    c.state.y.segment<3>(3 * i) << end + half * u, angle;
    c.state.y.segment<3>(c.system.n() + 3 * i) << rate + half * spin * perp(u), spin;
    end += 2 * half * u;
    rate += 2 * half * spin * perp(u);
  }
  return c;
}

/// Two cranks of length 2·half and a coupler as long as their bearings are apart, at an angle; `many` side by
/// side, each with its own coupler. Rows are dependent where all lies flat, at 0.
Case parallelograms(int many, double angle) {
  Case c;
  const double base = 6 * half;
  for (int k = 0; k < many; ++k) {
    const int b = 3 * k, m = static_cast<int>(c.system.markers.size());
    for (double x : {0.0, base}) c.system.markers.push_back({ground, {x, 0}, 0, {}, {}, {}});
    for (int crank : {0, 1})
      for (double x : {-half, half}) c.system.markers.push_back({b + crank, {x, 0}, 0, {}, {}, {}});
    for (double x : {-base / 2, base / 2}) c.system.markers.push_back({b + 2, {x, 0}, 0, {}, {}, {}});
    c.system.bodies.insert(c.system.bodies.end(), {bar(1), bar(1), bar(2)});
    c.system.joints.insert(c.system.joints.end(),
                           {Revolute{m, m + 2}, Revolute{m + 1, m + 4}, Revolute{m + 3, m + 6}, Revolute{m + 5, m + 7}});
  }
  finish(c, half);
  const Vector2d u(std::cos(angle), std::sin(angle));
  for (int k = 0; k < many; ++k) {
    c.state.y.segment<3>(9 * k) << half * u, angle;
    c.state.y.segment<3>(9 * k + 3) << half * u + Vector2d(base, 0), angle;
    c.state.y.segment<3>(9 * k + 6) << 2 * half * u + Vector2d(base / 2, 0), 0;
  }
  return c;
}

/// The step of `accelerate` before it looks for a branch.
struct Solved {
  explicit Solved(const Case& c) : eq(c.system) {
    pose(c.system, 0, c.state.y, eq);
    factor(c.system, c.state.y, eq);
    speed(c.system, 0, c.state.y, eq);
    apply_forces(c.system, c.state, eq);
    // S λ = Cq M⁻¹ f − γ for a given γ, Cq a = γ, here of any consistent kind: γ = Cq a₀.
    Cq = dense_jacobian(c.system, eq);
    VectorXd M(c.system.n());
    for (std::size_t b = 0; b < c.system.bodies.size(); ++b)
      M.segment<3>(3 * static_cast<Index>(b)) << c.system.bodies[b].m, c.system.bodies[b].m, c.system.bodies[b].J;
    VectorXd a0(M.size());
    for (Index i = 0; i < a0.size(); ++i) a0[i] = std::sin(1.0 + 2.0 * static_cast<double>(i)) * c.system.scale[i];
    const VectorXd gamma = Cq * a0;
    lambda = Cq * eq.f.cwiseQuotient(M) - gamma;
    eq.schur.solve(lambda);
    a = (eq.f - Cq.transpose() * lambda).cwiseQuotient(M);

    const Index n = M.size(), m = gamma.size();
    MatrixXd K = MatrixXd::Zero(n + m, n + m);
    const VectorXd root = M.cwiseSqrt().cwiseInverse();
    K.topLeftCorner(n, n).setIdentity();
    const MatrixXd L = c.system.row_scale.asDiagonal() * Cq * root.asDiagonal();
    K.bottomLeftCorner(m, n) = L;
    K.topRightCorner(n, m) = L.transpose();
    VectorXd r(n + m);
    r << eq.f.cwiseProduct(root), gamma.cwiseProduct(c.system.row_scale);
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr;
    qr.setThreshold(1e-12);
    qr.compute(K);
    const VectorXd z = qr.solve(r);
    rank = static_cast<int>(qr.rank());
    a_ref = z.head(n).cwiseProduct(root);
    lambda_ref = z.tail(m).cwiseProduct(c.system.row_scale);
    const auto apart = [](const VectorXd& x, const VectorXd& y, const VectorXd& unit) {
      return (x - y).cwiseQuotient(unit).norm() / y.cwiseQuotient(unit).norm();
    };
    a_error = apart(a, a_ref, c.system.scale);
    lambda_error = apart(lambda, lambda_ref, c.system.row_scale);
  }

  Equations eq;
  MatrixXd Cq;
  VectorXd a, lambda, a_ref, lambda_ref;
  int rank = 0;
  double a_error = 0, lambda_error = 0;
};

struct Named {
  const char* name;
  Case made;
  int lost;
};

TEST(DependentRows, GiveTheAccelerationsAndTheMultipliersOfLeastNorm) {
  for (const Named& of : {Named{"door", door(), 2}, Named{"clamped twice", clamped_twice(), 3}, Named{"chain, dense", chain(12), 6},
                          Named{"chain, sparse", chain(60), 24}, Named{"flat parallelogram", parallelograms(1, 0), 1},
                          Named{"flat parallelograms, sparse", parallelograms(7, 0), 7}}) {
    SCOPED_TRACE(of.name);
    const Solved s(of.made);
    EXPECT_EQ(s.eq.schur.sparse(), of.made.system.n_rows() > Schur::dense_rows);
    EXPECT_TRUE(s.eq.regular);
    EXPECT_EQ(s.eq.schur.lost(), of.lost);
    EXPECT_EQ(s.rank, of.made.system.n() + of.made.system.n_rows() - of.lost);
    EXPECT_LT(s.eq.schur.inconsistency(), 1e-12);
    EXPECT_LT(s.a_error, 1e-10);
    EXPECT_LT(s.lambda_error, 1e-5) << "what dependent rows share is known to rounding over the shift, 1e-6";
  }
}

TEST(DependentRows, AreNotSeenInRegularSystems) {
  for (const Case& c : {parallelograms(1, 0.5), parallelograms(7, 0.5)}) {
    const Solved s(c);
    EXPECT_FALSE(s.eq.schur.dependent());
    EXPECT_EQ(s.eq.schur.inconsistency(), 0);
    EXPECT_LT(s.a_error, 1e-12);
    EXPECT_LT(s.lambda_error, 1e-11);
  }
}

// Pivots go with the square of the angle: 1e-2 … 1e-12. Cq a = γ is met ever after, whatever holds it.
TEST(DependentRows, NearAFlatPoseTheConstraintsAreMetToWhatThePivotLeaves) {
  for (int many : {1, 7})
    for (double angle = 0.1; angle > 1e-9; angle /= 10) {
      SCOPED_TRACE(angle);
      const Case c = parallelograms(many, angle);
      const Solved s(c);
      ASSERT_TRUE(s.eq.regular);
      ASSERT_TRUE(s.a.allFinite() && s.lambda.allFinite());
      if (angle < 1e-5) continue;  // the threshold of the reference, too
      EXPECT_LT(s.a_error, 1e-13 / angle);
    }
}

TEST(DependentRows, ThatContradictEachOtherAreMissedByTheLeastSquaresAndSaySo) {
  for (int links : {12, 60}) {
    const Case c = chain(links);
    Equations eq(c.system);
    pose(c.system, 0, c.state.y, eq);
    factor(c.system, c.state.y, eq);
    const int row = c.system.row_begin[1];  // joints 1 and 2 are the same pin
    VectorXd mu = VectorXd::Zero(c.system.n_rows());
    mu[row] = 1, mu[row + 2] = 3;
    eq.schur.solve(mu);
    EXPECT_NEAR(eq.schur.inconsistency(), 1.0 / 3, 1e-5);
    VectorXd both = VectorXd::Zero(mu.size());
    both[row] = both[row + 2] = 2;
    eq.schur.solve(both);
    EXPECT_LT(eq.schur.inconsistency(), 1e-12);
    EXPECT_LT((mu - both).norm(), 1e-4 * both.norm());
  }
}

TEST(DependentRows, AreRefusedOnlyIfNotNumbers) {
  for (int links : {12, 60}) {
    Case c = chain(links);
    Equations eq(c.system);
    c.state.y[2] = std::nan("");
    pose(c.system, 0, c.state.y, eq);
    factor(c.system, c.state.y, eq);
    EXPECT_FALSE(eq.regular);
  }
}

}  // namespace
}  // namespace pintle::schur_test
