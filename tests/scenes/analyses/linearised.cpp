#include "tests/scenes/analyses/linearised.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/mechanism/result_tables.h"

namespace pintle_scenes {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using pintle::State;
using pintle::System;

namespace {

// Steps of central differences, in units of D. The equations bend over a part of the length, so
// that p's third derivatives leave step² = 1e-10; rounding of the forces is divided by the step.
constexpr double step = 1e-5;
// Newton's last step, in units of D; what is left is less by the error of its slopes, 1e-6 at most.
constexpr double converged = 1e-9;
constexpr int most = 60;

// System::scale, a shape's share taken less as its frequency is above the body's lowest: all shapes
// then turn sections alike.
VectorXd measure(const System& system) {
  VectorXd D = system.scale;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    if (system.bodies[b].modes() == 0) continue;
    const VectorXd& omega = system.bodies[b].flex->omega;
    D.segment(system.eta_begin[b], omega.size()).array() *= omega[0] / omega.array();
  }
  return D;
}

/// Freely chosen motion about a pose.
class About {
 public:
  About(const System& system, const State& at, double w) : system_(system), at_(at), w_(w), eq_(system), D_(measure(system)) {
    pose(system, at.t, at.y, eq_);
    const MatrixXd J = scaled_jacobian();
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(J.transpose());
    if (qr.rank() < J.rows()) throw std::runtime_error("the pose is singular");
    N_ = MatrixXd(qr.householderQ()).rightCols(J.cols() - J.rows());
  }
  Index free() const { return N_.cols(); }

  /// On the constraints at z₀ + D N p with ż = D N rate.
  State moved(const VectorXd& p, const VectorXd& rate) {
    State to = at_;
    const Index n = system_.n();
    to.y.head(n) += D_.cwiseProduct(N_ * p);
    to.y.segment(n, n).setZero();
    onto(to);
    to.y.segment(n, n) = turning(to.y) + D_.cwiseProduct(N_ * rate);
    onto(to);
    return to;
  }
  /// p̈ there.
  VectorXd acceleration(const VectorXd& p, const VectorXd& rate) {
    const State to = moved(p, rate);
    VectorXd dy(system_.n_y());
    if (!evaluate(system_, to, eq_, dy)) throw std::runtime_error("the pose is singular");
    const Index n = system_.n();
    VectorXd a = eq_.a;
    const VectorXd v = to.y.segment(n, n) - turning(to.y);  // ż
    for (Index b = 0; b < system_.n_rigid(); b += 3)
      a.segment<2>(b) += w_ * w_ * to.y.segment<2>(b) - 2 * w_ * pintle::perp(v.segment<2>(b));
    return N_.transpose() * a.cwiseQuotient(D_);
  }
  /// Newton's step from z₀ + D N p by the slopes at z₀; not a number where the constraints cannot
  /// be met.
  double left(const Eigen::PartialPivLU<MatrixXd>& slopes, const VectorXd& p) {
    try {
      return slopes.solve(acceleration(p, VectorXd::Zero(free()))).lpNorm<Eigen::Infinity>();
    } catch (const std::runtime_error&) {
      return std::nan("");
    }
  }
  /// Columns (p̈(+step) − p̈(−step))/(2 step), in p or in ṗ.
  MatrixXd slope(bool in_rate) {
    const Index k = free();
    MatrixXd out(k, k);
    const VectorXd zero = VectorXd::Zero(k);
    // An angle per second is to w as an angle is to one.
    const double h = in_rate ? step * std::max(1.0, std::abs(w_)) : step;
    for (Index i = 0; i < k; ++i) {
      const VectorXd d = h * VectorXd::Unit(k, i);
      const VectorXd up = in_rate ? acceleration(zero, d) : acceleration(d, zero);
      const VectorXd down = in_rate ? acceleration(zero, -d) : acceleration(-d, zero);
      out.col(i) = (up - down) / (2 * h);
    }
    return out;
  }

