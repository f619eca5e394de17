#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/equations/tangent.h"
#include "framework/dynamics/newton/kkt.h"
#include "framework/integration/step.h"

namespace pintle {

/// Coefficients of the generalised-α scheme [ChungHulbert1993] with the spectral radius ρ at infinite frequency. Second order,
/// unconditionally stable for 0 ≤ ρ ≤ 1; ρ = 1 has no numerical damping, ρ = 0 removes infinitely fast motion in one step.
struct AlphaWeights {
  explicit AlphaWeights(double rho);
  double m, f, beta, gamma;
  double shift;  ///< a ≈ v̇ at shift steps after the node: α_m − α_f ≤ 0
  double error;  ///< local error of q over h³ times the jerk: β + shift/2 − 1/6
};

/// Generalised-α for the constrained equations of motion [ArnoldBruls2007], by modified Newton:
///   M(q₁) v̇₁ + Cqᵀλ₁ = f(q₁, s₁),  C(q₁) = 0,
///   q₁ = q₀ + h s₀ + h² ((½ − β) a₀ + β a₁) + p,   s₁ = s₀ + h ((1 − γ) a₀ + γ a₁),
///   (1 − α_m) a₁ + α_m a₀ = (1 − α_f) v̇₁ + α_f v̇₀.
/// Internal states x are integrated as s is [JansenWhitingHulbert2000]; in each iteration they are solved for, owner by owner. Stabilised
/// index-2 form: λ enforces Ċ(q₁, s₁) = 0, and p, of order h³, enforces C = 0 by projection in the metric of the iteration matrix, which
/// does not excite stiff directions. Theory: docs/theory/implicit.md.
class Alpha {
 public:
  /// @param tolerance  of the step's error: Newton stops well below it. 0: iterates to rounding
  Alpha(const System&, const Equations&, double rho, double tolerance);

  /// Projects y onto the constraints, evaluates there and discards the memory: a start. @returns false in a singular configuration
  bool project(const System&, Instant&, Equations&);
  /// As Stages::attempt. step.error is the local error, filtered through the iteration matrix so that motion damped by the scheme does not
  /// count. @returns false if Newton does not converge; see trouble()
  bool attempt(const System&, double h, Step&, Equations&);
  /// Newton's method starts with the convergence data of `other` and, if it fits, its factor; its own are discarded.
  void begin_beside(Alpha& other);
  /// The state inside the step, as `interpolate`, with the curvature between the nodes kept out of stiff directions.
  void interpolate_between(const System&, const Step&, double t, State& out, Equations&);
  /// Evaluates at a state inside the step or at its end, with v̇ and λ between those of the ends; changes no state.
  void evaluate_between(const System&, const Step&, const State&, Equations&);
  /// Scales for lengths and speeds in Newton's convergence test. [m], [m/s]
  void validate_by(double length, double speed) { length_ = length, speed_ = speed; }

  static constexpr int order = 2;
  const std::string& trouble() const { return trouble_; }
  long iterations() const { return iterations_; }

  /// The data besides the nodes that the next steps depend on, exactly.
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(rate_, tired_, kept_, factored_, iterations_));
    if constexpr (A::loading) {
      if (factored_ && !kkt_.load(x)) x.fail();
    } else if (factored_) {
      kkt_.save(x);
    }
  }

 private:
  struct Weights {
    double q = 0, s = 0;  ///< derivatives of q₁ and s₁ with respect to v̇₁: h² β(1 − α_f)/(1 − α_m), h γ(1 − α_f)/(1 − α_m)
    template <class A>
    void archive(A& x) {
      x(PINTLE_MEMBERS(q, s));
    }
  };
  Weights start_weights(double h) const;
  bool soften_start(const System&, double h, const Instant& from, Equations&);
  void soften_bend(const System&, const Step&, double x, State& out, Equations&);
  void interpolate_internal(const System&, const Step&, double x, State& out, Equations&);
  void soften_internal(const System&, double weight, const State&, Equations&);
  Weights predict(double h, const Instant& from, Instant& to);
  bool iterate(const System&, const Weights&, Instant& to, Equations&);
  void move_to(const System&, const State&, Equations&);
  void balance(const System&, const State&, const Eigen::VectorXd& dy, const Eigen::VectorXd& lambda, Equations&);
  void evaluate_at(const System&, const State&, const Eigen::VectorXd& dy, const Eigen::VectorXd& lambda, Equations&);
  bool refactor(const System&, const Weights&, const Instant&, Equations&);
  void solve(Eigen::VectorXd& x, Eigen::VectorXd& y) { (lent_ ? *lent_ : kkt_).solve(x, y); }
  void border(const System&, Equations&);
  bool correct_friction(const System&, double weight, State&, Memory&, Equations&);
  double slip_violation(const System&, const State&, const Equations&) const;
  void keep_slip(const System&, const Equations&, const Eigen::VectorXd& slips, Eigen::VectorXd& x) const;
  void share_out_friction(const System&, Instant& to, Equations&);
  bool correct(const System&, const Weights&, Instant& to, Equations&);
  double correction_size(const System&, const Weights&, const State&) const;
  double constraint_violation(const System&, const State&, const Equations&) const;
  void forces_of(const System&, const Equations&, Memory&);
  void share_out(const System&, Instant& to, Equations&);
  void remember(const System&, double h, const Instant& from, Instant& to, Equations&);
  void estimate(const System&, Step&, Equations&);
  void filter(const System&, Eigen::Ref<Eigen::VectorXd>, int times, Equations&);
  void book_loss(const System&, const Equations&, Step&);
  bool blame(const System&, const Equations&, const char* what);

  AlphaWeights weights_;
  double tolerance_, length_, speed_ = 0;
  int loss_ = -1;         ///< the integral that accounts for numerical dissipation; −1: none
  Eigen::VectorXd unit_;  ///< scale of each coordinate, for a length of 1 m
  Tangent tangent_;
  Kkt kkt_;
  Eigen::MatrixXd border_, border_lambda_, W_;  ///< v̇ and λ due to 1 N of friction, by the factor; their effect on slips
  Kkt* lent_ = nullptr;                         ///< borrowed factor, used instead of kkt_'s until a new one is made
  std::vector<double> values_;
  Eigen::VectorXd q_base_, s_base_, p_;  ///< q₁ = q_base + w.q v̇₁ + p, [s₁; x₁] = s_base + w.s [v̇₁; ẋ₁]
  Eigen::VectorXd start_;                ///< [v̇; ẋ] at a start, as used by the step
  Eigen::VectorXd own_;                  ///< the scheme's own at the step's begin, as Memory::a
  Eigen::VectorXd dv_, dp_, mu_, work_;
  double rate_ = 1;                       ///< contraction of Newton's iteration, as last measured
  bool tired_ = true, factored_ = false;  ///< the factor should be renewed; there is one
  Weights kept_;                          ///< the weights used in the factor
  long iterations_ = 0;
  std::string trouble_;
};

}  // namespace pintle
