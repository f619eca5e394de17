#include "framework/dynamics/equations/rigid_contacts.h"

#include <algorithm>
#include <cmath>

#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/common/worse.h"
#include "framework/dynamics/equations/islands.h"
#include "framework/dynamics/equations/sharing.h"
#include "framework/dynamics/equations/sticking.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

bool is_closed(const System& system, const State& state, std::size_t k) {
  return k < system.contacts.size() && is_rigid(system.contacts[k]) && state.impact_rate[k] > 0;
}

// The state with closed rigid contacts opened and without the friction that their forces could affect.
State without_rigid(const System& system, const State& state) {
  State out = state;
  for (std::size_t k = 0; k < out.friction.size(); ++k) {
    const bool joint = k >= system.contacts.size();
    if (is_closed(system, state, k)) out.impact_rate[k] = 0;
    if (joint || out.friction[k].direction == 0) out.friction[k] = {};
  }
  return out;
}

// Start of an impact: all rigid contacts involved are closed, and their friction may stick.
void close_for_impact(const System& system, std::span<const int> touching, State& state) {
  for (const int c : touching) state.impact_rate[at(c)] = system.contacts[at(c)].slowest_impact;
  for (std::size_t k = 0; k < state.friction.size(); ++k) {
    state.friction[k] = {};
    if (is_closed(system, state, k)) state.friction[k].direction = 0;
  }
}

// Whether no gap closes further after impulses x. Bodies that a driver presses together cannot be stopped; impulses are found nevertheless
// if the direction of forces that press them has no effect on the motion and is left out.
bool stop_all(const System& system, const Closed& closed, const VectorXd& after, double fastest) {
  constexpr double closing = 1e-3;  // a direction that is left out, as of wedged bodies, leaves 1e-5 of that speed
  for (std::size_t i = 0; i < closed.contact.size(); ++i)
    if (!(-after[closed.unknowns[i].normal] <= closing * fastest + system.contacts[at(closed.contact[i])].slowest_impact)) return false;
  return true;
}

// Poisson's law: the impulse of expansion is e times that of compression, or more where a gap would close.
std::optional<VectorXd> poisson(const System& system, const Closed& closed, std::span<const double> e, const MatrixXd& W, const VectorXd& v,
                                double fastest) {
  const auto compression = unilateral_forces(closed.unknowns, W, v);
  if (!compression) return std::nullopt;
  std::vector<UnilateralContact> expanding = closed.unknowns;
  VectorXd given = VectorXd::Zero(v.size());
  for (std::size_t i = 0; i < e.size(); ++i) {
    UnilateralContact& k = expanding[i];
    given[k.normal] = k.preload = e[i] * (*compression)[k.normal];
  }
  const auto more = unilateral_forces(expanding, W, v + W * (*compression + given));
  if (!more) return std::nullopt;
  const VectorXd x = *compression + given + *more;
  return stop_all(system, closed, v + W * x, fastest) ? std::optional(x) : std::nullopt;
}

// Effective restitution of a contact: 0 if the separation speed or the opening would be too small to resolve.
struct Bounce {
  double e;
  std::optional<double> at_rest = {};  ///< if e is 0 for that reason: when the sequence of decreasing bounces ends
};
// Whether a contact that separates at this speed opens far enough to be resolved.
bool shows(const ContactPair& pair, double parts, double acceleration) {
  constexpr double times = 20;  // multiple of the slack within which a gap counts as closed
  return parts > pair.slowest_impact && (!(acceleration < 0) || parts * parts > -2 * acceleration * times * pair.slack);
}
Bounce bounce_of(const ContactPair& pair, double t, double opening, double acceleration) {
  const double e = pair.rigid->restitution, parts = -e * opening;
  if (!(opening < 0) || e == 0) return {0};
  if (shows(pair, parts, acceleration)) return {e};
  return {0, acceleration < 0 && e < 1 ? std::optional(t - 2 * parts / (acceleration * (1 - e))) : std::nullopt};
}

// Input of an impact of closed contacts.
struct Meeting {
  const System& system;
  const Closed& closed;
  const MatrixXd& W;
  VectorXd before, acceleration;
};

