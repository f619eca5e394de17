#pragma once

#include "meshes/gmsh.h"

namespace pintle {

/// What the module `mesher` offers, the one that links Gmsh: that of meshes/gmsh.h once the input is judged and
/// needs Gmsh indeed.
struct Mesher {
  const char* version;
  Mesh (*link)(const Link&, const MeshOptions&);
  Mesh (*geometry)(const std::filesystem::path&, const MeshOptions&, double scale);
};

}  // namespace pintle
