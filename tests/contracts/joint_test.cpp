// The exam every joint sits. A new joint joins by one line in joint_kinds.h.

#include "framework/dynamics/model/joints.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "tests/contracts/joint_kinds.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::joint_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Tolerances, relative to the size of the terms.
// A few dozen operations on numbers of one size.
constexpr double rounding = 1e-12;
// Central difference over `step`: 1e-10 cut-off times third derivatives up to 1e2 (two points that
// come within 0.3 of each other turn fast), 1e-11 rounding.
constexpr double difference = 1e-7;
constexpr double step = 1e-5;
// Smallest over largest singular value of one joint's rows at arms below 1 m. Dependent rows give
// 1e-16, the clamp on long arms 0.1.
constexpr double independent = 0.02;
constexpr int draws = 200;

double largest(const VectorXd& x) { return x.size() == 0 ? 0 : x.lpNorm<Eigen::Infinity>(); }

/// Poses or rates of a joint's markers, or what follows from them, one an end.
using Ends = std::vector<Vector3d>;

struct Evaluated {
  ConstraintRows rows;
  std::vector<ConstraintRows::Block> L;
};

class JointContract : public testing::TestWithParam<Kind> {
 protected:
  Joint joint_ = GetParam().make(0, 1, -0.4);
  std::size_t n_ = static_cast<std::size_t>(ends_of(joint_).n);
  Draw draw_{7};

  Evaluated evaluated(const Ends& poses, const Ends& rates, double t) const {
    std::vector<MarkerMotion> markers;
    for (std::size_t i = 0; i < n_; ++i) markers.push_back(moving(poses[i], rates[i]));
    Evaluated out;
    out.L.assign(n_, ConstraintRows::Block::Zero());
    evaluate_pose(joint_, markers.data(), t, out.rows, out.L.data());
    evaluate_speed(joint_, markers.data(), t, out.rows);
    return out;
  }
  Evaluated evaluated(const Ends& poses, double t) const { return evaluated(poses, Ends(n_, Vector3d::Zero()), t); }
  // Poses of which the first two points are apart: a distance has no derivative where they meet.
  Ends poses() {
    for (;;) {
      Ends p;
      for (std::size_t i = 0; i < n_; ++i) p.push_back(draw_.pose());
      if ((p[0] - p[1]).head<2>().norm() > 0.3) return p;
    }
  }
  Ends rates() {
    Ends r;
    for (std::size_t i = 0; i < n_; ++i) r.push_back(draw_.rates());
    return r;
  }
};

TEST_P(JointContract, JacobiansAreDifferencesOfTheViolationOverPoses) {
  for (int n = 0; n < draws; ++n) {
    const Ends p = poses();
    const Evaluated here = evaluated(p, 0.3);
    for (std::size_t end = 0; end < n_; ++end)
      for (int i = 0; i < 3; ++i) {
        Ends forth = p, back = p;
        forth[end][i] += step;
        back[end][i] -= step;
        const Vector3d slope = (evaluated(forth, 0.3).rows.C - evaluated(back, 0.3).rows.C) / (2 * step);
        EXPECT_LT(largest(here.L[end].col(i) - slope), difference * 3) << "draw " << n << ", end " << end << ", column " << i;
      }
  }
}

// Along p(t) = p₀ + p₁ t + p₂ t²: the first difference of C and the first difference of Ċ.
TEST_P(JointContract, RatesAreDifferencesAlongASmoothMotion) {
  for (int n = 0; n < draws; ++n) {
    const Ends p0 = poses(), p1 = rates(), p2 = rates();
    const double t0 = draw_.within(-3, 3);
    const auto rates_after = [&](double t) {
      Ends out;
      for (std::size_t i = 0; i < n_; ++i) out.emplace_back(p1[i] + 2 * p2[i] * t);
      return out;
    };
    const auto after = [&](double t) {
      Ends p;
      for (std::size_t i = 0; i < n_; ++i) p.emplace_back(p0[i] + p1[i] * t + p2[i] * t * t);
      return evaluated(p, rates_after(t), t0 + t);
    };
    const auto rate_after = [&](double t) -> Vector3d {
      const Evaluated r = after(t);
      const Ends rates = rates_after(t);
      Vector3d out = r.rows.Ct;
      for (std::size_t i = 0; i < n_; ++i) out += r.L[i] * rates[i];
      return out;
    };
    const Evaluated r = after(0);
    const Vector3d C_rate = (after(step).rows.C - after(-step).rows.C) / (2 * step);
    const Vector3d C_accel = (rate_after(step) - rate_after(-step)) / (2 * step);
    Vector3d accel = r.rows.kappa;
    for (std::size_t i = 0; i < n_; ++i) accel += 2 * r.L[i] * p2[i];
    // Rates up to 5, so terms of Ċ up to 10 and of C̈ up to 100.
    EXPECT_LT(largest(rate_after(0) - C_rate), 10 * difference) << "draw " << n;
    EXPECT_LT(largest(accel - C_accel), 100 * difference) << "draw " << n;
  }
}

