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

/// The reader, section by section. Each function reads one section of the root group into the
/// scene; all throw SceneError.
namespace pintle {

void read_materials(const Node& root, Scene&);
void read_bodies(const Node& root, Scene&);  ///< ground and bodies; after materials
void read_joints(const Node& root, Scene&);
void read_contacts(const Node& root, Scene&);  ///< after bodies
void read_drivers(const Node& root, const std::filesystem::path& folder, Scene&);
void read_states(const Node& root, Scene&);                                       ///< but their rates; before forces and outputs
void read_forces(const Node& root, const std::filesystem::path& folder, Scene&);  ///< after all that has signals
void read_state_rates(const Node& root, Scene&);                                  ///< after forces
void read_outputs(const Node& root, Scene&);                                      ///< after state rates
void read_events(const Node& root, Scene&);                                       ///< after all that they act on
void read_start(const Node& root, Scene&);                                        ///< after bodies and joints
void read_static(const Node& root, Scene&);                                       ///< after bodies
void read_run(const Node& root, Scene&);
void read_output(const Node& root, Scene&);  ///< after run

/// The name of a body, point, joint, driver or force: what a table's header and "body.point" can
/// bear.
std::string checked_name(const Node&);
/// The value of a parameter. @param all  the names of those of its group
Quantity read_parameter(const Node&, const std::vector<std::string>& all);
/// "crank.A", "crank" or "ground".
PointRef read_point_ref(const Node&);
/// [a, b]   @param remedy  what to write in place of another list
std::pair<PointRef, PointRef> read_ends(const Node&, const std::string& remedy = "two points [a, b] such as [crank.A, coupler.A]");

/// Profiles of a body or the ground that has these points. @param keys  path of a profile's keys
std::vector<SceneProfile> read_profiles(const Node& owner, std::string_view keys, const std::vector<ScenePoint>&, const std::string& body);

/// A law of a clearance joint or, other keys, of a contact. @param keys  path of the law's keys
SceneNormal read_normal(const Node&, std::string_view keys);
/// @param keys  path of friction's keys
/// What presses the surfaces of a contact of profiles apart, and what rubs.
void read_laws(const Node&, std::string_view keys, SceneNormal&, std::optional<SceneImpact>&, std::optional<SceneFriction>&);
/// Of `model: impact`; a restitution not given there is that of `normal`.
SceneImpact read_impact(const Node&, std::string_view keys);
void reject_impact_keys(const Node&);
void check_rigid_friction(const Node&);

SceneFriction read_friction(const Node&, const std::string& keys);
/// @param keys  path of the law's own keys
SceneFriction read_friction_law(const Node&, const std::string& keys);

enum class Smoothness { driver, load };  ///< a driver needs two derivatives, a load only the value
/// An expression in t, or {table: file}; judged to be finite from 0 to `until`.
Law read_time_law(const Node&, const Dimension&, Smoothness, const std::filesystem::path& folder, double until);
/// @throws SceneError  it is not finite somewhere from 0 to `until`
void must_be_finite(const Node&, const Law&, Smoothness, double until);
/// The path of the file that a table names. @throws SceneError  it is not beside the scene
std::filesystem::path table_file(const Node& table, const std::filesystem::path& folder);

/// The signals that what acts on the motion may name, found when first asked for.
class ActingSignals {
 public:
  ActingSignals(const Node& root, const Scene& scene) : root_(root), scene_(scene) {}
  const SignalNames& names();
  /// May the text name some? Cheaper than to list all of a large scene for "10 N".
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
/// A name that an expression can tell from all others. @param what  "a state"
void check_signal_name(const Node&, const Scene&, const char* what);

/// What a body of elements says; its points are read already.
SceneElastic read_elastic(const Node& body, const SceneBody&, const std::vector<SceneMaterial>&);
SceneBeam read_beam(const Node&, const SceneBody&, const std::vector<SceneMaterial>&);
ScenePlate read_plate(const Node&, const std::vector<SceneMaterial>&);

/// What a beam or plate is made of: a material of the scene, or one written in its own keys; and
/// its mass, where that is given instead of a density.
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
/// What a coupling says beside its points.
void read_coupling(const Node& joint, const JointWord&, SceneJoint&);
/// An expression that adds to `present`, what a length or angle is at the start; and the law of what it adds.
bool says_present(const Node&);
/// @param until  as of read_time_law
Law read_after_present(const Node&, const Dimension&, double until = 0);
/// Of a law from 0 to `until`.
void must_be_finite(const Node&, const Law&, Smoothness, double until);
/// Name of a point that the body has.
std::string read_own_point(const Node&, const SceneBody&);
/// n quantities in a list, each after the rule. `remedy`: what to write.
std::vector<double> read_quantities(const Node&, std::size_t n, const Dimension&, Rule, const std::string& remedy);

/// What events may release is in the mechanism at the start, if it does not say otherwise.
bool read_engaged(const Node&);

/// A length above zero.
inline double read_size(const Node& node) { return node.quantity(dimension::length, rule::positive); }

/// What one of the unit that `key` names is in SI; 1 without the key.
double unit_factor(const Node& group, std::string_view key, const Dimension& expected);

/// Reads `key` into `value` if it is there.
void read_optional(const Node& group, std::string_view key, const Dimension&, Rule, double& value);

/// The scene as JSON that the reader reads back to the same scene.
std::string filled_in(const Scene&, const Parameters&);

/// The frame of a body whose modes are chosen by the scene's motion and that says none: through the two points farthest apart that
/// joints hold, or at the only one if that is clamped; else mean axes. @pre it has modes
void choose_frame(SceneBody&, const Scene&);

}  // namespace pintle