 private:
  MatrixXd scaled_jacobian() const {  // Cq D
    MatrixXd J = MatrixXd::Zero(system_.n_rows(), system_.n());
    visit_jacobian(eq_, [&](int r, int c, double v) { J(r, c) += v * D_[c]; });
    return J;
  }
  // By the shortest way in units of D, so that stiff shapes hardly move.
  void onto(State& to) {
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> J;
    const auto factor = [&] {
      J.compute(scaled_jacobian());
      return true;
    };
    const auto subtract = [&](const VectorXd& violation, double* x) {
      const VectorXd change = J.solve(violation);
      Eigen::Map<VectorXd>(x, system_.n()) -= D_.cwiseProduct(change);
      return change.lpNorm<Eigen::Infinity>();
    };
    if (!onto_constraints(system_, to.t, to.y, eq_, factor, subtract)) throw std::runtime_error("the constraints cannot be met");
  }
  /// Speeds of what turns with the drive.
  VectorXd turning(const VectorXd& y) const {
    VectorXd s = VectorXd::Zero(system_.n());
    for (Index b = 0; b < system_.n_rigid(); b += 3) {
      s.segment<2>(b) = w_ * pintle::perp(y.segment<2>(b));
      s[b + 2] = w_;
    }
    return s;
  }

  const System& system_;
  const State& at_;
  double w_;
  pintle::Equations eq_;
  VectorXd D_;
  MatrixXd N_;
};

}  // namespace

// Damped by the natural monotonicity test: a step is halved until the next one by the same slopes,
// which measures what is left, is shorter.
State steady_state(const System& system, const State& near, double w) {
  constexpr double shortest = 1e-4;
  State at = near;
  for (int i = 0; i < most; ++i) {
    About about(system, at, w);
    const VectorXd zero = VectorXd::Zero(about.free());
    const Eigen::PartialPivLU<MatrixXd> slopes(about.slope(false));
    const VectorXd p = -slopes.solve(about.acceleration(zero, zero));
    if (!p.allFinite()) break;
    const double size = p.lpNorm<Eigen::Infinity>();
    if (size < converged) return about.moved(p, zero);
    double share = 1;
    while (share > shortest && !(about.left(slopes, share * p) < size)) share /= 2;
    at = about.moved(share * p, zero);
  }
  throw std::runtime_error("no steady state found");
}

SmallMotion linearised(const System& system, const State& steady, double w) {
  About about(system, steady, w);
  return {about.slope(false), about.slope(true)};
}

Eigen::VectorXcd exponents(const SmallMotion& motion) {
  const Index k = motion.A.rows();
  MatrixXd first(2 * k, 2 * k);
  first << MatrixXd::Zero(k, k), MatrixXd::Identity(k, k), motion.A, motion.B;
  Eigen::VectorXcd all = Eigen::EigenSolver<MatrixXd>(first, false).eigenvalues();
  std::ranges::sort(all, {}, [](const std::complex<double>& z) { return std::abs(z.imag()); });
  return all;
}

VectorXd frequencies(const SmallMotion& motion) {
  std::vector<double> found;
  for (const std::complex<double>& z : exponents(motion))
    if (z.imag() > 0) found.push_back(z.imag());
  return Eigen::Map<VectorXd>(found.data(), static_cast<Index>(found.size()));
}

double growth(const SmallMotion& motion) { return exponents(motion).real().maxCoeff(); }

Eigen::Vector2d place_of(const pintle::Model& model, const State& state, const std::string& point) {
  pintle::Equations eq(model.system);
  VectorXd dy(model.system.n_y());
  evaluate(model.system, state, eq, dy);
  pintle::Table table = trajectory_table(model);
  record(model, state, eq, table);
  return {table.column(point + ".x [m]")[0], table.column(point + ".y [m]")[0]};
}

}  // namespace pintle_scenes