TEST_P(JointContract, OnlyADriverDependsOnTime) { EXPECT_EQ(is_driver(joint_), largest(evaluated(poses(), 0.3).rows.Ct) > 0); }

TEST_P(JointContract, RowsBeyondItsOwnStayEmpty) {
  const Evaluated r = evaluated(poses(), rates(), 0.3);
  for (int i = rows(joint_); i < 3; ++i) {
    EXPECT_EQ(std::abs(r.rows.C[i]) + std::abs(r.rows.Ct[i]) + std::abs(r.rows.kappa[i]), 0);
    for (const auto& L : r.L) EXPECT_EQ(L.row(i).norm(), 0);
  }
}

// At a closed pose action equals reaction, force and moment: the joint adds no momentum.
TEST_P(JointContract, ItsWrenchesCancel) {
  for (int n = 0; n < draws; ++n) {
    Ends p = poses();
    Evaluated r = evaluated(p, 0.3);
    for (int i = 0; i < 30 && largest(r.rows.C) > 0; ++i) {
      const MatrixXd L = r.L[1].topRows(rows(joint_));
      p[1] -= L.transpose() * (L * L.transpose()).ldlt().solve(r.rows.C.head(rows(joint_)));
      r = evaluated(p, 0.3);
    }
    ASSERT_LT(largest(r.rows.C), 10 * rounding);
    const Vector3d lambda = draw_.rates();
    Vector2d force = Vector2d::Zero();
    double moment = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const Vector3d on = -r.L[i].transpose() * lambda;
      force += on.head<2>();
      moment += cross(p[i].head<2>(), on.head<2>()) + on[2];
    }
    EXPECT_LT(force.norm(), 10 * rounding);
    EXPECT_LT(std::abs(moment), 100 * rounding) << "draw " << n;
  }
}

// What the equations may leave out: directions that no equation reads, and angles that turn nothing.
TEST_P(JointContract, PropertiesSayWhatItReads) {
  const JointProperties& of = properties_of(joint_);
  bool turns = false;
  for (int n = 0; n < draws; ++n) {
    const Ends p = poses();
    for (const auto& L : evaluated(p, 0.3).L) turns = turns || L.col(2).norm() > 0;
    const Ends v = rates();
    std::vector<MarkerMotion> markers;
    for (std::size_t i = 0; i < n_; ++i) {
      markers.push_back(moving(p[i], v[i]));
      if (!of.directions[i]) markers.back().u.setConstant(std::nan(""));
    }
    Evaluated r{{}, std::vector<ConstraintRows::Block>(n_, ConstraintRows::Block::Zero())};
    evaluate_pose(joint_, markers.data(), 0.3, r.rows, r.L.data());
    evaluate_speed(joint_, markers.data(), 0.3, r.rows);
    EXPECT_TRUE(r.rows.C.allFinite() && r.rows.kappa.allFinite());
    for (const auto& L : r.L) EXPECT_TRUE(L.allFinite());
    const Vector3d lambda(1.2, -0.7, 0.4);
    const WrenchTangent tangent = wrench_tangent(joint_, markers.data(), lambda.data());
    EXPECT_TRUE(tangent.pose.allFinite());
    for (std::size_t i = 0; i < n_; ++i)
      for (std::size_t j = 0; j < n_; ++j)
        EXPECT_TRUE(of.curvature.block[i][j] ||
                    tangent.pose.block(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j), 3, 3).isZero(0))
            << i << ", " << j;
  }
  EXPECT_EQ(turns, of.angles);
}

// ---- the joint between bodies of every kind and the ground ------------------------------------

class JointBetween : public testing::TestWithParam<std::tuple<Kind, Carriers>> {
 protected:
  System system_ = make();
  Draw draw_{11};

  static System make() {
    const auto [kind, carriers] = GetParam();
    const Joint joint = kind.make(0, 1, -0.4);
    System s = bodies_for(joint, carriers);
    s.gravity = {0.6, -9.8};
    s.joints = {joint};
    s.joint_names = {kind.name};
    number(s);
    return s;
  }
  State state(Equations& eq) { return random_state(system_, draw_, eq); }
  MatrixXd jacobian(const Equations& eq) const {
    MatrixXd Cq = MatrixXd::Zero(system_.n_rows(), system_.n());
    visit_jacobian(eq, [&](int row, int column, double value) { Cq(row, column) = value; });
    return Cq;
  }
};

TEST_P(JointBetween, JacobianIsDifferencesOfTheViolationOverCoordinates) {
  Equations eq(system_);
  for (int n = 0; n < draws; ++n) {
    const State s = state(eq);
    const MatrixXd Cq = jacobian(eq);
    for (int i = 0; i < system_.n(); ++i) {
      VectorXd forth = s.y, back = s.y;
      forth[i] += step;
      back[i] -= step;
      pose(system_, s.t, forth, eq);
      const VectorXd C = eq.C;
      pose(system_, s.t, back, eq);
      EXPECT_LT(largest(Cq.col(i) - (C - eq.C) / (2 * step)), 3 * difference) << "draw " << n << ", coordinate " << i;
    }
  }
}

