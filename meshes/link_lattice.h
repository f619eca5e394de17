#pragma once

#include <optional>

#include "meshes/gmsh.h"

namespace pintle {

/// The link cut by two families of lines, where that is natural: bars and discs of quadrilaterals.
/// Lines run through the points that must become nodes; nothing is returned where that would make
/// fields much narrower than the size asked for, nor for other links and shapes.
/// @throws std::invalid_argument  a point lies outside the material
std::optional<Mesh> lattice_link(const Link&, const MeshOptions&);

}  // namespace pintle
