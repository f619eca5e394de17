#include "framework/component/reduction/inertia.h"

#include "framework/component/reduction/modal_model.h"

namespace pintle {

RigidInertia rigid_inertia(const FeModel& model, const Sparse& M) {
  const RigidFields f = rigid_fields(model);
  const Eigen::VectorXd Mx = M * f.x;
  return {f.T.col(0).dot(M * f.T.col(0)), f.T.transpose() * Mx, f.R.dot(M * f.R)};
}

FlexInertia flex_inertia(const FeModel& model, const Sparse& M, const Sparse& G, const ModalModel& modes) {
  const RigidFields f = rigid_fields(model);
  const Eigen::MatrixXd M_phi = M * modes.shapes;
  FlexInertia flex;
  flex.S = f.T.transpose() * M_phi;
  flex.j = f.x.transpose() * M_phi;
  flex.h = f.R.transpose() * M_phi;
  flex.G = modes.shapes.transpose() * (G * modes.shapes);
  flex.G = ((flex.G - flex.G.transpose()) / 2).eval();  // exactly skew-symmetric
  flex.omega = modes.omega;
  flex.zeta = Eigen::VectorXd::Zero(modes.omega.size());
  return flex;
}

Eigen::Matrix3Xd effective_mass(const FeModel& model, const Sparse& M, const ModalModel& modes) {
  const RigidFields f = rigid_fields(model);
  const RigidInertia rigid = rigid_inertia(model, M);
  const Eigen::Vector2d centre = rigid.c / rigid.m;
  const Eigen::VectorXd about_centre = f.R + centre.y() * f.T.col(0) - centre.x() * f.T.col(1);
  Eigen::MatrixX3d motions(about_centre.size(), 3);
  motions << f.T, about_centre;
  return (motions.transpose() * (M * modes.shapes)).cwiseAbs2();
}

}  // namespace pintle
