#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/scene/units/spelling.h"
#include "framework/scene/joint_words.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/yaml_node.h"

/// The reader, section by section. Each function reads one section of the root group into the scene; all throw SceneError.
namespace pintle {

void read_materials(const Node& root, Scene&);
void read_bodies(const Node& root, Scene&);  ///< ground and bodies; after materials
void read_joints(const Node& root, Scene&);
void read_contacts(const Node& root, Scene&);  ///< after bodies
void read_drivers(const Node& root, const std::filesystem::path& folder, Scene&);
void read_states(const Node& root, Scene&);                                           ///< without rates; before forces and outputs
void read_forces(const Node& root, Scene&);                                           ///< without laws; after everything that has signals
void read_state_rates(const Node& root, Scene&);                                      ///< after forces
void read_force_laws(const Node& root, const std::filesystem::path& folder, Scene&);  ///< after what states are made of
void read_outputs(const Node& root, Scene&);                                          ///< after state rates
void read_events(const Node& root, Scene&);                                           ///< after everything that they act on
void read_start(const Node& root, Scene&);                                            ///< after bodies and joints
void read_static(const Node& root, Scene&);                                           ///< after bodies
void read_run(const Node& root, Scene&);
void read_output(const Node& root, Scene&);  ///< after run

/// The name of a body, point, joint, driver or force: one allowed in a table's header and in "body.point".
std::string checked_name(const Node&);
/// The value of a parameter. @param all  the names of all parameters of its group
Quantity read_parameter(const Node&, const std::vector<std::string>& all);
/// "crank.A", "crank" or "ground".
PointRef read_point_ref(const Node&);
/// [a, b]   @param remedy  what to write instead of another list
std::pair<PointRef, PointRef> read_ends(const Node&, const std::string& remedy = "two points [a, b] such as [crank.A, coupler.A]");

/// Profiles of a body or the ground with these points. @param keys  path of a profile's keys
std::vector<SceneProfile> read_profiles(const Node& owner, std::string_view keys, const std::vector<ScenePoint>&, const std::string& body);

/// A law of a clearance joint or, with other keys, of a contact. @param keys  path of the law's keys
SceneNormal read_normal(const Node&, std::string_view keys);
/// The normal and friction laws of a contact of profiles.
/// @param keys  path of friction's keys
void read_laws(const Node&, std::string_view keys, SceneNormal&, std::optional<SceneImpact>&, std::optional<SceneFriction>&);
/// For `model: impact`; a restitution not given there is that of `normal`.
SceneImpact read_impact(const Node&, std::string_view keys);
void reject_impact_keys(const Node&);
void check_rigid_friction(const Node&);

SceneFriction read_friction(const Node&, const std::string& keys);
/// @param keys  path of the law's own keys
SceneFriction read_friction_law(const Node&, const std::string& keys);

enum class Smoothness { driver, load };  ///< a driver needs two derivatives, a load only the value
/// An expression in t, or {table: file}; checked to be finite from 0 to `until`.
Law read_time_law(const Node&, const Dimension&, Smoothness, const std::filesystem::path& folder, double until);
/// @throws SceneError  it is not finite somewhere from 0 to `until`
void must_be_finite(const Node&, const Law&, Smoothness, double until);
/// The path of a table's file. @throws SceneError  it is not next to the scene
std::filesystem::path table_file(const Node& table, const std::filesystem::path& folder);

/// The signals that expressions acting on the motion may name, determined at first use.
class ActingSignals {
 public:
  ActingSignals(const Node& root, const Scene& scene) : root_(root), scene_(scene) {}
  const SignalNames& names();
  /// Whether the text may name a signal; avoids listing all signals of a large scene for "10 N".
  bool may_be_in(const std::string& text) const;

 private:
  const Node& root_;
  const Scene& scene_;
  std::optional<SignalNames> names_;
};

/// A load as a law of time or of signals: an expression, or {table: file, over: expression}.
Law read_load_law(const Node&, std::string_view keys, const Dimension&, const std::filesystem::path& folder, double until, ActingSignals&);

/// The rate of a state: an expression of the dimension, or a table.
Law read_rate(const Node&, const Dimension&, const Scene&, const SignalNames&);
/// Checks that a name differs from all other names in expressions. @param what  "a state"
void check_signal_name(const Node&, const Scene&, const char* what);

/// The description of a body of elements; its points are read already.
SceneElastic read_elastic(const Node& body, const SceneBody&, const std::vector<SceneMaterial>&);
SceneBeam read_beam(const Node&, const SceneBody&, const std::vector<SceneMaterial>&);
ScenePlate read_plate(const Node&, const std::vector<SceneMaterial>&);

/// The material of a beam or plate: a material of the scene, or one written in its own keys; and its mass, if given instead of a density.
struct Made {
  SceneMaterial material;
  std::optional<double> mass;  ///< [kg]
};
/// @param keys  path of the owner's keys: "bodies.*.beam"
Made read_made(const Node& owner, std::string_view keys, const std::vector<SceneMaterial>&);

/// @throws SceneError  at the node: the body has no such point
void check_own_point(const Node&, const std::string& name, const SceneBody&);
/// The terms of a differential that lists groups; false: it lists points.
bool read_terms(const Node& list, SceneJoint&);
/// The data of a coupling besides its points.
void read_coupling(const Node& joint, const JointWord&, SceneJoint&);
/// Whether an expression adds to `present`, the value of a length or angle at the start.
bool says_present(const Node&);
/// The law of the part added to `present`. @param until  as for read_time_law
Law read_after_present(const Node&, const Dimension&, double until = 0);
/// Name of a point that the body has.
std::string read_own_point(const Node&, const SceneBody&);
/// n quantities in a list, each satisfying the rule. `remedy`: what to write.
std::vector<double> read_quantities(const Node&, std::size_t n, const Dimension&, Rule, const std::string& remedy);

/// Elements that events may release are engaged at the start by default.
bool read_engaged(const Node&);

/// A positive length.
inline double read_size(const Node& node) { return node.quantity(dimension::length, rule::positive); }

/// The SI value of the unit that `key` names; 1 without the key.
double unit_factor(const Node& group, std::string_view key, const Dimension& expected);

/// Reads `key` into `value` if present.
void read_optional(const Node& group, std::string_view key, const Dimension&, Rule, double& value);

/// The scene as JSON that the reader converts back to the same scene.
std::string filled_in(const Scene&);

/// The default reference conditions of a body whose modes are chosen by the scene's motion: through the two points farthest apart that
/// joints hold, or at the only such point if it is clamped; otherwise mean axes. @pre it has modes
void choose_frame(SceneBody&, const Scene&);
/// @throws SceneError  no contact law acts on a body with a massless boundary
void check_boundary(const SceneBody&, const Scene&);

}  // namespace pintle
