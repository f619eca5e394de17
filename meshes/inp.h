#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// What an input file says of the body beyond its mesh, in the file's units. None of it is used: the scene says it too.
struct InpClaims {
  struct Value {
    double value;
    std::string where;  ///< "part.inp:12"
  };
  std::string strain;       ///< where an element of plane strain is; empty: there is none
  std::string directional;  ///< where a material is not isotropic; empty: nowhere
  std::vector<Value> thickness, young, poisson;
  std::vector<std::string> warnings;  ///< cards that are passed over
};

/// A CalculiX or Abaqus input file. Read are *NODE, *ELEMENT, *NSET and *ELSET (with GENERATE, and
/// by the names of other sets), *SURFACE of element sides or of nodes, and *INCLUDE. Keywords,
/// parameters and set names in any case, comments, continued lines. Of the rest, cards that make
/// another body are refused, and InpClaims tells of those that the scene answers.
///
/// Elements: plane stress and plane strain (CPS, CPE), shells and membranes lying in the plane (S,
/// STRI, M3D), of 3, 4, 6, 8 and 9 nodes, whatever letters follow (R, I, H, …): the name gives the
/// shape, and that it is plane strain is among the claims. If there is none of these: beams and
/// trusses (B, T) of 2 and 3 nodes. Beside plane elements lines along the outline are edges, not
/// cells; those with a section of their own are refused.
///
/// Groups: each node set its nodes; each element set its nodes, and its sides if it is made of
/// lines; each surface its sides, the body on their left. What has one name becomes one group.
/// Sides of a surface are S1 … S4 of CPS, CPE and M3D; E1 … E4, or CalculiX's S3 … S6, of shells;
/// without label the free sides of the set. A group that no cell touches is left out; closed loops
/// of the outline that no group's side touches become "outline", "hole 1", … as in read_geometry.
///
/// Lengths in m times `scale`: 0.001 for a file in millimetres. *INCLUDE reads from `folder` (the file's own if
/// empty), from below it and where the user trusts (files/trust.h).
/// @param claims  gets what else the file says
/// @throws std::runtime_error     the file (or one it includes) cannot be read
/// @throws std::invalid_argument  file:line: what is wrong there and what would be right
Mesh read_inp(const std::filesystem::path&, double scale = 1, const std::filesystem::path& folder = {}, InpClaims* claims = nullptr);

}  // namespace pintle
