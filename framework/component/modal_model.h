#pragma once

#include <optional>
#include <vector>

#include "framework/component/fe_model.h"
#include "framework/component/inertia.h"

namespace pintle {

/// Which three conditions tie the floating frame to the material, i.e. what "no rigid motion" means.
struct FrameTie {
  enum Kind {
    tangent,    ///< frame sits on port a and turns with it: shapes look clamped there
    chord,      ///< frame's line from port a to port b: shapes look pinned at a, sliding along the line at b
    mean_axes,  ///< shapes carry no momentum: they look free–free
  } kind = mean_axes;
  int a = -1, b = -1;  ///< indices into FeModel::ports
};

/// What is reduced: the matrices of a model in independent freedoms (n × n, both triangles).
struct Component {
  const FeModel& model;
  Sparse K, M;
};
Component component(const FeModel&, bool lumped = false);

/// B with B ũ = 0 where the tie holds, 3 × n.
/// @throws std::invalid_argument  the tie's port cannot turn (tangent) or its two ports coincide (chord)
Eigen::MatrixXd tie_rows(const Component&, const FrameTie&);

/// How many shapes stay. Exactly one is set; `all`: as many as the body has freedoms, less three.
struct Keep {
  std::optional<int> count;
  std::optional<double> below;           ///< [Hz]
  std::optional<double> effective_mass;  ///< until the share of mass in x, in y and in rotation exceeds it
  bool all = false;
};

/// A flexible body after reduction. Promises, each a test: ΦᵀMΦ = I and ΦᵀKΦ = diag(ω²); ascending; every shape
/// meets the frame tie, so rank [T R Φ] = 3 + k.
struct ModalModel {
  Eigen::MatrixXd shapes;    ///< Φ, nodal freedoms N × k [kg^−½]
  Eigen::VectorXd omega;     ///< [rad/s], k
  Eigen::VectorXd residual;  ///< ‖KΦ − ω²MΦ − the tie's reactions‖/‖KΦ‖: 0 for true modes, not for static shapes
  std::optional<int> sturm;  ///< eigenvalues below the last mode by Sturm count, where modes were computed
};

/// Natural modes under the tie. For mean axes: those of the free body.
ModalModel normal_modes(const Component&, const FrameTie&, const Keep&);
/// Craig–Bampton: a static shape for each freedom of the interface ports and the lowest modes with these held
/// (`keep` counts those), restricted to the tie, then made diagonal. Static response at the ports stays exact.
/// Source: [CraigBampton1968].
ModalModel craig_bampton(const Component&, const std::vector<int>& ports, const FrameTie&, const Keep&);
/// Modes of the free body and, for each freedom of the ports, the residual attachment shape: the static response
/// of what the kept modes leave out. Static response at the ports stays exact. Source: [CraigChang1977].
ModalModel free_modes(const Component&, const std::vector<int>& ports, const FrameTie&, const Keep&);

RigidInertia rigid_inertia(const FeModel&, const Sparse& M);  ///< M: N × N nodal
/// Everything a floating frame needs; zeta is zero until a damping is chosen.
FlexInertia flex_inertia(const FeModel&, const Sparse& M, const Sparse& G, const ModalModel&);  ///< N × N nodal

/// Effective mass of each shape along x, y and in rotation about the mass centre: (TᵀMφ)², (RᵀMφ)²; 3 × k
/// [kg, kg, kg m²]. Over all modes of a body tied at one point or held the sums reach its mass and inertia.
Eigen::Matrix3Xd effective_mass(const FeModel&, const Sparse& M, const ModalModel&);

/// C = αM + βK gives ratio ζ = α/2ω + βω/2.
struct Rayleigh { double alpha = 0, beta = 0; };  ///< [1/s], [s]
/// From two ratios at two frequencies [rad/s]; the paper's Eqs. (13), (14).
/// @throws std::invalid_argument  the frequencies coincide or are not positive
Rayleigh rayleigh(double omega_1, double zeta_1, double omega_2, double zeta_2);
Eigen::VectorXd ratios(const Rayleigh&, const Eigen::VectorXd& omega);

}  // namespace pintle
