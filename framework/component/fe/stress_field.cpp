#include "framework/component/fe/statics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace pintle {

namespace {

using Eigen::Index;

struct Counts {
  Index lines = 0, plane = 0, points = 0;  // elements, elements, integration points
};

Counts counts(const FeModel& model) {
  Counts n;
  for (const AnyBlock& any : model.blocks)
    std::visit(
        [&]<class E>(const Block<E>& block) {
          (is_line<E> ? n.lines : n.plane) += block.size();
          if constexpr (!is_line<E>) n.points += Index{E::points} * block.size();
        },
        any);
  return n;
}

// Fills a field block by block; `line` and `point` are the first columns of the next element.
struct Filling {
  const FeModel& model;
  const Eigen::VectorXd& u;
  const std::vector<Fibre>& fibres;
  StressField& field;
  Index line = 0, point = 0;
  double jump = 0;  // [Pa]

  template <class E>
  void operator()(const Block<E>& block) {
    if constexpr (is_line<E>)
      lines(block);
    else
      plane(block);
  }

  template <class E>
  void lines(const Block<E>& block) {
    for (int i = 0; i < block.size(); ++i, ++line) {
      const int* node = block.nodes_of(i);
      const Stress<E> forces = stress(block.element(i), block.coords(i, model.x), gathered<E>(model, node, u));
      field.section_forces.middleCols<2>(2 * line) = forces;
      if (fibres.empty()) continue;
      const Fibre& fibre = fibres[static_cast<std::size_t>(line)];
      for (int k = 0; k < 2; ++k) {
        const double here = std::abs(forces(0, k)) / fibre.A + std::abs(forces(2, k)) * fibre.distance / fibre.I;
        double& most = field.von_mises[node[k]];
        most = std::max(most, here);
      }
    }
  }

  /// Plane elements of one material and thickness: their stress is continuous up to the mesh error.
  struct Sheet {
    PlaneProperties of;
    bool even;                  // all its elements have these properties
    Eigen::Matrix4Xd sum;       // over the elements at a node
    std::vector<int> meet;      // number of these
    std::vector<int> nodes{};   // of every element in turn
    std::vector<double> own{};  // von Mises stress of the element there
  };
  std::vector<Sheet> sheets{};

  template <class E>
  Sheet& sheet_of(const Block<E>& block) {
    const PlaneProperties& p = block.element(0).p;
    const bool even = block.properties.size() == 1;
    const auto same = [&](const Sheet& s) {
      return s.even && s.of.material.D == p.material.D && s.of.material.Dz == p.material.Dz && s.of.thickness == p.thickness;
    };
    if (even)
      if (const auto at = std::find_if(sheets.begin(), sheets.end(), same); at != sheets.end()) return *at;
    return sheets.emplace_back(
        Sheet{p, even, Eigen::Matrix4Xd::Zero(4, model.x.cols()), std::vector<int>(static_cast<std::size_t>(model.x.cols()), 0)});
  }

  template <class E>
  void plane(const Block<E>& block) {
    if (block.size() == 0) return;
    Sheet& sheet = sheet_of(block);
    for (int i = 0; i < block.size(); ++i, point += E::points) {
      const int* node = block.nodes_of(i);
      const E& e = block.element(i);
      const Coords<E> x = block.coords(i, model.x);
      const Stress<E> at_points = stress(e, x, gathered<E>(model, node, u));
      field.at_points.middleCols<E::points>(point) = at_points;
      field.points.middleCols<E::points>(point) = stress_points(e, x);
      const Eigen::Matrix<double, 4, E::nodes> at_nodes = nodal_stress(e, at_points);
      for (int k = 0; k < E::nodes; ++k) {
        sheet.sum.col(node[k]) += at_nodes.col(k);
        ++sheet.meet[static_cast<std::size_t>(node[k])];
        sheet.nodes.push_back(node[k]);
        sheet.own.push_back(pintle::von_mises(Eigen::Vector4d(at_nodes.col(k))));
      }
    }
  }

  void average(const Sheet& sheet) {
    std::vector<double> of_mean(sheet.meet.size(), 0);
    for (Index i = 0; i < sheet.sum.cols(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (sheet.meet[at] == 0) continue;
      const Eigen::Vector4d mean = sheet.sum.col(i) / sheet.meet[at];
      of_mean[at] = pintle::von_mises(mean);
      if (of_mean[at] < field.von_mises[i]) continue;
      field.von_mises[i] = of_mean[at];
      field.nodal.col(i) = mean;
    }
    for (std::size_t k = 0; k < sheet.own.size(); ++k)
      jump = std::max(jump, std::abs(sheet.own[k] - of_mean[static_cast<std::size_t>(sheet.nodes[k])]));
  }
};

}  // namespace

StressField stress_field(const FeModel& model, const Eigen::VectorXd& u, const std::vector<Fibre>& fibres) {
  if (u.size() != model.N())
    throw std::invalid_argument("displacement: " + std::to_string(u.size()) + " numbers, must be " + std::to_string(model.N()) +
                                ", one per nodal degree of freedom");
  const Counts n = counts(model);
  if (!fibres.empty() && static_cast<Index>(fibres.size()) != n.lines)
    throw std::invalid_argument("fibres: " + std::to_string(fibres.size()) + " for " + std::to_string(n.lines) +
                                " line elements; give one each or none");
  StressField field;
  if (n.plane > 0) field.nodal.setZero(4, model.x.cols());
  if (n.plane > 0 || !fibres.empty()) field.von_mises.setZero(model.x.cols());
  field.section_forces.resize(3, 2 * n.lines);
  field.at_points.resize(4, n.points);
  field.points.resize(2, n.points);
  Filling filling{model, u, fibres, field};
  for (const AnyBlock& any : model.blocks) std::visit([&](const auto& b) { filling(b); }, any);
  for (const Filling::Sheet& sheet : filling.sheets) filling.average(sheet);
  const double largest = field.von_mises.size() > 0 ? field.von_mises.maxCoeff() : 0;
  field.jump = largest > 0 ? filling.jump / largest : 0;
  return field;
}

}  // namespace pintle
