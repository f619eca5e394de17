#pragma once

#include "framework/configuration/row_solver.h"

namespace pintle {

/// A mechanism moved by hand: only its joints act, drivers are released, joints with clearance closed, no forces.
class MovedByHand {
 public:
  /// @param y  coordinates that close the joints, at least nearly
  MovedByHand(const System&, const Eigen::VectorXd& y);

  /// Moves a point of a body towards a position, as near as the joints allow, in small steps, to stay on the same branch.
  /// @param point  from the mass centre, body axes [m]   @returns false: the joints did not close, and nothing has moved
  bool pull(int body, const Eigen::Vector2d& point, const Eigen::Vector2d& to);

  const Eigen::VectorXd& coordinates() const { return q_; }
  /// Small motions that the joints allow, one per column, independent and at most `most`; largest entry 1 rad or the mechanism's length.
  Eigen::MatrixXd dofs(int most) const;
  /// Total number of these motions.
  int mobility() const;

 private:
  bool close(Eigen::VectorXd& q);
  void stand(const Eigen::VectorXd& q);
  Eigen::VectorXd allowed(const Eigen::VectorXd& motion) const;

  System system_;
  Equations eq_;
  RowSolver rows_;
  Eigen::VectorXd q_;
};

}  // namespace pintle
