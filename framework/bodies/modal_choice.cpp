#include "framework/bodies/modal_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/in_body.h"
#include "framework/bodies/modal_basis.h"
#include "framework/common/text.h"
#include "framework/component/reduction/static_response.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Method = SceneModes::Method;

constexpr Index evenly = 256;        ///< times at which shares are evaluated, besides the extremes
constexpr Index watched_nodes = 64;  ///< nodes whose displacement is evaluated, besides the ports
constexpr Index spectrum_samples = 8192;

/// The lowest of the modes counted by `keep`, and the static shapes that are always kept; all for the same reference conditions.
struct Candidates {
  ReferenceConditions conditions;
  ModalModel modes, fixed;
};

/// Keep for at most `count` modes: bodies with few dofs may have fewer.
template <class Modes>
ModalModel lowest(const Component& c, Index count, Modes modes) {
  Keep keep{static_cast<int>(count), {}, {}, false};
  if (c.model.n() <= 4 * count) keep = {{}, {}, {}, true};
  ModalModel all = modes(keep);
  if (all.omega.size() <= count) return all;
  return lowest_of(all, count);
}

Candidates candidates_of(const Scene& scene, const ElasticBody& e, const Component& c, int most) {
  const Method method = e.scene->elastic->modes->method;
  const std::vector<int> ports = shaped_ports(scene, e);
  Candidates out{reference_conditions_of(scene, e), {}, {}};
  const Keep none{0, {}, {}, false};
  if (method == Method::free) out.conditions = {ReferenceConditions::mean_axes};  // natural for free modes
  const ReferenceConditions& conditions = out.conditions;
  if (method == Method::craig_bampton) {
    out.modes = lowest(c, most, [&](const Keep& k) { return fixed_interface_modes(c, ports, conditions, k); });
    out.fixed = craig_bampton(c, ports, conditions, none);
  } else {
    out.modes = lowest(c, most, [&](const Keep& k) { return normal_modes(c, conditions, k); });
    if (method == Method::free) out.fixed = free_modes(c, ports, conditions, none);
  }
  if (out.fixed.omega.size() == 0) {
    out.fixed.shapes.resize(e.model.N(), 0);
    out.fixed.ports.resize(3 * static_cast<Index>(e.model.ports.size()), 0);
    out.fixed.omega.resize(0);
  }
  return out;
}

/// Displacement of a few nodes and of the ports, x and y of each, per column of nodal fields.
class Watched {
 public:
  explicit Watched(const ElasticBody& e) {
    const Index nodes = e.model.x.cols(), step = std::max<Index>(1, nodes / watched_nodes);
    for (Index i = 0; i < nodes; i += step) rows_.push_back(e.model.begin[static_cast<std::size_t>(i)]);
    if (nodes > 1) rows_.push_back(e.model.begin[static_cast<std::size_t>(nodes - 1)]);
    for (const Port& p : e.model.ports) ports_.push_back({p.dof[0], p.dof[1]});
  }
  MatrixXd of(const MatrixXd& nodal_field, const MatrixXd& ports) const {
    MatrixXd out(2 * static_cast<Index>(rows_.size()) + ports.rows(), nodal_field.cols());
    if (out.cols() == 0) return out;
    Index row = 0;
    for (const int r : rows_) out.middleRows<2>(row) = nodal_field.middleRows<2>(r), row += 2;
    out.bottomRows(ports.rows()) = ports;
    return out;
  }
  MatrixXd of(const ModalModel& m) const {
    MatrixXd ports(2 * static_cast<Index>(ports_.size()), m.omega.size());
    for (std::size_t p = 0; p < ports_.size() && ports.cols() > 0; ++p)
      ports.middleRows<2>(2 * static_cast<Index>(p)) = m.ports.middleRows<2>(3 * static_cast<Index>(p));
    return of(m.shapes, ports);
  }
  MatrixXd of(const FeModel& model, const MatrixXd& independent) const {
    MatrixXd ports(2 * static_cast<Index>(ports_.size()), independent.cols());
    for (std::size_t p = 0; p < ports_.size(); ++p)
      for (Index k = 0; k < 2; ++k) ports.row(2 * static_cast<Index>(p) + k) = independent.row(ports_[p][static_cast<std::size_t>(k)]);
    return of(nodal(model, independent), ports);
  }

