#include "framework/component/fe/fe_model.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Triplets = std::vector<Eigen::Triplet<double>>;

// Smallest ratio of a rim's radius of gyration to its reach from the port that still determines a rotation.
constexpr double degenerate = 1e-9;

template <class... Parts>
[[noreturn]] void reject_rim(const RimPort& rim, const Parts&... parts) {
  std::ostringstream words;
  words << "port \"" << rim.name << "\" at (" << rim.x.x() << ", " << rim.x.y() << "): ";
  (words << ... << parts);
  throw std::invalid_argument(words.str());
}

struct CoupledShape {
  Vector2d center = Vector2d::Zero();  // weighted
  double length = 0, radius = 0;       // Σw, √(Σ w r²/Σw)
};

CoupledShape coupled_shape(const FeModel& model, const RimPort& rim) {
  if (rim.weights.size() != rim.nodes.size())
    reject_rim(rim, rim.weights.size(), " weights for ", rim.nodes.size(), " nodes of its rim; give one each");
  CoupledShape shape;
  for (std::size_t k = 0; k < rim.nodes.size(); ++k) {
    if (!(rim.weights[k] > 0))
      reject_rim(rim, "weight of rim node ", rim.nodes[k], " is ", rim.weights[k],
                 ", must be > 0: it is the length of rim that belongs to the node");
    shape.center += rim.weights[k] * model.x.col(rim.nodes[k]);
    shape.length += rim.weights[k];
  }
  if (rim.nodes.size() < 2)
    reject_rim(rim, "its rim has ", rim.nodes.size(), " nodes, must have at least two apart; refine the mesh at the hole");
  shape.center /= shape.length;
  double reach = (shape.center - rim.x).norm();
  for (std::size_t k = 0; k < rim.nodes.size(); ++k) {
    const Vector2d x = model.x.col(rim.nodes[k]);
    shape.radius += rim.weights[k] * (x - shape.center).squaredNorm();
    reach = std::max(reach, (x - rim.x).norm());
  }
  shape.radius = std::sqrt(shape.radius / shape.length);
  if (!(shape.radius > degenerate * reach))
    reject_rim(rim, "the nodes of its rim coincide and define no rotation; refine the mesh at the hole");
  return shape;
}

// p = C u over the rim's dofs [u_x u_y] node by node: the rigid motion that best fits u, as [u_x u_y φ] of the port. The row of the
// rotation is in rad.
Eigen::Matrix3Xd average_motion(const FeModel& model, const RimPort& rim, const CoupledShape& shape) {
  const auto k = static_cast<Index>(rim.nodes.size());
  Eigen::Matrix3Xd C(3, 2 * k);
  const Vector2d lever = rim.x - shape.center;
  for (Index i = 0; i < k; ++i) {
    const double share = rim.weights[static_cast<std::size_t>(i)] / shape.length;
    const Vector2d r = Vector2d(model.x.col(rim.nodes[static_cast<std::size_t>(i)])) - shape.center;
    const Eigen::RowVector2d turn = share / (shape.radius * shape.radius) * Eigen::RowVector2d(-r.y(), r.x());
    C.block<2, 2>(0, 2 * i) = share * Eigen::Matrix2d::Identity();
    C.block<1, 2>(0, 2 * i) -= lever.y() * turn;
    C.block<1, 2>(1, 2 * i) += lever.x() * turn;
    C.block<1, 2>(2, 2 * i) = turn;
  }
  return C;
}

// A rim's nodal dofs and how they are coupled.
struct Rim {
  std::vector<int> dofs;       // nodal, of the rim, [u_x u_y] node by node
  std::array<int, 3> given{};  // average: indices in `dofs` of those determined by the others and the port
  Eigen::Matrix3Xd C;          // average
};

Rim average_rim(const FeModel& model, const RimPort& port, const CoupledShape& shape) {
  Rim rim;
  for (const int node : port.nodes)
    for (int d = 0; d < 2; ++d) rim.dofs.push_back(model.begin[static_cast<std::size_t>(node)] + d);
  rim.C = average_motion(model, port, shape);
  Eigen::Matrix3Xd even = rim.C;
  even.row(2) *= shape.radius;
  const Eigen::ColPivHouseholderQR<Eigen::Matrix3Xd> qr(even);
  for (int r = 0; r < 3; ++r) rim.given[static_cast<std::size_t>(r)] = qr.colsPermutation().indices()[r];
  return rim;
}

// Rows of L for a rigid rim: u_i = u_P + φ Z (x_i − x_P), φ_i = φ.
void add_rigid_rows(const FeModel& model, const RimPort& rim, int port, Triplets& L) {
  for (const int node : rim.nodes) {
    const int at = model.begin[static_cast<std::size_t>(node)];
    const Vector2d r = Vector2d(model.x.col(node)) - rim.x;
    L.emplace_back(at, port, 1);
    L.emplace_back(at, port + 2, -r.y());
    L.emplace_back(at + 1, port + 1, 1);
    L.emplace_back(at + 1, port + 2, r.x());
    if (model.begin[static_cast<std::size_t>(node) + 1] - at == 3) L.emplace_back(at + 2, port + 2, 1);
  }
}

