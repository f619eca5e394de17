#include "framework/component/reduction/static_response.h"

#include <stdexcept>
#include <string>

#include "framework/common/dense.h"
#include "framework/component/fe/statics.h"
#include "framework/component/reduction/reduction.h"

namespace pintle {
namespace {

using Eigen::MatrixXd;

/// Loads together with the reactions of the reference conditions or, with mean axes, the inertia of the acceleration that they cause. The
/// adjoint of `meeting_conditions`: their work on any motion is that of f on the motion after `meeting_conditions`.
MatrixXd in_equilibrium(const Component& c, const ReferenceConditions& conditions, const MatrixXd& loads) {
  const MatrixXd B = reference_condition_rows(c, conditions);
  const Eigen::MatrixX3d r = scaled_rigid_motions(c.model);
  const Eigen::Matrix3d rB = (B * r).transpose();
  return loads - B.transpose() * rB.fullPivLu().solve(r.transpose() * loads);
}

/// Three dofs whose fixing holds the body, far enough apart to be well conditioned.
Supports determinate_hold(const FeModel& model) {
  const MatrixXd motions = scaled_rigid_motions(model).transpose();
  const auto order = motions.colPivHouseholderQr().colsPermutation().indices();
  return {{order[0], order[1], order[2]}};
}

}  // namespace

StaticResponse::StaticResponse(const Component& c) : c_(c), moving_(free_dofs(c.model, determinate_hold(c.model))) {
  if (!held_.compute(restricted(c.K, moving_)))
    throw std::runtime_error(
        "static response: parts of the body are not joined, or a part of it moves without "
        "resistance; join them with elements that resist");
}

MatrixXd StaticResponse::under(const ReferenceConditions& conditions, const MatrixXd& loads) const {
  if (loads.rows() != c_.model.n())
    throw std::invalid_argument("static response: loads of " + std::to_string(loads.rows()) + " rows, must be " +
                                std::to_string(c_.model.n()) + ", one per independent degree of freedom");
  const MatrixXd moving_loads = in_equilibrium(c_, conditions, loads)(moving_, Eigen::all);
  MatrixXd u = MatrixXd::Zero(loads.rows(), loads.cols());
  u(moving_, Eigen::all) = held_.solve(moving_loads);  // in equilibrium: the support forces are zero
  return meeting_conditions(c_, conditions, u);
}

MatrixXd static_response(const Component& c, const ReferenceConditions& conditions, const MatrixXd& loads) {
  return StaticResponse(c).under(conditions, loads);
}

}  // namespace pintle
