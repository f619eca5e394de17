#pragma once

#include "exact_beam.h"

#include <Eigen/SparseCore>

#include <array>
#include <string>
#include <vector>

/// The discrete equations of the exact beam, M ü + f(u) = load, for its statics and its runs.
namespace pintle_oracle {

using BeamVector = Eigen::VectorXd;
using BeamSparse = Eigen::SparseMatrix<double>;
/// Of an element, of degree 3 at most.
using ElementMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;

/// Values and derivatives, over ξ in [0, 1], of an element's shape functions at a point.
struct ShapeValues {
  std::array<double, 4> value{}, slope{};
  double weight = 0;
};
ShapeValues shape_at(int degree, double xi, double weight);

/// The mesh; u = T z + g(t), z the free coordinates from A to B, g what the ends prescribe.
struct BeamMesh {
  const ExactBeam& beam;
  int nodes, free, width;  ///< width: of the band of a matrix over z
  double l;                ///< of an element
  std::vector<ShapeValues> points;
  BeamSparse T, M, Mz;            ///< M over u with the ends' points, Mz = TᵀMT
  BeamVector load;                ///< gravity and dead loads, over u
  std::vector<ElementMatrix> Te;  ///< an element's rows of T
  std::vector<int> first;         ///< and the first of its free coordinates
  SectionMotion rest[2];          ///< of the ends at the start
};

/// @throws std::invalid_argument for a beam that cannot be or a start off its supports.
BeamMesh build(const ExactBeam&, const BeamStart& start);

/// g, ġ or g̈ at t, chosen by `part`.
BeamVector held(const BeamMesh&, double t, Place SectionMotion::*part);

struct StartCoordinates {
  BeamVector z, rate;
};
StartCoordinates initial(const BeamMesh&, const BeamStart& start);

/// f over u; where asked for, each element's tangent over z.
struct Internal {
  BeamVector force;
  double energy;
  std::vector<ElementMatrix> tangents;
};
Internal internal(const BeamMesh&, const BeamVector& u, bool with_tangents);

/// Greatest displacement by the length, or turn; infinite if dz is not finite.
double size_of_step(const BeamMesh&, const BeamVector& dz);

/// A value as messages print it.
std::string text(double value);

}  // namespace pintle_oracle
