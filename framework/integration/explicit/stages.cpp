#include "framework/integration/explicit/stages.h"

#include "framework/dynamics/equations/sticking.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pintle {

using Index = Eigen::Index;

namespace {

// y += h Σ wⱼ kⱼ, four columns in each pass over y.
void add_combination(double h, const std::vector<double>& w, const std::vector<Eigen::VectorXd>& k, Eigen::VectorXd& y) {
  std::array<std::size_t, 4> at{};
  std::size_t count = 0;
  for (std::size_t j = 0; j < w.size(); ++j) {
    if (w[j] == 0) continue;
    at[count++] = j;
    if (count < 4) continue;
    y += (h * w[at[0]]) * k[at[0]] + (h * w[at[1]]) * k[at[1]] + (h * w[at[2]]) * k[at[2]] + (h * w[at[3]]) * k[at[3]];
    count = 0;
  }
  if (count == 1) y += (h * w[at[0]]) * k[at[0]];
  if (count > 1) y += (h * w[at[0]]) * k[at[0]] + (h * w[at[1]]) * k[at[1]];
  if (count > 2) y += (h * w[at[2]]) * k[at[2]];
}

}  // namespace

Stages::Stages(const System& system, const Tableau& tableau, Constraints constraints)
    : tableau_(tableau), constraints_(constraints), k_(static_cast<std::size_t>(tableau.stages()), Eigen::VectorXd::Zero(system.n_y())) {
  stage_.y.setZero(system.n_y());
  stage_.impact_rate.assign(system.contacts.size(), 0.0);
}

bool Stages::evaluate_stage(const System& system, State& state, Equations& eq, Eigen::VectorXd& dy) {
  if (constraints_ == Constraints::projection || system.n_rows() == 0) {
    if (eq.permanent == 0 && !project_stages_) {
      const bool found = evaluate(system, state, eq, dy);
      if (!eq.schur.weak()) {
        watch(eq);
        return found;
      }
      project_stages_ = true;
    }
    if (!pintle::project(system, state.t, state.y, eq)) {  // dependent rows agree only where C = 0 and Ċ = 0
      weak_ = weak_ || eq.permanent == 0;
      return false;
    }
  } else if (!partition_.correct(system, state.t, state.y, eq)) {
    return false;
  }
  accelerate(system, state, eq);
  fill_derivative(system, state.y, eq, dy);
  if (constraints_ == Constraints::projection) {
    weak_ = weak_ || eq.permanent == 0;
    watch(eq);
  }
  return eq.regular;
}

// Lost pivots beyond those of permanently redundant rows, and small pivots, indicate a singular configuration. In large systems with
// redundant rows the pivots say nothing: which of them are small depends on their order.
void Stages::watch(const Equations& eq) {
  weak_ = weak_ || eq.schur.near_singular(eq.permanent);
  if (eq.schur.lost() > eq.permanent)
    least_ = 0;
  else if (eq.permanent == 0 || !eq.schur.sparse())
    least_ = std::min(least_, eq.schur.kept());
  if (eq.permanent == 0) most_ = std::max(most_, eq.schur.least());
}

bool Stages::project(const System& system, Instant& node, Equations& eq) {
  if (constraints_ == Constraints::partitioning && system.n_rows() > 0) {
    if (partition_.dependent().empty() || !system.switches.empty()) {
      pose(system, node.state.t, node.state.y, eq);
      if (!partition_.suits(eq)) partition_.choose(system, eq);
    }
    if (!partition_.correct(system, node.state.t, node.state.y, eq)) return false;
  } else if (!pintle::project(system, node.state.t, node.state.y, eq)) {
    return false;
  }
  if (!remove_slip(system, node.state, eq)) return false;
  accelerate(system, node.state, eq);
  keep_friction(system, eq, node.state);
  fill_derivative(system, node.state.y, eq, node.dy);
  return eq.regular;
}

void Stages::refresh(const System& system, Equations& eq) {
  if (constraints_ != Constraints::partitioning || system.n_rows() == 0) return;
  const bool rank_changed =
      static_cast<int>(partition_.dependent().size()) != system.n_rows() - eq.schur.lost() - static_cast<int>(eq.released.size());
  if (partition_.worn() || rank_changed) partition_.choose(system, eq);
}

