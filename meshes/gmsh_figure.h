#pragma once

#include <string>
#include <vector>

#include "meshes/mesh.h"
#include "meshes/sizes.h"

/// What is to be meshed, in Gmsh's current model and in its unit of length. @pre a GmshSession is
/// open
namespace pintle {

/// A plane figure in the current model.
struct Figure {
  std::string name;  ///< for messages
  std::vector<int> surfaces;
  std::vector<int> curves;        ///< of their boundaries, shared ones too, each once
  std::vector<Contour> contours;  ///< of them together, the largest first
  double span = 0;                ///< of the figure, in its own unit
};

/// The surfaces that are the body: those of physical groups, all if there are none. In dimension 1:
/// the curves.
std::vector<int> gmsh_body(int dim);
/// @throws std::invalid_argument  not in the plane z = 0, or nothing with an outline
Figure gmsh_figure(const std::string& name, const std::vector<int>& surfaces);

/// A place that must become a node: on a curve, moved there once curves are meshed; within,
/// embedded.
struct Pinned {
  Eigen::Vector2d at;
  int curve;
  double t;  ///< its parameter there
};

/// Embeds the points that lie within; returns those on curves.
/// @param points  in m, `scale` to the unit of the figure
/// @throws std::invalid_argument  a point in a hole or outside
std::vector<Pinned> gmsh_pin(const Figure&, const std::vector<Eigen::Vector2d>& points, double scale);
/// Once curves are meshed: the nearest node of the curve, itself no end of it, goes to each place.
void gmsh_move_nodes(const std::vector<Pinned>&, double span);
/// Makes room on the curves for nodes at those places, and between one and the next.
void gmsh_make_room(const Figure&, const std::vector<Pinned>&, SizeField&);

}  // namespace pintle
