#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/equations/tangent.h"

/// Small motion about a motion, the constraints eliminated: docs/theory/linearisation.md.
namespace pintle {

/// M p̈ + D ṗ + K p = F x + …,  ẋ = G_p p + G_v ṗ + G_x x, of m coordinates and the internal states x.
struct SmallMotion {
  Eigen::MatrixXd M, D, K;
  Eigen::MatrixXd F = {}, G_p = {}, G_v = {}, G_x = {};
};

/// The equations of motion at a state: where it goes and how the residual answers, n × n.
struct MotionAt {
  MotionAt(const System&, const State&);
  State state;
  Equations eq;             ///< evaluated there
  Eigen::MatrixXd M, D, K;  ///< ∂r/∂a, ∂r/∂s, ∂r/∂q, internal states held
  Tangent::Internal x;      ///< how these answer, but for bristles of open contacts
  std::vector<std::string> x_names;
  bool regular = false;  ///< false: a singular pose, and nothing but `state` is there

  /// How fast the pose changes: the greatest of speeds and rates of internal states over scale and the roots of
  /// accelerations over scale [1/s]; 0 at rest.
  double rate(const System&) const;

 private:
  void leave_out_open(const System&);
};

/// The axes in which independent coordinates are told: turned by `phase`, turning at `rate` about the world's
/// origin. Translations of bodies are turned, angles and modal coordinates are as they are.
struct Axes {
  double rate = 0, phase = 0;  ///< [rad/s], [rad]
};

/// What the constraints leave free, along the motion: of small p and of small offsets u of driven rows, x = [p; u],
///   δq = X x,   δs = X ẋ + X1 x,   δa = X ẍ + 2 X1 ẋ + X2 x    (Cq δq = offsets, to first order, at all times)
/// p are the coordinates `independent` themselves, so X is the identity in their rows when phase is 0.
struct FreeMotion {
  /// @param offset_rows  rows of C of which an offset counts as an input
  /// @param independent  chosen before, at a pose near by; by the constraints if null
  FreeMotion(const System&, const MotionAt&, const Axes&, const std::vector<int>& offset_rows, const std::vector<int>* chosen = nullptr);

  std::vector<int> independent, dependent;
  bool full_rank = true;                  ///< no row of Cq follows from others
  std::vector<double> left;               ///< per offset, what other rows forbid of it: 0 to rounding, or they contradict it
  Eigen::MatrixXd X, X1, X2;              ///< n × (m + offsets)
  Eigen::MatrixXd Cq, Cq_rate, Cq_accel;  ///< with its derivatives along the motion

  Eigen::Index m() const { return static_cast<Eigen::Index>(independent.size()); }
  /// Zᵀ(…): the equations of p.
  SmallMotion project(const MotionAt&) const;
};

/// dᵏ/dt of a matrix along the motion at `at`: `fill(eq, matrix)` is called after `pose` at places on the path
/// q + s τ + ½ a τ², which has the derivatives of the motion itself up to the second.
struct Derivatives {
  Eigen::MatrixXd value, rate, accel;
};
template <class Fill>
Derivatives along(const System& system, const MotionAt& at, Eigen::Index rows, Eigen::Index columns, Fill fill) {
  constexpr double reach = 1e-2;  // of a scale, a step: sixth order leaves 2e-15, rounding 5e-12 of the second derivative
  constexpr double first[] = {0.75, -0.15, 1.0 / 60}, second[] = {1.5, -0.15, 1.0 / 90}, middle = -49.0 / 18;
  Derivatives out;
  Eigen::MatrixXd work(rows, columns);
  Equations eq(system);
  State to = at.state;
  const auto value = [&](double tau) -> const Eigen::MatrixXd& {
    const Eigen::Index n = system.n();
    to.y.head(n) = at.state.y.head(n) + tau * at.state.y.segment(n, n) + tau * tau / 2 * at.eq.a;
    pose(system, to.t, to.y, eq);
    work.setZero();
    fill(eq, work);
    return work;
  };
  out.value = value(0);
  out.rate.setZero(rows, columns);
  out.accel.setZero(rows, columns);
  const double rate = at.rate(system);
  if (rate == 0) return out;
  const double h = reach / rate;
  out.accel = middle * out.value;
  for (int k = 1; k <= 3; ++k)
    for (const int sign : {1, -1}) {
      const Eigen::MatrixXd& there = value(sign * k * h);
      out.rate += sign * first[k - 1] * there;
      out.accel += second[k - 1] * there;
    }
  out.rate /= h;
  out.accel /= h * h;
  return out;
}

}  // namespace pintle
