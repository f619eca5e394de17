#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meshes/gmsh.h"

/// Gmsh in a separate process, `pintle-mesher`, which is located next to the modules (meshes/module.h). A crash, a hang or lack of memory
/// there does not affect this process, and it can only read the drawing (meshes/confine.h).
namespace pintle {

/// Task for the mesher, for input that has been checked and needs Gmsh.
struct MesherTask {
  std::optional<Link> link;  ///< otherwise `file`
  std::string file;          ///< a drawing or a mesh
  double scale = 1;
  MeshOptions options;
  std::string at;                    ///< the current folder
  std::vector<std::string> folders;  ///< where files may be read from
  bool unconfined = false;           ///< the user trusts the drawing
  double most_bytes = 0;             ///< of address space
};

/// The mesh made by a separate process.
/// @throws as mesh_link and read_geometry; MeshingStopped
Mesh mesh_elsewhere(const MesherTask&);

// Protocol of the two processes. At its start the mesher sends its version. A message is its length, 8 bytes, followed by that many bytes;
// the first byte of an answer is its kind. A task is executed by a child of the mesher, which has Gmsh loaded already; if the child ends
// without an answer, the mesher ends with the child's exit code.
enum class Answer : char { mesh, invalid_argument, runtime_error, out_of_memory };
inline constexpr int killed_by = 128;  ///< exit codes from here on: killed by signal code − 128

}  // namespace pintle