// Which contacts separate under the impulses x. A contact that would separate too slowly to be resolved, such as the corner of a rocking
// block, stays closed: the impulses that stop it, and slips that are as slow, are added to x.
std::vector<bool> parting(const Meeting& m, std::span<const double> e, double slow, VectorXd& x) {
  const VectorXd after = m.before + m.W * x;
  double fall = 0;
  for (const UnilateralContact& k : m.closed.unknowns) fall = std::min(fall, m.acceleration[k.normal]);
  std::vector<bool> out;
  std::vector<Index> stays;
  bool creeps = false;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const UnilateralContact& k = m.closed.unknowns[i];
    const bool opens = after[k.normal] > slow;
    const bool goes_on = m.acceleration[k.normal] > 0;  // slow but accelerating, such as a disc that is lifted out of a row
    out.push_back(opens && (e[i] > 0 || goes_on || shows(m.system.contacts[at(m.closed.contact[i])], after[k.normal], fall)));
    if (out.back()) continue;
    creeps = creeps || opens;
    stays.push_back(k.normal);
    if (k.tangent >= 0 && std::abs(after[k.tangent]) <= slow) stays.push_back(k.tangent);
  }
  if (!creeps) return out;
  const auto n = static_cast<Index>(stays.size());
  MatrixXd own(n, n);
  VectorXd left(n);
  for (Index i = 0; i < n; ++i) {
    left[i] = after[stays[at(i)]];
    for (Index j = 0; j < n; ++j) own(i, j) = m.W(stays[at(i)], stays[at(j)]);
  }
  const VectorXd stop = share_out(own, left, VectorXd::Ones(n), one_force);
  for (Index i = 0; i < n; ++i) x[stays[at(i)]] -= stop[i];
  return out;
}

}  // namespace

Closed closed_contacts(const System& system, const State& state, const Equations& eq) {
  Closed out;
  const auto& of = eq.sticking.of;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (!of[i].normal) continue;
    UnilateralContact k{.normal = static_cast<int>(i)};
    if (i + 1 < of.size() && of[i + 1].at == of[i].at) {
      const Coulomb& law = *dry_law(system, of[i].at);
      const bool holds = of[i + 1].holds;
      (holds ? k.tangent : k.sliding) = static_cast<int>(i + 1);
      k.mu = holds ? law.mu_static
                   : std::abs(evaluate(law, eq.contact[of[i].at].gap.material_slip, 1, state.friction[of[i].at].direction).force);
      k.direction = state.friction[of[i].at].direction;
    }
    out.unknowns.push_back(k);
    out.contact.push_back(static_cast<int>(of[i].at));
  }
  return out;
}

double fastest_there(const Equations& eq, const VectorXd& speeds) { return largest(eq.sticking.J.cwiseAbs().transpose() * speeds); }

std::optional<VectorXd> newton_impulses(const System& system, const Closed& closed, std::span<const double> e, const MatrixXd& W,
                                        const VectorXd& before, const VectorXd& free, double fastest) {
  constexpr double rounding = 1e-10;  // relative to the approach speeds
  const double still = rounding * largest(before) + largest(free - before);
  VectorXd c = free;
  std::vector<int> slipping;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const UnilateralContact& k = closed.unknowns[i];
    c[k.normal] += e[i] * std::min(before[k.normal], 0.0);
    if (k.tangent < 0) continue;
    c[k.tangent] += system.contacts[at(closed.contact[i])].rigid->tangential * before[k.tangent];
    if (std::abs(before[k.tangent]) > still) slipping.push_back(k.tangent);
  }
  auto x = contact_forces(closed.unknowns, W, c, slipping);
  if (x && !stop_all(system, closed, free + W * *x, fastest)) x.reset();
  return x;
}

