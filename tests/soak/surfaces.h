#pragma once

#include <cstdint>
#include <string>

#include "tests/soak/drawn.h"

namespace soak {

/// From this seed on bodies have surfaces that touch.
inline constexpr std::uint64_t first_with_surfaces = 1'000'000;
/// From this one on these do not give way, and every other run is by Moreau's steps.
inline constexpr std::uint64_t first_rigid = 2'000'000;

/// Gives rigid bodies discs and polygons, the ground a floor, and pairs of them contacts.
void add_surfaces(Drawn&, Chance&);
/// The words of a rigid contact: its law of impact and its friction.
std::string rigid_laws(const Drawn&, Chance&);

}  // namespace soak
