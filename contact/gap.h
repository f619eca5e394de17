#pragma once

#include <array>
#include <limits>
#include <memory>

#include <Eigen/Core>

#include "contact/curve.h"
#include "eigen_layout.h"

namespace pintle {

/// A point with a velocity and a spin, as a contact sees a body; world axes.
struct MovingPoint {
  Eigen::Vector2d r, v;  ///< [m], [m/s]
  double w;              ///< [rad/s]
  double angle = 0;      ///< of the axes that it carries [rad]
};

/// A piece of a body's surface: an arc, of radius 0 a corner, a straight line, or a span of a curve; in the axes of the point that
/// carries it.
/// Normals point out of the material; the surface goes on with the material at its left.
struct Piece {
  double radius = 0;                                      ///< of an arc, < 0 where it is hollow; of a line or curve 0 [m]
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();       ///< of the arc; of a line its middle; of a curve 0 [m]
  double normal = 0;                                      ///< direction of the normal in the middle of the piece [rad]
  double half = std::numeric_limits<double>::infinity();  ///< half its extent: of an arc [rad], of a line [m]; infinite: a circle
  bool straight = false;
  std::shared_ptr<const CurveSpan> curve = {};  ///< then `half` is half the length of its chords [m]
};
inline bool is_corner(const Piece& p) { return p.radius == 0 && !p.straight && !p.curve; }
inline bool is_hollow(const Piece& p) { return p.radius < 0 || (p.curve && p.curve->turn() < 0); }
/// Its radius [m], of a curve the least one of curvature; 0 of lines and corners. Never below 0.
double least_radius(const Piece&);

/// Two pieces that may touch, not both straight, nor both hollow.
struct PiecePair {
  Piece a, b;
  /// How far a round piece can go from the middle of the hollow one that it is in [m]; below 0 where neither is hollow.
  double clearance() const { return -(a.radius + b.radius); }
  bool hollow() const { return a.radius < 0 || b.radius < 0; }
  bool curved() const { return a.curve || b.curve; }
};

/// A journal (disc) inside a bearing (hole), radii [m].
struct JournalBearing {
  double journal, bearing;
  double clearance() const { return bearing - journal; }
  operator PiecePair() const { return {{.radius = journal}, {.radius = -bearing}}; }
};
inline double journal_radius(const PiecePair& pair) { return pair.a.radius; }
inline double bearing_radius(const PiecePair& pair) { return -pair.b.radius; }

/// Where a curve is touched.
struct OnCurve {
  double curvature = 0;  ///< [1/m]; infinite: at the end of all its directions, where it is touched as a corner
  double at = 0;         ///< −1 where the span begins, 1 where it ends
  double per = 0;        ///< d(at)/d(length) [1/m]
};

/// Where two pieces stand to each other; Z is the quarter turn [0 −1; 1 0]. Eqs. (18)–(23) of Ebrahimi, Salahshoor, Moradi
/// (2017) are the case of a journal in its bearing; theory: docs/theory/contact.md. The middle of a curve is the point of its
/// material that is touched now.
/// A force F = −N n + T Zn at the middle of a's piece with the couple ρ_a T − s N if it is straight, and −F at that of b's with
/// ρ_b T − s N if it is, give the two bodies the power −N · rate + T · material_slip.
struct Gap {
  Eigen::Vector2d e = {0, 0};  ///< from the middle (of arcs the centre) of b's piece to that of a's [m]
  Eigen::Vector2d n = {1, 0};  ///< unit, along the normal of a's surface; (1, 0) between concentric arcs
  double depth = 0;            ///< positive into contact [m]
  double rate = 0;             ///< d(depth)/dt [m/s]
  double material_slip = 0;    ///< of a's surface point over b's, along Zn [m/s]
  double geometric_slip = 0;   ///< of a round piece in a hollow one: depth · (turning rate of n), Eq. (22); 0 if concentric [m/s]
  double across = 0;           ///< s = e·Zn, where a straight piece is touched; 0 between arcs [m]
  double turning = 0;          ///< of n [rad/s]
  double sideways = 0;         ///< of the two middles along Zn [m/s]
  Eigen::Vector2d arm_a = {0, 0}, arm_b = {0, 0};  ///< from the carrying points to the middles [m]
  OnCurve on_a = {}, on_b = {};                    ///< of curves
};

/// How n turns and touched points move along curves, each by the two middles' speed along Zn and the two spins.
struct Rolling {
  struct Part {
    double across = 0, a = 0, b = 0;  ///< a length or 1 over it, where the others are angles or lengths
    double of(double sideways, double w_a, double w_b) const { return across * sideways + a * w_a + b * w_b; }
  };
  Part turning;     ///< of n [rad/s]
  Part on_a, on_b;  ///< of the touched points of curves, along Zn, over their material [m/s]
};
/// @pre one piece is a curve
Rolling rolling(const PiecePair&, const Gap&);

/// Cannot fail.
Gap evaluate(const PiecePair&, const MovingPoint& a, const MovingPoint& b);

/// The point of a piece's surface that is touched, world axes [m].
/// @param middle  of the piece [m]   @param normal  out of it: n of a's, −n of b's   @param across  as in `Gap` [m]
Eigen::Vector2d touched(const Piece&, const Eigen::Vector2d& middle, const Eigen::Vector2d& normal, double across);

/// Where on a piece contact is, and the rate of that: −1 where the piece begins, 1 where it ends, beyond that outside; 0 on a whole
/// circle [–], [1/s].
struct PlaceOn {
  double at = 0, rate = 0;
};
std::array<PlaceOn, 2> places(const PiecePair&, const Gap&, const MovingPoint& a, const MovingPoint& b);

}  // namespace pintle
