#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/contact_pair.h"
#include "framework/dynamics/model/forces.h"
#include "framework/dynamics/model/joints.h"

/// How what acts between two markers answers to their motion. A new joint or force joins by an overload
/// of both functions in pair_tangent.cpp. Theory: docs/theory/tangent.md.
namespace pintle {

/// Derivatives of the wrenches [w_a; w_b] in the poses [p_a; p_b] and in their rates.
struct PairTangent {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  Matrix6 pose = Matrix6::Zero(), rate = Matrix6::Zero();
};

/// Which 3 × 3 blocks can differ from zero in any state: ∂w_a/∂p_a, ∂w_b/∂p_b, those between the two; and
/// whether the wrenches answer to rates at all.
struct PairReach {
  bool aa = false, bb = false, ab = false, rate = false;
  bool none() const { return !aa && !bb && !ab; }
};
PairReach reach(const Joint&);
PairReach reach(const Force&);
PairReach reach(const ContactPair&);

/// Of a joint's wrenches −Laᵀλ and −Lbᵀλ, λ held. @param lambda  the joint's own multipliers, rows(joint) of them
PairTangent pair_tangent(const Joint&, const MarkerMotion& a, const MarkerMotion& b, const double* lambda);
/// @param now  what the force does in this state
PairTangent pair_tangent(const Force&, const ForceEffect& now, const MarkerMotion& a, const MarkerMotion& b);
/// a: journal, b: bearing; the latched approach speed held. Zero while open.
/// @param now  what the contact does in this state
PairTangent pair_tangent(const ContactPair&, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b);

}  // namespace pintle
