#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshes/mesh.h"

namespace pintle {

/// Data of the body in an input file beyond its mesh, in the file's units. They are not used, since the scene gives them too.
struct InpClaims {
  struct Value {
    double value;
    std::string where;  ///< "part.inp:12"
  };
  std::string strain;       ///< place of an element of plane strain; empty: none
  std::string directional;  ///< place of a non-isotropic material; empty: none
  std::vector<Value> thickness, young, poisson;
  std::vector<std::string> warnings;  ///< ignored cards
};

/// A CalculiX or Abaqus input file. It reads *NODE, *ELEMENT, *NSET and *ELSET (with GENERATE, and by names of other sets), *SURFACE of
/// element sides or of nodes, and *INCLUDE. Keywords, parameters and set names in any case, comments, continued lines. Cards that would
/// change the body are rejected; InpClaims reports those whose data the scene gives.
///
/// Elements: plane stress and plane strain (CPS, CPE), shells and membranes in the plane (S, STRI, M3D), with 3, 4, 6, 8 and 9 nodes, with
/// any following letters (R, I, H, …): the name gives the shape, and plane strain is reported in the claims. If there are none of these:
/// beams and trusses (B, T) with 2 and 3 nodes. With plane elements, lines along the outline are edges, not cells; those with their own
/// section are rejected.
///
/// Groups: for each node set its nodes; for each element set its nodes, and its sides if it consists of lines; for each surface its sides,
/// with the body to their left. Sets with the same name become one group. Sides of a surface are S1 … S4 for CPS, CPE and M3D; E1 … E4, or
/// CalculiX's S3 … S6, for shells; without a label the free sides of the set. A group that no cell touches is omitted; closed loops of the
/// outline that no group's side touches become "outline", "hole 1", … as in read_geometry.
///
/// Lengths in m times `scale`: 0.001 for a file in millimetres. *INCLUDE reads from `folder` (the file's own if empty), below it and in
/// folders that the user trusts (files/trust.h).
/// @param claims  receives further data in the file
/// @throws std::runtime_error     the file (or one it includes) cannot be read
/// @throws std::invalid_argument  file:line: what is wrong there and how to correct it
Mesh read_inp(const std::filesystem::path&, double scale = 1, const std::filesystem::path& folder = {}, InpClaims* claims = nullptr);

}  // namespace pintle
