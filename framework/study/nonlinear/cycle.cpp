#include "framework/study/nonlinear/cycle.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "framework/analysis/simulate/simulate.h"
#include "framework/common/text.h"
#include "framework/study/nonlinear/differences.h"
#include "framework/study/nonlinear/follower.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_newton = 25, most_halvings = 8;
constexpr double at_once = 1e-4;       // of the period: an earlier return is the start point itself
constexpr double no_direction = 1e-3;  // of the largest displacement: the constraints do not allow this direction
constexpr double same_for_any_time = 1e-6;
constexpr double singular = 1e-7;      // of the largest pivot: smaller ones mean a family of orbits; the nearest is taken
constexpr double closes_before = 100;  // times the tolerance
constexpr double neutral_within = 1e-5;
constexpr int most_distances = 4;
constexpr double shortest_distance = 1e-6;
constexpr const char* no_orbit = "no periodic orbit";

/// Removes whole turns from the angles of bodies: a crank that has made one turn is at the same position.
void without_turns(const System& system, VectorXd& difference) {
  constexpr double turn = 2 * std::numbers::pi;
  for (Index k = 2; k < system.n_rigid(); k += 3) difference[k] -= turn * std::round(difference[k] / turn);
}

VectorXd as_vector(const std::vector<double>& x) { return VectorXd::Map(x.data(), static_cast<Index>(x.size())); }

/// Linearised map at a point: the directions that the constraints allow, in scaled coordinates, and the derivative along them.
struct Linearised {
  MatrixXd directions, derivative;
};

class Shooting {
 public:
  Shooting(const Model& model, const State& near, const CycleRun& run, const std::function<bool()>& go_on)
      : model_(model),
        near_(near),
        run_(run),
        go_on_(go_on),
        scales_(phase_scales(model.system, run.expected / run.period)),
        neighbour_(model.system, model.scheme, near) {}

  Cycle find(const CycleGuess& guess, const std::function<std::vector<double>(Integrator&)>& read) {
    if (guess.size() != scales_.size())
      throw OrbitTrouble{no_orbit, "the scene has different coordinates from those at the previous value"};
    point_ = near_.y.head(scales_.size());
    VectorXd from_motion = guess - point_;
    without_turns(model_.system, from_motion);
    point_ += from_motion;
    miss_ = miss(point_);
    check_time();
    newton();
    Cycle out;
    out.point.assign(point_.data(), point_.data() + point_.size());
    take_multipliers(derivative(), out);
    go_round_once_more(read, out);
    return out;
  }

 private:
  std::unique_ptr<Integrator> begin(const VectorXd& point, double later = 0) const {
    State start = near_;
    start.t += later;
    start.y.head(point.size()) = point;
    auto out = std::make_unique<Integrator>(model_.system, model_.scheme, std::move(start));
    if (!out->failure().empty()) throw OrbitTrouble{no_orbit, out->failure()};
    return out;
  }

  VectorXd head(const Integrator& integrator) const { return integrator.state().y.head(scales_.size()); }

  VectorXd apart(const VectorXd& a, const VectorXd& b) const {
    VectorXd out = a - b;
    without_turns(model_.system, out);
    return out.cwiseQuotient(scales_);
  }

  /// Integrates to the k-th return after `begun`.
  void to_return(Integrator& integrator, double begun, int k) const {
    if (run_.interval > 0) return go_to(integrator, begun + k * run_.interval, go_on_);
    while (go_to_return(integrator, begun + run_.longest, go_on_))
      if (integrator.state().t - begun > at_once * run_.expected) return;
    throw OrbitTrouble{no_orbit, "no return within " + number_text(run_.longest, 6) + " s after a trial point"};
  }

  void go_round(Integrator& integrator) const {
    const double begun = integrator.state().t;
    for (int k = 1; k <= run_.period; ++k) to_return(integrator, begun, k);
  }

  /// Residual of the shooting method: scaled distance between the point and the motion after the period. Projects the point onto the constraints.
  VectorXd miss(VectorXd& point) const {
    const auto integrator = begin(point);
    point = head(*integrator);
    go_round(*integrator);
    return apart(head(*integrator), point);
  }

  /// Whether the motion from the same point is the same if it starts `later`, and with its angles increased by `turns`.
  bool goes_alike(double later, const VectorXd& turns) const {
    try {
      const auto integrator = begin(point_ + turns, later);
      if (!(apart(head(*integrator), point_).lpNorm<Eigen::Infinity>() < same_for_any_time)) return false;
      go_round(*integrator);
      return (apart(head(*integrator), point_) - miss_).lpNorm<Eigen::Infinity>() < same_for_any_time;
    } catch (const OrbitTrouble& trouble) {
      if (trouble.status != no_orbit && trouble.status != status_text(Status::failed)) throw;
      return false;
    }
  }

