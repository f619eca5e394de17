#pragma once

#include <string>

#include "meshes/mesh.h"

namespace pintle {

/// The mesh of Gmsh's current model: cells of the body, groups from the physical ones, loops named, cells oriented counter-clockwise,
/// unused nodes removed; lengths times `scale`. Nodes in the order of their numbers.
/// @pre a GmshSession is open
/// @throws std::invalid_argument  a node outside the plane z = 0, a cell of an unknown kind
Mesh gmsh_extract(const std::string& name, double scale);

}  // namespace pintle
