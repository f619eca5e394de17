#pragma once

#include "framework/mechanism/model.h"

namespace pintle {

/// Profiles that start deep in each other are more likely a mistake than a contact; rigid ones cannot overlap at all.
/// @throws AssemblyError  naming the contact and by how much its surfaces overlap
void require_apart(const Scene&, const Model&, const State& start);

}  // namespace pintle
