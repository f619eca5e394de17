#pragma once

#include <array>

#include <Eigen/Core>

#include "eigen_layout.h"

/// How the wrenches between markers depend on their motion. Theory: docs/theory/tangent.md.
namespace pintle {

inline constexpr int most_ends = 6;  ///< markers that one joint connects

/// Which 3 × 3 blocks ∂(wrench i)/∂(pose j) can be nonzero in any state, and whether the wrenches depend on rates at all.
struct WrenchPattern {
  std::array<std::array<bool, most_ends>, most_ends> block{};
  bool rate = false;
};

/// Derivatives of the wrenches [w_a; w_b; …] with respect to the poses [p_a; p_b; …] and to their rates, 3n × 3n for n markers.
struct WrenchTangent {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3 * most_ends, 3 * most_ends>;
  Matrix pose, rate;
  explicit WrenchTangent(int markers) : pose(Matrix::Zero(3 * markers, 3 * markers)), rate(pose) {}
};

/// Indices of r and of the angle of marker i.
constexpr Eigen::Index place_of(int marker) { return 3 * marker; }
constexpr Eigen::Index angle_of(int marker) { return 3 * marker + 2; }

/// The force F on a and −F on b, where F depends on r_b − r_a with derivative K.
inline void oppose(const Eigen::Matrix2d& K, WrenchTangent::Matrix& out) {
  out.block<2, 2>(place_of(0), place_of(0)) -= K;
  out.block<2, 2>(place_of(1), place_of(1)) -= K;
  out.block<2, 2>(place_of(0), place_of(1)) += K;
  out.block<2, 2>(place_of(1), place_of(0)) += K;
}
/// The torque τ on a and −τ on b, where τ depends on φ_b − φ_a with derivative k.
inline void twist(double k, WrenchTangent::Matrix& out) {
  out(angle_of(0), angle_of(0)) -= k;
  out(angle_of(1), angle_of(1)) -= k;
  out(angle_of(0), angle_of(1)) += k;
  out(angle_of(1), angle_of(0)) += k;
}

}  // namespace pintle