TEST_P(JointBetween, SpeedViolationIsTheRateOfThePositionViolation) {
  Equations eq(system_);
  for (int n = 0; n < draws; ++n) {
    const State s = state(eq);
    const auto C_after = [&](double t) -> VectorXd {
      VectorXd y = s.y;
      y.head(system_.n()) += t * s.y.segment(system_.n(), system_.n());
      pose(system_, s.t + t, y, eq);
      return eq.C;
    };
    const VectorXd C_rate = (C_after(step) - C_after(-step)) / (2 * step);
    pose(system_, s.t, s.y, eq);
    speed(system_, s.t, s.y, eq);
    EXPECT_LT(largest(eq.Cdot - C_rate), 10 * difference) << "draw " << n;
  }
}

// γ = −d/dt(Cq s + Ct) at constant s; Cq a = γ: along the accelerations found, Ċ stays as it is.
TEST_P(JointBetween, AccelerationsKeepTheSpeedViolation) {
  Equations eq(system_);
  VectorXd dy(system_.n_y());
  const int n_q = system_.n();
  for (int n = 0; n < draws; ++n) {
    const State s = state(eq);
    ASSERT_TRUE(evaluate(system_, s, eq, dy));
    const VectorXd gamma = eq.gamma, a = dy.segment(n_q, n_q);
    const auto drift = [&](const VectorXd& accelerations) -> VectorXd {
      const auto Cdot_after = [&](double t) -> VectorXd {
        VectorXd y = s.y;
        y.head(n_q) += t * s.y.segment(n_q, n_q) + 0.5 * t * t * accelerations;
        y.segment(n_q, n_q) += t * accelerations;
        pose(system_, s.t + t, y, eq);
        speed(system_, s.t + t, y, eq);
        return eq.Cdot;
      };
      return (Cdot_after(step) - Cdot_after(-step)) / (2 * step);
    };
    // Speeds of the points up to 10, where they are 0.3 apart: terms up to 300.
    EXPECT_LT(largest(gamma + drift(VectorXd::Zero(n_q))), 300 * difference) << "draw " << n;
    EXPECT_LT(largest(drift(a)), (300 + 3 * largest(a)) * difference) << "draw " << n;
  }
}

// Power of λ on the markers and on the bodies, where Ċ = 0: that of the driver, λ·Ct; else none.
TEST_P(JointBetween, ReactionDoesNoWorkUnlessDriven) {
  Equations eq(system_);
  const int n_q = system_.n();
  for (int n = 0; n < draws; ++n) {
    State s = state(eq);
    const MatrixXd Cq = jacobian(eq);
    speed(system_, s.t, s.y, eq);
    s.y.segment(n_q, n_q) -= Cq.transpose() * (Cq * Cq.transpose()).ldlt().solve(eq.Cdot);
    speed(system_, s.t, s.y, eq);
    ASSERT_LT(largest(eq.Cdot), 100 * rounding);

    const Vector3d lambda = draw_.rates();
    VectorXd f = VectorXd::Zero(n_q);
    double power = 0;
    for (std::size_t end = 0; end < eq.L.size(); ++end) {
      const Wrench on = -eq.L[end].transpose() * lambda;
      const MarkerMotion& m = eq.motion[end];
      power += on.dot(Vector3d(m.v.x(), m.v.y(), m.w));
      add_wrench(system_, eq, static_cast<int>(end), on, f);
    }
    const double driven = lambda.dot(eq.rows[0].Ct);
    EXPECT_NEAR(power, driven, 100 * rounding) << "draw " << n;
    EXPECT_NEAR(f.dot(s.y.segment(n_q, n_q)), driven, 100 * rounding) << "draw " << n;
    EXPECT_TRUE(is_driver(system_.joints[0]) || driven == 0);
  }
}

TEST_P(JointBetween, RowsAreIndependent) {
  Equations eq(system_);
  for (int n = 0; n < draws; ++n) {
    const VectorXd y = state(eq).y;
    factor(system_, y, eq);
    EXPECT_TRUE(eq.regular);
    const VectorXd sigma = Eigen::JacobiSVD<MatrixXd>(jacobian(eq)).singularValues();
    EXPECT_GT(sigma.minCoeff(), independent * sigma.maxCoeff()) << "draw " << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, JointContract, testing::ValuesIn(kinds), [](const auto& p) { return p.param.name; });
INSTANTIATE_TEST_SUITE_P(Each, JointBetween, testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(all_carriers())),
                         [](const auto& p) { return std::get<0>(p.param).name + name_of(std::get<1>(p.param)); });

TEST(JointContract, EveryKindSitsTheExam) {
  std::vector<std::size_t> seen;
  for (const Kind& kind : kinds) seen.push_back(kind.make(0, 1, 0).index());
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  EXPECT_EQ(seen.size(), std::variant_size_v<Joint>);
}

}  // namespace
}  // namespace pintle::joint_test
