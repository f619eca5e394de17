#include "framework/component/reduction/modal_model.h"

#include <cmath>

#include "framework/common/dense.h"
#include "framework/component/fe/assembly.h"
#include "framework/component/reduction/reduction.h"

namespace pintle {
namespace {

/// The first component that reaches half of the largest is not changed by rounding, unless it is at the threshold; the largest itself may
/// have equals of opposite sign on symmetric bodies.
void fix_signs(ModalModel& model) {
  for (Eigen::Index k = 0; k < model.shapes.cols(); ++k) {
    const auto shape = model.shapes.col(k);
    const double half = shape.lpNorm<Eigen::Infinity>() / 2;
    Eigen::Index i = 0;
    while (i + 1 < shape.size() && std::abs(shape[i]) < half) ++i;
    if (shape[i] >= 0) continue;
    model.shapes.col(k) *= -1;
    model.ports.col(k) *= -1;
  }
}

Eigen::MatrixXd at_ports(const FeModel& model, const Eigen::MatrixXd& shapes) {
  Eigen::MatrixXd ports = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(model.ports.size()), shapes.cols());
  if (shapes.cols() == 0) return ports;
  Eigen::Index row = 0;
  for (const Port& port : model.ports)
    for (const int dof : port.dof) {
      if (dof >= 0) ports.row(row) = shapes.row(dof);
      ++row;
    }
  return ports;
}

Eigen::VectorXd residuals(const Component& c, const ReferenceConditions& conditions, const Modes& modes) {
  const Eigen::MatrixXd force = c.K * modes.shapes;
  Eigen::MatrixXd rest = force - (c.M * modes.shapes) * modes.lambda.asDiagonal();
  if (conditions.kind != ReferenceConditions::mean_axes) {
    const Eigen::MatrixXd B = reference_condition_rows(c, conditions);
    rest -= B.transpose() * (B * rest);
  }
  return rest.colwise().norm().cwiseQuotient(force.colwise().norm()).transpose();
}

}  // namespace

Component component(const FeModel& model, bool lumped) {
  const Assembler assembler(model);
  return {model, independent(model, assembler.stiffness()),
          independent(model, assembler.mass(lumped ? MassKind::lumped : MassKind::consistent))};
}

Eigen::MatrixXd orthonormal(const Sparse& M, const Eigen::MatrixXd& V, double share) {
  Eigen::MatrixXd Q(V.rows(), V.cols()), MQ(V.rows(), V.cols());
  Eigen::Index k = 0;
  for (const auto column : V.colwise()) {
    Eigen::VectorXd v = column, Mv = M * v;
    const double before = std::sqrt(v.dot(Mv));
    for (int pass = 0; pass < 2; ++pass) {
      v -= Q.leftCols(k) * (MQ.leftCols(k).transpose() * v);
      v -= Q.leftCols(k) * (Q.leftCols(k).transpose() * (M * v));
    }
    Mv = M * v;
    const double after = std::sqrt(std::max(0.0, v.dot(Mv)));
    if (!(after > share * before)) continue;
    Q.col(k) = v / after;
    MQ.col(k++) = Mv / after;
  }
  return Q.leftCols(k);
}

ModalModel modal_model(const Component& c, const ReferenceConditions& conditions, const Modes& modes) {
  ModalModel model;
  model.omega = modes.lambda.cwiseMax(0).cwiseSqrt();
  model.residual = residuals(c, conditions, modes);
  model.shapes = nodal(c.model, modes.shapes);
  model.ports = at_ports(c.model, modes.shapes);
  model.sturm = modes.sturm;
  fix_signs(model);
  return model;
}

ModalModel diagonalised(const Component& c, const ReferenceConditions& conditions, const Eigen::MatrixXd& V, std::optional<int> sturm) {
  // Scaling up a small new part of a shape also scales up rounding of rigid motions: the reference conditions are applied again.
  const Eigen::MatrixXd Q = meeting_conditions(c, conditions, orthonormal(c.M, meeting_conditions(c, conditions, V), least_share));
  if (Q.cols() == 0) return modal_model(c, conditions, {Q, Eigen::VectorXd(0), sturm});
  const Eigen::MatrixXd K = Q.transpose() * (c.K * Q), M = Q.transpose() * (c.M * Q);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> small(K, M);
  return modal_model(c, conditions, {Q * small.eigenvectors(), small.eigenvalues(), sturm});
}

ModalModel normal_modes(const Component& c, const ReferenceConditions& conditions, const Keep& keep) {
  if (conditions.kind != ReferenceConditions::mean_axes)
    return modal_model(c, conditions, held_modes(c, permitted_motions(c, conditions), keep, "the body under its reference conditions"));
  Modes modes = elastic_modes(c, keep);
  modes.shapes = meeting_conditions(c, conditions, modes.shapes);
  return modal_model(c, conditions, modes);
}

}  // namespace pintle
