#include "elements/point_mass.h"

namespace pintle {

Eigen::Matrix3d mass(const PointMass& p) { return Eigen::Vector3d(p.m, p.m, p.J).asDiagonal(); }

Eigen::Matrix3d skew_mass(const PointMass& p) {
  Eigen::Matrix3d G = Eigen::Matrix3d::Zero();
  G(0, 1) = p.m;
  G(1, 0) = -p.m;
  return G;
}

}  // namespace pintle
