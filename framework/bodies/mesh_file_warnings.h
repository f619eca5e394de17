#pragma once

#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "meshes/inp.h"

/// Where a mesh file and the scene may not mean the same body.
namespace pintle {

/// What the file says of thickness, material and plane state beside what the scene says. Adds to the warnings.
/// @throws std::invalid_argument  elements of plane strain, and the scene does not say `plane`
void validate_claims(const InpClaims&, const ScenePlate&, std::vector<std::string>& warnings);

/// A body read without a unit that is far larger than bodies are, or a thousand times the rest of the scene; empty: no doubt.
std::string size_warning(const Scene&, const ElasticBody&);

}  // namespace pintle
