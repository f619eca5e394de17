#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/system.h"
#include "framework/common/members.h"

namespace pintle {

/// Data of an implicit scheme at a node besides the state; empty for an explicit one.
struct Memory {
  double h = 0;                           ///< of the step to this node; 0: a start, without history [s]
  Eigen::VectorXd a;                      ///< the scheme's own accelerations, and rates of internal states
  Eigen::VectorXd lambda, lambda_before;  ///< multipliers here and a step earlier
  Eigen::VectorXd dy_before;              ///< derivative a step earlier
  Eigen::VectorXd F, P;                   ///< f − Cqᵀλ, and M v̇, which differ by Newton's remaining error
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(h, a, lambda, lambda_before, dy_before, F, P));
  }
};

/// A state with its derivative.
struct Instant {
  State state;
  Eigen::VectorXd dy;
  Memory memory = {};
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(state.t, state.y, state.impact_rate, state.friction, dy, memory));
  }
};

/// From an accepted node to a trial one, with the data for dense output and error control.
struct Step {
  Instant from, to;
  double h = 0;                   ///< [s]
  Eigen::VectorXd error;          ///< of the lower-order solution, as y
  bool ends_at_event = false;     ///< which changed forces or the state …
  Eigen::VectorXd y_before = {};  ///< … from these values, which end the step's dense output
  Eigen::VectorXd dy_before = {};
  const Eigen::VectorXd& y_end() const { return ends_at_event ? y_before : to.state.y; }
  const Eigen::VectorXd& dy_end() const { return ends_at_event ? dy_before : to.dy; }
};

inline constexpr double short_part =
    1e-3;  ///< relative to a step: in shorter ones, accelerations and multipliers of an implicit scheme show the rounding of speeds

}  // namespace pintle
