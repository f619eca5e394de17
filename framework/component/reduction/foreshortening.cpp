#include "framework/component/reduction/foreshortening.h"

#include <algorithm>

#include "framework/component/fe/assembly.h"
#include "framework/component/reduction/static_response.h"

namespace pintle {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A rim that moves as a rigid ring with its port.
struct RigidRim {
  Eigen::Index port;
  std::vector<int> at;  // first dof of each of its nodes
  Eigen::Matrix2Xd r;   // from the port to each
};

/// A rigid coupling determines both displacements of each of its nodes; an averaging one determines three dofs in total, so that some
/// nodes keep one of two.
std::vector<RigidRim> rigid_rims(const FeModel& model) {
  std::vector<RigidRim> rims;
  for (std::size_t p = 0; model.L.size() > 0 && p < model.ports.size(); ++p) {
    const Port& port = model.ports[p];
    RigidRim rim{static_cast<Eigen::Index>(p), {}, {}};
    std::vector<int> nodes;
    bool rigid = true;
    for (Sparse::InnerIterator l(model.L, port.dof[0]); rigid && l; ++l) {
      const auto above = std::ranges::upper_bound(model.begin, static_cast<int>(l.row()));
      nodes.push_back(static_cast<int>(above - model.begin.begin()) - 1);
      rim.at.push_back(*(above - 1));
      const int first = rim.at.back();
      rigid = model.independent_of(first) < 0 && model.independent_of(first + 1) < 0;
    }
    if (!rigid) continue;
    rim.r = model.x(Eigen::all, nodes).colwise() - port.x;
    rims.push_back(std::move(rim));
  }
  return rims;
}

/// Σ r·f over a rim's nodes, f nodal.
double virial(const RigidRim& rim, const VectorXd& f) {
  double sum = 0;
  for (std::size_t k = 0; k < rim.at.size(); ++k) sum += rim.r.col(static_cast<Eigen::Index>(k)).dot(f.segment<2>(rim.at[k]));
  return sum;
}

}  // namespace

std::vector<MatrixXd> foreshortening(const Component& c, const ReferenceConditions& conditions, const ModalModel& modes,
                                     const MatrixXd& loads) {
  return foreshortening_of_response(c, modes, static_response(c, conditions, loads));
}

std::vector<MatrixXd> foreshortening_of_response(const Component& c, const ModalModel& modes, const MatrixXd& response) {
  const MatrixXd& phi = modes.shapes;
  const MatrixXd u = nodal(c.model, response);
  const Assembler assembler(c.model);
  const std::vector<RigidRim> rims = rigid_rims(c.model);
  const MatrixXd force = rims.empty() ? MatrixXd() : assembler.stiffness() * u;
  std::vector<MatrixXd> all;
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    MatrixXd F = -phi.transpose() * (assembler.geometric_stiffness(u.col(k)) * phi);
    for (const RigidRim& rim : rims) {
      const Eigen::RowVectorXd turn = modes.ports.row(3 * rim.port + 2);
      F += virial(rim, force.col(k)) * turn.transpose() * turn;
    }
    all.push_back((F + F.transpose()) / 2);
  }
  return all;
}

Foreshortening inertia_foreshortening(const Component& c, const Sparse& M, const ReferenceConditions& conditions, const ModalModel& modes) {
  const RigidFields f = rigid_fields(c.model);
  MatrixXd loads(c.model.n(), 4);
  loads.col(0) = independent_load(c.model, M * f.T.col(0));
  loads.col(1) = independent_load(c.model, M * f.T.col(1));
  loads.col(2) = independent_load(c.model, M * f.x);
  loads.col(3) = independent_load(c.model, M * f.R);
  std::vector<MatrixXd> F = foreshortening(c, conditions, modes, loads);
  return {{std::move(F[0]), std::move(F[1])}, std::move(F[2]), std::move(F[3])};
}

std::vector<std::array<MatrixXd, 2>> port_foreshortening(const Component& c, const ReferenceConditions& conditions,
                                                         const ModalModel& modes) {
  const std::vector<Port>& ports = c.model.ports;
  MatrixXd loads = MatrixXd::Zero(c.model.n(), 2 * static_cast<Eigen::Index>(ports.size()));
  Eigen::Index column = 0;
  for (const Port& port : ports)
    for (int d = 0; d < 2; ++d) loads(port.dof[d], column++) = 1;
  std::vector<MatrixXd> F = foreshortening(c, conditions, modes, loads);
  std::vector<std::array<MatrixXd, 2>> out;
  for (std::size_t i = 0; i < ports.size(); ++i) out.push_back({std::move(F[2 * i]), std::move(F[2 * i + 1])});
  return out;
}

}  // namespace pintle
