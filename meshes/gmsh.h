#pragma once

#include <filesystem>
#include <vector>

#include "meshes/link.h"
#include "meshes/mesh.h"

/// Meshes by Gmsh, which runs in a separate process (meshes/mesher.h) and is loaded when first needed. The same input gives the same mesh,
/// to the bit. Threads that mesh at the same time have one process each. Limits of time and memory: meshes/limits.h.
namespace pintle {

struct MeshOptions {
  CellShape shape = CellShape::triangle6;  ///< plane; for quadrilaterals: without triangles
  double size = 0;                         ///< of a cell's side [m]; 0: a tenth of the square root of the area
  double hole_size = 0;                    ///< along holes [m]; 0: 24 sides around each, if that is smaller than `size`
  std::vector<Eigen::Vector2d> points;     ///< points that must become nodes, body axes [m]
};

/// Sizes grow by a quarter of the distance from holes, and from arcs of the outline where `size` is more than a twelfth of the full circle.
/// Bars and discs of quadrilaterals are divided by straight lines or by radial and concentric lines; everything else is meshed freely.
/// Middle nodes of sides lie on the arcs.
/// @throws std::invalid_argument  the link or the options are invalid, a point is outside the material
/// @throws std::runtime_error     Gmsh fails (its message), or would exceed its limits of time or memory
Mesh mesh_link(const Link&, const MeshOptions&);

/// A drawing (.geo, .step, .stp, .brep), meshed as requested, or a finished mesh (.msh), used unchanged: then the options have no effect.
/// In a .geo, smaller sizes in the file apply unless `size` is given, and its Transfinite is kept. Lengths: a STEP file contains its unit
/// and is converted to m; .geo, .brep and .msh have none. All are multiplied by `scale` (0.001 for a .brep in millimetres; 1 for STEP).
///
/// Groups: physical points and curves, by name or else by number; a curve's sides have the body to their left. A physical surface defines
/// the body (all surfaces if there is none), and its name becomes a group. Closed loops of the outline that no physical curve touches
/// become "outline" or "hole 1", "hole 2", … ordered by their centres from left to right, then from below.
/// A .geo file is a program. It may read files in `folder` (the drawing's own if empty), below it and in folders that the user trusts
/// (files/trust.h), and do nothing else; anything else is rejected.
/// @throws std::runtime_error     the file does not exist, or Gmsh cannot read or mesh it (its message), or would exceed its limits of time
/// or memory
/// @throws std::invalid_argument  the file is not of the kind its name says; the geometry is not plane (z = 0) or has no surface, a point
/// is outside the material, or an option is invalid
Mesh read_geometry(const std::filesystem::path&, const MeshOptions&, double scale = 1, const std::filesystem::path& folder = {});

}  // namespace pintle
