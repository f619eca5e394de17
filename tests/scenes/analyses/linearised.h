#pragma once

#include <Eigen/Core>
#include <string>

#include "framework/build/build.h"

/// Small motion about a steady one by differences of the library's own accelerations.
///
/// A mechanism driven at a constant rate w about the world's origin, with loads that turn with it
/// or none, is autonomous in coordinates z that turn too: of each body r = A(wt) z_r, θ = wt + z_θ,
/// η = z_η,
///     z̈_r = r̈ − 2w Z ż_r + w² z_r in the turning axes, z̈_θ = θ̈, z̈_η = η̈.
/// With w = 0 any mechanism under constant loads is. Steady means ż = 0 and z̈ = 0. What the
/// constraints leave free is p = Nᵀ D⁻¹ (z − z₀), with D what coordinates are measured by and N an
/// orthonormal basis of the null space of Cq D, so that p̈ = Nᵀ D⁻¹ z̈ without approximation.
namespace pintle_scenes {

/// The steady state found by Newton's method from `near`, at its time and turned as it is; its
/// speeds are not read. Laws of time hold still there but for the drive.
/// @throws std::runtime_error  singular configuration, no convergence
pintle::State steady_state(const pintle::System&, const pintle::State& near, double w = 0);

/// p̈ = A p + B ṗ.
struct SmallMotion {
  Eigen::MatrixXd A, B;
};
/// @pre `steady` is steady under w
SmallMotion linearised(const pintle::System&, const pintle::State& steady, double w = 0);

/// All λ of exp(λt), two a coordinate; by size of the imaginary part.
Eigen::VectorXcd exponents(const SmallMotion&);
/// |Im λ| of the pairs that oscillate, ascending [rad/s].
Eigen::VectorXd frequencies(const SmallMotion&);
/// Largest Re λ [1/s].
double growth(const SmallMotion&);

/// Place of a point that the scene records [m].
Eigen::Vector2d place_of(const pintle::Model&, const pintle::State&, const std::string& point);

}  // namespace pintle_scenes
