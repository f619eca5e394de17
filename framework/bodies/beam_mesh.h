#pragma once

#include <string>
#include <vector>

#include "framework/scene/scene.h"
#include "meshes/mesh.h"

namespace pintle {

/// A beam's axis cut at all points of the body that lie on it. One point is one node, however often the axis passes it.
struct BeamAxis {
  std::vector<Eigen::Vector2d> corners;  ///< in the order of the path; a point passed twice stands here twice
  std::vector<int> node;                 ///< of each corner: equal where the axis comes back to a point
  std::vector<std::string> name;         ///< of the point at each corner
  double length() const;
  bool returns() const;  ///< some point is passed twice
};
/// @throws std::invalid_argument  two points that are passed lie at one place, or the axis runs twice between the same two
BeamAxis beam_axis(const Scene&, const SceneBody&, const SceneBeam&);
/// Where the axis meets itself without a point: it stays open there. One sentence for each place, at most three, and how many more.
std::vector<std::string> crossings(const BeamAxis&);

/// @throws as beam_axis
Mesh beam_mesh(const BeamAxis&, const SceneBeam&);

}  // namespace pintle
