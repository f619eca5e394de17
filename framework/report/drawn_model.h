#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "framework/mechanism/drawing.h"

namespace pintle {

/// A flexible body to be drawn, and its shapes, one column each.
struct ShapedMesh {
  const Eigen::Matrix2Xd& points;  ///< undeformed [m]
  const std::vector<Cells>& cells;
  double size;                           ///< diagonal [m]
  const Eigen::MatrixXd& displacements;  ///< [x y] of all points
  const Eigen::MatrixXd* stresses;       ///< [σx σy τxy σz] likewise; nullptr: without
};

/// As a page draws it. @param bytes  limit; a larger mesh is thinned
nlohmann::ordered_json mesh_json(const ShapedMesh&, std::size_t bytes);

/// The colours of pictures: of bodies in the order of the scene, and of arrows by what gives them.
nlohmann::ordered_json palette_json();

/// The drawing of a mechanism on a page: outlines and meshes in body axes, and the positions of joints, contacts, springs and loads on
/// them. The motion comes from columns of trajectory.csv, found by the names of these elements.
/// @param mesh_bytes  limit for meshes and shapes of all flexible bodies together
nlohmann::ordered_json drawn_model_json(const Scene&, const Model&, std::size_t mesh_bytes);

/// Names of the columns, without units, for the positions of bodies and for the drawing.
std::vector<std::string> drawn_columns(const Model&);

}  // namespace pintle
