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

/// Removes states x whose root is exactly 0 and belongs to no motion: either nothing changes them (a parameter set by events) or they
/// change nothing (a counter). The other roots stay the same.
/// @param first  the first of x that may be removed  @param held  indices into x of those removed, ascending
SmallMotion without_held(SmallMotion, Eigen::Index first, std::vector<int>& held);

/// The equations of motion at a state: accelerations and derivatives of the residual, n × n.
struct MotionAt {
  MotionAt(const System&, const State&);
  State state;
  Equations eq;             ///< evaluated there
  Eigen::MatrixXd M, D, K;  ///< ∂r/∂a, ∂r/∂s, ∂r/∂q, with internal states held
  Tangent::Internal x;      ///< their response, except bristles of open contacts
  std::vector<std::string> x_names;
  bool regular = false;  ///< false: a singular configuration, where only `state` is valid

  /// Rate of change of the configuration: the largest of speeds and rates of internal states over their scales, and of square roots of
  /// accelerations over their scales [1/s]; 0 at rest.
  double rate(const System&) const;

 private:
  void leave_out_open(const System&);
};

/// The axes of the independent coordinates: rotated by `phase`, rotating at `rate` about the world's origin. Translations of bodies are
/// rotated; angles and modal coordinates are unchanged.
struct Axes {
  double rate = 0, phase = 0;  ///< [rad/s], [rad]
};

/// The motions that the constraints allow, along the reference motion: for small p and small offsets u of driven rows, x = [p; u],
///   δq = X x,   δs = X ẋ + X1 x,   δa = X ẍ + 2 X1 ẋ + X2 x    (Cq δq = offsets, to first order, at all times)
/// p are the coordinates `independent` themselves, so X is the identity in their rows if phase is 0.
struct FreeMotion {
  /// @param offset_rows  rows of C whose offsets are inputs
  /// @param independent  chosen before, in a configuration nearby; if null, chosen from the constraints
  FreeMotion(const System&, const MotionAt&, const Axes&, const std::vector<int>& offset_rows, const std::vector<int>* chosen = nullptr);

  std::vector<int> independent, dependent;
  bool full_rank = true;                  ///< all rows of Cq are independent
  std::vector<double> left;               ///< per offset, the part prevented by other rows: 0 to rounding, or they contradict it
  Eigen::MatrixXd X, X1, X2;              ///< n × (m + offsets)
  Eigen::MatrixXd Cq, Cq_rate, Cq_accel;  ///< and its derivatives along the motion

  Eigen::Index m() const { return static_cast<Eigen::Index>(independent.size()); }
  /// Zᵀ(…): the equations of p.
  SmallMotion project(const MotionAt&) const;
};

/// dᵏ/dt of a matrix along the motion at `at`: `fill(eq, matrix)` is called after `pose` at points of the path q + s τ + ½ a τ², whose
/// first two derivatives are those of the motion.
struct Derivatives {
  Eigen::MatrixXd value, rate, accel;
};
template <class Fill>
Derivatives along(const System& system, const MotionAt& at, Eigen::Index rows, Eigen::Index columns, Fill fill) {
  constexpr double reach = 1e-2;  // relative step: sixth order leaves an error of 2e-15, rounding 5e-12 in the second derivative
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
