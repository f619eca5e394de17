#pragma once

#include <array>
#include <vector>

#include "framework/dynamics/equations/laws.h"
#include "framework/dynamics/model/flexible_tangent.h"
#include "framework/dynamics/model/wrench_tangent.h"

namespace pintle {

/// Derivatives of the residual of the equations of motion, r(q, s, a, λ, t) = M a + Cqᵀλ − f: ∂r/∂q, ∂r/∂s and ∂r/∂a = M, each n × n. Its
/// pattern depends only on the system: a block for each body and two for each pair of bodies whose interaction depends on their relative
/// motion; pins and welds do not, and couple no bodies. Theory: docs/theory/tangent.md.
class Tangent {
 public:
  explicit Tangent(const System&);

  struct Place {
    int row, column;
  };
  /// The position of each summand, in the order of `evaluate`; the same in every state. A position may have several summands.
  const std::vector<Place>& places() const { return places_; }

  using Weights = TangentWeights;
  /// values[i] ← summand i of  w.q ∂r/∂q + w.s ∂r/∂s + w.a M,  with λ and a held, internal states according to w.x. No allocation.
  /// @pre pose, speed, update_mass and apply_forces were called at `state`; values has places().size()
  void evaluate(const System&, const State&, const Equations&, const Eigen::VectorXd& a, const Eigen::VectorXd& lambda, const Weights& w,
                std::vector<double>& values);

  /// ∂f/∂x, and the derivatives of g = ẋ with respect to q, s and x: how forces and internal states affect each other. Same @pre.
  struct Internal {
    Eigen::MatrixXd f_x, g_q, g_s, g_x;  ///< n × n_x, n_x × n, n_x × n, n_x × n_x
  };
  Internal internal(const System&, const State&, const Equations&);

 private:
  /// A body's own block, by columns: entry (i, j) on [x y θ η] is summand begin + i + j·stride. A rigid body whose interactions need no
  /// more has only its diagonal: stride 0.
  struct Own {
    int begin, stride;
  };
  /// An interaction that depends on poses or rates of its n markers. block[i][j]: first summand of ∂(force on body i)/∂(coordinates of body
  /// j), by columns; −1 if there is none.
  struct Interaction {
    enum Kind { joint, force, contact, friction } kind;
    std::size_t index, n;
    std::array<int, most_ends> marker;
    std::array<std::array<int, most_ends>, most_ends> block;
    bool rate;
    int owner;  ///< of internal states, index into System::internal; −1: none
  };

  void lay_out(const System&);
  void add(const System&, Interaction::Kind, std::size_t index, const JointEnds&, const WrenchPattern&);
  void add_inertia(const System&, const State&, const Equations&, const Eigen::VectorXd& a, const Weights&, double* values);
  void add_geometric_stiffness_of_forces(const System&, const Equations&, const Eigen::VectorXd& lambda, double weight,
                                         double* values) const;
  void add_geometric_stiffness(const System&, const Equations&, int marker, double fx, double fy, double* values) const;
  void add_interactions(const System&, const State&, const Equations&, const Eigen::VectorXd& lambda, const Weights&, double* values);
  static WrenchTangent wrenches(const System&, const Equations&, const Eigen::VectorXd& lambda, const Interaction&);

  std::vector<Place> places_;
  std::vector<Own> own_;  ///< per body
  std::vector<Interaction> interactions_;
  std::vector<FlexibleScratch> flexible_;  ///< per flexible body
  std::vector<MarkerJacobian> ends_;       ///< of one interaction
  LawTangent laws_;
};

/// The same as a dense matrix; slow.
Eigen::MatrixXd dense(const System&, const Tangent&, const std::vector<double>& values);

}  // namespace pintle
