#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "framework/common/heap_optional.h"
#include "framework/common/signal_function.h"
#include "framework/common/time_law.h"
#include "framework/scene/elastic.h"
#include "framework/scene/place.h"
#include "framework/scene/scene_contact.h"

/// The user's description: plain data with names and defaults, all in SI units, no matrices. Created in C++ or by the reader (reader.h).
/// Only `build` checks it.
namespace pintle {

/// A law of time, or of signals, with its source text (kept for run.json and messages).
struct Law {
  TimeLaw at;  ///< empty for a law of signals
  std::string text;
  bool constant = true;
  SignalFunction of_signals = {};         ///< function of `signals`, in their order
  std::vector<std::string> signals = {};  ///< "crank.angle", as in signal_words.h; empty: a law of time
  bool uses_time = false;                 ///< in addition to signals
};

/// A named point of a body, with a direction fixed to it; body axes.
struct ScenePoint {
  std::string name;
  Pair at{0, 0};     ///< [m]
  double angle = 0;  ///< [rad]
  Place place = {};
  std::string hole = {};                     ///< on a plate: the point is the middle of this hole …
  RimCoupling coupling = RimCoupling::none;  ///< … and is coupled to its rim in this way
};

/// "crank.A", "ground" (the point 0, 0) or "crank" (the origin of its axes).
struct PointRef {
  std::string body, point;  ///< point empty: the origin
  Place place;
};

/// A point of a surface: a named point of the body, or a position in body axes; and the arc of a path that starts there.
struct ScenePathPoint {
  std::string point;  ///< empty: `at`
  Pair at{0, 0};      ///< [m]; for a polar profile angle and radius [rad, m]
  double arc = 0;     ///< radius, > 0 turning left; 0: a straight line [m]
  Place place = {};
};

/// The surface of a body, used by contacts: a disc or a hole around a point, a path of lines and arcs, or a spline through points, given by
/// x and y or, if `polar`, by angle and radius.
struct SceneProfile {
  enum Kind { disc, hole, path, spline, polar };
  enum Side { left, right, inside, outside };  ///< side of the material: for an open path, for a closed one
  std::string name;
  Kind kind = disc;
  ScenePathPoint centre = {};  ///< of a disc or hole; for a polar profile the centre of its points
  double radius = 0;           ///< of a disc or hole [m]
  std::vector<ScenePathPoint> points = {};
  bool closed = false;
  Side material = left;
  double round = 0;  ///< radius of the arc at corners between straight lines [m]
  std::string on;    ///< for a body of elements: the point that carries the profile
  Place place = {};
};

struct SceneBody {
  std::string name;
  double mass = 0;     ///< [kg]; 0: not given, which only kinematics allows
  double inertia = 0;  ///< about the mass centre [kg m²]; likewise
  Pair center{0, 0};   ///< mass centre in body axes [m]
  std::vector<ScenePoint> points;
  std::vector<SceneProfile> profiles = {};
  HeapOptional<SceneElastic> elastic = {};  ///< if made of elements: these determine mass, inertia, center
  Pair at{0, 0};                            ///< approximate initial position of the body's origin, world [m]
  double angle = 0;                         ///< approximate initial angle [rad]
  Place place;
  bool drawn_at = false, drawn_angle = false;  ///< given in the scene rather than defaults
  std::string colour = {};                     ///< in pictures: a CSS name or #rrggbb; empty: default
};

/// Friction in an ideal joint: coulomb, lugre or gonthier.
struct SceneJointFriction {
  SceneFriction law;
  double radius = 0;   ///< of a revolute's pin [m]
  double length = 0;   ///< of a prismatic's block along its guide; 0: no couple is carried by friction [m]
  double preload = 0;  ///< [N]
};

/// A coordinate of a linear relation: b's direction minus a's, b along a's direction, or the distance from a to b; times `ratio`.
struct SceneTerm {
  enum Kind { angle, displacement, distance } kind = angle;
  PointRef a, b;
  double ratio = 1;
};

/// Data of couplings besides their points: sizes of wheels; terms or curve of relations. The offsets follow from the assembled start.
struct SceneCoupling {
  Pair radii{0, 0};                   ///< of the wheels at a and b [m]; 0: from `teeth`
  Pair teeth{0, 0};                   ///< alternatively, for gears
  bool inside = false;                ///< the smaller wheel runs in the larger
  bool crossed = false;               ///< of a belt
  double radius = 0;                  ///< of the wheel b on a line [m]
  double lead = 0;                    ///< of a screw: travel of its nut per turn, not 0 [m]
  std::vector<SceneTerm> terms = {};  ///< of a differential; empty: two shafts and a cage
  bool swings = false;                ///< of a cam: its follower rotates
  Law curve = {};                     ///< of a cam: lift [m] or swing [rad] as a function of the cam's angle [rad] instead of time
};

enum class JointKind { revolute, prismatic, slot, weld, distance, differential, gear, rack, rolling, belt, screw, cam };

struct SceneJoint {
  std::string name;
  JointKind kind = JointKind::revolute;
  PointRef a, b;
  std::optional<PointRef> c = {};          ///< differential, screw, cam: the cage or frame; otherwise the ground
  double length = 0;                       ///< distance [m]
  double angle = 0;                        ///< prismatic, weld: b's direction minus a's [rad]
  double ratio = 1;                        ///< differential: turns of a relative to the cage per turn of b in the opposite direction
  HeapOptional<SceneClearance> clearance;  ///< revolute only
  Place place;
  HeapOptional<ScenePlay> play = {};               ///< prismatic, slot, distance, gear and rack only
  HeapOptional<SceneJointFriction> friction = {};  ///< revolute, prismatic and slot, without clearance
  bool engaged = true;                             ///< at the start
  bool from_present = false;                       ///< `length` is relative to its value at the start, as the rest is assembled
  HeapOptional<SceneCoupling> coupling = {};       ///< gear, rack, rolling, belt, screw, cam, and differential of terms
};

/// A revolute with clearance whose bearing is an arc.
inline bool is_open(const SceneJoint& j) { return j.clearance && j.clearance->arc; }

/// Two profiles of two bodies that may touch. In `normal`, `bearing` is the elasticity of the first body, `journal` that of the second.
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

/// A motion imposed in time: b's direction minus a's, or the distance from a to b.
struct SceneDriver {
  std::string name;
  DriverKind kind = DriverKind::angle;
  PointRef a, b;
  Law law;  ///< [rad] or [m]
  Place place;
  bool engaged = true;        ///< at the start
  bool from_present = false;  ///< `law` is relative to the value at the start, as the rest is assembled
};

/// A point force in world axes, or in the axes of the loaded body if `follows`.
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
  std::optional<Law> law = {};                         ///< for its pull, instead of these [N]
};
struct SceneTorsionSpring {
  PointRef a, b;
  double stiffness = 0, damping = 0, free_angle = 0;  ///< [N m/rad], [N m s/rad], [rad]
  std::optional<Law> law = {};                        ///< for the restoring torque on b, instead of these [N m]
};
/// A spring and a damper in series.
struct SceneMaxwell {
  PointRef a, b;
  double stiffness = 0, damping = 0;  ///< [N/m], [N s/m], > 0
};
/// An elastic belt round pulleys, from each to the next and from the last to the first: one span each.
struct SceneBelt {
  std::vector<PointRef> pulleys;
  std::vector<double> radii;                          ///< negative where it runs clockwise, following the order of pulleys [m]
  double stiffness = 0, damping = 0, pretension = 0;  ///< per strain and strain rate, at the start [N], [N s], [N]
};
struct SceneLoad {
  std::string name;
  std::variant<SceneForce, SceneTorque, SceneSpring, SceneTorsionSpring, SceneMaxwell, SceneBelt> what;
  Place place;
  bool engaged = true;  ///< at the start
};

