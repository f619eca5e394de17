#pragma once

#include "framework/configuration/row_solver.h"

namespace pintle {

/// A mechanism that is moved by its joints alone, as by hand: drivers let go, joints with play closed, no forces.
class MovedByHand {
 public:
  /// @param y  coordinates that close the joints, or nearly
  MovedByHand(const System&, const Eigen::VectorXd& y);

  /// Moves a point of a body towards a place, as near as the joints let it come by small steps: no other branch is met by accident.
  /// @param point  from the mass centre, body axes [m]   @returns false: the joints did not close, and nothing has moved
  bool pull(int body, const Eigen::Vector2d& point, const Eigen::Vector2d& to);

  const Eigen::VectorXd& coordinates() const { return q_; }
  /// Small motions that the joints allow, a column each, independent and no more than `most`; greatest entry 1 rad or the mechanism's
  /// length.
  Eigen::MatrixXd freedoms(int most) const;
  /// Of these motions, how many there are in all.
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
