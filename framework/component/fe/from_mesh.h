#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/component/fe/fe_model.h"
#include "meshes/mesh.h"

/// Converts a mesh into elements and rims.
namespace pintle {

/// Names of plane elements: those of their cells, "quadrilateral4-plain" and
/// "quadrilateral8-reduced".
const std::vector<std::string>& element_names();

/// A block for each shape of cell of a plane mesh. `element`: empty for the default of the shape (quadrilateral4 with incompatible modes,
/// quadrilateral8 with 3 × 3 points); otherwise the element for cells of its shape. With a quadrilateral's name, triangles of the same
/// order are allowed among the cells.
/// @throws std::invalid_argument  no element has this name; the cells are of other shapes, or lines; density or thickness is not positive
std::vector<AnyBlock> plane_blocks(const Mesh&, const PlaneProperties&, std::string_view element);

/// Length of rim that belongs to each node of a group, in the order of `rim.nodes` [m]: ∫ N_i ds along its sides, so that the weighted mean
/// of a nodal field is its mean along the rim.
/// @throws std::invalid_argument  the group has no sides, or a node without one
std::vector<double> rim_weights(const Mesh&, const Group& rim);

}  // namespace pintle
