#include "framework/analysis/kinematics/kinematics.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "framework/analysis/simulate/end_short.h"
#include "framework/analysis/simulate/simulation.h"
#include "framework/common/dense.h"
#include "framework/common/processor_time.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/common/worse.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

using Eigen::VectorXd;
using Index = Eigen::Index;

std::vector<std::string> driver_names(const System& system) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    if (is_driver(system.joints[k])) out.push_back(system.joint_names[k]);
  return out;
}

}  // namespace

DrivenMotion::DrivenMotion(const System& system, State start)
    : system_(system), eq_(system), state_(std::move(start)), a_(VectorXd::Zero(system.n())), gamma_(VectorXd::Zero(system.n_rows())) {
  state_.impact_rate.resize(system.contacts.size(), 0.0);
  if (!project(state_, a_)) failure_ = "t = " + number_text(state_.t, 6) + " s: " + why();
}

bool DrivenMotion::project(State& state, VectorXd& a) {
  constexpr double enough = 1e-14, good = 1e-11;
  constexpr int most = 10;
  const Index n = system_.n();
  double worst = 0;
  for (int i = 0; i < most; ++i) {
    pose(system_, state.t, state.y, eq_);
    rows_.factor(system_, eq_);
    const double before = worst;
    worst = position_violation(system_, eq_);
    if (worst <= enough || (i > 0 && worst <= good && worst > 0.1 * before)) break;
    state.y.head(n) -= rows_.solve(system_, eq_.C);
  }
  if (!(worst <= good)) return false;
  speed(system_, state.t, state.y, eq_);
  state.y.segment(n, n) -= rows_.solve(system_, eq_.Cdot);
  speed(system_, state.t, state.y, eq_);
  acceleration_side(eq_, gamma_);
  a += rows_.solve(system_, gamma_ - rows_.times(system_, a));
  worst_position_ = worse(worst_position_, worst);
  const double fastest = std::max(size(state.y.segment(n, n)), 1e-9);
  const double drift = largest(eq_.Cdot.cwiseProduct(system_.row_scale));
  worst_velocity_ = worse(worst_velocity_, drift / fastest);
  return state.y.allFinite() && a.allFinite() && drift <= 1e-7 * std::max(fastest, size(a) * 1e-3);
}

// One step of h, if the corrections are within the bounds of the prediction.
bool DrivenMotion::attempt(double h, State& trial, VectorXd& a) {
  constexpr double farthest = 0.5, part = 0.1, speed_part = 0.3, small = 1e-6, small_turn = 1e-4, careful = 1e-3;
  const Index n = system_.n();
  const VectorXd s = state_.y.segment(n, n), step = h * s + h * h / 2 * a_, s_predicted = s + h * a_;
  trial = state_;
  trial.t = state_.t + h;
  trial.y.head(n) += step;
  trial.y.segment(n, n) = s_predicted;
  const VectorXd q_predicted = trial.y.head(n);
  a = a_;
  const double position = worst_position_, velocity = worst_velocity_;
  const double move = size(step);
  if (move > farthest) return false;
  if (project(trial, a) && size(trial.y.head(n) - q_predicted) <= part * move + small && (!rows_.deficient() || move <= careful)) {
    const double change = size(trial.y.segment(n, n) - s_predicted), fastest = std::max(size(s), size(trial.y.segment(n, n)));
    if (change <= speed_part * fastest || change * h <= small_turn) return true;
  }
  worst_position_ = position;
  worst_velocity_ = velocity;
  return false;
}

bool DrivenMotion::advance(double t) {
  if (!failure_.empty()) return false;
  State trial;
  VectorXd a;
  if (h_ == 0) h_ = t - state_.t;
  while (state_.t < t) {
    const double left = t - state_.t, h = h_ >= left * (1 - 1e-12) ? left : h_;
    if (attempt(h, trial, a)) {
      if (h == left) trial.t = t;
      std::swap(state_, trial);
      a_ = a;
      ++steps_;
      if (h >= h_ * (1 - 1e-12)) h_ *= 2;
      continue;
    }
    ++rejected_;
    h_ = h / 3;
    if (h_ < 1e-11 * std::max(std::abs(t), left)) {
      failure_ = "t = " + number_text(state_.t, 6) + " s: " + why();
      project(state_, a_);
      return false;
    }
  }
  return true;
}

