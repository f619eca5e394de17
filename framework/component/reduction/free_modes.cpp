#include "framework/component/reduction/reduction.h"
#include "framework/component/reduction/static_response.h"

namespace pintle {
namespace {

/// Elastic displacement, without momentum, of the free body under unit loads on `loaded` and the inertia of the rigid acceleration that
/// they cause.
Eigen::MatrixXd inertia_relief(const Component& c, const std::vector<int>& loaded) {
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(c.model.n(), static_cast<Eigen::Index>(loaded.size()));
  for (std::size_t k = 0; k < loaded.size(); ++k) load(loaded[k], static_cast<Eigen::Index>(k)) = 1;
  return static_response(c, {ReferenceConditions::mean_axes}, load);
}

}  // namespace

ModalModel free_modes(const Component& c, const std::vector<int>& ports, const ReferenceConditions& conditions, const Keep& keep) {
  const std::vector<int> loaded = port_dofs(c.model, ports);
  if (keep.all) return normal_modes(c, conditions, keep);  // these are complete

  const Modes modes = elastic_modes(c, keep);
  const auto attached = static_cast<Eigen::Index>(loaded.size());
  Eigen::MatrixXd V(c.model.n(), modes.shapes.cols() + attached);
  V.leftCols(modes.shapes.cols()) = meeting_conditions(c, {ReferenceConditions::mean_axes}, modes.shapes);
  if (attached > 0) V.rightCols(attached) = inertia_relief(c, loaded);
  // Made orthogonal to the modes, the attachment shapes become residual shapes: AF − ΦΛ⁻¹ΦᵀF.
  return diagonalised(c, conditions, orthonormal(c.M, V, least_share), modes.sturm);
}

}  // namespace pintle
