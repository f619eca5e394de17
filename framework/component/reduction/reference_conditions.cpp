#include <Eigen/LU>
#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/component/reduction/reduction.h"

namespace pintle {
namespace {

const Port& port_at(const FeModel& model, int index, const std::string& what) {
  const int count = static_cast<int>(model.ports.size());
  if (index < 0 || index >= count)
    throw std::invalid_argument(what + " = " + std::to_string(index) + ": the body has " + std::to_string(count) +
                                " ports; name one of them, from 0");
  return model.ports[static_cast<std::size_t>(index)];
}

const Port& turning_port(const FeModel& model, const ReferenceConditions& conditions) {
  const Port& a = port_at(model, conditions.a, "tangent frame: port a");
  if (a.dof[2] < 0)
    throw std::invalid_argument("tangent frame: port \"" + a.name +
                                "\" cannot turn (a node of plane elements has no rotation); use a port "
                                "in a hole or on a rim, the chord of two ports, or mean axes");
  return a;
}

struct Chord {
  const Port &a, &b;
  Eigen::Vector2d along;  // unit vector from a to b
};
Chord chord_of(const FeModel& model, const ReferenceConditions& conditions) {
  const Port& a = port_at(model, conditions.a, "chord frame: port a");
  const Port& b = port_at(model, conditions.b, "chord frame: port b");
  const Eigen::Vector2d d = b.x - a.x;
  if (d.norm() <= 1e-9 * extent(model))
    throw std::invalid_argument("chord frame: ports \"" + a.name + "\" and \"" + b.name +
                                "\" coincide; name two at different positions, or use the tangent frame");
  return {a, b, d.normalized()};
}

}  // namespace

std::vector<int> port_dofs(const FeModel& model, const std::vector<int>& ports) {
  std::vector<int> dofs;
  std::set<int> seen;
  for (const int p : ports) {
    const Port& port = port_at(model, p, "interface port");
    for (const int f : port.dof) {
      if (f < 0) continue;
      if (!seen.insert(f).second)
        throw std::invalid_argument("interface port \"" + port.name +
                                    "\": its degrees of freedom are already in the interface; name each port once");
      dofs.push_back(f);
    }
  }
  return dofs;
}

Eigen::MatrixXd reference_condition_rows(const Component& c, const ReferenceConditions& conditions) {
  Eigen::MatrixXd B = Eigen::MatrixXd::Zero(3, c.model.n());
  switch (conditions.kind) {
    case ReferenceConditions::tangent: {
      const Port& a = turning_port(c.model, conditions);
      for (int k = 0; k < 3; ++k) B(k, a.dof[k]) = 1;
      break;
    }
    case ReferenceConditions::chord: {
      const Chord chord = chord_of(c.model, conditions);
      for (int k = 0; k < 2; ++k) B(k, chord.a.dof[k]) = 1;
      B(2, chord.b.dof[0]) = -chord.along.y();
      B(2, chord.b.dof[1]) = chord.along.x();
      break;
    }
    case ReferenceConditions::mean_axes: {
      Eigen::MatrixX3d r = rigid_motions(c.model);
      const Eigen::MatrixXd Mr = c.M * r;
      const Eigen::Matrix3d inertia = r.transpose() * Mr;
      // Rotation about the origin carries the momentum m Z x_c.
      const double m = inertia(0, 0), x_c = inertia(1, 2) / m, y_c = -inertia(0, 2) / m;
      B = Mr.transpose();
      B.row(2) += y_c * B.row(0) - x_c * B.row(1);
      break;
    }
  }
  return B;
}

Sparse permitted_motions(const Component& c, const ReferenceConditions& conditions) {
  const int n = c.model.n();
  std::vector<char> held(static_cast<std::size_t>(n), 0);
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  if (conditions.kind == ReferenceConditions::tangent) {
    for (const int f : turning_port(c.model, conditions).dof) held[static_cast<std::size_t>(f)] = 1;
  } else {
    const Chord chord = chord_of(c.model, conditions);
    for (int k = 0; k < 2; ++k) {
      held[static_cast<std::size_t>(chord.a.dof[k])] = 1;
      held[static_cast<std::size_t>(chord.b.dof[k])] = 1;
      if (chord.along[k] != 0) entries.emplace_back(chord.b.dof[k], column, chord.along[k]);
    }
    ++column;
  }
  for (int i = 0; i < n; ++i)
    if (!held[static_cast<std::size_t>(i)]) entries.emplace_back(i, column++, 1);
  Sparse V(n, column);
  V.setFromTriplets(entries.begin(), entries.end());
  return V;
}

Eigen::MatrixXd meeting_conditions(const Component& c, const ReferenceConditions& conditions, const Eigen::MatrixXd& V) {
  if (V.cols() == 0) return V;
  const Eigen::MatrixXd B = reference_condition_rows(c, conditions);
  const Eigen::MatrixX3d r = scaled_rigid_motions(c.model);
  const Eigen::Matrix3d Br = B * r;
  return V - r * Br.fullPivLu().solve(B * V);
}

}  // namespace pintle