/// Actions of an event, in this order.
struct SceneDoing {
  std::vector<std::string> release, engage;           ///< joints, drivers, forces and contacts by their names
  std::vector<std::pair<std::string, Law>> set = {};  ///< states of the scene and their new values [SI]
  bool save = false, row = false;                     ///< save the state as a file; write a row of results
  std::string stop = {};                              ///< reason for stopping the run; empty: it continues
  bool does() const { return !release.empty() || !engage.empty() || !set.empty() || save || row || !stop.empty(); }
};
/// Occurs where all its guards have become positive.
struct SceneEvent {
  std::string name;
  Law guard;                        ///< the condition as written, 1 or 0
  std::vector<Law> when;            ///< its comparisons, the guards
  bool once = false;                ///< otherwise each time
  bool from_start = true;           ///< it occurs at the start if they are positive there
  SceneDoing then, otherwise = {};  ///< `otherwise`: when they are no longer positive
  Place place = {};
};

/// Displacement of a point of a flexible body within its frame, body axes [m].
struct StartDeflection {
  std::string point;
  Pair u{0, 0};
  Place place;
};
/// Initial values of a body at t = 0 fixed by the scene. Unset ones are determined by assembly.
struct StartBody {
  std::string body;
  std::optional<double> x, y, angle;    ///< of the body's origin and axes [m, m, rad]
  std::optional<double> vx, vy, speed;  ///< [m/s, m/s, rad/s]
  Place place;
  std::vector<StartDeflection> deflection = {};  ///< it starts deformed like this, with the least strain energy …
  std::vector<double> modes = {};                ///< … or by these modal coordinates, the lowest first [m kg^0.5]
};
/// Initial position of a journal in its bearing, world axes; by default concentric and moving with it.
struct StartJournal {
  std::string joint;
  Pair eccentricity{0, 0};  ///< journal centre minus bearing centre [m]
  Pair speed{0, 0};         ///< its rate [m/s]
  Place place;
};

