#include "framework/configuration/assemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include "framework/common/index.h"
#include "framework/common/some_of.h"
#include "framework/common/worse.h"
#include "framework/configuration/branching.h"
#include "framework/configuration/closure.h"
#include "framework/configuration/drawn_pose.h"
#include "framework/configuration/equilibrium.h"
#include "framework/configuration/ideal_pin.h"
#include "framework/configuration/least_step.h"
#include "framework/configuration/locked_couplings.h"
#include "framework/configuration/named_place.h"
#include "framework/configuration/overlap.h"
#include "framework/configuration/placed.h"
#include "framework/configuration/row_space.h"
#include "framework/dynamics/equations/internal.h"
#include "framework/dynamics/model/marker_motion.h"
#include "framework/integration/events/impact_log.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

using Eigen::VectorXd;
using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

/// Rough pose, the coordinates and speeds that the scene fixes (their W is 0), and the fixed origins.
struct Rough {
  VectorXd y, W_pose, W_speed;
  std::vector<Pin> places, rates;
  std::vector<int> bent;  ///< bodies whose deformation the scene prescribes
};

using Bent = std::vector<std::pair<int, VectorXd>>;  ///< bodies that start deformed, and their modal coordinates

Rough rough_state(const Scene& scene, const System& system, const Bent& bent) {
  Rough r;
  r.y.setZero(system.n_y());
  begin_switches(system, r.y);
  for (const auto& [body, eta] : bent) {
    r.y.segment(system.eta_begin[at(body)], eta.size()) = eta;
    r.bent.push_back(body);
  }
  r.W_pose.resize(system.n());
  r.W_speed.resize(system.n());
  r.W_pose.tail(system.n() - system.n_rigid()).setZero();  // undeformed if the joints can be closed that way
  r.W_speed.tail(system.n() - system.n_rigid()).setZero();
  std::map<std::string, const StartBody*> starts;
  for (const StartBody& s : scene.start_bodies) starts[s.body] = &s;
  const double area = system.length * system.length;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const SceneBody& body = scene.bodies[b];
    const auto i = static_cast<Index>(3 * b);
    const int index = static_cast<int>(b);
    r.W_pose.segment<3>(i) << area, area, 1;
    r.W_speed.segment<3>(i) << 1 / system.bodies[b].m, 1 / system.bodies[b].m, 1 / system.bodies[b].J;
    double x = body.at[0], y = body.at[1], angle = body.angle;
    if (const auto found = starts.find(body.name); found != starts.end()) {
      const StartBody& s = *found->second;
      if (s.angle) angle = *s.angle, r.W_pose[i + 2] = 0;
      if (s.speed) r.y[system.n() + i + 2] = *s.speed, r.W_speed[i + 2] = 0;
      if (s.x) x = *s.x, r.places.push_back({index, 0, *s.x});
      if (s.y) y = *s.y, r.places.push_back({index, 1, *s.y});
      if (s.vx) r.rates.push_back({index, 0, *s.vx});
      if (s.vy) r.rates.push_back({index, 1, *s.vy});
    }
    const Eigen::Vector2d arm = Eigen::Rotation2Dd(angle) * system.bodies[b].x_BO;
    r.y.segment<3>(i) << x - arm.x(), y - arm.y(), angle;
  }
  return r;
}

[[noreturn]] void cannot(const Scene& scene, const std::string& what, const Closure& closure, const VectorXd& left, const char* per,
                         const char* remedy) {
  Index worst = 0;
  left.cwiseAbs().maxCoeff(&worst);
  std::string message = what + ": " + closure.amount(worst, left[worst]) + per + " remains";
  if (const std::vector<std::string> others = closure.opponents(worst, left); !others.empty())
    message += "; it contradicts " + some_of(others);
  throw AssemblyError(scene.file, named_place(scene, closure.owner(worst)), message + "; " + remedy);
}

constexpr double nearly_right = 1e-6;  // a residual below this does not occur by chance
const char* const must_fit =
    "redundant joints must agree with each other to 1e-11 of the mechanism's size: write lengths, points and angles with more digits, or "
    "remove a joint";

// The violation of C that a run accepts (onto_constraints), and so the largest allowed here.
double constraints_met(const System& system, const VectorXd& y) {
  constexpr double met = 1e-11, still_good = 1e-8;
  return std::max(met, std::min(8 * angle_rounding(system, y), still_good));
}

/// A solution of C = 0, or the best that was found.
struct Closed {
  Sparse J;
  VectorXd C;
  int iterations = 0;
  bool far = false;  ///< the first step was much longer than the limit of a step
};