 private:
  std::vector<int> rows_;
  std::vector<std::array<int, 2>> ports_;
};

/// A body under its loads: static shapes, then candidates, as small matrices.
struct Reduced {
  VectorXd omega, zeta;     ///< of the candidates
  Index fixed;              ///< static shapes, in front
  MatrixXd gram;            ///< VᵀKV
  MatrixXd work;            ///< VᵀL, shapes × loads
  MatrixXd watched;         ///< displacement, rows × shapes
  MatrixXd static_work;     ///< LᵀU of the full static response U, loads × loads
  MatrixXd static_watched;  ///< its displacement, rows × loads
};

/// Ratios given in the scene; none where they cannot be computed before the shapes are chosen.
VectorXd damping(const Scene& scene, const ElasticBody& e, const VectorXd& omega) {
  try {
    return damping_of(scene, *e.scene, omega, omega);
  } catch (const SceneError&) {
    return VectorXd::Zero(omega.size());
  }
}

Reduced reduced(const Scene& scene, const ElasticBody& e) {
  const Component c = component_of(e);
  const Candidates candidates = candidates_of(scene, e, c, considered_modes);
  const ModalModel &D = candidates.fixed, &modes = candidates.modes;
  const Index d = D.omega.size(), n = modes.omega.size();
  const MatrixXd loads = loads_on(e), U = static_response(c, candidates.conditions, loads);
  const Watched watched(e);
  Reduced r{modes.omega,           damping(scene, e, modes.omega), d, MatrixXd::Zero(d + n, d + n), {}, {},
            loads.transpose() * U, watched.of(e.model, U)};
  r.gram.diagonal() << D.omega.cwiseAbs2(), modes.omega.cwiseAbs2();
  r.gram.topRightCorner(d, n) = D.shapes.transpose() * (e.K * modes.shapes);
  r.gram.bottomLeftCorner(n, d) = r.gram.topRightCorner(d, n).transpose();
  r.work.resize(d + n, loads.cols());
  r.work << work_of_loads(e, D), work_of_loads(e, modes);
  const MatrixXd of_fixed = watched.of(D), of_modes = watched.of(modes);
  r.watched.resize(of_modes.rows(), d + n);
  r.watched << of_fixed, of_modes;
  return r;
}

/// Times at which a row is largest in magnitude, and some at equal intervals between.
std::vector<Index> telling_times(const MatrixXd& eta, const MatrixXd& factor) {
  std::set<Index> times;
  for (const MatrixXd* rows : {&eta, &factor})
    for (Index i = 0; i < rows->rows(); ++i) {
      Index t = 0;
      rows->row(i).cwiseAbs().maxCoeff(&t);
      times.insert(t);
    }
  const Index n = factor.cols();
  for (Index i = 0; i < evenly; ++i) times.insert(i * (n - 1) / (evenly - 1));
  return {times.begin(), times.end()};
}

double longest(const MatrixXd& displacement) {
  double longest = 0;
  for (Index t = 0; t < displacement.cols(); ++t)
    for (Index i = 0; i + 1 < displacement.rows(); i += 2) longest = std::max(longest, displacement.col(t).segment<2>(i).norm());
  return longest;
}

/// The part of the body's motion at the selected times that the shapes taken so far do not represent: the missing static response and, for
/// each candidate not taken, the deviation from its static response.
class Left {
 public:
  Left(const Reduced& r, const MatrixXd& eta, const MatrixXd& factor)
      : r_(r),
        n_(r.omega.size()),
        factor_(factor),
        force_(r.work.bottomRows(n_) * factor),
        beyond_static_(eta - r.omega.cwiseAbs2().cwiseInverse().asDiagonal() * force_),
        energy_(factor.cwiseProduct(r.static_work * factor).colwise().sum()),
        field_(r.static_watched * factor) {}

