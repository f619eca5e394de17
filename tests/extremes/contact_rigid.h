#pragma once

#include "tests/extremes/atlas.h"

namespace extremes {

/// Bodies that do not give way where they touch: friction angle, dry friction, many contacts at once, corners, thin plates, thin bodies.
Atlas axes_of_rigid_bodies();

}  // namespace extremes
