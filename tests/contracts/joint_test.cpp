// The exam every joint sits. A new joint joins by one line in `kinds`.

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
#include <utility>
#include <variant>
#include <vector>

#include "framework/dynamics/equations/equations.h"
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

struct Kind {
  const char* name;
  Joint (*make)(int a, int b, double angle);
};
void PrintTo(const Kind& kind, std::ostream* out) {
  *out << kind.name;
}
const Kind kinds[] = {
    {"Revolute",
     [](int a, int b, double) {
       return Joint{Revolute{a, b}};
     }},
    {"Slot",
     [](int a, int b, double) {
       return Joint{Slot{a, b}};
     }},
    {"Prismatic",
     [](int a, int b, double angle) {
       return Joint{Prismatic{a, b, angle}};
     }},
    {"Weld",
     [](int a, int b, double angle) {
       return Joint{Weld{a, b, angle}};
     }},
    {"Distance",
     [](int a, int b, double) {
       return Joint{Distance{a, b, 0.8}};
     }},
    {"AngleDriver",
     [](int a, int b, double) {
       return Joint{AngleDriver{a, b, sine}};
     }},
    {"DistanceDriver",
     [](int a, int b, double) {
       return Joint{DistanceDriver{a, b, sine}};
     }},
};

MarkerMotion at_pose(const Vector3d& p) {
  MarkerMotion m;
  m.r = p.head<2>();
  m.d.setZero();
  m.angle = p[2];
  m.u = {std::cos(p[2]), std::sin(p[2])};
  return m;
}
MarkerMotion moving(const Vector3d& p, const Vector3d& p_rate) {
  MarkerMotion m = at_pose(p);
  m.v = p_rate.head<2>();
  m.w = p_rate[2];
  return m;
}
double largest(const VectorXd& x) {
  return x.size() == 0 ? 0 : x.lpNorm<Eigen::Infinity>();
}

class JointContract : public testing::TestWithParam<Kind> {
 protected:
  Joint joint_ = GetParam().make(0, 1, -0.4);
  Draw draw_{7};

  ConstraintRows rows_at(const MarkerMotion& a, const MarkerMotion& b, double t) const {
    ConstraintRows r;
    evaluate_pose(joint_, a, b, t, r);
    evaluate_speed(joint_, a, b, t, r);
    return r;
  }
  Vector3d C(const Vector3d& a, const Vector3d& b, double t) const {
    return rows_at(at_pose(a), at_pose(b), t).C;
  }
  // Two poses whose points are apart: a distance has no derivative where they meet.
  std::pair<Vector3d, Vector3d> poses() {
    for (;;) {
      std::pair<Vector3d, Vector3d> p{draw_.pose(), draw_.pose()};
      if ((p.first - p.second).head<2>().norm() > 0.3) return p;
    }
  }
};

TEST_P(JointContract, JacobiansAreDifferencesOfTheViolationOverPoses) {
  for (int n = 0; n < draws; ++n) {
    const auto [a, b] = poses();
    const ConstraintRows r = rows_at(at_pose(a), at_pose(b), 0.3);
    for (int i = 0; i < 3; ++i) {
      const Vector3d e = step * Vector3d::Unit(i);
      const Vector3d over_a = (C(a + e, b, 0.3) - C(a - e, b, 0.3)) / (2 * step);
      const Vector3d over_b = (C(a, b + e, 0.3) - C(a, b - e, 0.3)) / (2 * step);
      EXPECT_LT(largest(r.La.col(i) - over_a), difference * 3) << "draw " << n << ", column " << i;
      EXPECT_LT(largest(r.Lb.col(i) - over_b), difference * 3) << "draw " << n << ", column " << i;
    }
  }
}

