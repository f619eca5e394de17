#pragma once

#include "framework/drawing/vtk.h"
#include "framework/integration/events/impact.h"
#include "framework/mechanism/model.h"

namespace pintle {

/// Data that are the same in all frames: outlines in body axes, the exaggeration of clearances.
struct Drafting {
  Drafting(const Scene&, const Model&);
  std::vector<std::string> owners;                  ///< as in Drawing
  std::vector<std::optional<Rgb>> colours = {};     ///< as in Drawing
  std::vector<std::vector<Eigen::Vector2d>> links;  ///< closed outlines, body axes
  double pin = 0;                                   ///< radius of a joint's circle [m]
  double exaggeration = 1;                          ///< of clearances
  double deformation = 1;                           ///< of flexible bodies
};

/// The mechanism at an instant: links, joints, the ground, journal and bearing circles, springs, cylinders, all forces.
/// @pre eq was evaluated at `state`
Drawing draw(const Model&, const Drafting&, const State&, const Equations&);

std::vector<DrawnImpact> drawn_impacts(const std::vector<Impact>&);

/// Names of the columns of trajectory.csv, without units, that place the bodies of a drawing.
std::vector<std::string> pose_columns(const Model&);

}  // namespace pintle
