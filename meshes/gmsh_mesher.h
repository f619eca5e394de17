#pragma once

#include <filesystem>

#include "meshes/gmsh.h"

namespace pintle {

// What mesh_link and read_geometry say, in this process: once the input is judged and needs Gmsh indeed.
Mesh gmsh_link(const Link&, const MeshOptions&);
Mesh gmsh_geometry(const std::filesystem::path&, const MeshOptions&, double scale);

}  // namespace pintle