// Levenberg–Marquardt on C = 0, starting from y.
Closed close_from(Closure& closure, const System& system, const VectorXd& W, VectorXd& y, bool however_far = true) {
  constexpr double closed = 1e-12, most = 0.5, far = 20 * most;
  Closed out;
  double mu = 1e-9;
  auto& [J, C, i, is_far] = out;
  C = closure.violation(y, &J);
  const auto remains = [&] { return largest(out.C) > std::max(closed, 2 * angle_rounding(system, y)); };
  for (; i < 300 && remains(); ++i) {
    VectorXd step = least_step(J, W, -C, mu, 1);
    const double reach = std::max((step.array() / W.array().max(1e-300).sqrt()).abs().maxCoeff(), 1e-300);
    if (is_far = i == 0 && reach > far; is_far && !however_far) break;
    if (reach > most) step *= most / reach;
    VectorXd trial = y;
    trial.head(system.n()) += step;
    const VectorXd C_trial = closure.violation(trial);
    if (C_trial.norm() < C.norm()) {
      // Near a singular configuration a Newton step covers half of the remaining distance, so residuals fall to a quarter.
      const VectorXd further = y.head(system.n()) + 2 * step;
      y = trial;
      if (const double left = C_trial.norm() / C.norm(); left > 0.2 && left < 0.3 && reach <= most) {
        trial.head(system.n()) = further;
        if (closure.violation(trial).norm() < 0.1 * C_trial.norm()) y = trial;
      }
      C = closure.violation(y, &J);
      mu = std::max(mu / 10, 1e-15);
    } else if (mu < 1e3) {
      mu *= 10;
    } else {
      break;
    }
  }
  return out;
}

// Starts from the drawn pose. If that fails, or if the bodies have far to go, starts from the positions that a tree of joints gives them
// (`placed`).
Closed close_anyhow(const Scene& scene, Closure& closure, const System& system, Rough& r) {
  constexpr double far = 10;    // lengths of the mechanism
  constexpr double bent = 0.1;  // [rad]
  const VectorXd drawn = r.y;
  const auto is_closed = [&](const Closed& c) { return largest(c.C) <= constraints_met(system, r.y); };
  const auto from_placed = [&](double bend) {
    r.y = placed(scene, system, closure, drawn, r.W_pose, bend);
    Closed out = close_from(closure, system, r.W_pose, r.y);
    ++out.iterations;  // counts `placed`
    return out;
  };
  Closed first = close_from(closure, system, r.W_pose, r.y, false);
  std::vector<double> bends{0, bent};
  if (first.far) {
    if (Closed at_once = from_placed(0); is_closed(at_once) && largest((r.y - drawn).head(system.n_rigid())) > far * system.length)
      return at_once;
    else if (!is_closed(at_once))
      bends = {bent};
    r.y = drawn;
    first = close_from(closure, system, r.W_pose, r.y);
  }
  if (is_closed(first)) return first;
  const VectorXd compromise = r.y;
  for (const double bend : bends)
    if (Closed later = from_placed(bend); is_closed(later)) return later;
  r.y = compromise;
  return first;
}

/// What the scene prescribes holds to the last bit, in `of` the coordinates or the speeds: the solution gives it but for rounding.
template <class Part>
void keep_exactly(const System& system, const std::vector<Pin>& pins, Part of) {
  constexpr double rounding = 1e-13;
  const double size = rounding * std::max(largest(of), system.length);
  for (const Pin& pin : pins)
    if (double& value = of[3 * pin.body + pin.axis]; system.bodies[at(pin.body)].x_BO.isZero(0) && std::abs(value - pin.value) <= size)
      value = pin.value;
}

int close_joints(const Scene& scene, Closure& closure, const System& system, Rough& r) {
  closure.pin(r.places);
  Closed now = close_anyhow(scene, closure, system, r);
  const double left = largest(now.C);
  if (!(left <= constraints_met(system, r.y))) {
    closure.violation(r.y);
    const bool pinned = !scene.start_bodies.empty();
    cannot(
        scene, pinned ? "cannot close with the values given in `start`" : "cannot close", closure, now.C, "",
        left < nearly_right ? must_fit : "check lengths and points, or give the bodies rough poses (`pose`) nearer to the intended ones");
  }
  close_in(closure, system, r.W_pose, r.y, now.C, now.J);
  keep_exactly(system, r.places, r.y.head(system.n()));
  return now.iterations;
}

