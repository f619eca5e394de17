#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/component/fe/contact_surface.h"
#include "framework/component/fe/statics.h"

namespace pintle {

/// A body that may touch others.
struct TouchingBody {
  const FeModel* model;  ///< outlives the answer
  const Sparse* K;       ///< N × N, nodal
  Supports supports;     ///< may leave motions that contacts hold
};
/// Where two of them may touch.
struct TouchingPair {
  int first, second;  ///< bodies
  ContactRows rows;
};

/// What contacts bear.
struct TouchingSolution {
  std::vector<StaticSolution> bodies;  ///< `residual`: with the contact forces among the loads
  std::vector<Eigen::VectorXd> force;  ///< of each pair, ≥ 0, one a row [N]
  std::vector<Eigen::VectorXd> gap;    ///< of each pair, ≥ 0 [m]
  int iterations = 0;                  ///< changes of the set that touches, after Lemke's method
};

/// Elastic bodies at small displacements, contacts without friction: minimise ½ΣuᵀKu − fᵀu where no gap closes below zero.
/// Condensed onto the contact rows by one sparse factor a body; Lemke's method then finds which rows touch, and the linear system of
/// these their forces. Motions that supports leave are exact: docs/theory/static_contact.md.
class TouchingBodies {
 public:
  /// @throws std::runtime_error  a body's stiffness is not positive; contacts cannot hold a motion that supports leave
  TouchingBodies(std::vector<TouchingBody>, std::vector<TouchingPair>);
  ~TouchingBodies();
  /// @param loads  independent freedoms of each body [N, N m]
  /// @throws std::runtime_error  the loads draw a body away from all that could hold it
  TouchingSolution solve(const std::vector<Eigen::VectorXd>& loads) const;

 private:
  class Held;
  std::vector<TouchingPair> pairs_;
  std::vector<std::unique_ptr<Held>> bodies_;
  std::vector<Sparse> rows_;  // of each body: all rows × n
  Eigen::VectorXd gap_;
  Eigen::MatrixXd give_;    // gap per force
  Eigen::MatrixXd motion_;  // gap per motion left
};

}  // namespace pintle
