#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/component/fe/contact_surface.h"
#include "framework/component/fe/statics.h"

namespace pintle {

/// A body that may touch others.
struct TouchingBody {
  const FeModel* model;  ///< must outlive the solution
  const Sparse* K;       ///< N × N, nodal
  Supports supports;     ///< may leave motions that contacts restrain
};
/// Two surfaces that may touch.
struct TouchingPair {
  int first, second;  ///< bodies
  ContactRows rows;
};

/// Contact forces and the resulting displacements.
struct TouchingSolution {
  std::vector<StaticSolution> bodies;  ///< `residual`: with the contact forces among the loads
  std::vector<Eigen::VectorXd> force;  ///< of each pair, ≥ 0, one per row [N]
  std::vector<Eigen::VectorXd> gap;    ///< of each pair, ≥ 0 [m]
  int iterations = 0;                  ///< changes of the contact set after Lemke's method
};

/// Elastic bodies with small displacements and frictionless contacts: minimises ½ΣuᵀKu − fᵀu with nonnegative gaps. Condensed onto the
/// contact rows with one sparse factorization per body; Lemke's method then finds which rows touch, and their linear system gives the
/// forces. Motions that supports leave free are treated exactly: docs/theory/static_contact.md.
class TouchingBodies {
 public:
  /// @throws std::runtime_error  a body's stiffness is not positive; contacts cannot restrain a motion that supports leave free
  TouchingBodies(const std::vector<TouchingBody>&, std::vector<TouchingPair>);
  ~TouchingBodies();
  /// @param loads  independent dofs of each body [N, N m]
  /// @throws std::runtime_error  the loads pull a body away from everything that could hold it
  TouchingSolution solve(const std::vector<Eigen::VectorXd>& loads) const;

 private:
  class Held;
  std::vector<TouchingPair> pairs_;
  std::vector<std::unique_ptr<Held>> bodies_;
  std::vector<Sparse> rows_;  // of each body: all rows × n
  Eigen::VectorXd gap_;
  Eigen::MatrixXd give_;    // gap per unit force
  Eigen::MatrixXd motion_;  // gap per remaining motion
};

}  // namespace pintle
