#pragma once

#include "framework/mechanism/drawing.h"

namespace pintle {

/// What of a mechanism goes round or along something that does, by its markers; pictures and pages place it by their motion.
struct DrawnWheels {
  /// A pitch circle, a pulley or a disc that rolls, with a spoke that turns with it where it is not the ground's.
  struct Wheel {
    int marker;
    double radius;  ///< > 0 [m]
    Part part;
    int owner;  ///< into Drawing::owners
  };
  /// A belt between two pulleys, radii > 0 where it goes round counter-clockwise; nothing where they touch, as gears do.
  struct Span {
    int a, b;
    double radius_a, radius_b;
    Part part;
    int owner;
  };
  /// A rack, or what a disc rolls on: the line through a along its direction, near b.
  struct Line {
    int a, b, owner;
  };
  std::vector<Wheel> wheels;
  std::vector<Span> spans;
  std::vector<Line> lines;
};
DrawnWheels wheels_of(const System&);

/// The same at an instant. @pre eq has the motion
void draw_wheels(const System&, const Equations& eq, Drawing&);

}  // namespace pintle
