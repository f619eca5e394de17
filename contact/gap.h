#pragma once

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// A point with a velocity and a spin, as a contact sees a body; world axes.
struct MovingPoint {
  Eigen::Vector2d r, v;  ///< [m], [m/s]
  double w;              ///< [rad/s]
};

/// A journal (disc of radius `journal`) inside a bearing (hole of radius `bearing`).
/// Eqs. (18)–(23) of Ebrahimi, Salahshoor, Moradi (2017); theory: docs/theory/contact.md.
/// Contact acts at each body's own surface, centre + radius · n, so the two points are `depth`
/// apart.
struct JournalBearing {
  double journal, bearing;  ///< radii [m], journal < bearing
  double clearance() const { return bearing - journal; }
};

/// Where the two bodies stand to each other; Z is the quarter turn [0 −1; 1 0].
/// A force −N n + T Zn on the journal's surface point and its opposite on the bearing's give the
/// two bodies the power −N · rate + T · material_slip.
struct Gap {
  Eigen::Vector2d e;      ///< eccentricity: journal centre less bearing centre [m]
  Eigen::Vector2d n;      ///< unit, from bearing centre to journal centre; (1, 0) if concentric
  double depth;           ///< |e| − c, positive into contact [m]
  double rate;            ///< d(depth)/dt [m/s]
  double material_slip;   ///< of the journal's surface point over the bearing's, along Zn [m/s]
  double geometric_slip;  ///< that of the wandering contact points, as Eq. (22): depth · (turning
                          ///< rate of n); 0 if concentric [m/s]
};

/// Cannot fail.
Gap evaluate(const JournalBearing&, const MovingPoint& journal, const MovingPoint& bearing);

}  // namespace pintle
