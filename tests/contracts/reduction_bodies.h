#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "framework/component/fe/assembly.h"
#include "framework/component/reduction/modal_model.h"
#include "tests/unit/component/fe_bodies.h"

/// Bodies that the tests of reductions share, and what these judge by: dense algebra on the
/// assembled matrices, and the rims as the tests themselves made them.
namespace pintle {

/// A model with what makes it up, so that a test can tell a port's motion without the library's L.
struct SampleBody {
  FeModel model;
  std::vector<RimPort> rims;  ///< of the ports that are no nodes; ports at nodes come first
  std::vector<int> port_nodes;

  int ports() const { return static_cast<int>(model.ports.size()); }
  bool turns() const { return model.ports.front().dof[2] >= 0; }
};

/// [u_x u_y φ] of a port in a nodal field; φ = 0 where the node has none. Of a rim: the mean, and
/// the rotation that fits best.
inline Eigen::Vector3d port_motion(const SampleBody& body, int port, const Eigen::VectorXd& u) {
  const auto& begin = body.model.begin;
  const auto nodes = body.port_nodes.size();
  if (static_cast<std::size_t>(port) < nodes) {
    const auto node = static_cast<std::size_t>(body.port_nodes[static_cast<std::size_t>(port)]);
    Eigen::Vector3d motion = Eigen::Vector3d::Zero();
    motion.head(begin[node + 1] - begin[node]) = u.segment(begin[node], begin[node + 1] - begin[node]);
    return motion;
  }
  const RimPort& rim = body.rims[static_cast<std::size_t>(port) - nodes];
  Eigen::Vector2d mean = Eigen::Vector2d::Zero(), middle = Eigen::Vector2d::Zero();
  double length = 0, turn = 0, inertia = 0;
  for (std::size_t k = 0; k < rim.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(rim.nodes[k]);
    mean += rim.weights[k] * u.segment<2>(begin[node]);
    middle += rim.weights[k] * body.model.x.col(rim.nodes[k]);
    length += rim.weights[k];
  }
  mean /= length;
  middle /= length;
  for (std::size_t k = 0; k < rim.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(rim.nodes[k]);
    const Eigen::Vector2d r = body.model.x.col(rim.nodes[k]) - middle;
    const Eigen::Vector2d w = u.segment<2>(begin[node]);
    turn += rim.weights[k] * (r.x() * w.y() - r.y() * w.x());
    inertia += rim.weights[k] * r.squaredNorm();
  }
  turn /= inertia;
  const Eigen::Vector2d lever = rim.x - middle;
  return {mean.x() - turn * lever.y(), mean.y() + turn * lever.x(), turn};
}

inline SampleBody on_nodes(FeModel model, int a, int b) {
  add_ports(model, {{"A", a}, {"B", b}}, {});
  return {std::move(model), {}, {a, b}};
}

/// Steel strip of 10 mm × 4 mm.
inline BeamEuler euler_strip(double rotary = 0) { return {2e11 * 4e-5, 2e11 * 3.2e-10 / 6, 7800 * 4e-5, rotary * 7800 * 3.2e-10 / 6}; }

inline SampleBody euler_beam(int elements = 10, const Eigen::Vector2d& from = {0.1, -0.2}, const Eigen::Vector2d& to = {0.5, 0.1}) {
  return on_nodes(chain(euler_strip(), elements, from, to), 0, elements);
}

/// Two legs at an angle, thick beams with rotary inertia, a lump with inertia in the corner.
inline SampleBody timoshenko_bracket() {
  const int leg = 5;
  Eigen::Matrix2Xd x(2, 2 * leg + 1);
  Block<BeamTimoshenko> block{{{8e7, 1.6e4, 2.5e7, 3.1, 6e-4}}, {}, {}};
  for (int i = 0; i <= 2 * leg; ++i)
    x.col(i) = i <= leg ? Eigen::Vector2d(0.06 * i, 0.02 * i) : Eigen::Vector2d(0.3 - 0.03 * (i - leg), 0.1 + 0.05 * (i - leg));
  for (int i = 0; i < 2 * leg; ++i) {
    block.nodes.insert(block.nodes.end(), {i, i + 1});
    block.cells.push_back(i);
  }
  return on_nodes(fe_model(x, {block}, {{leg, {0.7, 2e-3}}, {2 * leg, {0.2, 0}}}), 0, 2 * leg);
}

inline RimPort edge_port(const Plate& p, const char* name, const char* edge, Coupling coupling) {
  const std::vector<int>& nodes = p.nodes.at(edge);
  RimPort rim{name, Eigen::Vector2d::Zero(), nodes, std::vector<double>(nodes.size(), 1), coupling};
  for (const int n : nodes) rim.x += p.mesh.x.col(n) / static_cast<double>(nodes.size());
  return rim;
}

/// A plate whose two short edges follow, or are followed by, a port.
inline SampleBody plate_on_edges(Coupling coupling) {
  const Plate p = plate(4, 2, CellShape::quadrilateral8, bent_rectangle(0.2, 0.05));
  SampleBody body{model_of(p, steel(PlaneState::stress)), {}, {}};
  body.rims = {edge_port(p, "A", "left", coupling), edge_port(p, "B", "right", coupling)};
  body.rims[1].x += Eigen::Vector2d(0.004, 0.011);  // a lever between port and rim
  add_ports(body.model, {}, body.rims);
  return body;
}

/// Ports at nodes of plane elements: they have no rotation.
inline SampleBody plate_on_nodes() {
  const Plate p = plate(4, 2, CellShape::triangle6, bent_rectangle(0.2, 0.05));
  return on_nodes(model_of(p, steel(PlaneState::strain)), p.nodes.at("left")[1], p.nodes.at("right")[2]);
}

/// Nodal matrices, and fields in nodal dofs as the test makes them from the nodes.
struct NodalMatrices {
  Eigen::MatrixXd K, M, G;
};
inline NodalMatrices nodal_matrices(const FeModel& model, MassKind kind = MassKind::consistent) {
  const Assembler assembler(model);
  return {assembler.stiffness(), assembler.mass(kind), assembler.skew_mass()};
}
inline Eigen::MatrixXd rigid_nodal(const FeModel& model) {
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(model.N(), 3);
  for (Eigen::Index k = 0; k < model.x.cols(); ++k) {
    const int f = model.begin[static_cast<std::size_t>(k)];
    r(f, 0) = r(f + 1, 1) = 1;
    r(f, 2) = -model.x(1, k);
    r(f + 1, 2) = model.x(0, k);
    if (model.begin[static_cast<std::size_t>(k) + 1] - f == 3) r(f + 2, 2) = 1;
  }
  return r;
}

}  // namespace pintle
