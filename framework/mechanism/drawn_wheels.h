#pragma once

#include "framework/mechanism/drawing.h"

namespace pintle {

/// Wheels, and the belts and racks along them, by their markers; pictures and pages place them by the motion of these.
struct DrawnWheels {
  /// A pitch circle, a pulley or a rolling disc, with a spoke that shows its rotation unless it belongs to the ground.
  struct Wheel {
    int marker;
    double radius;  ///< > 0 [m]
    Part part;
    int owner;  ///< index into Drawing::owners
  };
  /// A belt between two pulleys, with radii > 0 where it runs counter-clockwise; nothing where the circles touch, as for gears.
  struct Span {
    int a, b;
    double radius_a, radius_b;
    Part part;
    int owner;
  };
  /// A rack, or the line that a disc rolls on: through a along its direction, near b.
  struct Line {
    int a, b, owner;
  };
  std::vector<Wheel> wheels;
  std::vector<Span> spans;
  std::vector<Line> lines;
};
DrawnWheels wheels_of(const System&);

/// Draws them at an instant. @pre eq has the motion
void draw_wheels(const System&, const Equations& eq, Drawing&);

}  // namespace pintle
