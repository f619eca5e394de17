#pragma once

#include "framework/scene/scene.h"

namespace pintle {

/// Replaces each beam of N > 1 pieces by bodies "NAME 1" … "NAME N" of equal length along the beam, welded to each other by joints "NAME
/// 1-2" …, so that each bends little in its own floating frame. A piece has the axes, pose and start of the whole, and its material,
/// theory, damping, stiffening and modes (reference conditions at points that are not all on the piece are moved to its ends). Sections at
/// a cut are those of the taper there; elements are distributed, at least one per piece; a given mass is distributed by volume; lumps and
/// supports stay at their points.
///
/// A named point belongs to the piece on which it lies, at a cut to the first of the two; references to it then refer to that piece.
/// References to the body alone refer to the piece with the point at the origin of its axes. The other side of a cut gets a point "cut K".
/// A static case of the beam is removed, since it refers to the whole body. A scene without such a beam is returned unchanged.
/// @throws SceneError  a beam of bars or without modes; one that passes a point twice, or has a point off its axis; a joint, driver, force
/// or output that names a point the beam lacks, or the body alone without a point at the origin; both ends of one on the same beam; a name
/// that a piece or weld needs
Scene with_pieces(Scene);

}  // namespace pintle