// Rows of L for an averaging rim: C_e u_e = p − C_r u_r.
void add_average_rows(const FeModel& model, const Rim& rim, int port, Triplets& L) {
  Eigen::Matrix3d Ce;
  for (int r = 0; r < 3; ++r) Ce.col(r) = rim.C.col(rim.given[static_cast<std::size_t>(r)]);
  const Eigen::Matrix3d inverse = Ce.inverse();
  const Eigen::Matrix3Xd others = inverse * rim.C;
  for (int r = 0; r < 3; ++r) {
    const int row = rim.dofs[static_cast<std::size_t>(rim.given[static_cast<std::size_t>(r)])];
    for (int d = 0; d < 3; ++d) L.emplace_back(row, port + d, inverse(r, d));
    for (std::size_t k = 0; k < rim.dofs.size(); ++k)
      if (const int column = model.independent_of(rim.dofs[k]); column >= 0) L.emplace_back(row, column, -others(r, static_cast<Index>(k)));
  }
}

void validate(const FeModel& model, const std::vector<NodePort>& nodes, const std::vector<RimPort>& rims) {
  const auto count = static_cast<std::size_t>(model.x.cols());
  if (!model.ports.empty()) throw std::invalid_argument("the model has ports already; add all of them at once");
  std::vector<std::string> names;
  std::vector<const RimPort*> owner(count, nullptr);
  for (const RimPort& rim : rims) {
    names.push_back(rim.name);
    for (const int node : rim.nodes) {
      if (node < 0 || static_cast<std::size_t>(node) >= count)
        reject_rim(rim, "node ", node, " does not exist; nodes run from 0 to ", count, " − 1");
      const RimPort*& other = owner[static_cast<std::size_t>(node)];
      if (other == &rim) reject_rim(rim, "node ", node, " is twice in its rim; name it once");
      if (other) reject_rim(rim, "its rim shares node ", node, " with that of port \"", other->name, "\"; a node follows one port at most");
      other = &rim;
    }
  }
  for (const NodePort& port : nodes) {
    names.push_back(port.name);
    if (port.node < 0 || static_cast<std::size_t>(port.node) >= count)
      throw std::invalid_argument("port \"" + port.name + "\": node " + std::to_string(port.node) +
                                  " does not exist; nodes run from 0 to " + std::to_string(count) + " − 1");
    if (const RimPort* rim = owner[static_cast<std::size_t>(port.node)])
      throw std::invalid_argument("port \"" + port.name + "\": its node " + std::to_string(port.node) + " is on the rim of port \"" +
                                  rim->name + "\"; put it elsewhere");
  }
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end()) throw std::invalid_argument("port \"" + *twice + "\": two ports have this name; rename one");
}

}  // namespace

void add_ports(FeModel& model, const std::vector<NodePort>& nodes, const std::vector<RimPort>& rims) {
  validate(model, nodes, rims);
  std::vector<CoupledShape> shapes;
  for (const RimPort& port : rims) shapes.push_back(coupled_shape(model, port));
  const int N = model.N();
  std::vector<Rim> average(rims.size());
  std::vector<int> independent(rims.empty() ? 0 : static_cast<std::size_t>(N), 0);
  for (std::size_t r = 0; r < rims.size(); ++r) {
    if (rims[r].coupling == Coupling::rigid) {
      for (const int node : rims[r].nodes)
        for (int i = model.begin[static_cast<std::size_t>(node)]; i < model.begin[static_cast<std::size_t>(node) + 1]; ++i)
          independent[static_cast<std::size_t>(i)] = -1;
    } else {
      average[r] = average_rim(model, rims[r], shapes[r]);
      for (const int k : average[r].given) independent[static_cast<std::size_t>(average[r].dofs[static_cast<std::size_t>(k)])] = -1;
    }
  }
  int n = rims.empty() ? N : 0;
  for (int& i : independent)
    if (i == 0) i = n++;
  model.independent = std::move(independent);

  for (const NodePort& port : nodes) {
    const int at = model.begin[static_cast<std::size_t>(port.node)];
    Port made{port.name, model.x.col(port.node), {-1, -1, -1}};
    for (int d = 0; at + d < model.begin[static_cast<std::size_t>(port.node) + 1]; ++d) made.dof[d] = model.independent_of(at + d);
    model.ports.push_back(made);
  }
  if (rims.empty()) return;
  Triplets L;
  for (int i = 0; i < N; ++i)
    if (const int k = model.independent_of(i); k >= 0) L.emplace_back(i, k, 1);
  for (std::size_t r = 0; r < rims.size(); ++r, n += 3) {
    model.ports.push_back({rims[r].name, rims[r].x, {n, n + 1, n + 2}});
    if (rims[r].coupling == Coupling::rigid)
      add_rigid_rows(model, rims[r], n, L);
    else
      add_average_rows(model, average[r], n, L);
  }
  model.L.resize(N, n);
  model.L.setFromTriplets(L.begin(), L.end());
}

}  // namespace pintle
