#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/scene/place.h"

/// The description of touching surfaces in a scene: laws of normal force and friction, clearances. Plain data, SI units.
namespace pintle {

/// The elasticity of one of the bodies in contact.
struct Elasticity {
  double young = 0;    ///< [Pa]
  double poisson = 0;  ///< –
};

/// How a contact law's stiffness is computed from the radii: see docs/theory/contact.md.
enum class RadiusConvention { internal, external };

/// The published factor χ(e) that damps the impact; `none` is Hertz without loss. The list, the names in scene files and the formulas are
/// in contact/normal_law.h; those of cylinders in contact/cylinder_law.h.
struct SceneNormal {
  std::string law = "lankarani-nikravesh";  ///< a name known to contact/normal_law.h or contact/cylinder_law.h, "spring-damper", "table"
  double restitution = 1;
  double exponent = 1.5;
  std::optional<double> stiffness;  ///< given directly [N/mⁿ]; otherwise from elasticity and radii
  Elasticity bearing, journal;
  RadiusConvention radii = RadiusConvention::internal;
  double slowest_impact = 1e-6;  ///< lower bound of the latched approach speed [m/s]
  Place place;
  bool follows = false;  ///< its damping is scaled by the largest approach speed since the onset; false: by that at the onset
  double damping = 0;    ///< of the law "spring-damper", for contacts of profiles [N s/m]
  // For laws of cylinders and tables:
  std::string hysteresis = "lankarani-nikravesh";  ///< their hysteresis factor, for `restitution`
  double length = 0;                               ///< of cylinders, along their axes [m]
  std::vector<Pair> points = {};                   ///< of a table: depth and force, from (0, 0) [m, N]
  double layer = 0;  ///< of winkler: thickness of the layer, with `bearing`'s elasticity [m]; 0: `stiffness` is that of the layer [N/m³]
};

enum class SlidingSpeed { material, geometric };

struct SceneFriction {
  double coefficient = 0;       ///< while sliding, –
  double v0 = 1e-3, v1 = 1e-2;  ///< speeds of a curve [m/s]; Ambrósio's v0 < v1
  SlidingSpeed sliding = SlidingSpeed::material;
  Place place = {};
  std::string law = "ambrosio";      ///< or threlfall, tanh, bengisu-akay, coulomb, lugre, gonthier
  std::optional<double> holds = {};  ///< static coefficient, ≥ coefficient; unset: the same, –
  double stribeck = 0;  ///< speed scale of the fall from the static to the sliding coefficient [m/s]; 0: immediate, for bristles 1 mm/s
  // For lugre and gonthier, per unit of normal force:
  double bristle_stiffness = 0;                                    ///< [1/m]
  std::optional<double> bristle_damping = {}, damping_speed = {};  ///< unset: critical_damping, gentle_damping_speed [s/m], [m/s]
  double viscous = 0;                                              ///< [s/m]
  double dwell = 0;                                                ///< of gonthier [s]
};

/// Rigid bodies with instantaneous impacts: docs/theory/impact.md.
struct SceneImpact {
  double restitution = 0;  ///< 0 to 1
  double tangential = 0;   ///< for slips that friction stops, 0 to 1
  bool poisson = false;    ///< restitution of impulses; false: of speeds (Newton)
};

/// Model of a journal in its bearing: docs/theory/contact.md. A scene changes it by one word; data of other models may remain and are
/// ignored, which `pintle check` reports.
enum class ClearanceModel { contact, massless_link, spring_damper, impact };

/// The remaining part of the hole of an open bearing, in the axes of the bearing's point.
struct SceneArc {
  double middle = 0;  ///< direction of its middle [rad]
  double extent = 0;  ///< angle that it spans, at most a full turn [rad]
  double wall = 0;    ///< thickness; not used for a full turn [m]
  double edge = 0;    ///< radius of the edges at its ends; 0: sharp [m]
  static constexpr double turn = 6.283185307179586, rounding = 1e-9;
  bool whole() const { return extent > turn - rounding; }
};

struct SceneClearance {
  ClearanceModel model = ClearanceModel::contact;
  double radial = 0;          ///< bearing radius − journal radius [m]
  double bearing_radius = 0;  ///< [m]
  std::string bearing;        ///< name of the joint's body with the bearing
  SceneNormal normal;         ///< without stiffness and `young` if not given
  /// For the spring and damper [N/m], [N s/m]; unset: with the stiffness and loss of `normal` in a typical impact.
  std::optional<double> stiffness = {}, damping = {};
  std::optional<SceneFriction> friction;
  Place place;
  SceneImpact impact = {};           ///< for the impact model
  std::optional<SceneArc> arc = {};  ///< of an open bearing; unset: the hole is complete

  double journal_radius() const { return bearing_radius - radial; }
};
/// Name in scene files.
const char* model_name(ClearanceModel);

/// Clearance in a prismatic, slot or distance joint, or between the teeth of a gear or rack.
struct ScenePlay {
  double gap = 0;                              ///< from a centred block or pin to each wall; for a rod, on each side of its length [m]
  double length = 0, height = 0;               ///< of the block in a prismatic joint, along and across the guide [m]
  double round = 0;                            ///< radius of its corners [m]
  double pin_radius = 0;                       ///< of a slot's pin [m]
  double backlash = 0;                         ///< of teeth, along the pitch circle [m]
  double pressure_angle = 0;                   ///< of their flanks [rad]
  std::optional<double> travel = {};           ///< of the pin from end to end of its slot, with a in the middle; unset: no ends [m]
  enum Only { both, pull, push } only = both;  ///< a rod that only pulls: a rope
  SceneNormal normal = {};
  std::optional<SceneFriction> friction = {};
  Place place = {};
  std::optional<SceneImpact> impact = {};  ///< instead of `normal`
};

}  // namespace pintle
