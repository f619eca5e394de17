#pragma once

#include <array>
#include <limits>
#include <memory>

#include <Eigen/Core>

#include "contact/curve.h"
#include "eigen_layout.h"

namespace pintle {

/// A point with a velocity and a spin, through which a contact accesses a body; world axes.
struct MovingPoint {
  Eigen::Vector2d r, v;  ///< [m], [m/s]
  double w;              ///< [rad/s]
  double angle = 0;      ///< of its axes [rad]
};

/// A piece of a body's surface: an arc (a corner if its radius is 0), a straight line, or a span of a curve; in the axes of the point that
/// carries it. Normals point out of the material; the surface runs with the material to its left.
struct Piece {
  double radius = 0;                                      ///< of an arc, < 0 if it is hollow; of a line or curve 0 [m]
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();       ///< of the arc; of a line its middle; of a curve 0 [m]
  double normal = 0;                                      ///< direction of the normal at the middle of the piece [rad]
  double half = std::numeric_limits<double>::infinity();  ///< half its extent: of an arc [rad], of a line [m]; infinite: a circle
  bool straight = false;
  std::shared_ptr<const CurveSpan> curve = {};  ///< if set, `half` is half the length of its chords [m]
};
inline bool is_corner(const Piece& p) { return p.radius == 0 && !p.straight && !p.curve; }
inline bool is_hollow(const Piece& p) { return p.radius < 0 || (p.curve && p.curve->turn() < 0); }
/// Its radius [m], for a curve the least radius of curvature; 0 for lines and corners. Never negative.
double least_radius(const Piece&);

/// Two pieces that may touch, not both straight, nor both hollow.
struct PiecePair {
  Piece a, b;
  /// How far a round piece can move from the middle of the hollow one that contains it [m]; negative if neither is hollow.
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

/// Contact point on a curve.
struct OnCurve {
  double curvature = 0;  ///< [1/m]; infinite: at the end of its range of directions, where it acts as a corner
  double at = 0;         ///< −1 where the span begins, 1 where it ends
  double per = 0;        ///< d(at)/d(length) [1/m]
};

/// Relative position of two pieces; Z is the rotation by a quarter turn [0 −1; 1 0]. Eqs. (18)–(23) of Ebrahimi, Salahshoor, Moradi (2017)
/// are the case of a journal in its bearing; theory: docs/theory/contact.md. The middle of a curve is its present contact point.
/// A force F = −N n + T Zn at the middle of a's piece, with the couple ρ_a T − s N if it is straight, and −F at that of b's, with ρ_b T − s
/// N if it is, transfer to the two bodies the power −N · rate + T · material_slip.
struct Gap {
  Eigen::Vector2d e = {0, 0};  ///< from the middle (for arcs the centre) of b's piece to that of a's [m]
  Eigen::Vector2d n = {1, 0};  ///< unit, along the normal of a's surface; (1, 0) between concentric arcs
  double depth = 0;            ///< positive into contact [m]
  double rate = 0;             ///< d(depth)/dt [m/s]
  double material_slip = 0;    ///< of a's surface point relative to b's, along Zn [m/s]
  double geometric_slip = 0;   ///< for a round piece in a hollow one: depth · (turning rate of n), Eq. (22); 0 if concentric [m/s]
  double across = 0;           ///< s = e·Zn, the contact point on a straight piece; 0 between arcs [m]
  double turning = 0;          ///< rotation of n [rad/s]
  double sideways = 0;         ///< relative velocity of the two middles along Zn [m/s]
  Eigen::Vector2d arm_a = {0, 0}, arm_b = {0, 0};  ///< from the carrying points to the middles [m]
  OnCurve on_a = {}, on_b = {};                    ///< for curves
};

/// Rotation of n and motion of contact points along curves, as functions of the relative speed of the two middles along Zn and the two
/// spins.
struct Rolling {
  struct Part {
    double across = 0, a = 0, b = 0;  ///< in `turning` [1/m], –, –; in on_a and on_b –, [m], [m]
    double of(double sideways, double w_a, double w_b) const { return across * sideways + a * w_a + b * w_b; }
  };
  Part turning;     ///< of n [rad/s]
  Part on_a, on_b;  ///< of the contact points of curves, along Zn, relative to their material [m/s]
};
/// @pre one piece is a curve
Rolling rolling(const PiecePair&, const Gap&);

/// Cannot fail.
Gap evaluate(const PiecePair&, const MovingPoint& a, const MovingPoint& b);

/// The contact point on a piece's surface, world axes [m].
/// @param middle  of the piece [m]   @param normal  outward: n for a's, −n for b's   @param across  as in `Gap` [m]
Eigen::Vector2d touched(const Piece&, const Eigen::Vector2d& middle, const Eigen::Vector2d& normal, double across);

/// Position of the contact on a piece, and its rate: −1 where the piece begins, 1 where it ends, outside beyond these; 0 on a full circle
/// [–], [1/s].
struct PlaceOn {
  double at = 0, rate = 0;
};
std::array<PlaceOn, 2> places(const PiecePair&, const Gap&, const MovingPoint& a, const MovingPoint& b);

}  // namespace pintle