// Along p(t) = p₀ + p₁ t + p₂ t²: the first difference of C and the first difference of Ċ.
TEST_P(JointContract, RatesAreDifferencesAlongASmoothMotion) {
  for (int n = 0; n < draws; ++n) {
    const auto [a0, b0] = poses();
    const Vector3d a1 = draw_.rates(), b1 = draw_.rates(), a2 = draw_.rates(), b2 = draw_.rates();
    const double t0 = draw_.within(-3, 3);
    const auto rows_after = [&, pa = a0, pb = b0](double t) {
      return rows_at(moving(pa + a1 * t + a2 * t * t, a1 + 2 * a2 * t),
                     moving(pb + b1 * t + b2 * t * t, b1 + 2 * b2 * t), t0 + t);
    };
    const auto rate_after = [&](double t) -> Vector3d {
      const ConstraintRows r = rows_after(t);
      return r.La * (a1 + 2 * a2 * t) + r.Lb * (b1 + 2 * b2 * t) + r.Ct;
    };
    const ConstraintRows r = rows_after(0);
    const Vector3d C_rate = (rows_after(step).C - rows_after(-step).C) / (2 * step);
    const Vector3d C_accel = (rate_after(step) - rate_after(-step)) / (2 * step);
    // Rates up to 5, so terms of Ċ up to 10 and of C̈ up to 100.
    EXPECT_LT(largest(rate_after(0) - C_rate), 10 * difference) << "draw " << n;
    EXPECT_LT(largest(2 * r.La * a2 + 2 * r.Lb * b2 + r.kappa - C_accel), 100 * difference)
        << "draw " << n;
  }
}

TEST_P(JointContract, OnlyADriverDependsOnTime) {
  const auto [a, b] = poses();
  const ConstraintRows r = rows_at(at_pose(a), at_pose(b), 0.3);
  EXPECT_EQ(is_driver(joint_), largest(r.Ct) > 0);
}

TEST_P(JointContract, RowsBeyondItsOwnStayEmpty) {
  const auto [a, b] = poses();
  const ConstraintRows r = rows_at(moving(a, draw_.rates()), moving(b, draw_.rates()), 0.3);
  for (int i = rows(joint_); i < 3; ++i)
    EXPECT_EQ(std::abs(r.C[i]) + std::abs(r.Ct[i]) + std::abs(r.kappa[i]) + r.La.row(i).norm() +
                  r.Lb.row(i).norm(),
              0);
}

// At a closed pose action equals reaction, force and moment: the joint adds no momentum.
TEST_P(JointContract, ItsTwoWrenchesCancel) {
  for (int n = 0; n < draws; ++n) {
    auto [a, b] = poses();
    ConstraintRows r = rows_at(at_pose(a), at_pose(b), 0.3);
    for (int i = 0; i < 30 && largest(r.C) > 0; ++i) {
      const MatrixXd L = r.Lb.topRows(rows(joint_));
      b -= L.transpose() * (L * L.transpose()).ldlt().solve(r.C.head(rows(joint_)));
      r = rows_at(at_pose(a), at_pose(b), 0.3);
    }
    ASSERT_LT(largest(r.C), 10 * rounding);
    const Vector3d lambda = draw_.rates();
    const Vector3d on_a = -r.La.transpose() * lambda, on_b = -r.Lb.transpose() * lambda;
    const auto moment = [](const Vector3d& p, const Vector3d& wrench) {
      return cross(p.head<2>(), wrench.head<2>()) + wrench[2];
    };
    EXPECT_LT((on_a + on_b).head<2>().norm(), 10 * rounding);
    EXPECT_LT(std::abs(moment(a, on_a) + moment(b, on_b)), 100 * rounding) << "draw " << n;
  }
}

// ---- the joint between bodies of every kind and the ground ------------------------------------

class JointBetween : public testing::TestWithParam<std::tuple<Kind, Carriers>> {
 protected:
  System system_ = make();
  Draw draw_{11};

  static System make() {
    const auto [kind, carriers] = GetParam();
    System s = two_bodies(carriers);
    s.gravity = {0.6, -9.8};
    s.joints = {kind.make(0, 1, -0.4)};
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
      EXPECT_LT(largest(Cq.col(i) - (C - eq.C) / (2 * step)), 3 * difference)
          << "draw " << n << ", coordinate " << i;
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
    const ConstraintRows& r = eq.rows[0];
    const Wrench on[] = {-r.La.transpose() * lambda, -r.Lb.transpose() * lambda};
    VectorXd f = VectorXd::Zero(n_q);
    double power = 0;
    for (int side = 0; side < 2; ++side) {
      const MarkerMotion& m = eq.motion[static_cast<std::size_t>(side)];
      power += on[side].dot(Vector3d(m.v.x(), m.v.y(), m.w));
      add_wrench(system_, eq, side, on[side], f);
    }
    const double driven = lambda.dot(r.Ct);
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
INSTANTIATE_TEST_SUITE_P(Each, JointBetween,
                         testing::Combine(testing::ValuesIn(kinds),
                                          testing::ValuesIn(all_carriers())),
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
