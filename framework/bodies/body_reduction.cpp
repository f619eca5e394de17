#include "framework/bodies/body_reduction.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/LU>

#include "framework/bodies/in_body.h"
#include "framework/bodies/load_history.h"
#include "framework/bodies/modal_basis.h"
#include "framework/bodies/modal_choice.h"
#include "framework/component/reduction/foreshortening.h"
#include "framework/component/reduction/static_response.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Compliance relative to the body's largest of its kind below which a port counts as fixed by the reference conditions.
constexpr double held = 1e-9;

// Inertia about the mass centre x_c instead of the origin: uses x − x_c, and R about it.
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
  if (e.scene->elastic->stiffening != Stiffening::none) flex.second = inertia_foreshortening(component_of(e), e.M, r.conditions, r.modes);
  return about(inertia.c / inertia.m, std::move(flex));
}

/// Data shared by several checks of one body.
struct ReducedBody {
  const ElasticBody& e;
  const Reduction& r;
  MatrixXd loads;  ///< loads_on
  const Component& c;
  StaticResponse response;
  std::vector<int> interface;  ///< ports in use
};

/// Smallest ratio of reduced to full compliance uᵀf for unit loads at the ports in use.
CoveredCompliance covered(const ReducedBody& b) {
  const ElasticBody& e = b.e;
  const MatrixXd loads = b.loads.rightCols(3 * static_cast<Index>(e.model.ports.size()));
  const VectorXd full = loads.cwiseProduct(b.response.under(b.r.conditions, loads)).colwise().sum();
  const VectorXd kept = (b.r.modes.ports * b.r.modes.omega.cwiseInverse().asDiagonal()).rowwise().squaredNorm();
  double greatest[2] = {0, 0};  // of forces, of couples
  for (Index i = 0; i < full.size(); ++i) greatest[i % 3 == 2] = std::max(greatest[i % 3 == 2], full[i]);
  CoveredCompliance out{std::numeric_limits<double>::infinity(), ""};
  for (const int port : b.interface)
    for (Index k = 0; k < 3; ++k) {
      const Index i = 3 * Index{port} + k;
      if (!(full[i] > held * greatest[k == 2]) || kept[i] / full[i] >= out.share) continue;
      const char* names[3] = {", x", ", y", ", turning"};
      out = {kept[i] / full[i], e.model.ports[static_cast<std::size_t>(port)].name + names[k]};
    }
  if (out.at.empty()) out.share = 1;
  return out;
}

/// Shapes transformed to mean axes are φ − R(RᵀMR)⁻¹RᵀMφ; with R about the mass centre RᵀMφ is S and h.
std::vector<FreeCompliance> when_free(const ReducedBody& b) {
  const std::vector<Port>& ports = b.e.model.ports;
  std::vector<FreeCompliance> out(ports.size());
  const RigidInertia inertia = rigid_inertia(b.e.model, b.e.M);
  const Vector2d centre = inertia.c / inertia.m;
  const double J = inertia.J - inertia.c.squaredNorm() / inertia.m;
  for (const int p : b.interface) {
    const Vector2d d = ports[static_cast<std::size_t>(p)].x - centre;
    Eigen::Matrix2Xd free = b.r.modes.ports.middleRows<2>(3 * Index{p}) - b.r.inertia.S / inertia.m;
    free.row(0) += d.y() / J * b.r.inertia.h;
    free.row(1) -= d.x() / J * b.r.inertia.h;
    const MatrixXd loads = b.loads.middleCols<2>(inertia_loads + 3 * Index{p});
    FreeCompliance& at = out[static_cast<std::size_t>(p)];
    at.full = loads.cwiseProduct(b.response.under({ReferenceConditions::mean_axes}, loads)).colwise().sum();
    at.kept = (free * b.r.modes.omega.cwiseInverse().asDiagonal()).rowwise().squaredNorm();
  }
  return out;
}

/// Reference conditions that fix the body only by its interface: the chord of the two ports farthest apart, or a port with a rotation.
std::optional<ReferenceConditions> hold_by(const ElasticBody& e, const std::vector<int>& interface) {
  ReferenceConditions chord{ReferenceConditions::chord};
  double farthest = 1e-6 * (e.mesh.x.rowwise().maxCoeff() - e.mesh.x.rowwise().minCoeff()).norm();
  const auto place = [&](int p) { return e.model.ports[static_cast<std::size_t>(p)].x; };
  for (const int a : interface)
    for (const int b : interface)
      if (const double apart = (place(b) - place(a)).norm(); a < b && apart > farthest) farthest = apart, chord.a = a, chord.b = b;
  if (chord.a >= 0) return chord;
  for (const int a : interface)
    if (e.model.ports[static_cast<std::size_t>(a)].freedom[2] >= 0) return ReferenceConditions{ReferenceConditions::tangent, a};
  return {};
}

