#pragma once

#include <optional>
#include <variant>

#include <Eigen/Core>

#include "eigen_layout.h"

/// Linear elastic solids, used by plane elements as D and by beams as two moduli. Small strain, no temperature, no damping. Theory:
/// docs/theory/elements.md.
namespace pintle {

/// Out-of-plane condition: no stress, or no strain.
enum class PlaneState { stress, strain };

struct Isotropic {
  double young = 0;    ///< E [Pa]
  double poisson = 0;  ///< ν, in (−1, ½)
};

/// Axes 1 and 2 in the plane, 1 rotated by `angle` from the body's x axis; 3 out of the plane. ν₁₂ is −ε₂/ε₁ under tension along 1.
/// Constants with a 3 in their name are used only in plane strain.
struct Orthotropic {
  double young_1 = 0, young_2 = 0;  ///< E₁, E₂ [Pa]
  double poisson_12 = 0;            ///< ν₁₂
  double shear_12 = 0;              ///< G₁₂ [Pa]
  double angle = 0;                 ///< [rad]
  std::optional<double> young_3, poisson_13, poisson_23;
};

struct Material {
  std::variant<Isotropic, Orthotropic> elastic;
  double density = 0;  ///< ρ [kg/m³], 0: no mass
};

/// Data of a material for a plane element: σ = D ε with ε = [εx εy γxy], σz = Dz ε, body axes.
struct PlaneMaterial {
  Eigen::Matrix3d D;      ///< [Pa] symmetric positive definite
  Eigen::RowVector3d Dz;  ///< [Pa] zero in plane stress
};
/// @throws std::invalid_argument  the constants are not those of a stable solid (D not positive definite), constants of axis 3 are missing
/// for plane strain of an orthotropic material, or the density is negative
PlaneMaterial plane_material(const Material&, PlaneState);

/// Young's and shear modulus along a beam's axis. For a beam cut from an orthotropic solid at an angle, the coupling of extension and shear
/// is neglected.
struct BeamModuli {
  double E, G;  ///< [Pa]
  double nu;    ///< as needed for Cowper's shear factor: E/2G − 1
};
/// `direction`: angle of the beam's axis from the body's x axis [rad].
/// @throws std::invalid_argument  as plane_material in plane stress
BeamModuli beam_moduli(const Material&, double direction);

}  // namespace pintle
