#pragma once

#include <vector>

#include "framework/component/fe/fe_model.h"
#include "meshes/mesh.h"

/// Where two meshed bodies may touch. Theory: docs/theory/static_contact.md.
namespace pintle {

/// The curve that sides of a mesh lie on.
struct ContactCurve {
  bool straight = false;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< of the circle; a point of the line; body axes [m]
  double radius = 0;                                 ///< < 0: the wall of a hole [m]; 0 of a line
  Eigen::Vector2d along = Eigen::Vector2d::Zero();   ///< of a line: unit, the body on its left
};

/// A side of a cell on its curve, the body on its left.
struct ContactSide {
  int node[3];      ///< ends, then the middle
  int nodes;        ///< 2 or 3
  double from, to;  ///< of its ends along the curve: angle [rad], of a line length [m]
  double middle;    ///< likewise, of its middle
};

struct ContactSurface {
  ContactCurve curve;
  std::vector<ContactSide> sides;
  double thickness = 0;  ///< [m]
};

/// Sides as a surface: the circle through their corners, or the straight line.
/// @throws std::invalid_argument  there is none; they lie on neither, or on several circles
ContactSurface contact_surface(const Mesh&, const std::vector<Cells>& sides, double thickness);

/// What holds a contact apart: pressure p = Σ p_i H_i(s) ≥ 0 over the first surface, H_i the hats of its corners, and the weighted
/// gaps 0 ≤ g_i = ∫ H_i g dA / ∫ H_i dA against forces f_i = p_i ∫ H_i dA. Linear in the displacements: g = gap + first u₁ + second u₂.
struct ContactRows {
  Eigen::VectorXd gap;      ///< of the bodies as they lie [m]
  Eigen::VectorXd area;     ///< ∫ H_i dA [m²]
  Eigen::VectorXd along;    ///< where the corner is along the first curve: angle [rad], of a line length [m]
  Eigen::Matrix2Xd at;      ///< the corner, axes of the first body [m]
  Eigen::Matrix2Xd pushed;  ///< resultant on the first body of a unit force f_i –
  Sparse first, second;     ///< rows × N of each body
};
/// @param shift  where the first body's origin lies in the second's axes, which are parallel [m]
/// @throws std::invalid_argument  nowhere does one face the other
ContactRows contact_rows(const FeModel& first_body, const ContactSurface& first, const FeModel& second_body, const ContactSurface& second,
                         const Eigen::Vector2d& shift);

}  // namespace pintle
