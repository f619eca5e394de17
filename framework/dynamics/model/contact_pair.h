#pragma once

#include <array>
#include <optional>
#include <vector>

#include "contact/elastic_law.h"
#include "contact/friction_law.h"
#include "contact/gap.h"
#include "contact/pressure.h"
#include "framework/common/members.h"
#include "framework/dynamics/model/flank.h"
#include "framework/dynamics/model/internal_states.h"
#include "framework/dynamics/model/marker.h"
#include "framework/dynamics/model/wrench_tangent.h"

namespace pintle {

/// The relative speed that friction opposes; see docs/theory/contact.md.
enum class Sliding { material, geometric };

/// Impact law of rigid bodies: Newton's restitution relates speeds, Poisson's relates impulses. docs/theory/impact.md
struct RigidImpact {
  double restitution = 0;  ///< in the normal direction, 0 to 1
  double tangential = 0;   ///< for slips that friction stops, 0 to 1
  bool poisson = false;
};

/// Displacement of the centres of a journal and its bearing per force on them, beyond that of the shapes of their bodies; body axes [m/N].
struct ResidualFlexibility {
  Eigen::Matrix2d a = Eigen::Matrix2d::Zero(), b = Eigen::Matrix2d::Zero();
};

/// Two pieces of surface that may touch at one point: a journal a in a bearing b, which is a clearance joint; pieces of two profiles; or
/// the flanks of teeth with backlash. Depending on its model it is a contact without constraint rows or, for a clearance joint with `link`,
/// a massless link between the two centres: one constraint row, held by a joint of the system.
struct ContactPair {
  int a, b;  ///< markers that carry the pieces: for a clearance joint at the two centres
  PiecePair gap;
  NormalLaw normal;
  std::optional<FrictionLaw> friction;
  Sliding sliding = Sliding::material;
  double slowest_impact = 1e-6;  ///< lower bound of the latched approach speed; a rigid contact does not bounce more slowly [m/s]
  bool follows = false;  ///< true: the latched speed grows with the approach speed during the contact; false: it stays that at onset
  int link = -1;         ///< the joint that holds the centres apart; then no contact law acts. −1: a contact
  // For profiles, whose contact consists of several pairs, one after another:
  int pair = 0, pairs = 1;                                   ///< index of this pair, number of pairs
  bool profiles = false;                                     ///< false: a clearance joint
  double deepest = std::numeric_limits<double>::infinity();  ///< beyond this depth these pieces no longer face each other [m]
  /// Sides in the order before a, after a, before b, after b: where the pieces end, in units of their half extents, and the pair that takes
  /// over the contact there, −1 for none.
  std::array<double, 4> extent{1, 1, 1, 1};
  std::array<int, 4> beyond{-1, -1, -1, -1};
  std::optional<RigidImpact> rigid = {};        ///< then `normal` is none …
  double slack = 0;                             ///< … and an overlap up to this counts as touching [m]
  std::optional<PressureTheory> pressure = {};  ///< of cylinders whose contact law needs it
  bool journal = false;                         ///< for profiles: a is the journal of an open bearing b
  std::optional<Flank> flank = {};              ///< then the pieces are unused
  bool written_on_a = false;                    ///< results give the force on a, otherwise on b
  /// Of a clearance joint whose bodies have a massless boundary: massless_boundary.h.
  std::optional<ResidualFlexibility> massless = {};
};

/// State of dry friction of a contact or joint, and of a rigid contact, with the force that the accelerations determine.
struct DryFriction {
  static constexpr double undecided = 2;  ///< the surfaces touch, but whether they slide or stick is undecided: no friction
  static constexpr double given = 3;      ///< of a rigid contact: both forces are prescribed by a time-stepping scheme
  double direction = undecided;           ///< −1, 1: they slide, a over b along Zn; 0: they stick
  double force = 0;                       ///< contact: force on a along Zn while it sticks; joint: force on b along the slip [N]
  double load = 0;                        ///< of a joint or rigid contact: the normal force [N]
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(direction, force, load));
  }
};

/// State and forces of a contact at an instant. Friction acts on each body's own surface, Eq. (19).
struct ContactEffect {
  Gap gap;
  Wrench on_a = Wrench::Zero(), on_b = Wrench::Zero();
  NormalForce normal;
  double friction = 0;       ///< on a along Zn [N]
  double d_slip = 0;         ///< derivative of friction with respect to the sliding speed [N s/m] …
  double d_normal = 0;       ///< … and to the normal force, –
  double friction_loss = 0;  ///< as the law defines it: −force · its own sliding speed; with bristles, also the power that bends them [W]
  std::array<double, most_internal> x_rate{};  ///< rates of its bristles
};

