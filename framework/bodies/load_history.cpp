#include "framework/bodies/load_history.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <unsupported/Eigen/FFT>

#include "framework/component/fe/loads.h"
#include "framework/component/reduction/inertia.h"
#include "framework/component/reduction/modal_model.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double two_pi = 2 * std::numbers::pi;

constexpr Index law_samples = 4096;

}  // namespace

Eigen::MatrixXd loads_on(const ElasticBody& e) {
  const FeModel& model = e.model;
  const RigidFields f = rigid_fields(model);
  const RigidInertia inertia = rigid_inertia(model, e.M);
  const Vector2d c = inertia.c / inertia.m;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(model.n(), inertia_loads + 3 * static_cast<Index>(model.ports.size()));
  loads.col(0) = independent_load(model, e.M * f.T.col(0));
  loads.col(1) = independent_load(model, e.M * f.T.col(1));
  loads.col(2) = independent_load(model, e.M * f.R) + c.y() * loads.col(0) - c.x() * loads.col(1);
  loads.col(3) = independent_load(model, e.M * f.x) - c.x() * loads.col(0) - c.y() * loads.col(1);
  for (std::size_t p = 0; p < model.ports.size(); ++p)
    for (Index k = 0; k < 3; ++k)
      if (const int dof = model.ports[p].dof[k]; dof >= 0) loads(dof, inertia_loads + 3 * static_cast<Index>(p) + k) = 1;
  return loads;
}

VectorXd power_spectrum(const VectorXd& samples) {
  const Index n = samples.size();
  VectorXd windowed = samples.array() - samples.mean();
  for (Index i = 0; i < n; ++i)  // Hann window: leakage falls off fast
    windowed[i] *= 1 - std::cos(two_pi * static_cast<double>(i) / static_cast<double>(n));
  Eigen::VectorXcd transform(n);
  Eigen::FFT<double> fft;
  fft.fwd(transform, windowed);
  return transform.head(n / 2 + 1).cwiseAbs2();
}

std::vector<Imposed> imposed_frequencies(const Scene& scene) {
  std::vector<Imposed> all;
  const double until = scene.run.until;
  for (const SceneDriver& d : scene.drivers) {
    VectorXd acceleration(law_samples);
    double fastest = 0;
    for (Index i = 0; i < law_samples; ++i) {
      const Jet law = d.law.at(until * static_cast<double>(i) / static_cast<double>(law_samples));
      acceleration[i] = law.accel;
      fastest = std::max(fastest, std::abs(law.rate));
    }
    Imposed out{d.name, 0, false, false};
    // For a uniform law only the rounding of its rate is left.
    out.even = acceleration.lpNorm<Eigen::Infinity>() * until <= 1e-6 * fastest;
    if (!out.even) {
      Index most = 0;
      power_spectrum(acceleration).maxCoeff(&most);
      out.frequency = static_cast<double>(std::max<Index>(1, most)) / until;
    }
    if (d.kind == DriverKind::angle && fastest / two_pi > out.frequency) out.frequency = fastest / two_pi, out.turns = true;
    all.push_back(out);
  }
  return all;
}

}  // namespace pintle
