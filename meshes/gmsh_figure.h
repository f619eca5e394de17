#pragma once

#include <string>
#include <vector>

#include "meshes/mesh.h"
#include "meshes/sizes.h"

/// The figure to be meshed, in Gmsh's current model and its unit of length. @pre a GmshSession is open
namespace pintle {

/// A plane figure in the current model.
struct Figure {
  std::string name;  ///< for messages
  std::vector<int> surfaces;
  std::vector<int> curves;        ///< of their boundaries, each once even if shared
  std::vector<Contour> contours;  ///< of all together, the largest first
  double span = 0;                ///< size of the figure, in its own unit
};

/// The surfaces of the body: those of physical groups, or all if there are none. In dimension 1: the curves.
std::vector<int> gmsh_body(int dim);
/// @throws std::invalid_argument  not in the plane z = 0, or without an outline
Figure gmsh_figure(const std::string& name, const std::vector<int>& surfaces);

/// A point that must become a node: if it is on a curve, a node is moved there once curves are meshed; inside, it is embedded.
struct Pinned {
  Eigen::Vector2d at;
  int curve;
  double t;  ///< its parameter on the curve
};

/// Embeds the points inside; returns those on curves.
/// @param points  in m, `scale` converts to the unit of the figure
/// @throws std::invalid_argument  a point in a hole or outside
std::vector<Pinned> gmsh_pin(const Figure&, const std::vector<Eigen::Vector2d>& points, double scale);
/// Once curves are meshed: moves the nearest node of the curve, except its ends, to each point.
void gmsh_move_nodes(const std::vector<Pinned>&, double span);
/// Makes the curves fine enough for separate nodes at these points.
void gmsh_make_room(const Figure&, const std::vector<Pinned>&, SizeField&);

}  // namespace pintle