/// Whether a massless link keeps its two centres apart: then no contact law acts, and it does not open or close.
inline bool is_held(const ContactPair& pair) { return pair.link >= 0; }

inline int written_marker(const ContactPair& pair) { return pair.written_on_a ? pair.a : pair.b; }
/// The force written to results, from an effect or a contact of several pairs.
template <class Effect>
const Wrench& written_force(const ContactPair& pair, const Effect& effect) {
  return pair.written_on_a ? effect.on_a : effect.on_b;
}

/// Slack relative to the mechanism's length, for the rounding of closed gaps.
inline constexpr double touching_part = 1e-13;
inline bool is_rigid(const ContactPair& pair) { return pair.rigid.has_value(); }

/// The smallest radius of its pieces; for teeth, of their pitch circles; between a corner and a line, the mechanism's length [m].
double contact_size(const ContactPair&, double mechanism);
/// Overlap relative to contact_size beyond which no contact law here is valid.
inline constexpr double deepest_valid = 0.1;
/// The length with which its depth is compared: the clearance of a piece inside a hollow one, half the backlash of teeth, otherwise a
/// hundredth of the size of the pieces [m].
double fine_length(const ContactPair&, double mechanism);

MovingPoint moving_point(const MarkerMotion&);
inline Gap gap_between(const ContactPair& pair, const MovingPoint& a, const MovingPoint& b) {
  return pair.flank ? evaluate(*pair.flank, a, b) : evaluate(pair.gap, a, b);
}

/// @param impact_rate  latched approach speed [m/s]; 0 while open: then only the gap is computed; for profiles nothing
/// @param dry  read for Coulomb friction, and for the normal force of a rigid contact
/// @param x  the states of its bristles; read if it has any
ContactEffect evaluate(const ContactPair&, const MarkerMotion& a, const MarkerMotion& b, double impact_rate, const DryFriction& dry = {},
                       const double* x = nullptr);

/// The sliding speed that its friction opposes [m/s].
double sliding_speed(const ContactPair&, const Gap&);
/// Whether it is closed and has bristle friction.
bool has_bristles(const ContactPair&);
/// The bristles' states, named as in results; empty for another law.
std::vector<InternalState> internal_states(const FrictionLaw&);

/// Its friction law, if it is Coulomb's and the contact is closed; otherwise nullptr.
const Coulomb* dry_friction(const ContactPair&);
/// Wrenches on a and b of 1 N of friction, or of normal force; their power is the material slip, or the opening speed −rate.
std::array<Wrench, 2> unit_friction(const ContactPair&, const Gap&);
std::array<Wrench, 2> unit_normal(const ContactPair&, const Gap&);
/// Adds friction, or the normal force of a rigid contact, to the effect of the contact.
void add_friction(const ContactPair&, double force, ContactEffect&);
void add_normal(const ContactPair&, double force, ContactEffect&);
/// The rate of the material slip, or of the opening speed, with all coordinate accelerations zero [m/s²].
double slip_acceleration(const ContactPair&, const Gap&, const MarkerMotion& a, const MarkerMotion& b);
double opening_acceleration(const ContactPair&, const Gap&, const MarkerMotion& a, const MarkerMotion& b);

/// Input of the normal law. @param latched  approach speed at onset or, if it follows, the largest since then [m/s]
Approach approach_of(const ContactPair&, double depth, double rate, double latched);

/// Distance of the contact point from the nearest end of its pieces [m]; negative outside.
struct Margin {
  double value, rate;  ///< [m], [m/s]
  int side;            ///< index into ContactPair::beyond; −1: neither piece ends
};
Margin margin(const ContactPair&, const Gap&, const MovingPoint& a, const MovingPoint& b);

inline constexpr WrenchPattern contact_pattern{{{{true, true}, {true, true}}}, true};
/// How the wrenches [a; b] depend on the motion, with the latched approach speed and bristles held. Zero while open.
/// @param now  effect of the contact in this state
WrenchTangent wrench_tangent(const ContactPair&, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b);
/// How wrenches and bristles depend on each other and on the motion. @pre closed, with bristles
InternalTangent internal_tangent(const ContactPair&, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b,
                                 const double* x);

}  // namespace pintle