  /// Takes shape j, made K-orthonormal to those taken before; a shape that they already represent adds nothing.
  void take(Index j) {
    VectorXd y = VectorXd::Unit(r_.gram.cols(), j);
    for (int pass = 0; pass < 2; ++pass)
      for (const VectorXd& t : taken_) y -= t * t.dot(r_.gram * y);
    const double norm = y.dot(r_.gram * y);
    if (j >= r_.fixed) ++modes_;
    if (!(norm > 1e-10 * r_.gram(j, j))) return;
    y /= std::sqrt(norm);
    taken_.push_back(y);
    const Eigen::RowVectorXd part = (y.transpose() * r_.work) * factor_;
    energy_ -= part.cwiseAbs2();
    field_ -= (r_.watched * y) * part;
    force_ -= (r_.gram * y).tail(n_) * part;
  }

  double energy() const {
    const Index rest = n_ - modes_;
    const auto dynamic = beyond_static_.bottomRows(rest);
    const Eigen::RowVectorXd all = energy_ + (r_.omega.tail(rest).asDiagonal() * dynamic).colwise().squaredNorm() +
                                   2 * dynamic.cwiseProduct(force_.bottomRows(rest)).colwise().sum();
    return std::max(0.0, all.maxCoeff() / 2);
  }
  double displacement() const {
    const Index rest = n_ - modes_;
    return longest(field_ + r_.watched.rightCols(rest) * beyond_static_.bottomRows(rest));
  }

 private:
  const Reduced& r_;
  Index n_, modes_ = 0;
  std::vector<VectorXd> taken_;
  MatrixXd factor_, force_, beyond_static_;
  Eigen::RowVectorXd energy_;
  MatrixXd field_;
};

std::string fine_percent(double part) { return number_text(std::round(1e5 * part) / 1e3) + " %"; }

/// The smallest number of modes that leaves negligible parts, relative to what no candidate represents.
std::size_t enough(const std::vector<ConsideredMode>& modes, const ModalChoice& choice) {
  for (std::size_t k = 0; k < modes.size(); ++k)
    if (modes[k].left_energy <= choice.beyond_energy + negligible_part &&
        modes[k].left_displacement <= choice.beyond_displacement + negligible_part)
      return k + 1;
  return modes.size();
}

void explain(ModalChoice& choice, double until) {
  const ConsideredMode& last = choice.considered[static_cast<std::size_t>(choice.count - 1)];
  choice.reason = std::to_string(choice.count) + " of the " + std::to_string(choice.considered.size()) +
                  " lowest modes, by a rigid run of " + number_text(until) + " s: the others account for " +
                  fine_percent(last.left_energy) + " of the greatest strain energy, " + fine_percent(last.left_displacement) +
                  " of the greatest displacement";
}

}  // namespace

MatrixXd work_of_loads(const ElasticBody& e, const ModalModel& m) {
  const RigidFields f = rigid_fields(e.model);
  const RigidInertia inertia = rigid_inertia(e.model, e.M);
  const Eigen::Vector2d c = inertia.c / inertia.m;
  MatrixXd fields(e.model.N(), inertia_loads);
  fields << f.T, f.R + c.y() * f.T.col(0) - c.x() * f.T.col(1), f.x - f.T * c;
  MatrixXd out(m.omega.size(), inertia_loads + m.ports.rows());
  out << m.shapes.transpose() * (e.M * fields), m.ports.transpose();
  return out;
}

MatrixXd oscillator_response(const VectorXd& omega, const VectorXd& zeta, const std::vector<double>& t, const MatrixXd& Q) {
  MatrixXd eta = MatrixXd::Zero(Q.rows(), Q.cols());
  for (Index i = 0; i < Q.rows(); ++i) {
    const double w = omega[i], a = zeta[i] * w, decay = a * a - w * w;  // > 0: no oscillation
    double x = 0, v = 0;
    for (Index k = 1; k < Q.cols(); ++k) {
      const double h = t[static_cast<std::size_t>(k)] - t[static_cast<std::size_t>(k - 1)];
      if (!(h > 0)) {
        eta(i, k) = x;
        continue;
      }
      double c, s;  // e^(−ah) cosh(√decay h), e^(−ah) sinh(√decay h)/√decay
      if (const double root = std::sqrt(std::abs(decay)); root * h < 1e-8) {
        c = std::exp(-a * h), s = c * h;
      } else if (decay < 0) {
        const double e = std::exp(-a * h);
        c = e * std::cos(root * h), s = e * std::sin(root * h) / root;
      } else {
        const double slow = std::exp((root - a) * h), fast = std::exp((-root - a) * h);
        c = (slow + fast) / 2, s = (slow - fast) / (2 * root);
      }
      // The non-oscillating part follows the load: p(τ) = p₀ + ṗτ.
      const double rate = (Q(i, k) - Q(i, k - 1)) / (h * w * w), p = Q(i, k - 1) / (w * w) - 2 * a * rate / (w * w);
      const double dx = x - p, dv = v - rate;
      x = p + rate * h + c * dx + s * (dv + a * dx);
      v = rate + c * dv - s * (w * w * dx + a * dv);
      eta(i, k) = x;
    }
  }
  return eta;
}

