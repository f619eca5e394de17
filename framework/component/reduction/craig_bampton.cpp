#include <cmath>
#include <stdexcept>
#include <string>

#include "framework/common/dense.h"
#include "framework/component/eigen/factor.h"
#include "framework/component/fe/statics.h"
#include "framework/component/reduction/reduction.h"

namespace pintle {
namespace {

/// Interface displacements that are not rigid motions, b × (b − 3).
Eigen::MatrixXd straining(const Component& c, const std::vector<int>& interface) {
  const auto b = static_cast<Eigen::Index>(interface.size());
  if (b >= 3) {
    Eigen::MatrixXd rigid = scaled_rigid_motions(c.model)(interface, Eigen::all);
    // For ports closer together than 1e-8 of the body's size, K⁻¹ would contain only rounding.
    const auto spans = [](const auto& svd) { return svd.singularValues()[2] > 1e-8 * svd.singularValues()[0]; };
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rigid, Eigen::ComputeFullU);
    if (spans(svd)) return svd.matrixU().rightCols(b - 3);
    // For very small bodies: rotations are scaled by the body's size, so that they are comparable to displacements.
    Eigen::VectorXd size = Eigen::VectorXd::Ones(b);
    const double place = rigid.leftCols<2>().cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < b; ++i)
      if (rigid.row(i).head<2>().isZero(0) && rigid(i, 2) != 0) size[i] = place / std::abs(rigid(i, 2));
    rigid = size.asDiagonal() * rigid;
    const Eigen::JacobiSVD<Eigen::MatrixXd> sized(rigid, Eigen::ComputeFullU);
    if (spans(sized)) return size.cwiseInverse().asDiagonal() * sized.matrixU().rightCols(b - 3);
  }
  throw std::invalid_argument("Craig–Bampton: the interface ports hold the body with " + std::to_string(b) +
                              " degrees of freedom and leave a rigid motion free; add a port, use one with rotation, or use free modes");
}

/// Displacements of the whole body when the interface moves as the columns of C, without loads inside.
Eigen::MatrixXd static_shapes(const Component& c, const std::vector<int>& interface, const std::vector<int>& interior,
                              const Eigen::MatrixXd& C) {
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(c.model.n(), C.cols());
  shapes(interface, Eigen::all) = C;
  if (interior.empty() || C.cols() == 0) return shapes;
  Factor inside;
  if (!inside.compute(restricted(c.K, interior)))
    throw std::runtime_error("Craig–Bampton: with its ports held, a part of the body still moves freely, because its parts are not joined");
  const Eigen::MatrixXd pull = (c.K * shapes)(interior, Eigen::all);
  shapes(interior, Eigen::all) = -inside.solve(pull);
  return shapes;
}

Sparse columns_of_identity(int n, const std::vector<int>& which) {
  Sparse S(n, static_cast<Eigen::Index>(which.size()));
  if (which.empty()) return S;  // Eigen reads out of bounds for a matrix without columns
  S.reserve(Eigen::VectorXi::Constant(S.cols(), 1));
  for (int k = 0; k < S.cols(); ++k) S.insert(which[static_cast<std::size_t>(k)], k) = 1;
  S.makeCompressed();
  return S;
}

Modes fixed_modes(const Component& c, const std::vector<int>& interior, const Keep& keep) {
  return held_modes(c, columns_of_identity(c.model.n(), interior), keep, "the body with its interface held");
}

}  // namespace

ModalModel fixed_interface_modes(const Component& c, const std::vector<int>& ports, const ReferenceConditions& conditions,
                                 const Keep& keep) {
  Modes fixed = fixed_modes(c, free_dofs(c.model, {port_dofs(c.model, ports)}), keep);
  fixed.shapes = meeting_conditions(c, conditions, fixed.shapes);
  return modal_model(c, conditions, fixed);
}

ModalModel craig_bampton(const Component& c, const std::vector<int>& ports, const ReferenceConditions& conditions, const Keep& keep) {
  const std::vector<int> interface = port_dofs(c.model, ports);
  const Eigen::MatrixXd C = straining(c, interface);
  // All fixed-interface modes and all static shapes together span the same space as all modes with the reference conditions.
  if (keep.all) return normal_modes(c, conditions, keep);

  const std::vector<int> interior = free_dofs(c.model, {interface});
  const Modes fixed = fixed_modes(c, interior, keep);
  Eigen::MatrixXd V(c.model.n(), fixed.shapes.cols() + C.cols());
  V.leftCols(fixed.shapes.cols()) = fixed.shapes;
  V.rightCols(C.cols()) = static_shapes(c, interface, interior, C);
  return diagonalised(c, conditions, V, fixed.sturm);
}

}  // namespace pintle
