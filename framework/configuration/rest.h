#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/equations/tangent.h"
#include "framework/dynamics/newton/kkt.h"

namespace pintle {

/// Fixes the drivers of `held` at the values of their laws in `from` at t.
void hold_drivers(const System& from, double t, System& held);
bool has_potential(const System&);

/// Own states held at prescribed values.
struct KeptStates {
  std::vector<int> which;
  std::shared_ptr<Eigen::VectorXd> at;  ///< values of all own states
};

/// A mechanism at rest in a configuration: the forces out of balance and the potential energy.
class Rest {
 public:
  Rest(const System&, double t, const KeptStates& = {});

  /// Projects the configuration onto the joints and evaluates everything there.
  /// @returns false if that fails, or takes too large a step
  bool project(State&, double farthest);

  /// Largest coordinate of a displacement, relative to the mechanism's size, angles in radians.
  double size(const Eigen::VectorXd& displacement) const;
  /// Largest remaining force or couple relative to the largest acting one.
  double residual() const;
  /// The same in the metric of M⁻¹, which the overdamped flow reduces.
  double unrest() const;
  double rounding() const { return 1e-14 * magnitude_; }  ///< of the potential energy
  double at_work() const;                                 ///< largest force, or couple over the mechanism's length

  System held;  ///< the mechanism with its drivers held
  Equations eq;
  Tangent tangent;
  Kkt kkt;
  std::vector<double> values;
  Eigen::VectorXd out_of_balance;
  double potential = 0;

 private:
  void stop(State&) const;
  double potential_of(const State&, double& magnitude) const;

  double t_, span_ = 1, magnitude_ = 0;
};

/// Columns: displacements, relative to System::scale, that violate no constraint.
Eigen::MatrixXd open_directions(const System&, const Equations&);

}  // namespace pintle
