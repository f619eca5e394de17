#pragma once

#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "meshes/inp.h"

/// Warnings where a mesh file and the scene may not describe the same body.
namespace pintle {

/// Compares thickness, material and plane state in the file with those in the scene. Adds to the warnings.
/// @throws std::invalid_argument  elements of plane strain, and the scene does not give `plane`
void validate_claims(const InpClaims&, const ScenePlate&, std::vector<std::string>& warnings);

/// Warning for a body read without a unit that is unusually large, or a thousand times the rest of the scene; empty: no doubt.
std::string size_warning(const Scene&, const ElasticBody&);

}  // namespace pintle