ModalChoice choose_modes(const Scene& scene, const ElasticBody& e, const LoadHistory& history) {
  const Reduced r = in_body(scene, *e.scene, [&] { return reduced(scene, e); });
  const Index n = r.omega.size();
  if (n == 0) return {0, "there are no modes in addition to the static shapes", {}, 0, 0};
  const MatrixXd eta = oscillator_response(r.omega, r.zeta, history.t, r.work.bottomRows(n) * history.factor);
  const std::vector<Index> times = telling_times(eta, history.factor);
  const MatrixXd eta_then = eta(Eigen::all, times);
  Left left(r, eta_then, history.factor(Eigen::all, times));
  const double energy = left.energy(), displacement = left.displacement();
  ModalChoice choice;
  if (!(energy > 0) || !(displacement > 0)) {
    choice.count = 1;
    choice.reason = "the lowest mode: no load acts on the body in the rigid run";
    return choice;
  }
  for (Index j = 0; j < r.fixed; ++j) left.take(j);
  for (Index i = 0; i < n; ++i) {
    left.take(r.fixed + i);
    const double own = r.omega[i] * eta.row(i).lpNorm<Eigen::Infinity>();
    choice.considered.push_back(
        {r.omega[i] / (2 * std::numbers::pi), own * own / 2 / energy, left.energy() / energy, left.displacement() / displacement, false});
  }
  choice.beyond_energy = choice.considered.back().left_energy;
  choice.beyond_displacement = choice.considered.back().left_displacement;
  choice.count = static_cast<int>(enough(choice.considered, choice));
  for (int k = 0; k < choice.count; ++k) choice.considered[static_cast<std::size_t>(k)].kept = true;
  explain(choice, history.t.back());
  return choice;
}

ModalChoice choose_by_rule(const Scene& scene, const ElasticBody& e, const std::string& why) {
  const Index there = in_body(scene, *e.scene, [&] {
    const Component c = component_of(e);
    return candidates_of(scene, e, c, without_a_run).modes.omega.size();
  });
  return {static_cast<int>(there),
          "the " + std::to_string(there) + " lowest modes, by the default rule, because there is no rigid run: " + why,
          {},
          0,
          0};
}

double excited_up_to(const std::vector<double>& t, const MatrixXd& Q, const VectorXd& omega) {
  const double span = t.back() - t.front();
  if (!(span > 0)) return 0;
  VectorXd power = VectorXd::Zero(spectrum_samples / 2 + 1), samples(spectrum_samples);
  for (Index i = 0; i < Q.rows(); ++i) {
    std::size_t k = 1;
    for (Index j = 0; j < spectrum_samples; ++j) {
      const double at = t.front() + span * static_cast<double>(j) / static_cast<double>(spectrum_samples);
      while (k + 1 < t.size() && t[k] < at) ++k;
      const double h = t[k] - t[k - 1], part = h > 0 ? std::clamp((at - t[k - 1]) / h, 0.0, 1.0) : 1;
      samples[j] = (1 - part) * Q(i, static_cast<Index>(k) - 1) + part * Q(i, static_cast<Index>(k));
    }
    power += power_spectrum(samples) / (omega[i] * omega[i]);
  }
  const double all = power.sum();
  double below = 0;
  for (Index k = 0; k < power.size(); ++k)
    if (all > 0 && (below += power[k]) >= 0.99 * all) return static_cast<double>(k) / span;
  return 0;
}

}  // namespace pintle
