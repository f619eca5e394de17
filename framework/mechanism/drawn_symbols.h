#pragma once

#include "framework/mechanism/drawing.h"

namespace pintle {

/// Index into Drawing::owners of the first joint, contact and force; the ground is the last owner.
struct FirstOwners {
  explicit FirstOwners(const System&);
  int joint, contact, force, of_ground;
};

/// Supports under pins that the ground holds, and strokes along its guides and surfaces where these are near the mechanism.
void draw_ground(const Model&, const Drafting&, const Equations&, Drawing&);

/// What holds the surfaces of a body together: bars from its first joint to the others and to the middle of each surface.
void draw_bars(const Model&, const Equations&, Drawing&);

/// Drivers of a length and forces along their line as barrel and rod, springs as coils, of angles as spirals.
struct DrawnActuator {
  enum Kind { cylinder, coil, spiral } kind;
  int a, b, owner;  ///< markers; into Drawing::owners
  double width;     ///< of a cylinder half of it, of a spiral its inner radius [m]
};
std::vector<DrawnActuator> actuators_of(const System&, const Drafting&);
void draw_actuators(const System&, const Drafting&, const Equations&, Drawing&);

/// Forces and couples of joints, springs and loads, each on the body that its columns name. Contacts draw their own.
void draw_reactions_and_loads(const System&, const Equations&, Drawing&);

/// The points of `output.points`, or where there are none the pins that move; and where each contact touches.
void follow_points(const Model&, const State&, const Equations&, Drawing&);

}  // namespace pintle
