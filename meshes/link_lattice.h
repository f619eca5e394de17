#pragma once

#include <optional>

#include "meshes/gmsh.h"

namespace pintle {

/// The link divided by two families of lines, if its shape suggests it: bars and discs of quadrilaterals. Lines run through the points that
/// must become nodes; returns nothing where that would make cells much narrower than the requested size, and for other links and shapes.
/// @throws std::invalid_argument  a point is outside the material
std::optional<Mesh> lattice_link(const Link&, const MeshOptions&);

}  // namespace pintle
