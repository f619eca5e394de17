#pragma once

#include <filesystem>
#include <vector>

#include "meshes/link.h"
#include "meshes/mesh.h"

/// Meshes by Gmsh, which runs in a process of its own (meshes/mesher.h) and is loaded when it is first needed. Same
/// input, same mesh, to the bit. Threads that mesh at the same time have a process each. What meshing may take:
/// meshes/limits.h.
namespace pintle {

struct MeshOptions {
  CellShape shape = CellShape::triangle6;  ///< plane; quadrilaterals: no triangles among them
  double size = 0;                         ///< of a cell's side [m]; 0: a tenth of the square root of the area
  double hole_size = 0;                    ///< along holes [m]; 0: 24 sides go round, if smaller than `size`
  std::vector<Eigen::Vector2d> points;     ///< places that must become nodes, body axes [m]
};

/// Sizes grow by a quarter of the distance from holes, and from arcs of the outline where `size` is
/// more than a twelfth of the full circle. Bars and discs of quadrilaterals are cut by straight or
/// by radial and concentric lines; all else is meshed freely. Middle nodes of sides lie on the
/// arcs.
/// @throws std::invalid_argument  the link or the options are wrong, a point lies off the material
/// @throws std::runtime_error     Gmsh fails (its words), or would need more time or memory than it may
Mesh mesh_link(const Link&, const MeshOptions&);

/// A drawing (.geo, .step, .stp, .brep), meshed as asked, or a finished mesh (.msh), taken as it
/// is: of the options nothing counts then. In a .geo, sizes of the file's own hold where they are
/// smaller unless `size` is given, and its Transfinite stands. Lengths: a STEP file
/// says its unit and comes out in m; .geo, .brep and .msh have none. All are multiplied by `scale`
/// (0.001 for a .brep in millimetres; 1 for STEP).
///
/// Groups: physical points and curves, by name or else by number; a curve's sides have the body on
/// their left. A physical surface says what is the body (all surfaces if there is none), and its
/// name becomes a group. Closed loops of the outline that no physical curve touches become
/// "outline" or "hole 1", "hole 2", … by their centres from left to right, then from below.
/// A .geo file is a program. It may read files in `folder` (the drawing's own if empty), below it and where the user
/// trusts (files/trust.h), and do nothing else; what it tries beyond is refused.
/// @throws std::runtime_error     the file is not there, or Gmsh cannot read or mesh it (its words), or would need more
///     time or memory than it may
/// @throws std::invalid_argument  the file is not of the kind it is named; the geometry is not plane (z = 0), there is no surface in it, a
///     point lies off the material, or an option is wrong
Mesh read_geometry(const std::filesystem::path&, const MeshOptions&, double scale = 1, const std::filesystem::path& folder = {});

}  // namespace pintle