/// Static shapes represent loads at the interface exactly; the deformation due to inertia beyond and between them is left to the modes.
CoveredInertia inertia_covered(const ReducedBody& b) {
  CoveredInertia out;
  const std::optional<ReferenceConditions> hold = hold_by(b.e, b.interface);
  if (b.e.scene->elastic->modes->method != SceneModes::Method::craig_bampton || !hold) return out;
  constexpr Index translations = 2;
  const MatrixXd loads = b.loads.leftCols<translations>();
  const VectorXd full = loads.cwiseProduct(b.response.under(*hold, loads)).colwise().sum();
  // φ transformed to these conditions is φ − R(BR)⁻¹Bφ: its work is that of φ minus (Rᵀf)ᵀ(BR)⁻¹Bφ.
  const MatrixXd B = reference_condition_rows(b.c, *hold), R = rigid_motions(b.e.model);
  MatrixXd B_phi = MatrixXd::Zero(3, b.r.modes.omega.size());
  for (Index p = 0; p < static_cast<Index>(b.e.model.ports.size()); ++p)
    if (p == hold->a || p == hold->b)
      for (Index k = 0; k < 3; ++k)
        if (const int freedom = b.e.model.ports[static_cast<std::size_t>(p)].freedom[k]; freedom >= 0)
          B_phi += B.col(freedom) * b.r.modes.ports.row(3 * p + k);
  const MatrixXd rigid = (B * R).fullPivLu().solve(B_phi);
  const MatrixXd work = work_of_loads(b.e, b.r.modes).leftCols<translations>() - rigid.transpose() * (R.transpose() * loads);
  const VectorXd kept = (b.r.modes.omega.cwiseInverse().asDiagonal() * work).colwise().squaredNorm();
  const char* names[translations] = {"acceleration along x", "acceleration along y"};
  for (Index k = 0; k < translations; ++k)
    if (full[k] > held * full.maxCoeff() && kept[k] / full[k] < out.share) out = {kept[k] / full[k], names[k]};
  return out;
}

std::vector<MatrixXd> by_load(const ReducedBody& b) {
  const Index count = std::min(stiffened_shapes, b.r.modes.omega.size());
  std::vector<Index> used{0, 1, 2, 3};
  for (const int port : b.interface)
    for (Index k = 0; k < 3; ++k)
      if (b.e.model.ports[static_cast<std::size_t>(port)].freedom[k] >= 0) used.push_back(inertia_loads + 3 * Index{port} + k);
  std::vector<MatrixXd> F =
      foreshortening_of_response(b.c, lowest_of(b.r.modes, count), b.response.under(b.r.conditions, b.loads(Eigen::all, used)));
  std::vector<MatrixXd> out(static_cast<std::size_t>(b.loads.cols()), MatrixXd::Zero(count, count));
  for (std::size_t i = 0; i < used.size(); ++i) out[static_cast<std::size_t>(used[i])] = std::move(F[i]);
  return out;
}

}  // namespace

Reduction reduction_of(const Scene& scene, const ElasticBody& e, std::optional<int> chosen) {
  Reduction r;
  const SceneElastic& said = *e.scene->elastic;
  if (!said.modes) return r;
  r.conditions = reference_conditions_of(scene, e);
  r.modes = reduce(scene, e, chosen);
  if (r.modes.omega.size() == 0) return r;
  in_body(scene, *e.scene, [&] {
    r.inertia = invariants(e, r);
    if (said.stiffening != Stiffening::none) r.second = port_foreshortening(component_of(e), r.conditions, r.modes);
    const Component c = component_of(e);
    const ReducedBody reduced{e, r, loads_on(e), c, StaticResponse(c), interface_of(scene, e)};
    r.compliance = covered(reduced);
    r.when_free = when_free(reduced);
    r.inertia_covered = inertia_covered(reduced);
    r.by_load = by_load(reduced);
  });
  return r;
}

}  // namespace pintle
