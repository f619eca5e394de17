#include "framework/drawing/flexible_drawing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "elements/plane.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/modal_basis.h"
#include "framework/drawing/body_drawing.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Matrix2Xd;
using Eigen::MatrixXd;
using Eigen::Vector2d;

/// Converts the values of each point, stacked point by point, into one column per point.
template <int rows>
Eigen::Matrix<double, rows, Eigen::Dynamic> by_point(const MatrixXd& shapes, const Eigen::VectorXd& eta) {
  Eigen::Matrix<double, rows, Eigen::Dynamic> out(rows, shapes.rows() / rows);
  out.reshaped().noalias() = shapes * eta;
  return out;
}

Matrix2Xd perp(const Matrix2Xd& d) {
  Matrix2Xd out(2, d.cols());
  out.row(0) = -d.row(1);
  out.row(1) = d.row(0);
  return out;
}

void add_stress(const Eigen::Matrix4Xd& stress, std::vector<Field>& fields) {
  Eigen::RowVectorXd mises(stress.cols());
  Matrix2Xd main(2, stress.cols());
  for (Index i = 0; i < stress.cols(); ++i) {
    mises[i] = von_mises(stress.col(i));
    main.col(i) = principal(stress.col(i)).head<2>();
  }
  fields.push_back({"von Mises [Pa]", mises});
  fields.push_back({"principal 1 [Pa]", main.row(0)});
  fields.push_back({"principal 2 [Pa]", main.row(1)});
}

}  // namespace

FlexibleDrawing::FlexibleDrawing(const ElasticBody& body, const ModalModel& modes, const Vector2d& centre) : name_(body.scene->name) {
  BodyDrawing drawing(body);
  const Index points = drawing.points.cols(), n = modes.shapes.cols();
  u_.resize(2 * points, n);
  stress_.resize(4 * points, n);
  forces_.resize(body.plate() ? 0 : 3 * points, n);
  for (Index i = 0; i < n; ++i) {
    const StressField field = stress_field(body.model, modes.shapes.col(i), body.fibres);
    u_.col(i) = drawing.displacement(modes.shapes.col(i)).reshaped();
    stress_.col(i) = drawing.stress(field).reshaped();
    forces_.col(i) = drawing.section_forces(field).reshaped();
  }
  x_ = drawing.points.colwise() - centre;
  cells_ = std::move(drawing.cells);
  size_ = drawing.size;
}

DrawnBody FlexibleDrawing::at(const FlexiblePose& pose, double exaggeration) const {
  const Eigen::Matrix2d A = Eigen::Rotation2Dd(pose.angle).toRotationMatrix();
  const Matrix2Xd x = A * x_, u = A * by_point<2>(u_, pose.eta);
  DrawnBody out{name_, (x + exaggeration * u).colwise() + pose.r, cells_, {}};
  out.fields.push_back({"displacement [m]", u});
  const Matrix2Xd turning = pose.w * perp(x + u) + A * by_point<2>(u_, pose.speed);
  out.fields.push_back({"velocity [m/s]", turning.colwise() + pose.v});
  add_stress(by_point<4>(stress_, pose.eta), out.fields);
  if (forces_.rows() > 0) {
    const Eigen::Matrix3Xd forces = by_point<3>(forces_, pose.eta);
    out.fields.push_back({"section force [N]", forces.topRows<2>()});
    out.fields.push_back({"section moment [N m]", forces.row(2)});
  }
  return out;
}

double FlexibleDrawing::largest_displacement(const Eigen::VectorXd& eta) const { return by_point<2>(u_, eta).colwise().norm().maxCoeff(); }

