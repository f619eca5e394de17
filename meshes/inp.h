#pragma once

#include <filesystem>

#include "meshes/mesh.h"

namespace pintle {

/// A CalculiX or Abaqus input file. Read are *NODE, *ELEMENT, *NSET and *ELSET (with GENERATE, and
/// by the names of other sets), *SURFACE of element sides or of nodes, and *INCLUDE. Keywords,
/// parameters and set names in any case, comments, continued lines. Everything else (materials,
/// steps) is passed over.
///
/// Elements: plane stress and plane strain (CPS, CPE), shells and membranes lying in the plane (S,
/// STRI, M3D), of 3, 4, 6, 8 and 9 nodes, whatever letters follow (R, I, H, …): the name gives the
/// shape alone. If there is none of these: beams and trusses (B, T) of 2 and 3 nodes. Beside plane
/// elements lines along the outline are edges, not cells.
///
/// Groups: each node set its nodes; each element set its nodes, and its sides if it is made of
/// lines; each surface its sides, the body on their left. What has one name becomes one group.
/// Sides of a surface are S1 … S4 of CPS, CPE and M3D; E1 … E4, or CalculiX's S3 … S6, of shells;
/// without label the free sides of the set. A group that no cell touches is left out; closed loops
/// of the outline that no group's side touches become "outline", "hole 1", … as in read_geometry.
///
/// Lengths in m times `scale`: 0.001 for a file in millimetres. *INCLUDE reads from `folder` (the file's own if
/// empty), from below it and where the user trusts (files/trust.h).
/// @throws std::runtime_error     the file (or one it includes) cannot be read
/// @throws std::invalid_argument  file:line: what is wrong there and what would be right
Mesh read_inp(const std::filesystem::path&, double scale = 1, const std::filesystem::path& folder = {});

}  // namespace pintle
