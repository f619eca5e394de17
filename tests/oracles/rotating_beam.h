#pragma once

#include <Eigen/Core>

#include <functional>

/// A beam of EI = ρA = L = 1 clamped at radius `hub` and spun at w, in the plane of its spin. With
/// u along it from stretch alone, v across, and N = w² ∫ (hub + s) ds the pull beyond s,
///     V = ½ ∫ v″² + N v′² + EA u′² − w² (u² + v²) ds,   gyroscopic 2w ∫ u̇ v ds.
/// Rayleigh and Ritz with s² P_k for v and s P_k for u, P_k Legendre's polynomials on (0, 1).
namespace pintle_oracle {

struct RotatingBeam {
  double w, hub = 0;
  double EA = 0;  ///< 0: does not stretch
  /// What a model lacks of the pull's work if its frame leans against the clamp by `lean`:
  ///     ½ ∫ lacking(s) (v′ − lean)² ds,   lean = ∫ lean(s) v ds + lean_tip v(1).
  std::function<double(double s)> lacking = {}, lean = {};
  double lean_tip = 0;
};

/// Squares of frequencies, ascending. Below zero it diverges; where it stretches, only those that
/// oscillate are there.
Eigen::VectorXd squares(const RotatingBeam&);

/// What ties a floating frame: it follows the clamp, the line from clamp to tip, or the mean turn.
enum class BeamFrameTie { tangent, chord, mean_axes };
/// A linear body in such a frame: none of the pull acts on slopes from the frame.
RotatingBeam without_stiffening(RotatingBeam, BeamFrameTie);
/// Mean axes, the body in equilibrium with its own inertia: what the clamp's pull does is lacking.
RotatingBeam without_pull_of_clamp(RotatingBeam);

}  // namespace pintle_oracle
