#pragma once

#include "framework/mechanism/drawing.h"

namespace pintle {

/// Index into Drawing::owners of the first joint, contact and force; the ground is the last owner.
struct FirstOwners {
  explicit FirstOwners(const System&);
  int joint, contact, force, of_ground;
};

/// Supports under pins on the ground, and strokes along its guides and surfaces near the mechanism.
void draw_ground(const Model&, const Drafting&, const Equations&, Drawing&);

/// Connections between the surfaces of a body: bars from its first joint to the others and to the middle of each surface.
void draw_bars(const Model&, const Equations&, Drawing&);

/// Length drivers and forces along their line as barrel and rod, springs as coils, angular ones as spirals.
struct DrawnActuator {
  enum Kind { cylinder, coil, spiral } kind;
  int a, b, owner;  ///< markers; index into Drawing::owners
  double width;     ///< of a cylinder half its width, of a spiral its inner radius [m]
};
std::vector<DrawnActuator> actuators_of(const System&, const Drafting&);
void draw_actuators(const System&, const Drafting&, const Equations&, Drawing&);

/// Forces and couples of joints, springs and loads, each on the body that its columns name. Contacts draw their own.
void draw_reactions_and_loads(const System&, const Equations&, Drawing&);

/// The points of `output.points`, or if there are none, the moving pins (if at most 12); and the point of each contact.
void follow_points(const Model&, const State&, const Equations&, Drawing&);

}  // namespace pintle
