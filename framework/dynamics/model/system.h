#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/component/reduction/inertia.h"
#include "framework/dynamics/model/contact_pair.h"
#include "framework/dynamics/model/forces.h"
#include "framework/dynamics/model/joint_friction.h"
#include "framework/dynamics/model/joints.h"
#include "framework/dynamics/model/marker.h"
#include "framework/dynamics/model/signals.h"
#include "framework/dynamics/model/switches.h"

namespace pintle {

/// A body. Its coordinates are [x y θ] of its mass centre in the undeformed state, so the inertia of a rigid body is three constants,
/// without velocity-dependent forces. A flexible body also has modal coordinates η: docs/theory/motion.md.
struct Body {
  std::string name;
  double m = 0;                                    ///< [kg]
  double J = 0;                                    ///< about the mass centre [kg m²]
  Eigen::Vector2d x_BO = Eigen::Vector2d::Zero();  ///< origin of the user's axes relative to the mass centre [m]
  std::optional<FlexInertia> flex = {};            ///< about the mass centre
  int modes() const { return flex ? static_cast<int>(flex->omega.size()) : 0; }
};

/// Internal states of one owner: n numbers of x from `begin` on.
struct InternalStates {
  enum Owner { force, contact, friction } owner;  ///< a force element, bristles of a contact, bristles of friction in a joint
  int index, begin, n;
};

/// What an integral of the energy balance accounts for.
enum class Account { hysteresis, friction, damper, load, driver, damping, scheme, joint_friction, switching };
struct Integral {
  Account account;
  int index;  ///< contact, force, joint, friction in a joint, switch; for damping the body; for the scheme 0
};

/// A scene prepared to run: built once, then never changed. Ground is not among the bodies.
struct System {
  Eigen::Vector2d gravity = Eigen::Vector2d::Zero();  ///< [m/s²]
  std::vector<Body> bodies;
  std::vector<Marker> markers;  ///< every marker that a joint, force or contact uses
  std::vector<Joint> joints;    ///< drivers included
  std::vector<JointFriction> frictions;
  std::vector<Force> forces;
  std::vector<ContactPair> contacts;
  std::vector<MotionSignal> signals;  ///< inputs of laws
  std::vector<SignalLaw> laws;        ///< for forces and for rates of states
  std::vector<OwnState> states;       ///< of the scene; the last of the internal states
  std::vector<std::string> joint_names, force_names, contact_names;
  /// Joints with clearance as ideal joints: they are used to assemble the mechanism.
  std::vector<Joint> loose;
  std::vector<std::string> loose_names;

  double length = 1;  ///< size of the mechanism, for scaling [m]
  /// First modal coordinate of body i in q, one past: q is [x y θ] body by body, then η body by body.
  std::vector<int> eta_begin;
  /// Scale of each coordinate: length, 1 for an angle, length·√m for η, whose shapes have the mean square displacement 1/m.
  Eigen::VectorXd scale;
  std::vector<int> row_begin;                    ///< first constraint row of joint i; one past
  std::vector<int> end_begin;                    ///< first end of joint i, an end being the joint at one of its markers; one past
  std::vector<int> end_marker;                   ///< marker of each end
  Eigen::VectorXd row_scale;                     ///< 1/length for a row in metres, 1 for an angle
  std::vector<Integral> integrals;               ///< the quantities in z, in order
  std::vector<int> contact_z, force_z, joint_z;  ///< first integral of each, −1 for none
  std::vector<InternalStates> internal;          ///< of each owner that has any
  std::vector<int> force_x;                      ///< first internal state of each force, 0 if it has none …
  Eigen::VectorXd x_scale;                       ///< scales of their errors; 0: that of lengths
  std::vector<int> contact_x, friction_x;        ///< … of each contact, of each friction in a joint
  int own_x = 0;                                 ///< … of the scene's own states
  std::vector<Switch> switches;                  ///< what events may release and engage
  /// Switch of each, −1 for none; empty without switches.
  std::vector<int> joint_switch, force_switch, contact_switch;

  int n_rigid() const { return 3 * static_cast<int>(bodies.size()); }
  int n() const { return eta_begin.empty() ? n_rigid() : eta_begin.back(); }
  int n_rows() const { return row_begin.empty() ? 0 : row_begin.back(); }
  int n_z() const { return static_cast<int>(integrals.size()); }
  int n_x() const { return static_cast<int>(x_scale.size()); }
  int n_s() const { return n() + n_x(); }  ///< number of first-order variables: speeds and internal states
  int x_begin() const { return 2 * n(); }  ///< of the internal states in y
  int z_begin() const { return n() + n_s(); }
  int switch_begin() const { return z_begin() + n_z(); }  ///< start of two numbers for each switch in y
  int n_y() const { return switch_begin() + 2 * static_cast<int>(switches.size()); }
};

/// Fills the data that follow from the lists: coordinates, rows, integrals. Call it once the lists are complete.
/// @param scheme_loses  adds an integral for the energy that an implicit scheme removes
void number(System&, bool scheme_loses = false);
/// Internal states of an owner, and the owner's name in results; the same for all pairs of two profiles.
std::vector<InternalState> states_of(const System&, const InternalStates&);
std::string owner_name(const System&, const InternalStates&);
/// Whether joint k is the massless link of a clearance joint.
bool is_link(const System&, int joint);

/// Σ r²/J of bodies whose teeth meet: mobility that their rotation adds for a unit force at both pitch circles; otherwise 0 [1/kg].
double tooth_mobility(const System&, const ContactPair&);
/// Sum of 1/m of the bodies that meet in a contact, for teeth including the effect of rotation [1/kg].
double lightness(const System&, const ContactPair&);
/// The latched approach speed if surfaces overlap without a known impact: that of the impact that would reach this depth [m/s].
double latched_at(const System&, const ContactPair&, double depth);

/// Whether bending of its body affects a joint's rows at this marker: not where the shapes are zero, as at a pin to which the body's frame
/// is fixed.
bool feels_shapes(const System&, const Joint&, int marker);

/// Clearance joints, whose contacts come before those of profiles.
int n_clearances(const System&);

/// The number of contacts and frictions in joints if the accelerations determine some of their forces; otherwise 0.
std::size_t dry_states(const System&);

inline bool has_gravity(const System& s) { return s.gravity.x() != 0 || s.gravity.y() != 0; }

/// All time-dependent data. Copy one to branch a run, store one to restart it.
struct State {
  double t = 0;                            ///< [s]
  Eigen::VectorXd y;                       ///< coordinates q, speeds s, internal states x, ledger integrals z, switches
  std::vector<double> impact_rate;         ///< per contact, latched approach speed; 0 while open [m/s]
  std::vector<DryFriction> friction = {};  ///< per contact, then per friction in a joint; empty without dry_states
};

}  // namespace pintle