void book_impulses(const System& system, const Closed& closed, const VectorXd& x, const VectorXd& mean, State& state) {
  auto z = state.y.segment(system.z_begin(), system.n_z());
  for (std::size_t i = 0; i < closed.unknowns.size(); ++i) {
    const UnilateralContact& k = closed.unknowns[i];
    const int begin = system.contact_z[at(closed.contact[i])];
    z[begin] -= x[k.normal] * mean[k.normal];
    if (k.tangent >= 0) z[begin + 1] -= x[k.tangent] * mean[k.tangent];
  }
}

void book_driver_impulses(const System& system, const Equations& eq, const VectorXd& impulses, State& state) {
  for (std::size_t j = 0; j < system.joints.size(); ++j)
    if (system.joint_z[j] >= 0) state.y[system.z_begin() + system.joint_z[j]] += impulses[system.row_begin[j]] * eq.rows[j].Ct[0];
}

std::optional<std::vector<Blow>> strike(const System& system, std::span<const int> touching, State& state, Equations& eq) {
  constexpr double rounding = 1e-10;  // relative to the approach speeds
  VectorXd dy(system.n_y());
  if (!evaluate(system, state, eq, dy)) return std::nullopt;
  close_for_impact(system, touching, state);
  evaluate_held(system, state, eq);
  const Closed closed = closed_contacts(system, state, eq);
  const VectorXd acceleration = sticking_accelerations(system, eq);
  const MatrixXd W = respond_to_sticking(system, eq);
  auto speeds = state.y.segment(system.n(), system.n());
  const VectorXd before = eq.sticking.J.transpose() * speeds;
  const double fastest = fastest_there(eq, speeds.cwiseAbs());

  std::vector<Bounce> bounce;
  std::vector<double> e;
  bool by_poisson = false;
  for (std::size_t i = 0; i < closed.unknowns.size(); ++i) {
    const ContactPair& pair = system.contacts[at(closed.contact[i])];
    const int k = closed.unknowns[i].normal;
    bounce.push_back(bounce_of(pair, state.t, before[k], acceleration[k]));
    e.push_back(bounce.back().e);
    by_poisson = by_poisson || pair.rigid->poisson;
  }
  if (by_poisson && std::ranges::any_of(e, [](double each) { return each > 0; }))  // contacts that were closed return their impulse too
    for (std::size_t i = 0; i < e.size(); ++i) e[i] = system.contacts[at(closed.contact[i])].rigid->restitution;
  auto x = by_poisson ? poisson(system, closed, e, W, before, fastest) : newton_impulses(system, closed, e, W, before, before, fastest);
  if (!x) {  // bodies wedged between others cannot all separate with restitution e
    std::ranges::fill(e, 0.0);
    x = newton_impulses(system, closed, e, W, before, before, fastest);
  }
  if (!x) return std::nullopt;
  const std::vector<bool> parts = parting({system, closed, W, before, acceleration}, e, rounding * largest(before), *x);
  speeds += eq.sticking.a * *x;
  const VectorXd after = before + W * *x;
  book_impulses(system, closed, *x, (before + after) / 2, state);
  book_driver_impulses(system, eq, eq.sticking.lambda * *x, state);

  std::vector<Blow> out;
  for (std::size_t i = 0; i < closed.unknowns.size(); ++i) {
    const int k = closed.unknowns[i].normal, c = closed.contact[i];
    out.push_back({c, -before[k], parts[i] ? after[k] : 0, (*x)[k], parts[i] ? std::nullopt : bounce[i].at_rest});
    state.friction[at(c)] = {};
    state.impact_rate[at(c)] = parts[i] ? 0 : std::max(-before[k], system.contacts[at(c)].slowest_impact);
  }
  return out;
}

namespace {

// Eliminates the other holding forces from W and c: they respond at once.
void let_others_hold(const System& system, const State& state, const Equations& eq, MatrixXd& W, VectorXd& c) {
  std::vector<Index> others;
  const auto& of = eq.sticking.of;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (of[i].holds && !is_closed(system, state, of[i].at)) others.push_back(static_cast<Index>(i));
  if (others.empty()) return;
  const auto m = static_cast<Index>(others.size());
  MatrixXd own(m, m), by(m, W.cols() + 1);
  for (Index i = 0; i < m; ++i) {
    const Index row = others[at(i)];
    for (Index j = 0; j < m; ++j) own(i, j) = W(row, others[at(j)]);
    by.row(i) << W.row(row), c[row];
  }
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> least_norm(m, m);
  least_norm.compute(own);
  const MatrixXd share = least_norm.solve(by), to = by.leftCols(W.cols()).transpose();
  W -= to * share.leftCols(W.cols());
  c -= to * share.col(W.cols());
}

}  // namespace

