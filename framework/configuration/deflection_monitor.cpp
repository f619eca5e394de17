#include "framework/configuration/deflection_monitor.h"

#include <algorithm>

#include "framework/bodies/elastic_parts.h"
#include "framework/common/text.h"

namespace pintle {

using Eigen::Index;

DeflectionMonitor::DeflectionMonitor(const Model& model) : model_(model), bent_(model.bending.size()), loaded_(model.stiffening.size()) {
  for (std::size_t k = 0; k < loaded_.size(); ++k) {
    const StiffeningProbe& p = model.stiffening[k];
    if (p.judged) continue;
    const auto loads = static_cast<Index>(p.F.size());
    loaded_[k].first.resize(loads);
    loaded_[k].factor.setZero(loads, 4);
    for (Index i = 0; i < loads; ++i) loaded_[k].first[i] = p.F[static_cast<std::size_t>(i)](0, 0);
  }
}

void DeflectionMonitor::see(const State& state, const Equations& eq) {
  t_ = state.t;
  for (std::size_t k = 0; k < bent_.size(); ++k) {
    const BendingProbe& p = model_.bending[k];
    const auto eta = state.y.segment(model_.system.eta_begin[static_cast<std::size_t>(p.index)], p.displacement.cols());
    const Eigen::VectorXd u = p.displacement * eta;
    for (Index i = 0; i + 1 < u.size(); i += 2) bent_[k].deflection = std::max(bent_[k].deflection, u.segment<2>(i).norm() / p.size);
    if (p.slope.rows() > 0) bent_[k].slope = std::max(bent_[k].slope, (p.slope * eta).lpNorm<Eigen::Infinity>());
  }
  for (std::size_t k = 0; k < loaded_.size(); ++k)
    if (!model_.stiffening[k].judged) see_loads(model_.stiffening[k], state, eq, loaded_[k]);
}

void DeflectionMonitor::see_loads(const StiffeningProbe& probe, const State& state, const Equations& eq, Loaded& out) {
  now_.resize(out.first.size());
  loads_now(model_.system, model_.attachments, state, eq, static_cast<std::size_t>(probe.index), now_);
  if (!now_.allFinite()) return;
  const double by_inertia = out.first.head<inertia_loads>().dot(now_.head<inertia_loads>()), by_all = out.first.dot(now_);
  const double on_first[4] = {-by_inertia, by_inertia, -by_all, by_all};
  for (Index i = 0; i < 4; ++i)
    if (!out.any || on_first[i] > out.on_first[static_cast<std::size_t>(i)]) {
      out.on_first[static_cast<std::size_t>(i)] = on_first[i];
      out.factor.col(i) = now_;
    }
  out.any = true;
}

std::string DeflectionMonitor::warning_of_loads(std::size_t k) const {
  const StiffeningProbe& p = model_.stiffening[k];
  if (p.judged || !loaded_[k].any) return "";
  return stiffening_warning(p.body, p.now, frequency_change(p.omega, p.F, loaded_[k].factor));
}

std::string DeflectionMonitor::beyond_limits() const {
  for (std::size_t k = 0; k < bent_.size(); ++k) {
    if (!(bent_[k].deflection > greatest_deflection)) continue;
    const std::string why = warning_of_loads(k);
    return "t = " + number_text(t_) + " s: " + deflection_warning(model_.bending[k].body, bent_[k].deflection, bent_[k].slope, "bent") +
           (why.empty() ? "" : "; " + why);
  }
  return "";
}

std::string DeflectionMonitor::worst_warning() const {
  std::vector<std::string> all;
  warn(all);
  return all.empty() ? "" : all.front();
}

void DeflectionMonitor::warn(std::vector<std::string>& warnings) const {
  for (std::size_t k = 0; k < bent_.size(); ++k) {
    const std::string warning = deflection_warning(model_.bending[k].body, bent_[k].deflection, bent_[k].slope, "bent");
    if (!warning.empty()) warnings.push_back(warning);
    if (const std::string loads = warning_of_loads(k); !loads.empty()) warnings.push_back(loads);
  }
}

}  // namespace pintle
