#pragma once

#include <Eigen/Core>

namespace pintle {

/// A point with a velocity and a spin, as a contact sees a body; world axes.
struct MovingPoint {
  Eigen::Vector2d r, v;  ///< [m], [m/s]
  double w;              ///< [rad/s]
};

/// A journal (disc of radius `journal`) inside a bearing (hole of radius `bearing`).
/// Eqs. (18)–(23) of Ebrahimi, Salahshoor, Moradi (2017).
struct JournalBearing {
  double journal, bearing;  ///< radii [m], journal < bearing
  double clearance() const { return bearing - journal; }
};

struct Gap {
  Eigen::Vector2d e;      ///< eccentricity: journal centre less bearing centre [m]
  Eigen::Vector2d n;      ///< unit, from bearing centre to journal centre; (1, 0) if concentric
  double depth;           ///< |e| − c, positive into contact [m]
  double rate;            ///< d(depth)/dt [m/s]
  double material_slip;   ///< of the journal's surface point over the bearing's, along Zn [m/s]
  double geometric_slip;  ///< the same with the bodies' spin left out, as Eq. (22): depth·(turning rate of n)
};

/// Cannot fail.
Gap evaluate(const JournalBearing&, const MovingPoint& journal, const MovingPoint& bearing);

}  // namespace pintle
