#include <Eigen/LU>
#include <Eigen/QR>
#include <stdexcept>

#include "framework/component/factor.h"
#include "framework/component/reduction.h"
#include "framework/component/statics.h"

namespace pintle {
namespace {

/// Three freedoms that hold the body, far enough apart to hold it well.
std::vector<int> determinate_hold(const FeModel& model) {
  const Eigen::MatrixXd motions = scaled_rigid_motions(model).transpose();
  const auto order = motions.colPivHouseholderQr().colsPermutation().indices();
  return {order[0], order[1], order[2]};
}

/// Elastic displacement, without momentum, of the free body under unit loads on `loaded` and the
/// inertia of the rigid acceleration that they cause. The loads are then in equilibrium, so that
/// the hold carries nothing.
Eigen::MatrixXd inertia_relief(const Component& c, const std::vector<int>& loaded) {
  Eigen::MatrixXd load =
      Eigen::MatrixXd::Zero(c.model.n(), static_cast<Eigen::Index>(loaded.size()));
  for (std::size_t k = 0; k < loaded.size(); ++k) load(loaded[k], static_cast<Eigen::Index>(k)) = 1;
  const Eigen::MatrixX3d r = scaled_rigid_motions(c.model);
  const Eigen::MatrixXd Mr = c.M * r;
  const Eigen::Matrix3d inertia = r.transpose() * Mr;
  load -= Mr * inertia.fullPivLu().solve(r.transpose() * load);

  const std::vector<int> moving = free_freedoms(c.model, {determinate_hold(c.model)});
  Factor held;
  if (!held.compute(restricted(c.K, moving)))
    throw std::runtime_error("free modes: the body's parts are not joined");
  const Eigen::MatrixXd moving_load = load(moving, Eigen::all);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(load.rows(), load.cols());
  u(moving, Eigen::all) = held.solve(moving_load);
  return tied(c, {FrameTie::mean_axes}, u);
}

}  // namespace

ModalModel free_modes(const Component& c, const std::vector<int>& ports, const FrameTie& tie,
                      const Keep& keep) {
  const std::vector<int> loaded = port_freedoms(c.model, ports);
  if (keep.all) return normal_modes(c, tie, keep);  // these leave nothing out

  const Modes modes = elastic_modes(c, keep);
  const auto attached = static_cast<Eigen::Index>(loaded.size());
  Eigen::MatrixXd V(c.model.n(), modes.shapes.cols() + attached);
  V.leftCols(modes.shapes.cols()) = tied(c, {FrameTie::mean_axes}, modes.shapes);
  if (attached > 0) V.rightCols(attached) = inertia_relief(c, loaded);
  // Orthogonal to the modes, the attachment shapes become residual ones: AF − ΦΛ⁻¹ΦᵀF.
  return diagonalised(c, tie, orthonormal(c.M, V, least_share), modes.sturm);
}

}  // namespace pintle