namespace {

// Whether this slip or gap, which no force holds, is kept at 0 by the forces that hold others: then it needs no force of its own.
bool is_held_by_others(const MatrixXd& W, const std::vector<Index>& holding, Index row) {
  constexpr double dependent = 1e-10;
  const auto n = static_cast<Index>(holding.size());
  if (n == 0) return false;
  MatrixXd own(n, n);
  VectorXd by(n);
  for (Index i = 0; i < n; ++i) {
    by[i] = W(holding[at(i)], row);
    for (Index j = 0; j < n; ++j) own(i, j) = W(holding[at(i)], holding[at(j)]);
  }
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> least_norm(n, n);
  least_norm.setThreshold(dependent);
  least_norm.compute(own);
  return W(row, row) - by.dot(least_norm.solve(by)) <= dependent * W(row, row);
}

// Whether each closed contact opens, sticks or slides under the forces x.
enum class Doing { opens, sticks, slides };
std::vector<Doing> doings(const Closed& closed, const MatrixXd& W, const VectorXd& c, const VectorXd& x) {
  constexpr double nearly = 1e-9, limit = 1e-8;
  const VectorXd rate = W * x + c, terms = W.cwiseAbs() * x.cwiseAbs() + c.cwiseAbs();
  const auto none = [&](Index i) { return std::abs(rate[i]) <= nearly * terms[i]; };
  double most = 0;
  for (const UnilateralContact& k : closed.unknowns) most = std::max(most, x[k.normal]);
  std::vector<Index> holding;
  for (const UnilateralContact& k : closed.unknowns) {
    if (x[k.normal] > nearly * most) holding.push_back(k.normal);
    if (k.tangent >= 0 && std::abs(x[k.tangent]) < k.mu * (x[k.normal] - limit * most)) holding.push_back(k.tangent);
  }
  const auto holds = [&](Index i) {
    return std::ranges::find(holding, i) != holding.end() || (none(i) && is_held_by_others(W, holding, i));
  };
  std::vector<Doing> out;
  for (const UnilateralContact& k : closed.unknowns) {
    const bool presses = x[k.normal] > nearly * most, sticks = k.tangent >= 0 && holds(k.tangent);
    const bool stays = presses || (holds(k.normal) && (k.tangent < 0 || sticks));
    out.push_back(!stays ? Doing::opens : sticks ? Doing::sticks : Doing::slides);
  }
  return out;
}

}  // namespace

// If the forces are not unique, one solution is used. A contact with no force and no opening in it stays closed.
bool decide_rigid(const System& system, State& state, Equations& eq) {
  VectorXd dy(system.n_y());
  if (!evaluate(system, without_rigid(system, state), eq, dy)) return false;
  evaluate_held(system, state, eq);
  const Closed closed = closed_contacts(system, state, eq);
  MatrixXd W = respond_to_sticking(system, eq);
  VectorXd c = sticking_accelerations(system, eq);
  let_others_hold(system, state, eq, W, c);
  const auto x = contact_forces(closed.unknowns, W, c);
  if (!x) return false;
  const std::vector<Doing> now = doings(closed, W, c, *x);
  for (std::size_t i = 0; i < now.size(); ++i) {
    const UnilateralContact& k = closed.unknowns[i];
    const auto contact = at(closed.contact[i]);
    DryFriction& dry = state.friction[contact];
    if (now[i] == Doing::opens) {
      state.impact_rate[contact] = 0;
      dry = {};
    } else if (k.tangent >= 0) {
      dry.direction = now[i] == Doing::sticks ? 0 : -std::copysign(1.0, (*x)[k.tangent]);
    }
  }
  return true;
}

}  // namespace pintle