int match_speeds(const Scene& scene, Closure& closure, const System& system, Rough& r) {
  closure.pin(r.rates);
  Sparse J;
  closure.violation(r.y, &J);
  if (J.rows() == 0) return 0;
  const VectorXd D = closure.drift(r.y);
  auto s = r.y.segment(system.n(), system.n());
  s += least_step(J, r.W_speed, -D, 1e-13, 8);
  VectorXd left = closure.drift(r.y);
  const double scale = std::max({D.lpNorm<Eigen::Infinity>(), s.lpNorm<Eigen::Infinity>(), 1e-12});
  for (int i = 0; i < 3 && left.lpNorm<Eigen::Infinity>() > 1e-12 * scale; ++i) {  // very different masses hide some rows
    const VectorXd W = r.W_speed.cwiseMax(1e-6 * r.W_speed.maxCoeff()).cwiseProduct((r.W_speed.array() > 0).cast<double>().matrix());
    const VectorXd before = s;
    s += least_step(J, W, -left, 1e-13, 8);
    const VectorXd now = closure.drift(r.y);
    if (!(now.lpNorm<Eigen::Infinity>() < left.lpNorm<Eigen::Infinity>())) {
      s = before;
      break;
    }
    left = now;
  }
  if (left.lpNorm<Eigen::Infinity>() > 1e-8 * scale)
    cannot(scene, "cannot move with the speeds that `start` and the drivers prescribe", closure, left, "/s",
           left.lpNorm<Eigen::Infinity>() < nearly_right * scale ? must_fit
                                                                 : "remove a speed from `start`, a driver, or a joint (such as a gear) "
                                                                   "between bodies that other joints couple with a different ratio");
  const std::vector<Dependence> singular = singular_dependences(system, 0, r.y);
  if (!singular.empty() && !choose_branch(closure, system, J, singular, r.W_speed, r.y))
    throw AssemblyError(
        scene.file, named_place(scene, closure.owner(singular.front().N.back().first)),
        "the start is a singular configuration, where the motion can branch, and no branch has these speeds; start from another "
        "pose, or give other speeds in `start`");
  keep_exactly(system, r.rates, s);
  return 1;
}

// Flexible bodies start undeformed and move as rigid ones. They deform only if the joints cannot be closed otherwise, soft shapes before
// stiff ones.
template <class Close>
int undeformed_first(const System& system, Rough& r, VectorXd Rough::*weight, Close close) {
  if (system.n() == system.n_rigid()) return close(r);
  Rough bent = r;
  try {
    return close(r);
  } catch (const AssemblyError&) {
  }
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    if (const int n = system.bodies[b].modes(); n > 0 && !(weight == &Rough::W_pose && std::ranges::count(r.bent, static_cast<int>(b)))) {
      const VectorXd& omega = system.bodies[b].flex->omega;
      const bool pose = weight == &Rough::W_pose;
      (bent.*weight).segment(system.eta_begin[b], n) =
          pose ? VectorXd((system.scale.segment(system.eta_begin[b], n) * omega.minCoeff()).cwiseQuotient(omega).cwiseAbs2())
               : VectorXd::Ones(n);
    }
  r = bent;
  return close(r);
}

/// The first redundant driver, otherwise the first redundant joint.
const std::string& last_driver(const System& system, const std::vector<Redundancy>& redundant) {
  for (const Redundancy& r : redundant)
    if (is_driver(system.joints[at(r.joint)])) return system.joint_names[at(r.joint)];
  return system.joint_names[at(redundant.front().joint)];
}

}  // namespace

std::vector<std::string> warnings_of(const Model& model, const Assembly& assembly) {
  const System& system = model.system;
  std::vector<std::string> out = assembly.doubts;
  std::vector<std::string> singular;
  bool any = false;
  for (const Redundancy& r : assembly.redundant) {
    if (const std::string twice = driven_twice(system, r); r.permanent && !twice.empty()) out.push_back(twice);
    any = any || r.permanent;
    if (!r.permanent) singular.push_back(row_text(system, r.joint, r.row));
  }
  if (any)
    out.push_back(
        "redundant joints: the motion does not determine how they share these forces; the program chooses the solution of least norm: " +
        rows_text(system, assembly.shared));
  if (!singular.empty())
    out.push_back("the start is a singular configuration, where the motion can branch: in this pose only, other joints imply " +
                  some_of(singular, false) +
                  "; speeds in `start` choose the branch; without them it is the one nearest to the least kinetic energy");
  for (std::string& locked : locked_couplings(system, assembly.start.t, assembly.start.y)) out.push_back(std::move(locked));
  return out;
}

