#pragma once

#include <filesystem>

#include "framework/bodies/elastic_body.h"
#include "framework/scene/error.h"

/// Shared by the files that create an elastic body: look-up by name, with errors that list the existing names.
namespace pintle {

inline Eigen::Vector2d vector(const Pair& p) { return {p[0], p[1]}; }
std::string shown(const Eigen::Vector2d&);  ///< "(0.1, 0) m"

inline const SceneBeam* beam_of(const SceneBody& body) { return std::get_if<SceneBeam>(&body.elastic->shape); }
inline const ScenePlate& plate_of(const SceneBody& body) { return std::get<ScenePlate>(body.elastic->shape); }
std::string kind_of(const std::filesystem::path&);  ///< extension in lower case: ".inp"
bool is_finished_mesh(const ScenePlate&);           ///< read from .msh or .inp: its nodes are fixed

/// @throws SceneError  there is no such point; names the nearest or lists all
const ScenePoint& point_of(const Scene&, const SceneBody&, const std::string& name, const Place&);
std::vector<std::string> group_names(const Mesh&);
/// @throws SceneError  likewise for a group; `remedy` is used for a mesh without groups
const Group& group_of(const Scene&, const Mesh&, const std::string& name, const Place&, const std::string& remedy);
/// The sides along a group, found by its nodes if the mesh does not list them.
std::vector<Cells> sides_of(const Mesh&, const Group&);

}  // namespace pintle
