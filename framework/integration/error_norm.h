#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/system.h"
#include "framework/common/members.h"
#include "framework/integration/step.h"

namespace pintle {

/// What errors are measured by. Lengths, modal ones by what their shapes move, are judged against the smallest that matters (a
/// clearance c, else the mechanism), angles by what they move, speeds against the fastest so far, internal states
/// against their own scale, integrals against the kinetic energy so far.
class ErrorNorm {
 public:
  ErrorNorm(const System&, double tolerance);

  /// Largest error of a step over its scale. @param follows_impacts  where there is a clearance, speeds are judged against what is
  /// gained across it at the acceleration of the motion, √(c v ω), ω = v/L or of the lowest shape, and those of shapes against
  /// what is as fine, ω c
  double of(const Step&, bool follows_impacts) const;
  /// An accepted node: largest speed and energy so far.
  void see(const Eigen::VectorXd& y);

  double length() const { return fine_length_; }
  /// Of any body's centre or of its farthest marker about it [m/s].
  double fastest_speed(const Eigen::VectorXd& y) const;
  /// What speeds are measured by in a step of h from y [m/s].
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
