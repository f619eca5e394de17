#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <Eigen/SparseCore>

#include "eigen_layout.h"
#include "elements/line.h"
#include "elements/plane.h"
#include "elements/point_mass.h"

namespace pintle {

using Sparse = Eigen::SparseMatrix<double>;

/// Elements of one kind.
template <class E>
struct Block {
  std::vector<E> properties;  ///< one for all, or one per element
  std::vector<int> nodes;     ///< E::nodes per element
  std::vector<int> cells;     ///< index of the cell in the mesh, over all its blocks
  int size() const { return static_cast<int>(nodes.size()) / E::nodes; }
  const E& element(int i) const { return properties[properties.size() == 1 ? 0 : static_cast<std::size_t>(i)]; }
  const int* nodes_of(int i) const { return &nodes[static_cast<std::size_t>(i) * E::nodes]; }
  Coords<E> coords(int i, const Eigen::Matrix2Xd& x) const {
    Coords<E> c;
    const int* node = nodes_of(i);
    for (int k = 0; k < E::nodes; ++k) c.col(k) = x.col(node[k]);
    return c;
  }
};
using AnyBlock =
    std::variant<Block<Bar>, Block<BeamEuler>, Block<BeamTimoshenko>, Block<Triangle3>, Block<Triangle6>, Block<Quadrilateral4>,
                 Block<Quadrilateral4Plain>, Block<Quadrilateral8>, Block<Quadrilateral8Reduced>, Block<Quadrilateral9>>;
template <class E>
inline constexpr bool is_line = E::stress_rows == 3;  ///< bars and beams; otherwise plane

/// A mass fixed to a node.
struct Lump {
  int node;
  PointMass mass;
};

/// A point where a mechanism may connect to a body: a node, or the middle of a hole whose rim is coupled to it. Its displacement and
/// rotation are separate dofs, so that joints use three numbers.
struct Port {
  std::string name;
  Eigen::Vector2d x;  ///< body axes [m]
  /// Independent dofs u_x, u_y, φ; φ = −1 where it has no rotation.
  int dof[3] = {-1, -1, -1};
};

/// How the rim of a hole is coupled to the port in its middle.
enum class Coupling {
  rigid,    ///< the rim moves as a rigid ring
  average,  ///< the port follows the average motion of the rim (weighted by length); the rim stays flexible
};

/// A body made of elements. Its N nodal dofs are ordered node by node; the n independent ones are those that remain after couplings
/// have tied rims to ports: u = L ũ. They keep the nodal order, followed by u_x, u_y, φ of each rim's port. Theory:
/// docs/theory/couplings.md.
struct FeModel {
  Eigen::Matrix2Xd x;  ///< nodes, body axes [m]
  std::vector<AnyBlock> blocks;
  std::vector<Lump> lumps;       ///< a lump with J > 0 must be at a node with a rotation
  std::vector<int> begin;        ///< first nodal dof of each node, one past; 2 or 3 each
  Sparse L;                      ///< N × n; 0 × 0 stands for the identity
  std::vector<int> independent;  ///< for each nodal dof, −1 where L determines it; empty: all are independent
  std::vector<Port> ports;       ///< those at nodes, then those of rims
  int N() const { return begin.back(); }
  int n() const { return L.size() == 0 ? N() : static_cast<int>(L.cols()); }
  const Port* port(std::string_view name) const;  ///< nullptr: there is none of this name
  /// The independent dof that equals a nodal one, or −1.
  int independent_of(int nodal) const { return independent.empty() ? nodal : independent[static_cast<std::size_t>(nodal)]; }
};

/// Numbers the dofs of blocks and lumps; no ports yet. A node has a rotation if one of its elements has one there.
/// @throws std::invalid_argument  a node without an element or one that does not exist, a number of elements that does not fit the
/// properties, a lump's J on a node without rotation
FeModel fe_model(Eigen::Matrix2Xd x, std::vector<AnyBlock> blocks, std::vector<Lump> lumps = {});

/// A port at a node.
struct NodePort {
  std::string name;
  int node;
};
/// A port in the middle of a rim. `weights`: length of rim that belongs to each node [m], > 0.
struct RimPort {
  std::string name;
  Eigen::Vector2d x;
  std::vector<int> nodes;
  std::vector<double> weights;
  Coupling coupling = Coupling::rigid;
};
/// Adds ports to a model that has none, and L.
/// @throws std::invalid_argument  two ports have one name; two rims share a node, or a port is at a node of a rim; a rim's nodes or weights
/// do not determine a rigid motion
void add_ports(FeModel&, const std::vector<NodePort>&, const std::vector<RimPort>&);

/// An element's dofs, taken from a nodal field u, N; `node`: its nodes.
template <class E>
NodalVector<E> gathered(const FeModel& model, const int* node, const Eigen::VectorXd& u) {
  NodalVector<E> e;
  for (int k = 0; k < E::nodes; ++k)
    e.template segment<E::dofs_per_node>(k * E::dofs_per_node) =
        u.segment<E::dofs_per_node>(model.begin[static_cast<std::size_t>(node[k])]);
  return e;
}

/// Nodal fields, N each: unit translations T, position x, unit rotation R (about the origin). The rotations of nodes in them are 0, 0 and
/// 1.
struct RigidFields {
  Eigen::MatrixX2d T;
  Eigen::VectorXd x, R;
};
RigidFields rigid_fields(const FeModel&);
/// The same in independent dofs, n × 3: translations along x and y, rotation about the origin.
/// L times these are T and R.
Eigen::MatrixX3d rigid_motions(const FeModel&);
/// u = L ũ, N × k, and its transpose applied to forces, which preserves their resultant and moment.
Eigen::MatrixXd nodal(const FeModel&, const Eigen::MatrixXd& independent);
Eigen::VectorXd independent_load(const FeModel&, const Eigen::VectorXd& nodal_load);

/// Length of the diagonal of the box around the nodes [m].
double extent(const FeModel&);

/// Rigid motions, n × 3, of similar size: the rotation is about the middle of the nodes and scaled by 1/extent.
Eigen::MatrixX3d scaled_rigid_motions(const FeModel&);

}  // namespace pintle
