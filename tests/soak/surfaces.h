#pragma once

#include <cstdint>

#include "tests/soak/drawn.h"

namespace soak {

/// From this seed on bodies have surfaces that touch.
inline constexpr std::uint64_t first_with_surfaces = 1'000'000;

/// Gives rigid bodies discs and polygons, the ground a floor, and pairs of them contacts.
void add_surfaces(Drawn&, Chance&);

}  // namespace soak