  /// The whole turns that bodies make in one period: the law of a driver continues from the angle after them.
  VectorXd turns_of_a_round() const {
    const auto integrator = begin(point_);
    go_round(*integrator);
    const VectorXd whole = head(*integrator) - point_;
    VectorXd rest = whole;
    without_turns(model_.system, rest);
    return whole - rest;
  }

  /// Checks that laws allow a closed orbit: returns at equal times require laws that repeat after the period; returns at events require
  /// laws that do not depend on time.
  void check_time() const {
    constexpr double irrational = 0.381966;  // of the period: no simple fraction of the period of a law
    const VectorXd none = VectorXd::Zero(scales_.size());
    if (run_.interval == 0 && !goes_alike(irrational * run_.expected, none))
      throw OrbitTrouble{no_orbit, "laws or drivers depend on time: an orbit closes after their period; name it as section.every"};
    const double period = run_.period * run_.interval;
    if (run_.interval > 0 && !goes_alike(period, none) && !goes_alike(period, turns_of_a_round()))
      throw OrbitTrouble{no_orbit, "laws or drivers do not repeat after " + number_text(period, 6) +
                                       " s, orbit.period times section.every: the same point goes elsewhere one period later; make "
                                       "section.every a multiple of the period of the driving, such as 2*pi/omega"};
  }

  void newton() {
    for (int k = 0; k < most_newton; ++k) {
      if (miss_.lpNorm<Eigen::Infinity>() <= run_.tolerance) return;
      const Linearised here = linearise(first_distance());
      MatrixXd equations = here.derivative;
      equations.diagonal().array() -= 1;
      Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
      solver.setThreshold(singular);
      solver.compute(equations);
      const VectorXd step = here.directions * solver.solve(-(here.directions.transpose() * miss_));
      if (!step.allFinite() || !step_along(step)) break;
    }
    if (miss_.lpNorm<Eigen::Infinity>() <= run_.tolerance) return;
    throw OrbitTrouble{no_orbit, "Newton's method comes no closer than " + number_text(miss_.lpNorm<Eigen::Infinity>(), 3) +
                                     " of the scales; take values closer together, a longer section.transient, or another orbit.period"};
  }

  /// Takes the step, halved until the residual decreases. @returns false if it does not
  bool step_along(const VectorXd& step) {
    double part = 1;
    for (int k = 0; k <= most_halvings; ++k, part /= 2) {
      VectorXd point = point_ + part * step.cwiseProduct(scales_);
      try {
        const VectorXd missed = miss(point);
        if (!(missed.norm() < miss_.norm())) continue;
        point_ = point, miss_ = missed;
        return true;
      } catch (const OrbitTrouble& trouble) {
        if (trouble.status == status_text(Status::interrupted)) throw;
      }
    }
    return false;
  }

  /// Moves the neighbour away from the point, with the modes of the motion there. @returns its scaled distance on the constraints
  VectorXd set_apart(const std::string& here, const VectorXd& by) {
    neighbour_.load(here);
    if (!neighbour_.change([&](State& state) { state.y.head(by.size()) += by.cwiseProduct(scales_); }))
      throw OrbitTrouble{no_orbit, neighbour_.failure()};
    return apart(head(neighbour_), point_);
  }

  /// Distance of neighbours: the given one, otherwise the shortest of those compared.
  double first_distance() const { return run_.distance > 0 ? run_.distance : shortest_distance; }

  /// An orthonormal basis of the directions that the constraints allow.
  MatrixXd directions_at(const std::string& here) {
    const Index n = scales_.size();
    MatrixXd allowed(n, n);
    for (Index k = 0; k < n; ++k) allowed.col(k) = set_apart(here, shortest_distance * VectorXd::Unit(n, k)) / shortest_distance;
    Eigen::ColPivHouseholderQR<MatrixXd> qr;
    qr.setThreshold(no_direction);
    qr.compute(allowed);
    return qr.householderQ() * MatrixXd::Identity(n, qr.rank());
  }

  Linearised linearise(double distance) {
    const std::string here = begin(point_)->save();
    Linearised out{directions_at(here), {}};
    out.derivative = derivative_along(here, out.directions, distance);
    return out;
  }

  MatrixXd derivative_along(const std::string& here, const MatrixXd& directions, double distance) {
    const Index d = directions.cols();
    if (d == 0) throw OrbitTrouble{no_orbit, "the mechanism has no free motion: drivers prescribe all of it"};
    MatrixXd before(d, d), after(d, d);
    for (Index j = 0; j < d; ++j) {
      VectorXd began = VectorXd::Zero(scales_.size()), came = began;
      for (const double sign : {1.0, -1.0}) {
        began += sign * set_apart(here, sign * distance * directions.col(j));
        go_round(neighbour_);
        came += sign * apart(head(neighbour_), point_);
      }
      before.col(j) = directions.transpose() * began;
      after.col(j) = directions.transpose() * came;
    }
    return before.transpose().fullPivHouseholderQr().solve(after.transpose()).transpose();
  }