namespace {

/// The node of a port that does not belong to a rim.
int node_of(const FeModel& model, const Port& port) {
  int node = 0;
  while (model.independent_of(model.begin[static_cast<std::size_t>(node)]) != port.dof[0]) ++node;
  return node;
}

/// Whether a joint, a load, a contact or a lump acts on a node.
bool acts_at(const Scene& scene, const ElasticBody& body, int node) {
  const auto is_there = [&](int port) {
    return port >= 0 && node_of(body.model, body.model.ports[static_cast<std::size_t>(port)]) == node;
  };
  return std::ranges::any_of(loaded_ports(scene, body), is_there) ||
         std::ranges::any_of(body.scene->elastic->lumps, [&](const SceneLump& lump) { return is_there(port_of(body, lump.at)); });
}

/// Whether two elements are one straight beam of one section, or of a taper that is made of steps.
bool runs_on(const ElasticBody& body, Index one, Index other) {
  const auto axis = [&](Index element) -> Eigen::Vector2d {
    const int* node = body.mesh.cells.front().nodes.data() + 2 * element;
    return (body.mesh.x.col(node[1]) - body.mesh.x.col(node[0])).normalized();
  };
  constexpr double step = 0.4;
  const Fibre &a = body.fibres[static_cast<std::size_t>(one)], &b = body.fibres[static_cast<std::size_t>(other)];
  const auto alike = [](double x, double y) { return std::abs(x - y) <= step * std::max(x, y); };
  return alike(a.A, b.A) && alike(a.I, b.I) && alike(a.distance, b.distance) && (axis(one) - axis(other)).norm() < 1e-6;
}

StressProbe beam_probe(const Scene& scene, const ElasticBody& body, const ModalModel& modes, int node) {
  StressProbe probe{true, {}};
  std::vector<Index> ends;  // columns of StressField::section_forces
  const std::vector<int>& nodes = body.mesh.cells.front().nodes;
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (nodes[k] == node) ends.push_back(static_cast<Index>(k));
  for (const Index end : ends) {
    const Fibre& fibre = body.fibres[static_cast<std::size_t>(end / 2)];
    probe.sides.push_back({MatrixXd(3, modes.shapes.cols()), fibre.A, fibre.I, fibre.distance});
  }
  for (Index i = 0; i < modes.shapes.cols(); ++i) {
    const StressField field = stress_field(body.model, modes.shapes.col(i), body.fibres);
    for (std::size_t k = 0; k < ends.size(); ++k) probe.sides[k].rows.col(i) = field.section_forces.col(ends[k]);
  }
  if (ends.size() == 2 && runs_on(body, ends[0] / 2, ends[1] / 2) && !acts_at(scene, body, node)) {
    const StressProbe::Side &a = probe.sides[0], &b = probe.sides[1];
    probe.sides = {{(a.rows + b.rows) / 2, (a.A + b.A) / 2, (a.I + b.I) / 2, (a.distance + b.distance) / 2}};
  }
  return probe;
}

/// @throws SceneError  as stress_probe
const Port& material_port(const Scene& scene, const ElasticBody& body, const PointRef& ref) {
  const auto reject = [&](const std::string& what) {
    throw SceneError(scene.file, ref.place, what + ", where there is no stress; name a point of the material");
  };
  if (ref.point.empty()) reject("\"" + ref.body + "\" without a point means the origin of its axes");
  const ScenePoint& point = point_of(scene, *body.scene, ref.point, ref.place);
  if (!point.hole.empty()) reject("\"" + ref.body + "." + ref.point + "\" is the centre of the hole \"" + point.hole + "\"");
  return *body.model.port(ref.point);
}

}  // namespace

StressProbe stress_probe(const Scene& scene, const ElasticBody& body, const ModalModel& modes, const PointRef& ref) {
  const int node = node_of(body.model, material_port(scene, body, ref));
  if (!body.plate()) return beam_probe(scene, body, modes, node);
  MatrixXd rows(4, modes.shapes.cols());
  for (Index i = 0; i < modes.shapes.cols(); ++i) rows.col(i) = stress_field(body.model, modes.shapes.col(i)).nodal.col(node);
  return {false, {{std::move(rows)}}};
}

}  // namespace pintle
