#pragma once

#include <nlohmann/json.hpp>

#include "framework/scene/scene.h"

/// The scene as JSON, part by part, such that the reader reads back the same part.
namespace pintle {

using Json = nlohmann::ordered_json;

/// Appends without checking whether the name exists: names are unique, and a search would make a large scene quadratic.
void append(Json& object, const std::string& name, Json value);

Json json(const Pair&);
std::string json(const PointRef&);  ///< "crank.A"
Json ends(const PointRef& a, const PointRef& b);
Json json(const SceneMaterial&);  ///< as an entry of `materials`
Json json(const SceneElastic&);   ///< the body without points and pose
Json json(const SceneStatic&);
Json json(const SceneEvent&);
Json json(const SceneContact&);
Json json(const SceneClearance&);
Json json(const ScenePlay&);
Json json(const SceneFriction&, bool in_clearance);

}  // namespace pintle