/// A state of the scene's own, with a given rate: of a controller, a motor, a tank. SI, of any dimension.
struct SceneState {
  std::string name;
  Law rate;
  double start = 0;
  double scale = 1;  ///< scale of its errors
  std::string unit;  ///< SI, as written in expressions; empty: a number
  Place place = {};
};
/// A number computed for the results.
struct SceneOutput {
  std::string name;
  Law law;
  std::string unit;  ///< likewise
  Place place = {};
};

struct RunOptions {
  double until = 1;                        ///< [s]
  std::string method = "auto";             ///< auto | rkf45 | dopri5 | verner87 | generalized-alpha | moreau
  double step = 0;                         ///< of moreau, fixed [s]
  double rho = 0.8;                        ///< of generalized-alpha: spectral radius at infinite frequency, 0 to 1
  double tolerance = 1e-8;                 ///< local error, relative
  std::string constraints = "projection";  ///< projection | partitioning
  std::optional<double> onset_cut;         ///< reduces the step until the first penetration is below this [m];
                                           ///< unset: the onset is located as an event
  double max_step = 0;                     ///< [s]; 0: none
  long max_steps = 100'000'000;
  double ledger_bound = 1e-3;  ///< energy-balance error, relative to the energy in play
  Place place;
};

struct OutputOptions {
  double every = 0;                   ///< output interval [s]; 0: a thousandth of the run
  double states = 0;                  ///< interval of saved states [s]; 0: only the last
  int frames = 0;                     ///< animation frames; 0: none; -1: default of the command
  double exaggerate = 0;              ///< factor on drawn clearance; 0: chosen so that the gap is visible
  double deformation = 1;             ///< factor on drawn deformation; 0: chosen so that it is visible
  std::vector<PointRef> points;       ///< points whose motion, and on flexible bodies displacement, is recorded
  std::vector<PointRef> stress;       ///< points of flexible bodies whose stress is recorded
  std::vector<double> instants = {};  ///< times of further rows, which studies ask for [s]
  Place place;
};

/// A parameter, in SI.
struct SceneParameter {
  std::string name;
  double value = 0;
  std::string unit = {};  ///< "N*s/m"; empty: a number
  bool varies = false;    ///< events set it; `value` is its initial value
};

struct Scene {
  std::string file;  ///< for messages
  std::string title;
  Pair gravity{0, 0};                      ///< [m/s²]
  std::vector<SceneParameter> parameters;  ///< after overrides, SI
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
  /// Of beams that have been cut into pieces: the piece that a point belongs to, "boom 2" for "boom.tip".
  std::map<std::string, std::string> piece_of_point = {};
  bool start_at_rest = false;  ///< `start: equilibrium`
  std::vector<StartJournal> start_journals;
  bool has_run = true;  ///< false: nothing to run (reader.h: require_run); `run` is then meaningless
  RunOptions run;
  OutputOptions output;
  std::vector<std::string> warnings = {};  ///< input that is valid but may not be intended, in words
  std::string filled_in;                   ///< the scene as JSON text, including all parameters and defaults
};

}  // namespace pintle
