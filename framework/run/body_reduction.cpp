#include "framework/run/body_reduction.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "framework/component/foreshortening.h"
#include "framework/component/static_response.h"
#include "framework/run/excitation.h"
#include "framework/run/in_body.h"
#include "framework/run/modes.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Compliance beside the body's greatest of its kind below which a port counts as held by the tie.
constexpr double held = 1e-9;

// Inertia about the mass centre x_c instead of the origin: x − x_c, R about it.
FlexInertia about(const Vector2d& centre, FlexInertia f) {
  f.j -= centre.transpose() * f.S;
  f.h += centre.y() * f.S.row(0) - centre.x() * f.S.row(1);
  if (f.second) {
    Foreshortening& F = *f.second;
    F.j -= centre.x() * F.S[0] + centre.y() * F.S[1];
    F.h += centre.y() * F.S[0] - centre.x() * F.S[1];
  }
  return f;
}

FlexInertia invariants(const ElasticBody& e, const Reduction& r) {
  const RigidInertia inertia = rigid_inertia(e.model, e.M);
  FlexInertia flex = flex_inertia(e.model, e.M, skew_mass_of(e), r.modes);
  if (e.scene->elastic->stiffening != Stiffening::none) flex.second = inertia_foreshortening(component_of(e), e.M, r.tie, r.modes);
  return about(inertia.c / inertia.m, std::move(flex));
}

/// Reduced over full compliance uᵀf of unit loads at the ports in use, the least.
CoveredCompliance covered(const Scene& scene, const ElasticBody& e, const Reduction& r) {
  const MatrixXd loads = loads_on(e).rightCols(3 * static_cast<Index>(e.model.ports.size()));
  const VectorXd full = loads.cwiseProduct(static_response(component_of(e), r.tie, loads)).colwise().sum();
  const VectorXd kept = (r.modes.ports * r.modes.omega.cwiseInverse().asDiagonal()).rowwise().squaredNorm();
  double greatest[2] = {0, 0};  // of forces, of couples
  for (Index i = 0; i < full.size(); ++i) greatest[i % 3 == 2] = std::max(greatest[i % 3 == 2], full[i]);
  CoveredCompliance out{std::numeric_limits<double>::infinity(), ""};
  for (const int port : interface_of(scene, e))
    for (Index k = 0; k < 3; ++k) {
      const Index i = 3 * Index{port} + k;
      if (!(full[i] > held * greatest[k == 2]) || kept[i] / full[i] >= out.share) continue;
      const char* names[3] = {", x", ", y", ", turning"};
      out = {kept[i] / full[i], e.model.ports[static_cast<std::size_t>(port)].name + names[k]};
    }
  if (out.at.empty()) out.share = 1;
  return out;
}

}  // namespace

Reduction reduction_of(const Scene& scene, const ElasticBody& e, std::optional<int> chosen) {
  Reduction r;
  const SceneElastic& said = *e.scene->elastic;
  if (!said.modes) return r;
  r.tie = tie_of(scene, e);
  r.modes = reduce(scene, e, chosen);
  if (r.modes.omega.size() == 0) return r;
  in_body(scene, *e.scene, [&] {
    r.inertia = invariants(e, r);
    if (said.stiffening == Stiffening::axial) r.second = port_foreshortening(component_of(e), r.tie, r.modes);
    r.compliance = covered(scene, e, r);
  });
  return r;
}

}  // namespace pintle
