#pragma once

#include <filesystem>
#include <vector>

#include "meshes/link.h"
#include "meshes/mesh.h"

/// The one pair of files that knows Gmsh.
namespace pintle {

struct MeshOptions {
  CellShape shape = CellShape::triangle6;  ///< plane
  double size = 0;       ///< of a cell's side [m]; 0: a tenth of the square root of the area, or the file's own
  double hole_size = 0;  ///< the same along holes [m]; 0: such that 24 sides go round, if smaller than `size`
  std::vector<Eigen::Vector2d> points;  ///< places that must become nodes, body axes [m]
};

/// @throws std::invalid_argument  the link or the options are wrong; std::runtime_error: Gmsh fails
Mesh mesh_link(const Link&, const MeshOptions&);

/// A drawing (.geo, .step, .stp, .brep), meshed as asked, or a finished mesh (.msh). Lengths in m times
/// `scale`. Physical curves and points become groups; a physical surface says what is the body (all
/// surfaces if there is none), and its name becomes a group.  In a drawing without physical curves each
/// closed loop inside the outline becomes the group "hole 1", "hole 2", … by its centre from left to
/// right, then from below; the outline becomes "outline".
/// @throws std::runtime_error     the file is not there, or Gmsh cannot read or mesh it (its words)
/// @throws std::invalid_argument  the geometry is not plane (z = 0), or there is no surface in it
Mesh read_geometry(const std::filesystem::path&, const MeshOptions&, double scale = 1);

}  // namespace pintle