  /// The derivative at the point found. A given distance is used as it is; one ten times as long only serves to estimate the error.
  BoundedDerivative derivative() {
    const std::string here = begin(point_)->save();
    const MatrixXd directions = directions_at(here);
    std::vector<MatrixXd> all;
    double distance = first_distance();
    for (int k = 0; k < (run_.distance > 0 ? 2 : most_distances); ++k, distance *= 10) try {
        all.push_back(derivative_along(here, directions, distance));
      } catch (const OrbitTrouble& trouble) {
        if (k == 0 || trouble.status == status_text(Status::interrupted)) throw;
        break;  // a neighbour so far away does not return
      }
    if (run_.distance > 0 && all.size() == 2) return {all[0], (all[1] - all[0]).cwiseAbs().array() + run_.tolerance};
    return best_of_distances(all, run_.tolerance);
  }

  /// The multipliers, and how far each may be off, to first order: |row of V^-1| |error| |column of V| for the eigenvectors V.
  void take_multipliers(const BoundedDerivative& derivative, Cycle& out) const {
    const Eigen::EigenSolver<MatrixXd> solver(derivative.value);
    const Eigen::VectorXcd& all = solver.eigenvalues();
    const Eigen::MatrixXcd V = solver.eigenvectors();
    const MatrixXd rows = V.fullPivLu().inverse().cwiseAbs();
    const VectorXd errors = (rows * derivative.error * V.cwiseAbs()).diagonal();
    std::vector<Index> order;
    for (Index j = 0; j < all.size(); ++j) order.push_back(j);
    std::ranges::sort(order, [&](Index a, Index b) {
      return std::abs(all[a]) != std::abs(all[b]) ? std::abs(all[a]) > std::abs(all[b]) : std::arg(all[a]) > std::arg(all[b]);
    });
    if (run_.interval == 0) order.pop_back();  // along the motion itself the multiplier is 0, because of the section
    for (const Index j : order) out.re.push_back(all[j].real()), out.im.push_back(all[j].imag()), out.error.push_back(errors[j]);
  }

  void go_round_once_more(const std::function<std::vector<double>(Integrator&)>& read, Cycle& out) const {
    const auto integrator = begin(point_);
    const double begun = integrator->state().t;
    out.least = run_.period;
    for (int k = 1; k <= run_.period; ++k) {
      to_return(*integrator, begun, k);
      out.signals.push_back(read(*integrator));
      const bool closed = apart(head(*integrator), point_).lpNorm<Eigen::Infinity>() <= closes_before * run_.tolerance;
      if (run_.period % k == 0 && closed) out.least = std::min<double>(out.least, k);
    }
    out.period = integrator->state().t - begun;
  }

  const Model& model_;
  const State near_;
  const CycleRun run_;
  const std::function<bool()>& go_on_;
  const VectorXd scales_;
  Integrator neighbour_;
  VectorXd point_, miss_;
};

}  // namespace

double Cycle::modulus(std::size_t j) const { return std::hypot(re[j], im[j]); }

double Cycle::argument(std::size_t j) const { return std::atan2(im[j], re[j]); }

OrbitStability stability(const Cycle& cycle) {
  const double most = cycle.re.empty() ? 0 : cycle.modulus(0);
  const double within = cycle.error.empty() ? neutral_within : std::fmax(neutral_within, cycle.error[0]);
  return most > 1 + within ? OrbitStability::unstable : most < 1 - within ? OrbitStability::stable : OrbitStability::neutral;
}

std::string stability_word(OrbitStability stability) {
  return stability == OrbitStability::stable ? "stable" : stability == OrbitStability::neutral ? "neutral" : "unstable";
}

Cycle find_cycle(const Model& model, const State& near, const CycleGuess& guess, const CycleRun& run,
                 const std::function<std::vector<double>(Integrator&)>& read, const std::function<bool()>& go_on) {
  return Shooting(model, near, run, go_on).find(guess, read);
}

CycleGuess continued_guess(const System& system, const Cycle& before, double x) {
  CycleGuess out = as_vector(before.point);
  if (before.point_before.size() != before.point.size() || before.x == before.x_before) return out;
  VectorXd secant = out - as_vector(before.point_before);
  if (secant.size() != system.z_begin()) return out;
  without_turns(system, secant);
  return out + (x - before.x) / (before.x - before.x_before) * secant;
}

}  // namespace pintle
