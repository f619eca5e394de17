#pragma once

#include <memory>
#include <vector>

#include "framework/dynamics/equations/tangent.h"
#include "framework/dynamics/newton/kkt.h"

namespace pintle {

/// Drivers of `held` held where their laws in `from` are at t.
void hold_drivers(const System& from, double t, System& held);
bool has_potential(const System&);

/// Own states that stay at numbers given from outside.
struct KeptStates {
  std::vector<int> which;
  std::shared_ptr<Eigen::VectorXd> at;  ///< of every own state
};

/// What is asked of a mechanism at rest in a pose: the forces out of balance, the potential energy.
class Rest {
 public:
  Rest(const System&, double t, const KeptStates& = {});

  /// Brings the pose onto the joints and evaluates everything there.
  /// @returns false if it cannot be, or only by a leap
  bool project(State&, double farthest);

  /// Largest coordinate of a displacement, over the mechanism's extent, angles as they are.
  double size(const Eigen::VectorXd& displacement) const;
  /// Greatest force or couple left over the greatest at work.
  double residual() const;
  /// The same at the metric of M⁻¹: what the flow lowers.
  double unrest() const;
  double rounding() const { return 1e-14 * magnitude_; }  ///< of the potential energy
  double at_work() const;                                 ///< greatest force, or couple over the mechanism's length

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

/// Columns: displacements over System::scale that violate no row.
Eigen::MatrixXd open_directions(const System&, const Equations&);

}  // namespace pintle
