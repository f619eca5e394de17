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
#include "framework/study/nonlinear/follower.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_newton = 25, most_halvings = 8;
constexpr double at_once = 1e-4;       // of the period: an earlier return is that of the point itself
constexpr double no_direction = 1e-3;  // of the largest displacement: the constraints do not allow this direction
constexpr double same_for_any_time = 1e-6;
constexpr double singular = 1e-7;      // of the largest pivot: smaller ones mean a family of orbits; the nearest is taken
constexpr double closes_before = 100;  // times the tolerance
constexpr double neutral_within = 1e-5;
constexpr const char* no_orbit = "no periodic orbit";

/// Removes whole turns from the angles of bodies: a crank that has turned once is where it was.
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
    if (guess.size() != scales_.size()) throw OrbitTrouble{no_orbit, "the scene has other coordinates than at the previous value"};
    point_ = near_.y.head(scales_.size());
    VectorXd from_motion = guess - point_;
    without_turns(model_.system, from_motion);
    point_ += from_motion;
    miss_ = miss(point_);
    if (run_.interval == 0) check_autonomous();
    newton();
    const Linearised here = linearise();
    Cycle out;
    out.point.assign(point_.data(), point_.data() + point_.size());
    take_multipliers(here.derivative, out);
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
    throw OrbitTrouble{no_orbit, "no return within " + number_text(run_.longest, 6) + " s of a point tried"};
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

  /// If returns are events, an orbit can close only if nothing depends on time itself. @throws OrbitTrouble  something does
  void check_autonomous() const {
    constexpr double later = 0.381966;  // of the period: not a simple fraction
    const auto integrator = begin(point_, later * run_.expected);
    bool same = apart(head(*integrator), point_).lpNorm<Eigen::Infinity>() < same_for_any_time;
    if (same) {
      go_round(*integrator);
      same = (apart(head(*integrator), point_) - miss_).lpNorm<Eigen::Infinity>() < same_for_any_time;
    }
    if (!same) throw OrbitTrouble{no_orbit, "laws or drivers depend on time: an orbit closes after their period; name it as section.every"};
  }

  void newton() {
    for (int k = 0; k < most_newton; ++k) {
      if (miss_.lpNorm<Eigen::Infinity>() <= run_.tolerance) return;
      const Linearised here = linearise();
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

  /// An orthonormal basis of the directions that the constraints allow.
  MatrixXd directions_at(const std::string& here) {
    const Index n = scales_.size();
    MatrixXd allowed(n, n);
    for (Index k = 0; k < n; ++k) allowed.col(k) = set_apart(here, run_.distance * VectorXd::Unit(n, k)) / run_.distance;
    Eigen::ColPivHouseholderQR<MatrixXd> qr;
    qr.setThreshold(no_direction);
    qr.compute(allowed);
    return qr.householderQ() * MatrixXd::Identity(n, qr.rank());
  }

  Linearised linearise() {
    const auto integrator = begin(point_);
    const std::string here = integrator->save();
    Linearised out{directions_at(here), {}};
    const Index d = out.directions.cols();
    if (d == 0) throw OrbitTrouble{no_orbit, "the mechanism has no free motion: drivers prescribe all of it"};
    MatrixXd before(d, d), after(d, d);
    for (Index j = 0; j < d; ++j) {
      VectorXd began = VectorXd::Zero(scales_.size()), came = began;
      for (const double sign : {1.0, -1.0}) {
        began += sign * set_apart(here, sign * run_.distance * out.directions.col(j));
        go_round(neighbour_);
        came += sign * apart(head(neighbour_), point_);
      }
      before.col(j) = out.directions.transpose() * began;
      after.col(j) = out.directions.transpose() * came;
    }
    out.derivative = before.transpose().fullPivHouseholderQr().solve(after.transpose()).transpose();
    return out;
  }

  void take_multipliers(const MatrixXd& derivative, Cycle& out) const {
    Eigen::VectorXcd all = Eigen::EigenSolver<MatrixXd>(derivative, false).eigenvalues();
    std::sort(all.begin(), all.end(), [](const std::complex<double>& a, const std::complex<double>& b) {
      return std::abs(a) != std::abs(b) ? std::abs(a) > std::abs(b) : std::arg(a) > std::arg(b);
    });
    const Index own = run_.interval == 0 ? 1 : 0;  // along the motion itself the section makes it 0
    for (Index j = 0; j < all.size() - own; ++j) out.re.push_back(all[j].real()), out.im.push_back(all[j].imag());
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
  return most > 1 + neutral_within   ? OrbitStability::unstable
         : most < 1 - neutral_within ? OrbitStability::stable
                                     : OrbitStability::neutral;
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
