#pragma once

#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/dynamics/equations/marker_jacobian.h"
#include "framework/dynamics/model/flexible_tangent.h"

/// Laws of signals at an instant: their values, their response to the motion, and the scene's own states. Theory: docs/theory/signals.md.
namespace pintle {

/// eq.signals and eq.laws. After speed. @param x  the internal states
void evaluate_laws(const System&, double t, const double* x, Equations&);

/// slopes(l, k) ← ∂(law l)/∂(signal k), laws × signals. After evaluate_laws.
void law_slopes(const System&, const Equations&, double t, Eigen::MatrixXd& slopes);

/// The scene's own states, treated as internal.h treats those of owners: solves x = base + weight g; applies (1 − weight g_x)⁻¹ to v. Both
/// work in eq's own scratch.
void follow_own_states(const System&, Equations&, double t, double weight, const double* base, double* x);
void filter_own_states(const System&, const State&, Equations&, double weight, double* v);
/// Contribution of the laws to the tangent: −Σ d (F_σ ∂σ/∂q)ᵀ, likewise for s, where d is the effect of a unit force. If own states follow
/// the motion, F_σ + F_x (1/weight − g_x)⁻¹ g_σ replaces F_σ.
class LawTangent {
 public:
  explicit LawTangent(const System&);

  /// One component of one force: the bodies it acts on and the bodies its law depends on; block[i][j] is the first summand of
  /// ∂(on[i])/∂(by[j]).
  struct Sized {
    std::size_t force;
    bool other;
    int law;
    std::vector<int> on, by;
    std::vector<std::vector<int>> block;
  };
  std::vector<Sized> sized;

  /// Subtracts from the summands at `values`. After apply_forces.
  void add(const System&, const State&, const Equations&, const TangentWeights&, double* values);
  /// Columns and rows of the own states in ∂f/∂x and in the derivatives of g.
  void couple(const System&, const State&, const Equations&, Eigen::MatrixXd& f_x, Eigen::MatrixXd& g_q, Eigen::MatrixXd& g_s,
              Eigen::MatrixXd& g_x);

 private:
  void condense(const System&, double weight);
  void see(const System&, const State&, const Equations&, int law, double w_q, double w_s);  ///< row_ ← w_q ∂/∂q + w_s ∂/∂s
  void point(const System&, const Equations&, const Sized&);                                 ///< d_ ← effect of a unit force

  Eigen::MatrixXd slopes_, g_signals_, follow_, A_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd row_, d_;
  MarkerJacobian jacobian_;
};

}  // namespace pintle
