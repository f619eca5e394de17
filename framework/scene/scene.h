#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "framework/common/signal_function.h"
#include "framework/common/time_law.h"
#include "framework/scene/elastic.h"
#include "framework/scene/place.h"
#include "framework/scene/scene_contact.h"

/// What the user means: plain data with names and defaults, SI units throughout, no matrices.
/// Written by hand in C++ or by the reader (reader.h). Only `build` judges it.
namespace pintle {

/// A law of time, or of signals, and the text it was written as (kept for run.json and messages).
struct Law {
  TimeLaw at;  ///< of a law of signals empty
  std::string text;
  bool constant = true;
  SignalFunction of_signals = {};         ///< in `signals`, in their order
  std::vector<std::string> signals = {};  ///< "crank.angle", as signal_words.h knows them; empty: a law of time
  bool uses_time = false;                 ///< beside signals
};

/// A named point of a body, with a direction drawn on it; body axes.
struct ScenePoint {
  std::string name;
  Pair at{0, 0};     ///< [m]
  double angle = 0;  ///< [rad]
  Place place = {};
  std::string hole = {};                     ///< of a plate: the point is the middle of this hole …
  RimCoupling coupling = RimCoupling::none;  ///< … and follows its rim so
};

/// "crank.A", "ground" (the point 0, 0) or "crank" (the origin of its axes).
struct PointRef {
  std::string body, point;  ///< point empty: the origin
  Place place;
};

/// A point of a surface: a named one of the body, or a place in body axes; and the arc of a path that leads on from there.
struct ScenePathPoint {
  std::string point;  ///< empty: `at`
  Pair at{0, 0};      ///< [m]; of a polar profile angle and radius [rad, m]
  double arc = 0;     ///< radius, > 0 turning left; 0: a straight line [m]
  Place place = {};
};

/// The surface of a body, that contacts are made of: a disc or a hole about a point, a path of lines and arcs, or a spline through
/// points, given by x and y or, `polar`, by angle and radius.
struct SceneProfile {
  enum Kind { disc, hole, path, spline, polar };
  enum Side { left, right, inside, outside };  ///< where the material is: of an open path, of a closed one
  std::string name;
  Kind kind = disc;
  ScenePathPoint centre = {};  ///< of a disc or hole; of a polar profile what its points are about
  double radius = 0;           ///< of a disc or hole [m]
  std::vector<ScenePathPoint> points = {};
  bool closed = false;
  Side material = left;
  double round = 0;  ///< radius of the arc at corners between straight lines [m]
  std::string on;    ///< of a body of elements: its point that carries the profile
  Place place = {};
};

struct SceneBody {
  std::string name;
  double mass = 0;     ///< [kg]; 0: not given, which kinematics alone can do without
  double inertia = 0;  ///< about the mass centre [kg m²]; likewise
  Pair center{0, 0};   ///< mass centre in body axes [m]
  std::vector<ScenePoint> points;
  std::vector<SceneProfile> profiles = {};
  std::optional<SceneElastic> elastic = {};  ///< made of elements: mass, inertia, center come from them
  Pair at{0, 0};                             ///< rough starting position of the body's origin, world [m]
  double angle = 0;                          ///< rough starting angle [rad]
  Place place;
  bool drawn_at = false, drawn_angle = false;  ///< the scene says so: they are not mere defaults
  std::string colour = {};                     ///< in pictures: a name of CSS or #rrggbb; empty: chosen there
};

/// Friction in an ideal joint: coulomb, lugre or gonthier.
struct SceneJointFriction {
  SceneFriction law;
  double radius = 0;   ///< of a revolute's pin [m]
  double length = 0;   ///< of a prismatic's block along its guide; 0: it bears no couple by friction [m]
  double preload = 0;  ///< [N]
};

/// A coordinate of a linear relation: b's direction less a's, b along a's direction, or the distance from a to b; times `ratio`.
struct SceneTerm {
  enum Kind { angle, displacement, distance } kind = angle;
  PointRef a, b;
  double ratio = 1;
};

/// What couplings say beside their points: wheels their sizes, relations their terms or curve. They start as they are assembled.
struct SceneCoupling {
  Pair radii{0, 0};                   ///< of the wheels at a and b [m]; 0: from `teeth`
  Pair teeth{0, 0};                   ///< instead, of gears
  bool inside = false;                ///< the smaller wheel runs in the larger
  bool crossed = false;               ///< of a belt
  double radius = 0;                  ///< of the wheel b on a line [m]
  double lead = 0;                    ///< of a screw: its nut's way a turn, not 0 [m]
  std::vector<SceneTerm> terms = {};  ///< of a differential; empty: two shafts and a cage
  bool swings = false;                ///< of a cam: its follower turns
  Law curve = {};                     ///< of a cam: lift [m] or swing [rad] over the cam's angle [rad] in place of time
};

enum class JointKind { revolute, prismatic, slot, weld, distance, differential, gear, rack, rolling, belt, screw, cam };

struct SceneJoint {
  std::string name;
  JointKind kind = JointKind::revolute;
  PointRef a, b;
  std::optional<PointRef> c = {};           ///< differential, screw, cam: the cage or frame; else the ground
  double length = 0;                        ///< distance [m]
  double angle = 0;                         ///< prismatic, weld: b's direction less a's [rad]
  double ratio = 1;                         ///< differential: turns of a against the cage for one of b's the other way
  std::optional<SceneClearance> clearance;  ///< revolute only
  Place place;
  std::optional<ScenePlay> play = {};               ///< prismatic, slot, distance, gear and rack only
  std::optional<SceneJointFriction> friction = {};  ///< revolute, prismatic and slot, without clearance
  bool engaged = true;                              ///< at the start
  bool from_present = false;                        ///< `length` is added to that at the start, as the rest is assembled
  std::optional<SceneCoupling> coupling = {};       ///< gear, rack, rolling, belt, screw, cam, and differential of terms
};

/// A revolute with clearance whose bearing is an arc.
inline bool is_open(const SceneJoint& j) { return j.clearance && j.clearance->arc; }

/// Two profiles of two bodies that may touch. In `normal`, `bearing` is the first body's elasticity, `journal` the second's.
struct SceneContact {
  std::string name;
  PointRef a, b;  ///< the point is a profile
  SceneNormal normal;
  std::optional<SceneFriction> friction = {};
  Place place = {};
  std::optional<SceneImpact> impact = {};  ///< instead of `normal`
  bool engaged = true;                     ///< at the start
};

enum class DriverKind { angle, distance };

/// A motion imposed in time: b's direction less a's, or the distance from a to b.
struct SceneDriver {
  std::string name;
  DriverKind kind = DriverKind::angle;
  PointRef a, b;
  Law law;  ///< [rad] or [m]
  Place place;
  bool engaged = true;        ///< at the start
  bool from_present = false;  ///< `law` is added to what is imposed as it is at the start, as the rest is assembled
};

/// A point force in world axes, or in the axes of the body it acts on if `follows`.
struct SceneForce {
  PointRef at;
  Law x, y;  ///< [N]
  bool follows = false;
};
/// A torque on b and its opposite on a (ground by default).
struct SceneTorque {
  PointRef a, b;
  Law law;  ///< [N m]
};
struct SceneSpring {
  PointRef a, b;
  double stiffness = 0, damping = 0, free_length = 0;  ///< [N/m], [N s/m], [m]
  std::optional<Law> law = {};                         ///< of its pull instead of these [N]
};
struct SceneTorsionSpring {
  PointRef a, b;
  double stiffness = 0, damping = 0, free_angle = 0;  ///< [N m/rad], [N m s/rad], [rad]
  std::optional<Law> law = {};                        ///< of the torque that turns b back, instead of these [N m]
};
/// A spring and a damper in series.
struct SceneMaxwell {
  PointRef a, b;
  double stiffness = 0, damping = 0;  ///< [N/m], [N s/m], > 0
};
/// An elastic belt round pulleys, from each to the next and from the last to the first: a span of its own each.
struct SceneBelt {
  std::vector<PointRef> pulleys;
  std::vector<double> radii;                          ///< below 0 where it goes round clockwise, the order of pulleys followed [m]
  double stiffness = 0, damping = 0, pretension = 0;  ///< over the strain and its rate, at the start [N], [N s], [N]
};
struct SceneLoad {
  std::string name;
  std::variant<SceneForce, SceneTorque, SceneSpring, SceneTorsionSpring, SceneMaxwell, SceneBelt> what;
  Place place;
  bool engaged = true;  ///< at the start
};

/// What an event does, in this order.
struct SceneDoing {
  std::vector<std::string> release, engage;           ///< joints, drivers, forces and contacts by their names
  std::vector<std::pair<std::string, Law>> set = {};  ///< states of the scene, and what they become [SI]
  bool save = false, row = false;                     ///< the state as a file; a row of results
  std::string stop = {};                              ///< the run, and why; empty: it goes on
  bool does() const { return !release.empty() || !engage.empty() || !set.empty() || save || row || !stop.empty(); }
};
/// Comes where all its guards have become positive.
struct SceneEvent {
  std::string name;
  Law guard;                        ///< the condition as it is written, 1 or 0
  std::vector<Law> when;            ///< its comparisons, the guards
  bool once = false;                ///< else each time
  bool from_start = true;           ///< where they are positive at the start, it comes there
  SceneDoing then, otherwise = {};  ///< `otherwise`: where they no longer are
  Place place = {};
};

/// Displacement of a point of a flexible body within its frame, body axes [m].
struct StartDeflection {
  std::string point;
  Pair u{0, 0};
  Place place;
};
/// What the scene pins down of a body at t = 0. Unset: found by assembly.
struct StartBody {
  std::string body;
  std::optional<double> x, y, angle;    ///< of the body's origin and axes [m, m, rad]
  std::optional<double> vx, vy, speed;  ///< [m/s, m/s, rad/s]
  Place place;
  std::vector<StartDeflection> deflection = {};  ///< it starts bent so, with the least strain energy …
  std::vector<double> modes = {};                ///< … or by these modal coordinates, the lowest first [m kg^0.5]
};
/// Where a journal starts in its bearing, world axes; by default concentric and moving with it.
struct StartJournal {
  std::string joint;
  Pair eccentricity{0, 0};  ///< journal centre less bearing centre [m]
  Pair speed{0, 0};         ///< its rate [m/s]
  Place place;
};

/// A number of the scene's own that changes at a rate: of a controller, a motor, a tank. SI, of any dimension.
struct SceneState {
  std::string name;
  Law rate;
  double start = 0;
  double scale = 1;  ///< what its errors are measured by
  std::string unit;  ///< SI, as expressions write it; empty: a number
  Place place = {};
};
/// A number that is worked out for the results.
struct SceneOutput {
  std::string name;
  Law law;
  std::string unit;  ///< likewise
  Place place = {};
};

struct RunOptions {
  double until = 1;                        ///< [s]
  std::string method = "auto";             ///< auto | rkf45 | dopri5 | verner87 | generalized-alpha | moreau
  double step = 0;                         ///< of moreau [s]
  double rho = 0.8;                        ///< of generalized-alpha: spectral radius at infinite frequency, 0 to 1
  double tolerance = 1e-8;                 ///< local error, relative
  std::string constraints = "projection";  ///< projection | partitioning
  std::optional<double> onset_cut;         ///< cut the step until first penetration is below this [m];
                                           ///< unset: locate the onset as an event
  double max_step = 0;                     ///< [s]; 0: none
  long max_steps = 100'000'000;
  double ledger_bound = 1e-3;  ///< unexplained energy, relative to the energy in play
  Place place;
};

struct OutputOptions {
  double every = 0;              ///< output interval [s]; 0: a thousandth of the run
  double states = 0;             ///< interval of saved states [s]; 0: the last alone
  int frames = 0;                ///< animation frames; 0: none; -1: as many as the command thinks fit
  double exaggerate = 0;         ///< drawn clearance times this; 0: chosen so that the gap can be seen
  double deformation = 1;        ///< drawn deformation times this; 0: chosen so that it can be seen
  std::vector<PointRef> points;  ///< whose motion, and on flexible bodies displacement, is recorded
  std::vector<PointRef> stress;  ///< of flexible bodies, whose stress is recorded
  Place place;
};

struct Scene {
  std::string file;  ///< for messages
  std::string title;
  Pair gravity{0, 0};                                      ///< [m/s²]
  std::vector<std::pair<std::string, double>> parameters;  ///< after overrides, SI
  std::vector<SceneMaterial> materials;
  std::optional<SceneStatic> statics;
  std::vector<ScenePoint> ground;  ///< points of the ground
  std::vector<SceneProfile> ground_profiles;
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
  std::vector<SceneContact> contacts;
  std::vector<SceneDriver> drivers;
  std::vector<SceneLoad> loads;
  std::vector<SceneState> states = {};
  std::vector<SceneOutput> outputs = {};
  std::vector<SceneEvent> events = {};
  std::vector<StartBody> start_bodies;
  bool start_at_rest = false;  ///< `start: equilibrium`
  std::vector<StartJournal> start_journals;
  bool has_run = true;  ///< false: nothing to run (reader.h: require_run); `run` is without meaning
  RunOptions run;
  OutputOptions output;
  std::vector<std::string> warnings = {};  ///< what could be read but may not be meant, in words
  std::string filled_in;                   ///< the scene as JSON text with every parameter and default filled in
};

}  // namespace pintle
