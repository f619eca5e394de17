#pragma once

#include <vector>

#include "framework/component/fe/fe_model.h"
#include "meshes/mesh.h"

/// Surfaces at which two meshed bodies may touch. Theory: docs/theory/static_contact.md.
namespace pintle {

/// The curve on which sides of a mesh lie.
struct ContactCurve {
  bool straight = false;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< of the circle; a point of the line; body axes [m]
  double radius = 0;                                 ///< negative: the wall of a hole [m]; 0 for a line
  Eigen::Vector2d along = Eigen::Vector2d::Zero();   ///< for a line: unit vector, with the body to its left
};

/// A side of a cell on its curve, with the body to its left.
struct ContactSide {
  int node[3];      ///< ends, then the middle
  int nodes;        ///< 2 or 3
  double from, to;  ///< of its ends along the curve: angle [rad], for a line length [m]
  double middle;    ///< likewise, for its middle
};

struct ContactSurface {
  ContactCurve curve;
  std::vector<ContactSide> sides;
  double thickness = 0;  ///< [m]
};

/// Converts sides into a surface: the circle through their corners, or the straight line.
/// @throws std::invalid_argument  no sides; they lie on neither, or on several circles
ContactSurface contact_surface(const Mesh&, const std::vector<Cells>& sides, double thickness);

/// Discretized contact: pressure p = Σ p_i H_i(s) ≥ 0 over the first surface, with H_i the hat functions of its corners, and the weighted
/// gaps 0 ≤ g_i = ∫ H_i g dA / ∫ H_i dA conjugate to forces f_i = p_i ∫ H_i dA. Linear in the displacements: g = gap + first u₁ + second
/// u₂.
struct ContactRows {
  Eigen::VectorXd gap;      ///< of the undeformed bodies [m]
  Eigen::VectorXd area;     ///< ∫ H_i dA [m²]
  Eigen::VectorXd along;    ///< position of the corner along the first curve: angle [rad], for a line length [m]
  Eigen::Matrix2Xd at;      ///< the corner, axes of the first body [m]
  Eigen::Matrix2Xd pushed;  ///< resultant on the first body of a unit force f_i, –
  Sparse first, second;     ///< rows × N of each body
};
/// @param shift  position of the first body's origin in the second's axes, which are parallel [m]
/// @throws std::invalid_argument  the surfaces do not face each other anywhere
ContactRows contact_rows(const FeModel& first_body, const ContactSurface& first, const FeModel& second_body, const ContactSurface& second,
                         const Eigen::Vector2d& shift);

}  // namespace pintle
