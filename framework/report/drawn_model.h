#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "framework/mechanism/drawing.h"

namespace pintle {

/// The mesh of a flexible body with the displacements and stresses of its shapes. @param bytes  limit; a larger mesh is thinned
nlohmann::ordered_json mesh_json(const FlexibleDrawing&, std::size_t bytes);

/// The colours of pictures: of bodies in the order of the scene, and of arrows by what gives them.
nlohmann::ordered_json palette_json();

/// The drawing of a mechanism on a page: outlines and meshes in body axes, and the positions of joints, contacts, springs and loads on
/// them. The motion comes from columns of trajectory.csv, found by the names of these elements.
/// @param mesh_bytes  limit for meshes and shapes of all flexible bodies together
nlohmann::ordered_json drawn_model_json(const Scene&, const Model&, std::size_t mesh_bytes);

/// Names of the columns, without units, for the positions of bodies and for the drawing.
std::vector<std::string> drawn_columns(const Model&);

}  // namespace pintle
