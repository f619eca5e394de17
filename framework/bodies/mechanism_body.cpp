#include "framework/bodies/mechanism_body.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <numbers>
#include <utility>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/in_body.h"
#include "framework/bodies/modal_basis.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

// The shapes must leave inertia to the frame: M − BBᵀ > 0, compared with the rigid body's.
void validate_frame(const MechanismBody& b) {
  Eigen::Matrix3Xd B(3, b.body.modes());
  B << b.body.flex->S, b.body.flex->h;
  const Eigen::Vector3d size(1 / std::sqrt(b.body.m), 1 / std::sqrt(b.body.m), 1 / std::sqrt(b.body.J));
  const Eigen::Matrix3d left = Eigen::Matrix3d::Identity() - size.asDiagonal() * (B * B.transpose()) * size.asDiagonal();
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(left).eigenvalues()[0];
  if (!(least > 1e-10))
    throw std::invalid_argument(
        "its shapes leave the frame no inertia: its reference conditions hold degrees of freedom without mass; use the consistent mass "
        "matrix, "
        "rotary inertia, another frame or fewer shapes");
}

void warn_of_damping(MechanismBody& b) {
  const auto& f = *b.body.flex;
  for (Eigen::Index i = 0; i < f.zeta.size(); ++i)
    if (f.zeta[i] > 1) {
      b.warnings.push_back("\"" + b.body.name + "\": damping makes the shapes from " + std::to_string(i + 1) + " on (" +
                           std::to_string(std::lround(f.omega[i] / (2 * std::numbers::pi))) +
                           " Hz) overdamped: the damping ratio there is " + number_text(f.zeta[i]));
      return;
    }
}

}  // namespace

void validate_inertia(const Scene& scene, const ElasticBody& e) {
  const RigidInertia inertia = rigid_inertia(e.model, e.M);
  if (!(inertia.J - inertia.c.squaredNorm() / inertia.m > 0))
    throw SceneError(scene.file, e.scene->place,
                     "it has no moment of inertia about its mass centre; give it more elements or rotary inertia");
}

MechanismBody mechanism_body(const Scene& scene, ElasticBody elastic, Reduction r) {
  MechanismBody b{
      std::move(elastic),     r.conditions,      std::move(r.modes),   {}, Vector2d::Zero(), std::move(r.second), std::move(r.compliance),
      std::move(r.when_free), r.inertia_covered, std::move(r.by_load), {}};
  const SceneBody& body = *b.elastic.scene;
  for (const std::string& w : b.elastic.warnings) b.warnings.push_back("\"" + body.name + "\": " + w);
  const RigidInertia inertia = rigid_inertia(b.elastic.model, b.elastic.M);
  b.centre = inertia.c / inertia.m;
  b.body = {body.name, inertia.m, inertia.J - inertia.c.squaredNorm() / inertia.m, -b.centre};
  validate_inertia(scene, b.elastic);
  if (b.modes.omega.size() == 0) return b;
  b.body.flex = std::move(r.inertia);
  b.body.flex->zeta = damping_of(scene, body, b.modes.omega, b.modes.omega);
  in_body(scene, body, [&] { validate_frame(b); });
  warn_of_damping(b);
  return b;
}

MechanismBody mechanism_body(const Scene& scene, ElasticBody elastic, std::optional<int> chosen) {
  validate_inertia(scene, elastic);
  Reduction r = reduction_of(scene, elastic, chosen);
  return mechanism_body(scene, std::move(elastic), std::move(r));
}

Marker marker_of(const Scene& scene, const MechanismBody& b, int body, const PointRef& ref, bool turns) {
  const ElasticBody& e = b.elastic;
  const int found = port_of(e, ref.point);
  if (found < 0 && !ref.point.empty()) point_of(scene, *e.scene, ref.point, ref.place);  // reports the existing points
  if (found < 0 && b.body.flex)
    throw SceneError(
        scene.file, ref.place,
        "\"" + ref.body + "\" without a point means the origin of its axes, where a flexible body has no point; name one of its points");
  if (found < 0) return {body, b.body.x_BO, 0};
  const auto i = static_cast<std::size_t>(found);
  const Port& port = e.model.ports[i];
  const ScenePoint& point = point_of(scene, *e.scene, port.name, ref.place);
  Marker m{body, port.x - b.centre, ref.point.empty() ? 0 : point.angle};
  if (!b.body.flex) return m;
  if (turns && port.dof[2] < 0)
    throw SceneError(scene.file, ref.place,
                     "\"" + ref.body + "." + port.name + "\" is a point of " + (e.plate() ? "a plate" : "a bar") +
                         ", which has no direction to hold or turn; " +
                         (e.plate() ? "use the centre of a hole, which turns with its rim" : "use a beam that bends"));
  const auto row = 3 * static_cast<Eigen::Index>(i);
  m.shape = b.modes.ports.middleRows<2>(row);
  m.slope = b.modes.ports.row(row + 2);
  if (e.scene->elastic->stiffening == Stiffening::axial) m.second = b.second[i];
  return m;
}

VectorXd bent_start(const Scene& scene, const MechanismBody& b, const StartBody& start) {
  const Eigen::Index n = b.body.modes();
  VectorXd eta = VectorXd::Zero(n);
  if (!start.modes.empty()) {
    if (static_cast<Eigen::Index>(start.modes.size()) > n)
      throw SceneError(scene.file, start.place,
                       "gives " + std::to_string(start.modes.size()) + " modal coordinates, but \"" + b.body.name + "\" keeps " +
                           std::to_string(n) + " shapes; remove the others, or keep more shapes");
    for (std::size_t i = 0; i < start.modes.size(); ++i) eta[static_cast<Eigen::Index>(i)] = start.modes[i];
    return eta;
  }
  // η = Ω⁻¹x with the least |x|, whose square is twice the strain energy.
  Eigen::MatrixXd D(2 * static_cast<Eigen::Index>(start.deflection.size()), n);
  VectorXd u(D.rows());
  Eigen::Index row = 0;
  for (const StartDeflection& d : start.deflection) {
    D.middleRows<2>(row) = b.modes.ports.middleRows<2>(3 * Eigen::Index{port_of(b.elastic, d.point)});
    u.segment<2>(row) = vector(d.u);
    row += 2;
  }
  const VectorXd softness = b.modes.omega.cwiseInverse();
  eta = softness.cwiseProduct((D * softness.asDiagonal()).completeOrthogonalDecomposition().solve(u));
  const VectorXd made = D * eta;
  constexpr double met = 1e-9;
  for (std::size_t i = 0; i < start.deflection.size(); ++i) {
    const Vector2d there = made.segment<2>(2 * static_cast<Eigen::Index>(i));
    if ((there - vector(start.deflection[i].u)).norm() <= met * u.norm()) continue;
    throw SceneError(scene.file, start.deflection[i].place,
                     "the shapes of \"" + b.body.name + "\" cannot displace it by " + shown(vector(start.deflection[i].u)) +
                         "; the nearest possible displacement is " + shown(there) + ": its frame, \"" +
                         title_of(*b.elastic.scene->elastic->modes) + "\", holds that point, or too few shapes are kept");
  }
  return eta;
}

}  // namespace pintle
