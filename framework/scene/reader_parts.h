#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "framework/scene/keys.h"
#include "framework/scene/yaml_node.h"

/// The reader, section by section. Each function reads one section of the root group into the
/// scene; all throw SceneError.
namespace pintle {

void read_bodies(const Node& root, Scene&);  ///< ground and bodies
void read_joints(const Node& root, Scene&);
void read_drivers(const Node& root, const std::filesystem::path& folder, Scene&);
void read_forces(const Node& root, const std::filesystem::path& folder, Scene&);
void read_start(const Node& root, Scene&);  ///< after bodies and joints
void read_run(const Node& root, Scene&);
void read_output(const Node& root, Scene&);  ///< after run

/// The name of a body, point, joint, driver or force: what a table's header and "body.point" can
/// bear.
std::string checked_name(const Node&);
/// "crank.A", "crank" or "ground".
PointRef read_point_ref(const Node&);
/// [a, b]
std::pair<PointRef, PointRef> read_ends(const Node&);

enum class Smoothness { driver, load };  ///< a driver needs two derivatives, a load only the value
/// An expression in t, or {table: file}; judged to be finite from 0 to `until`.
Law read_time_law(const Node&, const Dimension&, Smoothness, const std::filesystem::path& folder,
                  double until);

/// Reads `key` into `value` if it is there.
void read_optional(const Node& group, std::string_view key, const Dimension&, Rule, double& value);

/// The scene as JSON that the reader reads back to the same scene.
std::string filled_in(const Scene&, const Parameters&);

}  // namespace pintle
