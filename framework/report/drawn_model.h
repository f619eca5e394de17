#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "framework/mechanism/drawing.h"

namespace pintle {

/// What a page draws of a mechanism: outlines and meshes in the axes of bodies, and where joints, contacts, springs and loads sit on
/// them. The motion comes from columns of trajectory.csv, found by the names of these things.
/// @param mesh_bytes  that meshes and shapes of all flexible bodies may take together
nlohmann::ordered_json drawn_model_json(const Scene&, const Model&, std::size_t mesh_bytes);

/// Names of the columns, without units, that place the bodies and make what is drawn.
std::vector<std::string> drawn_columns(const Model&);

/// The columns, without units, that no drawing can do without.
std::vector<std::string> needed_columns(const Model&);

}  // namespace pintle
