#include "framework/component/fe/fe_model.h"

#include "meshes/reject.h"

#include <algorithm>

namespace pintle {

namespace {

struct NodeSizes {
  std::vector<int>& size;

  template <class E>
  void operator()(const Block<E>& block) const {
    const std::size_t count = block.nodes.size() / E::nodes;
    if (block.nodes.size() != count * E::nodes)
      reject("elements of ", E::nodes, " nodes: ", block.nodes.size(),
             " node numbers are not a multiple of it; give each element all its nodes");
    if (block.properties.size() != 1 && block.properties.size() != count)
      reject("elements: ", block.properties.size(), " properties for ", count, " elements; give one for all or one each");
    for (const int node : block.nodes) {
      if (node < 0 || static_cast<std::size_t>(node) >= size.size())
        reject("element: node ", node, " does not exist; nodes run from 0 to ", size.size(), " − 1");
      int& s = size[static_cast<std::size_t>(node)];
      s = std::max(s, E::dofs_per_node);
    }
  }
};

}  // namespace

const Port* FeModel::port(std::string_view name) const {
  const auto at = std::find_if(ports.begin(), ports.end(), [&](const Port& p) { return p.name == name; });
  return at == ports.end() ? nullptr : &*at;
}

FeModel fe_model(Eigen::Matrix2Xd x, std::vector<AnyBlock> blocks, std::vector<Lump> lumps) {
  FeModel model;
  std::vector<int> size(static_cast<std::size_t>(x.cols()), 0);
  for (const AnyBlock& block : blocks) std::visit(NodeSizes{size}, block);
  model.begin.reserve(size.size() + 1);
  model.begin.push_back(0);
  for (std::size_t i = 0; i < size.size(); ++i) {
    if (size[i] == 0) {
      const Eigen::Vector2d at = x.col(static_cast<Eigen::Index>(i));
      reject("node ", i, " at (", at.x(), ", ", at.y(), ") belongs to no element; drop it from the mesh");
    }
    model.begin.push_back(model.begin.back() + size[i]);
  }
  for (const Lump& lump : lumps) {
    if (lump.node < 0 || static_cast<std::size_t>(lump.node) >= size.size())
      reject("point mass: node ", lump.node, " does not exist; nodes run from 0 to ", size.size(), " − 1");
    if (!(lump.mass.m >= 0 && lump.mass.J >= 0))
      reject("point mass at node ", lump.node, ": m = ", lump.mass.m, " kg, J = ", lump.mass.J, " kg m²; neither may be negative");
    if (lump.mass.J > 0 && size[static_cast<std::size_t>(lump.node)] < 3)
      reject("point mass at node ", lump.node, ": J = ", lump.mass.J,
             " kg m² but the node has no rotation; leave J out or spread the mass over two nodes");
  }
  model.x = std::move(x);
  model.blocks = std::move(blocks);
  model.lumps = std::move(lumps);
  return model;
}

RigidFields rigid_fields(const FeModel& model) {
  const int N = model.N();
  RigidFields f{Eigen::MatrixX2d::Zero(N, 2), Eigen::VectorXd::Zero(N), Eigen::VectorXd::Zero(N)};
  for (Eigen::Index i = 0; i < model.x.cols(); ++i) {
    const int at = model.begin[static_cast<std::size_t>(i)];
    f.T(at, 0) = f.T(at + 1, 1) = 1;
    f.x.segment<2>(at) = model.x.col(i);
    f.R.segment<2>(at) << -model.x(1, i), model.x(0, i);
    if (model.begin[static_cast<std::size_t>(i) + 1] - at == 3) f.R[at + 2] = 1;
  }
  return f;
}

Eigen::MatrixX3d rigid_motions(const FeModel& model) {
  const RigidFields f = rigid_fields(model);
  Eigen::MatrixX3d all = Eigen::MatrixX3d::Zero(model.n(), 3);
  for (int i = 0; i < model.N(); ++i)
    if (const int k = model.independent_of(i); k >= 0) all.row(k) << f.T.row(i), f.R[i];
  for (const Port& port : model.ports) {
    all.row(port.dof[0]) << 1, 0, -port.x.y();
    all.row(port.dof[1]) << 0, 1, port.x.x();
    if (port.dof[2] >= 0) all.row(port.dof[2]) << 0, 0, 1;
  }
  return all;
}

Eigen::MatrixXd nodal(const FeModel& model, const Eigen::MatrixXd& independent) {
  if (model.L.size() == 0) return independent;
  return model.L * independent;
}

Eigen::VectorXd independent_load(const FeModel& model, const Eigen::VectorXd& nodal_load) {
  if (model.L.size() == 0) return nodal_load;
  return model.L.transpose() * nodal_load;
}

double extent(const FeModel& model) { return (model.x.rowwise().maxCoeff() - model.x.rowwise().minCoeff()).norm(); }

Eigen::MatrixX3d scaled_rigid_motions(const FeModel& model) {
  const Eigen::Vector2d middle = (model.x.rowwise().maxCoeff() + model.x.rowwise().minCoeff()) / 2;
  Eigen::MatrixX3d r = rigid_motions(model);
  r.col(2) += middle.y() * r.col(0) - middle.x() * r.col(1);
  if (const double size = extent(model); size > 0) r.col(2) /= size;
  return r;
}

}  // namespace pintle
