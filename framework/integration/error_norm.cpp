#include "framework/integration/error_norm.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"
#include "framework/common/worse.h"
#include "framework/dynamics/equations/energy.h"
#include "framework/dynamics/model/reach.h"

namespace pintle {

using Index = Eigen::Index;

namespace {

constexpr double slowest_speed = 1e-6;  // relative to the finest length per step: slower counts as rest
}  // namespace

ErrorNorm::ErrorNorm(const System& system, double tolerance) : system_(system), tolerance_(tolerance), reach_(reaches(system)) {
  for (const Body& b : system.bodies) {
    mass_ += b.m;
    if (b.modes() > 0) lowest_shape_ = lowest_shape_ > 0 ? std::min(lowest_shape_, b.flex->omega.minCoeff()) : b.flex->omega.minCoeff();
  }
  for (double& r : reach_)
    if (r == 0) r = system.length;
  fine_length_ = system.length;
  for (const ContactPair& c : system.contacts) fine_length_ = std::min(fine_length_, fine_length(c, system.length));
}

double ErrorNorm::fastest_speed(const Eigen::VectorXd& y) const {
  double fastest = 0;
  const double* v = y.data() + system_.n();
  for (std::size_t b = 0; b < reach_.size(); ++b, v += 3) {
    const double around = v[2] * reach_[b];
    fastest = std::max({fastest, v[0] * v[0] + v[1] * v[1], around * around});
  }
  return std::sqrt(fastest);
}

double ErrorNorm::speed(const Eigen::VectorXd& y, double h) const {
  return std::max({fastest_, fastest_speed(y), slowest_speed * fine_length_ / h});
}

void ErrorNorm::see(const Eigen::VectorXd& y) {
  fastest_ = std::max(fastest_, fastest_speed(y));
  energy_ = std::max(energy_, kinetic_energy(system_, y));
}

double ErrorNorm::of(const Step& step, bool follows_impacts) const {
  const Index n = system_.n();
  const auto& y = step.to.state.y;
  const double fastest = std::max(fastest_, fastest_speed(y));
  const double length = fine_length_, slowest = slowest_speed * length / step.h;
  constexpr double known = 1e-13;  // relative to the fastest speed; the constraints are satisfied to this, so a smaller error is noise
  const double across =
      std::max(std::sqrt(length * fastest * std::max(fastest / system_.length, lowest_shape_)), known / tolerance_ * fastest);
  const double speed = std::max(follows_impacts ? std::min(fastest, across) : fastest, slowest);
  const double energy = std::max({energy_, kinetic_energy(system_, y), mass_ * slowest * slowest / 2});
  double worst = 0;
  for (Index b = 0; b < static_cast<Index>(reach_.size()); ++b) {
    const double reach = reach_[at(static_cast<int>(b))];
    const auto compare = [&](Index i, double scale) {
      const double rounding = 1e-15 * std::abs(y[i]);
      worst = worse(worst, std::abs(step.error[i]) / (tolerance_ * scale + rounding));
    };
    compare(3 * b, length);
    compare(3 * b + 1, length);
    compare(3 * b + 2, length / reach);
    compare(n + 3 * b, speed);
    compare(n + 3 * b + 1, speed);
    compare(n + 3 * b + 2, speed / reach);
    const double per_metre = std::sqrt(system_.bodies[at(static_cast<int>(b))].m);  // shapes scale as 1/√m
    const Index begin = system_.eta_begin[at(static_cast<int>(b))], end = system_.eta_begin[at(static_cast<int>(b)) + 1];
    for (Index i = begin; i < end; ++i) {
      const double as_fine = system_.bodies[at(static_cast<int>(b))].flex->omega[i - begin] * length;
      compare(i, length * per_metre);
      compare(n + i, std::max(speed, std::min(as_fine, fastest)) * per_metre);
    }
  }
  for (Index i = 0; i < system_.n_x(); ++i) {
    const Index k = system_.x_begin() + i;
    const double scale = system_.x_scale[i] > 0 ? system_.x_scale[i] : length;
    worst = worse(worst, std::abs(step.error[k]) / (tolerance_ * scale + 1e-15 * std::abs(y[k])));
  }
  for (Index i = system_.z_begin(); i < y.size(); ++i)
    worst = worse(worst, std::abs(step.error[i]) / (tolerance_ * std::max(energy, std::abs(y[i])) + 1e-300));
  return worst;
}

}  // namespace pintle
