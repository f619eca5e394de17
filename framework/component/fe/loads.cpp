#include "framework/component/fe/loads.h"

#include <stdexcept>
#include <string>

namespace pintle {

namespace {

// Sums `of(coords of the side)`, two values a node, over all sides.
template <class Of>
Eigen::VectorXd sum_sides(const FeModel& model, const std::vector<Cells>& sides, const Of& of) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.N());
  for (const Cells& cells : sides) {
    const auto nodes = static_cast<std::size_t>(nodes_of(cells.shape));
    Eigen::Matrix2Xd x(2, static_cast<Eigen::Index>(nodes));
    for (std::size_t first = 0; first + nodes <= cells.nodes.size(); first += nodes) {
      for (std::size_t k = 0; k < nodes; ++k) {
        const int node = cells.nodes[first + k];
        if (node < 0 || node >= model.x.cols())
          throw std::invalid_argument("load: a side's node " + std::to_string(node) + " does not exist; nodes run from 0 to " +
                                      std::to_string(model.x.cols()) + " − 1");
        x.col(static_cast<Eigen::Index>(k)) = model.x.col(node);
      }
      const Eigen::VectorXd share = of(x);
      for (std::size_t k = 0; k < nodes; ++k)
        load.segment<2>(model.begin[static_cast<std::size_t>(cells.nodes[first + k])]) +=
            share.segment<2>(static_cast<Eigen::Index>(2 * k));
    }
  }
  return load;
}

}  // namespace

void add_force(Eigen::VectorXd& independent, const Port& port, const Eigen::Vector2d& f, double torque) {
  if (torque != 0 && port.dof[2] < 0)
    throw std::invalid_argument("port \"" + port.name + "\": torque " + std::to_string(torque) +
                                " N m, but the port has no rotation; load it by a pair of forces");
  independent[port.dof[0]] += f.x();
  independent[port.dof[1]] += f.y();
  if (port.dof[2] >= 0) independent[port.dof[2]] += torque;
}

Eigen::VectorXd traction_load(const FeModel& model, const std::vector<Cells>& sides, const Eigen::Vector2d& traction, double thickness) {
  return sum_sides(model, sides, [&](const Eigen::Matrix2Xd& x) { return side_load(x, traction, thickness); });
}

Eigen::VectorXd pressure_load(const FeModel& model, const std::vector<Cells>& sides, double pressure, double thickness) {
  return sum_sides(model, sides, [&](const Eigen::Matrix2Xd& x) { return side_pressure(x, pressure, thickness); });
}

Eigen::VectorXd acceleration_load(const FeModel& model, const Sparse& M, const Eigen::Vector2d& a) {
  return M * (rigid_fields(model).T * a);
}

Eigen::VectorXd spin_load(const FeModel& model, const Sparse& M, double w, const Eigen::Vector2d& about) {
  const RigidFields f = rigid_fields(model);
  return w * w * (M * (f.x - f.T * about));
}

Eigen::VectorXd line_load(const FeModel& model, const Eigen::Vector2d& q) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(model.N());
  bool any_line = false;
  for (const AnyBlock& any : model.blocks)
    std::visit(
        [&]<class E>(const Block<E>& block) {
          if constexpr (is_line<E>) {
            any_line = true;
            for (int i = 0; i < block.size(); ++i) {
              const NodalVector<E> f = pintle::line_load(block.element(i), block.coords(i, model.x), q);
              for (int k = 0; k < E::nodes; ++k) {
                const int node = block.nodes_of(i)[k];
                load.segment<E::dofs_per_node>(model.begin[static_cast<std::size_t>(node)]) +=
                    f.template segment<E::dofs_per_node>(k * E::dofs_per_node);
              }
            }
          }
        },
        any);
  if (!any_line) throw std::invalid_argument("line load: the body has no beams or bars; load a plane body by traction on its edges");
  return load;
}

}  // namespace pintle