namespace {

// The system with clearance joints as ideal ones, and as many integrals, so that states have equal length.
System without_play(System system) {
  system.joints.insert(system.joints.end(), system.loose.begin(), system.loose.end());
  system.joint_names.insert(system.joint_names.end(), system.loose_names.begin(), system.loose_names.end());
  number(system, std::ranges::count(system.integrals, Account::scheme, &Integral::account) > 0);
  return system;
}

// Does one step of the assembly: first with clearance joints as ideal ones; if this contradicts the scene's start, without them.
template <class Do>
auto as_if_ideal(const Scene& scene, const System& system, const System& closed, const std::vector<Eigen::Vector2d>& drawn, Rough& r,
                 Do does) {
  const auto with = [&](const System& these) {
    Closure closure(scene, these, pressed_directions(scene, these), drawn);
    return does(closure, these);
  };
  if (system.loose.empty()) return with(system);
  const Rough before = r;
  try {
    return with(closed);
  } catch (const AssemblyError&) {
    r = before;
    return with(system);
  }
}

int close_joints(const Scene& scene, const System& system, const System& closed, const std::vector<Eigen::Vector2d>& drawn, Rough& r) {
  return as_if_ideal(scene, system, closed, drawn, r, [&](Closure& closure, const System& these) {
    return undeformed_first(these, r, &Rough::W_pose, [&](Rough& from) { return close_joints(scene, closure, these, from); });
  });
}

Assembly assembled(const Scene& scene, const System& system, const Bent& bent) {
  const System closed = without_play(system);
  Rough r = rough_state(scene, closed, bent);
  const VectorXd before = r.y.head(system.n());
  Assembly out;
  const std::vector<Eigen::Vector2d> drawn = drawn_journals(scene, system, r.y, out.doubts);
  out.iterations = close_joints(scene, system, closed, drawn, r);
  out.moved = (r.y.head(system.n()) - before).lpNorm<Eigen::Infinity>();
  doubt_moves(scene, system, before, r.y.head(system.n()), out.doubts);
  as_if_ideal(scene, system, closed, drawn, r, [&](Closure& closure, const System& these) {
    return undeformed_first(these, r, &Rough::W_speed, [&](Rough& from) { return match_speeds(scene, closure, these, from); });
  });
  r.y.conservativeResizeLike(VectorXd::Zero(system.n_y()));
  r.y.tail(system.n_y() - system.x_begin()).setZero();
  begin_switches(system, r.y);
  out.start.t = 0;
  out.start.y = r.y;
  relax_internal_states(system, 0, out.start.y);
  out.start.impact_rate.assign(system.contacts.size(), 0.0);
  RowReport rows = validate_rows(system, 0, r.y);
  out.rank = rows.rank;
  out.redundant = std::move(rows.redundant);
  out.shared = std::move(rows.shared);
  if (!out.redundant.empty())
    if (const std::string conflict = contradiction(system, 0, r.y, scene.run.until); !conflict.empty())
      throw AssemblyError(scene.file, named_place(scene, last_driver(system, out.redundant)),
                          conflict + "; remove one of them, or let it follow the other");
  return out;
}

/// Moves the start to the equilibrium, with the speeds that drivers impose there.
void start_at_rest(const Scene& scene, const Model& model, Assembly& out) {
  const Equilibrium rest = find_equilibrium(scene, model, out);
  if (!rest.found) throw AssemblyError(scene.file, {0, "start"}, "there is no equilibrium to start from: " + rest.reason);
  Closure closure(scene, model.system, pressed_directions(scene, model.system));
  Rough r = rough_state(scene, model.system, {});
  out.moved = std::max(out.moved, (rest.state.y - out.start.y).head(model.system.n()).lpNorm<Eigen::Infinity>());
  out.start = rest.state;
  r.y = out.start.y;
  undeformed_first(model.system, r, &Rough::W_speed, [&](Rough& from) { return match_speeds(scene, closure, model.system, from); });
  out.start.y = r.y;
}

}  // namespace

void refuse_rigid_contacts(const Scene& scene, const System& system, const std::string& what) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (is_rigid(system.contacts[c]))
      throw AssemblyError(scene.file, named_place(scene, system.contact_names[c]),
                          what + " needs compliant contacts; instead of model: impact, give it a normal law with a stiffness");
}

VectorXd closed_pose(const Scene& scene, const System& system, const std::vector<std::pair<int, VectorXd>>& bent) {
  const System closed = without_play(system);
  Rough r = rough_state(scene, closed, bent);
  std::vector<std::string> told_later;
  close_joints(scene, system, closed, drawn_journals(scene, system, r.y, told_later), r);
  return r.y;
}

Assembly assemble(const Scene& scene, const System& system) { return assembled(scene, system, {}); }

Assembly assemble(const Scene& scene, const Model& model) {
  Assembly out = assembled(scene, model.system, model.bent);
  require_apart(scene, model, out.start);
  if (scene.start_at_rest) start_at_rest(scene, model, out);
  return out;
}

}  // namespace pintle
