#pragma once

#include "framework/scene/scene.h"

namespace pintle {

/// Replaces each beam of N > 1 pieces by bodies "NAME 1" … "NAME N" of equal length along the beam,
/// welded to each other by joints "NAME 1-2" …, so that each bends little in a floating frame of
/// its own. A piece has the axes, pose and start of the whole, and its material, theory, damping,
/// stiffening and modes (a frame tied to points that are not all on the piece is tied to its ends).
/// Sections at a cut are those of the taper there; elements are shared, each piece having one at
/// least; a given mass is shared by volume; lumps and supports stay at their points.
///
/// A named point belongs to the piece in which it lies, at a cut to the first of the two, and what
/// named it names that piece's from then on; what named the body alone, the piece that has the
/// point at the origin of its axes. At the other side of a cut stands a point "cut K".
/// A static case of the beam goes, for it has the whole body in mind. A scene without such a beam
/// comes back as it is.
/// @throws SceneError  a beam of bars or without modes; one that passes a point twice, or has a
///                     point off its axis; a joint, driver, force or output that names a point the
///                     beam lacks, or the body alone without a point at the origin; both ends of
///                     one on the same beam; a name that a piece or weld needs
Scene with_pieces(Scene);

}  // namespace pintle
