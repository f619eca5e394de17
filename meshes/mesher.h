#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshes/gmsh.h"

/// Gmsh in a process of its own, `pintle-mesher`, which stands beside the modules (meshes/module.h). It crashes, hangs
/// and runs out of memory for itself alone, and can do nothing but read the drawing (meshes/confine.h).
namespace pintle {

/// What the mesher is to do, once its input is judged and needs Gmsh indeed.
struct MesherTask {
  std::optional<Link> link;  ///< or else `file`
  std::string file;          ///< a drawing or a mesh
  double scale = 1;
  MeshOptions options;
  std::string at;                    ///< the current folder
  std::vector<std::string> folders;  ///< where files may be read from
  bool unconfined = false;           ///< the user trusts the drawing
  double most_bytes = 0;             ///< of address space
};

/// The mesh that a process of its own makes.
/// @throws as mesh_link and read_geometry; MeshingStopped
Mesh mesh_elsewhere(const MesherTask&);

// What the two processes agree on. At its start the mesher says which version it is. A message is its length, 8 bytes,
// then as many; an answer's first byte is its kind. A task is worked on by a child of the mesher's, which has Gmsh
// loaded already; if that ends otherwise than by an answer, the mesher ends with the exit code it came to.
enum class Answer : char { mesh, invalid_argument, runtime_error, out_of_memory };
inline constexpr int killed_by = 128;  ///< exit codes from here on: by signal code − 128

}  // namespace pintle
