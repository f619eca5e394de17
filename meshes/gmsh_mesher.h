#pragma once

#include <filesystem>

#include "meshes/gmsh.h"

namespace pintle {

// The work of mesh_link and read_geometry, in this process: for input that has been checked and needs Gmsh.
Mesh gmsh_link(const Link&, const MeshOptions&);
Mesh gmsh_geometry(const std::filesystem::path&, const MeshOptions&, double scale);

}  // namespace pintle