// Projected and unprojected stages must not be mixed: each kind satisfies the order conditions, a mixture does not. If any stage but the
// first turns out to need the projection, all are computed again.
bool Stages::evaluate_inner(const System& system, const Instant& from_node, double h, Equations& eq) {
  const State& from = from_node.state;
  const std::size_t inner = tableau_.closes ? k_.size() - 1 : k_.size();
  stage_.impact_rate = from.impact_rate;
  stage_.friction = from.friction;
  k_[0] = from_node.dy;
  project_stages_ = false;
  for (std::size_t i = 1; i < inner; ++i) {
    const bool projected = project_stages_;
    stage_.t = from.t + tableau_.c[i] * h;
    stage_.y = from.y;
    add_combination(h, tableau_.a[i], k_, stage_.y);
    if (!evaluate_stage(system, stage_, eq, k_[i])) return false;
    if (i > 1 && project_stages_ && !projected) i = 0;
  }
  return true;
}

bool Stages::reach(const System& system, const Instant& from_node, double h, Instant& to_node, Equations& eq) {
  weak_ = false;
  least_ = 1, most_ = 0;
  const State& from = from_node.state;
  if (!evaluate_inner(system, from_node, h, eq)) return false;

  State& to = to_node.state;
  to.t = from.t + h;
  to.impact_rate = from.impact_rate;
  to.friction = from.friction;
  to.y = from.y;
  add_combination(h, tableau_.b, k_, to.y);  // a closing stage has weight 0
  if (!to.y.allFinite() || !project(system, to_node, eq)) return false;
  watch(eq);
  if (tableau_.closes) k_.back() = to_node.dy;
  return to_node.dy.allFinite();
}

bool Stages::attempt(const System& system, double h, Step& step, Equations& eq) {
  step.h = h;
  if (!reach(system, step.from, h, step.to, eq)) return false;
  step.error.setZero(system.n_y());
  add_combination(h, tableau_.e, k_, step.error);
  return step.error.allFinite();
}

// The error of the cubic would be h⁴ inside a step, but it is h⁶ at its end.
void Stages::refine_cubics(const System& system, const Step& step, State& out) const {
  const std::vector<double>& d = tableau_.d;
  const double x = (out.t - step.from.state.t) / step.h, bend = step.h * x * x * (1 - x) * (1 - x);
  const Index cubic = system.n_y() - 2 * system.n();
  for (std::size_t i = 0; i < d.size(); ++i)
    if (d[i] != 0) out.y.tail(cubic) += (bend * d[i]) * (i + 1 < d.size() ? k_[i] : step.dy_end()).tail(cubic);
}

// The difference of all rates over that of all values is the rate of a decay. Of an oscillation it shows anything between 1 and the square
// of the rate, by its phase; that square is the difference of the accelerations over that of the positions.
Stages::Stiffness Stages::stiffness(const System& system, const Step& step) const {
  const std::size_t last = k_.size() - (tableau_.closes ? 2 : 1);
  std::size_t inner = last;  // the last stage at the time of the step's end
  while (inner > 0 && tableau_.c[inner] != 1) --inner;
  if (inner == 0) return {};
  const auto stage = [&](Index i) {
    if (inner == last) return stage_.y[i];
    double change = 0;
    for (std::size_t j = 0; j < tableau_.a[inner].size(); ++j) change += tableau_.a[inner][j] * k_[j][i];
    return step.from.state.y[i] + step.h * change;
  };
  const auto moved = [&](Index i, double scale) { return std::pow((step.to.state.y[i] - stage(i)) / scale, 2); };
  const auto changed = [&](Index i, double scale) { return std::pow((step.to.dy[i] - k_[inner][i]) / scale, 2); };
  double places = 0, speeds = 0, accelerations = 0, states = 0, rates = 0;
  for (Index i = 0, n = system.n(); i < n; ++i) {
    const double scale = system.scale[i];
    places += moved(i, scale), speeds += moved(n + i, scale), rates += changed(i, scale), accelerations += changed(n + i, scale);
  }
  for (Index i = 0; i < system.n_x(); ++i) {
    const double scale = system.x_scale[i] > 0 ? system.x_scale[i] : system.length;
    states += moved(system.x_begin() + i, scale), rates += changed(system.x_begin() + i, scale);
  }
  const double all = places + speeds + states;
  return {.decay = all > 0 ? step.h * std::sqrt((rates + accelerations) / all) : 0,
          .oscillation = places > 0 ? step.h * std::pow(accelerations / places, 0.25) : 0};
}

}  // namespace pintle