// The drivers involved in the rows that have become dependent, or nearly so, where the motion ends.
std::string DrivenMotion::why() {
  std::vector<std::string> asking = driver_names(system_), moving;
  pose(system_, state_.t, state_.y, eq_);
  if (system_.n_rows() <= 400 && system_.n_rows() > 0) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(system_.n_rows(), system_.n());
    visit_jacobian(eq_,
                   [&](int row, int column, double value) { A(row, column) += system_.row_scale[row] * value * system_.scale[column]; });
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Index last = std::min(A.rows(), A.cols()) - 1;
    const VectorXd u = svd.matrixU().rightCols(A.rows() - last).rowwise().norm(), v = svd.matrixV().col(last);
    std::vector<std::string> part;
    for (std::size_t k = 0; k < system_.joints.size(); ++k)
      if (is_driver(system_.joints[k]) && u[system_.row_begin[k]] > 1e-3) part.push_back(system_.joint_names[k]);
    if (!part.empty()) asking = part;
    for (std::size_t b = 0; b < system_.bodies.size(); ++b)
      if (v.segment<3>(static_cast<Index>(3 * b)).norm() > 0.1) moving.push_back(system_.bodies[b].name);
    std::string at_pose;
    for (std::size_t b = 0; b < system_.bodies.size() && b < 4; ++b)
      at_pose += (b ? ", " : "") + system_.bodies[b].name + " " + number_text(state_.y[static_cast<Index>(3 * b) + 2], 6) + " rad";
    if (svd.singularValues()[last] > 1e-3 * svd.singularValues()[0])
      return "no configuration near the angles " + at_pose + " satisfies the law of " + some_of(asking) +
             ": drivers contradict each other, a law jumps, or a length is out of reach; correct the law";
    return "dead centre or end of reach at the angles " + at_pose + ": the law of " + some_of(asking) +
           " cannot be followed further; it no longer determines where " + some_of(moving) + " goes; change the law, or drive another body";
  }
  return "a singular configuration, or one that " + some_of(asking) + " cannot reach";
}

void require_driven(const Scene& scene, const Model& model, const Assembly& assembly) {
  const System& system = model.system;
  const int open = system.n() - assembly.rank;
  std::vector<std::string> loose;
  const auto clearances = static_cast<std::size_t>(n_clearances(system));
  for (std::size_t c = 0; c < clearances; ++c) loose.push_back(system.contact_names[c]);
  if (open > 0) loose.insert(loose.end(), system.loose_names.begin(), system.loose_names.end());
  Place place = scene.drivers.empty() ? Place{} : scene.drivers.front().place;
  place.key = "drivers";
  if (!loose.empty())
    throw AssemblyError(scene.file, place,
                        "the clearance at " + some_of(loose) +
                            " leaves degrees of freedom that no driver moves; leave `clearance` out here, or use `pintle run`");
  if (open <= 0) return;
  // A displacement that satisfies all rows, projected from one that moves everything.
  Equations eq(system);
  pose(system, 0, assembly.start.y, eq);
  RowSolver rows;
  rows.factor(system, eq);
  VectorXd any(system.n());
  for (Index i = 0; i < any.size(); ++i) any[i] = system.scale[i] * (1 + std::cos(static_cast<double>(i * i + 1)));
  if (system.n_rows() > 0) any -= rows.solve(system, rows.times(system, any));
  any = any.cwiseQuotient(system.scale);
  std::vector<std::string> moving;
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    if (any.segment<3>(static_cast<Index>(3 * b)).norm() > 1e-6) moving.push_back(system.bodies[b].name);
  const bool singular = system.n_rows() >= system.n();
  throw AssemblyError(scene.file, place,
                      std::to_string(open) + (open == 1 ? " degree of freedom is" : " degrees of freedom are") + " not driven" +
                          (singular ? " at the starting pose, which may be a singular one (dead centre, flat linkage)" : "") + ": " +
                          some_of(moving) + (moving.size() == 1 ? " moves" : " move") + " freely; add a driver for each, " +
                          (singular ? "or start from another pose, " : "") + "or use `pintle run`");
}

