#pragma once

#include <string>
#include <vector>

#include "framework/scene/scene.h"
#include "meshes/mesh.h"

namespace pintle {

/// A beam's axis, divided at all points of the body that lie on it. A point is a single node even if the axis passes it several times.
struct BeamAxis {
  std::vector<Eigen::Vector2d> corners;  ///< in the order of the path; a point passed twice is listed twice
  std::vector<int> node;                 ///< of each corner: equal where the axis returns to a point
  std::vector<std::string> name;         ///< of the point at each corner
  double length() const;
  bool returns() const;  ///< whether a point is passed twice
};
/// @throws std::invalid_argument  two points on the path coincide, or the axis runs twice between the same two points
BeamAxis beam_axis(const Scene&, const SceneBody&, const SceneBeam&);
/// Warnings where the axis crosses itself without a point, so that the pieces are not joined: one sentence per place, at most three, and
/// the number of the rest.
std::vector<std::string> crossings(const BeamAxis&);

/// @throws as beam_axis
Mesh beam_mesh(const BeamAxis&, const SceneBeam&);

}  // namespace pintle
