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

/// Which relative speed friction opposes; see docs/theory/contact.md.
enum class Sliding { material, geometric };

/// Of rigid bodies, which impacts stop at once: Newton's restitution is of speeds, Poisson's of impulses. docs/theory/impact.md
struct RigidImpact {
  double restitution = 0;  ///< of the normal direction, 0 to 1
  double tangential = 0;   ///< of slips that friction stops, 0 to 1
  bool poisson = false;
};

/// Two pieces of surface that may touch at one point: a journal a in a bearing b, which is a clearance joint, or pieces of two
/// profiles; or the flanks of teeth with backlash. By its model a contact without constraint rows, or, of a clearance joint with `link`, a
/// massless link between the two centres, one row that some joint of the system holds.
struct ContactPair {
  int a, b;  ///< markers that carry the pieces: of a clearance joint at the two centres
  PiecePair gap;
  NormalLaw normal;
  std::optional<FrictionLaw> friction;
  Sliding sliding = Sliding::material;
  double slowest_impact = 1e-6;  ///< floor of the latched approach speed; a rigid contact does not bounce more slowly [m/s]
  bool follows = false;          ///< the latched speed grows with the approach of the same contact; false: that of its onset
  int link = -1;                 ///< the joint that holds the centres apart; then no law acts. −1: a contact
  // Of profiles, the contact of which is made of several pairs, one after another:
  int pair = 0, pairs = 1;                                   ///< which of them, of how many
  bool profiles = false;                                     ///< false: a clearance joint
  double deepest = std::numeric_limits<double>::infinity();  ///< beyond this depth it is no longer these pieces that face each other [m]
  /// What lies before a, after a, before b, after b: where the pieces end, in their half extents, and the pair that has the contact
  /// there, −1 for none.
  std::array<double, 4> extent{1, 1, 1, 1};
  std::array<int, 4> beyond{-1, -1, -1, -1};
  std::optional<RigidImpact> rigid = {};        ///< then `normal` is none …
  double slack = 0;                             ///< … and an overlap up to this is a touch [m]
  std::optional<PressureTheory> pressure = {};  ///< of cylinders under a law of theirs
  bool journal = false;                         ///< of profiles: a is the journal of an open bearing b
  std::optional<Flank> flank = {};              ///< then the pieces are nothing
};

/// What a rigid contact, or one or a joint of dry friction, is doing, and what the accelerations have decided of its force.
struct DryFriction {
  static constexpr double undecided = 2;  ///< the surfaces have met, and neither slide nor stick yet: without friction
  static constexpr double given = 3;      ///< of a rigid contact: both forces are those that a time-stepping scheme has found
  double direction = undecided;           ///< −1, 1: they slide, a over b along Zn; 0: they stick
  double force = 0;                       ///< of a contact on a along Zn, where it sticks; of a joint on b along the slip [N]
  double load = 0;                        ///< of a joint, a rigid contact: what presses it [N]
  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(direction, force, load));
  }
};

/// What a contact does at an instant. Friction acts on each body's own surface, Eq. (19).
struct ContactEffect {
  Gap gap;
  Wrench on_a = Wrench::Zero(), on_b = Wrench::Zero();
  NormalForce normal;
  double friction = 0;       ///< on a along Zn [N]
  double d_slip = 0;         ///< of that, in the sliding speed [N s/m] …
  double d_normal = 0;       ///< … and in the normal force, –
  double friction_loss = 0;  ///< as the law sees it: −force · its own sliding speed; of bristles also what bends them [W]
  std::array<double, most_internal> x_rate{};  ///< of its bristles
};

/// Its two centres are kept apart by a massless link: no law acts, nothing is touched or left.
inline bool is_held(const ContactPair& pair) { return pair.link >= 0; }

/// Its slack, of the mechanism's length: what rounding may leave of a gap that is closed.
inline constexpr double touching_part = 1e-13;
inline bool is_rigid(const ContactPair& pair) { return pair.rigid.has_value(); }

/// The smallest radius of its pieces, of teeth of their pitch circles, the mechanism's length between a corner and a line [m].
double contact_size(const ContactPair&, double mechanism);
/// The length that its depth is judged against: the clearance round a piece in a hollow one, half the backlash of teeth, else a hundredth of
/// their size [m].
double fine_length(const ContactPair&, double mechanism);

MovingPoint moving_point(const MarkerMotion&);
inline Gap gap_between(const ContactPair& pair, const MovingPoint& a, const MovingPoint& b) {
  return pair.flank ? evaluate(*pair.flank, a, b) : evaluate(pair.gap, a, b);
}

/// @param impact_rate  latched approach speed [m/s]; 0 while open: then only the gap is found, of profiles not even that
/// @param dry  read where friction is Coulomb's, and of a rigid contact for its normal force
/// @param x  the states of its bristles; read where it has any
ContactEffect evaluate(const ContactPair&, const MarkerMotion& a, const MarkerMotion& b, double impact_rate, const DryFriction& dry = {},
                       const double* x = nullptr);

/// The sliding speed that its friction opposes [m/s].
double sliding_speed(const ContactPair&, const Gap&);
/// Its friction is one of bristles, and acts.
bool has_bristles(const ContactPair&);
/// What bristles remember, as results name it; empty for another law.
std::vector<InternalState> internal_states(const FrictionLaw&);

/// Its friction, if that is Coulomb's and acts; else nullptr.
const Coulomb* dry_friction(const ContactPair&);
/// What friction, a normal force, of 1 N does to a and to b: by power, the material slip, the opening speed −rate, of unit rates.
std::array<Wrench, 2> unit_friction(const ContactPair&, const Gap&);
std::array<Wrench, 2> unit_normal(const ContactPair&, const Gap&);
/// Adds friction, a normal force of a rigid contact, to what the contact does.
void add_friction(const ContactPair&, double force, ContactEffect&);
void add_normal(const ContactPair&, double force, ContactEffect&);
/// The rate of the material slip, of the opening speed, where no coordinate is accelerated [m/s²].
double slip_acceleration(const ContactPair&, const Gap&, const MarkerMotion& a, const MarkerMotion& b);
double opening_acceleration(const ContactPair&, const Gap&, const MarkerMotion& a, const MarkerMotion& b);

/// What the normal law is told. @param latched  approach speed at onset or, if it follows, the largest since [m/s]
Approach approach_of(const ContactPair&, double depth, double rate, double latched);

/// How far inside the ends of its pieces a contact is, where that is least [m]; below 0: outside.
struct Margin {
  double value, rate;  ///< [m], [m/s]
  int side;            ///< index into ContactPair::beyond; −1: neither piece ends
};
Margin margin(const ContactPair&, const Gap&, const MovingPoint& a, const MovingPoint& b);

inline constexpr WrenchPattern contact_pattern{{{{true, true}, {true, true}}}, true};
/// How the wrenches [a; b] answer to the motion, the latched approach speed and bristles held. Zero while open.
/// @param now  what the contact does in this state
WrenchTangent wrench_tangent(const ContactPair&, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b);
/// How wrenches and bristles answer to each other and to the motion. @pre closed, with bristles
InternalTangent internal_tangent(const ContactPair&, const ContactEffect& now, const MarkerMotion& a, const MarkerMotion& b,
                                 const double* x);

}  // namespace pintle