void follow(const Scene& scene, const Model& written, DrivenMotion& motion, const std::function<bool(double)>& advance,
            const Listeners& listeners, Run& run) {
  const double begin = processor_time();
  double drawing = 0;
  run.trajectory = trajectory_table(written);
  require_few_rows(scene, listeners);
  const double until = scene.run.until;
  Clock outputs(scene.output.every > 0 ? scene.output.every : until / 1000, until, scene.output.instants);
  Clock frames(scene.output.frames > 1 ? until / (scene.output.frames - 1) : 0, until);  // visited even if not drawn
  bool going = motion.failure().empty();
  double reached = motion.state().t;
  const auto steps = [&] {
    for (long k = 0; going && (outputs.due(until) || frames.due(until)); ++k) {
      const double t = !outputs.due(until) ? frames.next() : !frames.due(until) ? outputs.next() : std::min(outputs.next(), frames.next());
      if (listeners.progress && k % 64 == 0 && !listeners.progress(t)) {
        run.status = Status::interrupted;
        run.reason = "stopped by the user";
        break;
      }
      going = advance(t);
      if (!going) break;
      reached = t;
      if (outputs.due(t)) {
        record(written, motion.state(), motion.equations(), run.trajectory), outputs.tick();
        warn_of_signals(scene, written, motion.state(), run.trajectory, run.warnings);
        if (listeners.rows) {
          listeners.rows(run.trajectory, run.ledger, run.impacts, run.happenings);
          run.trajectory.data.clear();
        }
      }
      if (frames.due(t)) {
        const double before = processor_time();
        if (listeners.frame) listeners.frame(motion.state(), motion.equations());
        frames.tick();
        drawing += processor_time() - before;
      }
    }
  };
  guarded(run, reached, steps);
  if (!going && !ended_short(run)) {
    run.status = Status::failed;
    run.reason = motion.failure();
  }
  run.t_end = ended_short(run) ? reached : motion.state().t;
  run.counts.steps = motion.steps();
  run.counts.rejected = motion.rejected();
  run.worst_position = motion.worst_position();
  run.worst_velocity = motion.worst_velocity();
  run.seconds = processor_time() - begin - drawing;
}

namespace {

// Keeps the outputs whose columns are all recorded, and reads them from there.
void keep_outputs_of(const Model& model, Model& written) {
  const std::vector<WrittenOutput> all = std::exchange(written.outputs, {});
  const std::vector<std::string> were = trajectory_table(model).header, are = trajectory_table(written).header;
  std::vector<int> now(all.size(), -1);
  for (std::size_t k = 0; k < all.size(); ++k) {
    WrittenOutput output = all[k];
    bool told_of = true;
    for (WrittenOutput::Input& input : output.in) {
      if (input.from == WrittenOutput::Input::output) input.index = now[static_cast<std::size_t>(input.index)];
      if (input.from == WrittenOutput::Input::column) {
        const auto found = std::ranges::find(are, were[static_cast<std::size_t>(input.index)]);
        input.index = found == are.end() ? -1 : static_cast<int>(found - are.begin());
      }
      const bool of_state = input.from == WrittenOutput::Input::signal &&
                            model.system.signals[static_cast<std::size_t>(input.index)].kind == MotionSignal::state;
      told_of = told_of && input.index >= 0 && !of_state;
    }
    if (!told_of) continue;
    now[k] = static_cast<int>(written.outputs.size());
    written.outputs.push_back(std::move(output));
  }
}

}  // namespace

Run kinematics(const Scene& scene, const Model& model, const Assembly& assembly, const Listeners& listeners) {
  require_driven(scene, model, assembly);
  Model written = model;  // what is written: no forces, and no states, whose rates would have to be integrated
  written.system.joints.clear(), written.system.forces.clear(), written.system.contacts.clear(), written.system.frictions.clear();
  written.system.internal.clear(), written.system.states.clear(), written.stresses.clear(), written.order = {};
  keep_outputs_of(model, written);
  Run run;
  run.warnings = model.warnings;
  if (!model.system.contacts.empty())
    run.warnings.push_back("contacts of profiles are ignored, because kinematics computes no forces; to include them, use `pintle run`");
  if (!model.system.states.empty())
    run.warnings.push_back(
        "the scene's states, and outputs that name them, are left out, because kinematics follows the drivers alone; to include them, use "
        "`pintle run`");
  DrivenMotion motion(model.system, assembly.start);
  const auto advance = [&](double t) {
    if (!motion.advance(t)) return false;
    motion.equations().a = motion.acceleration();
    return true;
  };
  follow(scene, written, motion, advance, listeners, run);
  return run;
}

}  // namespace pintle
