#pragma once

#include <string>

#include "meshes/mesh.h"

namespace pintle {

/// The mesh in Gmsh's current model: cells of the body, groups from the physical ones, loops named,
/// cells turned counter-clockwise, unused nodes dropped; lengths times `scale`. Nodes in the order
/// of their numbers.
/// @pre a GmshSession is open
/// @throws std::invalid_argument  a node off the plane z = 0, a cell of a kind not known here
Mesh gmsh_extract(const std::string& name, double scale);

}  // namespace pintle
