#include "framework/bodies/body_reduction.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>
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
  std::vector<int> interface;         ///< ports in use
  std::vector<int> shaped, massless;  ///< those with mass, and those whose boundary is massless
  bool is_massless(int port) const { return std::ranges::find(massless, port) != massless.end(); }
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
      if ((k < 2 && b.is_massless(port)) || !(full[i] > held * greatest[k == 2]) || kept[i] / full[i] >= out.share) continue;
      const char* names[3] = {", x", ", y", ", turning"};
      out = {kept[i] / full[i], e.model.ports[static_cast<std::size_t>(port)].name + names[k]};
    }
  if (out.at.empty()) out.share = 1;
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
    if (e.model.ports[static_cast<std::size_t>(a)].dof[2] >= 0) return ReferenceConditions{ReferenceConditions::tangent, a};
  return {};
}

/// The rigid motion, 3 × shapes, whose removal makes the shapes satisfy conditions at ports: (BR)⁻¹Bφ.
MatrixXd rigid_part(const ReducedBody& b, const ReferenceConditions& hold) {
  const MatrixXd B = reference_condition_rows(b.c, hold), R = rigid_motions(b.e.model);
  MatrixXd B_phi = MatrixXd::Zero(3, b.r.modes.omega.size());
  for (Index p = 0; p < static_cast<Index>(b.e.model.ports.size()); ++p)
    if (p == hold.a || p == hold.b)
      for (Index k = 0; k < 3; ++k)
        if (const int dof = b.e.model.ports[static_cast<std::size_t>(p)].dof[k]; dof >= 0)
          B_phi += B.col(dof) * b.r.modes.ports.row(3 * p + k);
  return (B * R).fullPivLu().solve(B_phi);
}

/// Displacement of a port by the shapes, brought to mean axes: φ − R(RᵀMR)⁻¹RᵀMφ; with R about the mass centre RᵀMφ is S and h.
Eigen::Matrix2Xd free_shapes(const ReducedBody& b, int port) {
  const RigidInertia inertia = rigid_inertia(b.e.model, b.e.M);
  const Vector2d centre = inertia.c / inertia.m, d = b.e.model.ports[static_cast<std::size_t>(port)].x - centre;
  const double J = inertia.J - inertia.c.squaredNorm() / inertia.m;
  Eigen::Matrix2Xd free = b.r.modes.ports.middleRows<2>(3 * Index{port}) - b.r.inertia.S / inertia.m;
  free.row(0) += d.y() / J * b.r.inertia.h;
  free.row(1) -= d.x() / J * b.r.inertia.h;
  return free;
}

/// The compliance that a basis leaves out has no negative part, except from rounding.
Eigen::Matrix2d without_rounding(const Eigen::Matrix2d& left_out) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> of((left_out + left_out.transpose()) / 2);
  return of.eigenvectors() * of.eigenvalues().cwiseMax(0).asDiagonal() * of.eigenvectors().transpose();
}

/// What the shapes do not represent of the compliance at a port of the body, held as its shapes are: free, by its other ports in use, or by
/// the frame.
Eigen::Matrix2d left_out(const ReducedBody& b, int port) {
  using Method = SceneModes::Method;
  const Method method = b.e.scene->elastic->modes->method;
  ReferenceConditions hold{ReferenceConditions::mean_axes};
  Eigen::Matrix2Xd shapes;
  if (method == Method::free || (method == Method::normal && b.r.conditions.kind == ReferenceConditions::mean_axes)) {
    shapes = free_shapes(b, port);
  } else {
    hold = method == Method::craig_bampton ? hold_by(b.e, b.shaped).value() : b.r.conditions;
    const int* dof = b.e.model.ports[static_cast<std::size_t>(port)].dof;
    const MatrixXd R = rigid_motions(b.e.model)(std::array<int, 2>{dof[0], dof[1]}, Eigen::all);
    shapes = b.r.modes.ports.middleRows<2>(3 * Index{port}) - R * rigid_part(b, hold);
  }
  const MatrixXd loads = b.loads.middleCols<2>(inertia_loads + 3 * Index{port});
  const Eigen::Matrix2Xd kept = shapes * b.r.modes.omega.cwiseInverse().asDiagonal();
  return without_rounding(loads.transpose() * b.response.under(hold, loads) - kept * kept.transpose());
}

std::vector<FreeCompliance> when_free(const ReducedBody& b) {
  std::vector<FreeCompliance> out(b.e.model.ports.size());
  for (const int p : b.interface) {
    const MatrixXd loads = b.loads.middleCols<2>(inertia_loads + 3 * Index{p});
    FreeCompliance& at = out[static_cast<std::size_t>(p)];
    at.full = loads.cwiseProduct(b.response.under({ReferenceConditions::mean_axes}, loads)).colwise().sum();
    at.kept = (free_shapes(b, p) * b.r.modes.omega.cwiseInverse().asDiagonal()).rowwise().squaredNorm();
    if (b.is_massless(p)) at.massless = left_out(b, p), at.kept = at.full;
  }
  return out;
}

/// Static shapes represent loads at the interface exactly; the deformation due to inertia beyond and between them is left to the modes.
CoveredInertia inertia_covered(const ReducedBody& b) {
  CoveredInertia out;
  const std::optional<ReferenceConditions> hold = hold_by(b.e, b.shaped);
  if (b.e.scene->elastic->modes->method != SceneModes::Method::craig_bampton || !hold) return out;
  constexpr Index translations = 2;
  const MatrixXd loads = b.loads.leftCols<translations>();
  const VectorXd full = loads.cwiseProduct(b.response.under(*hold, loads)).colwise().sum();
  // φ transformed to these conditions: its work is that of φ minus (Rᵀf)ᵀ(BR)⁻¹Bφ.
  const MatrixXd work = work_of_loads(b.e, b.r.modes).leftCols<translations>() -
                        rigid_part(b, *hold).transpose() * (rigid_motions(b.e.model).transpose() * loads);
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
      if (b.e.model.ports[static_cast<std::size_t>(port)].dof[k] >= 0) used.push_back(inertia_loads + 3 * Index{port} + k);
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
    const ReducedBody reduced{
        e, r, loads_on(e), c, StaticResponse(c), interface_of(scene, e), shaped_ports(scene, e), massless_ports(scene, e)};
    r.compliance = covered(reduced);
    r.when_free = when_free(reduced);
    r.inertia_covered = inertia_covered(reduced);
    r.by_load = by_load(reduced);
  });
  return r;
}

}  // namespace pintle
