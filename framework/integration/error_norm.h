#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/system.h"
#include "framework/common/members.h"
#include "framework/integration/step.h"

namespace pintle {

/// Scales of errors. Lengths, and modal coordinates by the displacement of their shapes, are compared with the smallest length that matters
/// (a clearance c, otherwise the mechanism's length); angles by the displacement they cause; speeds with the fastest so far; internal
/// states with their own scale; integrals with the kinetic energy so far.
class ErrorNorm {
 public:
  ErrorNorm(const System&, double tolerance);

  /// Largest error of a step over its scale. @param follows_impacts  with a clearance, speeds are compared with the speed gained across it
  /// at the acceleration of the motion, √(c v ω), where ω = v/L or that of the lowest shape, and speeds of shapes with the equally fine ω c
  double of(const Step&, bool follows_impacts) const;
  /// Updates the largest speed and energy so far from an accepted node.
  void see(const Eigen::VectorXd& y);

  double length() const { return fine_length_; }
  /// Largest speed of a body's centre, or of its farthest marker relative to the centre [m/s].
  double fastest_speed(const Eigen::VectorXd& y) const;
  /// Scale of speeds in a step of h from y [m/s].
  double speed(const Eigen::VectorXd& y, double h) const;

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(fastest_, energy_));
  }

 private:
  const System& system_;
  double tolerance_;
  double fine_length_ = 1, mass_ = 0, lowest_shape_ = 0;
  std::vector<double> reach_;  ///< per body, largest |x_BP| of its markers [m]
  double fastest_ = 0, energy_ = 0;
};

}  // namespace pintle
