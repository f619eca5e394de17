#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "elements/material.h"
#include "elements/section.h"
#include "framework/scene/place.h"
#include "meshes/link.h"

/// The description of a finite-element body in a scene.
namespace pintle {

struct SceneMaterial {
  std::string name;  ///< empty if it was written in the body itself
  Material material;
  Place place;
};

enum class BeamTheory { euler, timoshenko };

inline constexpr int default_beam_elements = 20;

/// A beam along straight pieces between points of the body.
struct SceneBeam {
  std::vector<std::string> through;  ///< names of two or more points, in order
  SectionShape section = CircleSection{0};
  std::optional<SectionShape> taper_to;  ///< section at the far end; dimensions vary linearly along the beam
  BeamTheory theory = BeamTheory::timoshenko;
  ShearFactor shear = ShearFactor::cowper;
  bool rotary = true;  ///< rotary inertia of the sections
  bool bar = false;    ///< bars: axial only, pinned at every node
  SceneMaterial material;
  std::optional<double> mass;  ///< scales the density to give the body this mass [kg]
  int elements = 0;            ///< over the whole length, distributed by length; 0: the default
  int pieces = 1;              ///< number of floating frames it is divided into, with the pieces welded together
};

struct SceneFile {
  std::string path;         ///< relative to the scene file
  double scale = 1;         ///< m per unit of the file
  bool unit_given = false;  ///< by `unit` or `scale`
};
struct SceneGrid {
  std::array<Pair, 4> corners;  ///< counter-clockwise [m]
  int nx = 1, ny = 1;
};

/// A plane part of uniform thickness.
struct ScenePlate {
  std::variant<Link, SceneFile, SceneGrid> shape;
  double thickness = 0;  ///< [m]
  PlaneState state = PlaneState::stress;
  bool state_given = false;  ///< by `plane`
  SceneMaterial material;
  std::optional<double> mass;      ///< scales the density to give the body this mass [kg]
  std::string element;             ///< "triangle6" …; empty: triangle6, or as in the mesh file
  double size = 0, hole_size = 0;  ///< [m]; 0: default
};

enum class RimCoupling { none, rigid, average };

/// Which dofs of a point or group are fixed.
struct SceneSupport {
  std::string at;  ///< point, group, hole or edge
  bool x = false, y = false, rotation = false;
  Place place;
};

/// A lump fixed to a point.
struct SceneLump {
  std::string at;
  double mass = 0, inertia = 0;  ///< [kg], [kg m²]
  Place place;
};

/// How many shapes are kept; unset: all.
struct SceneKeep {
  bool automatic = false;  ///< those excited by the motion of the scene
  std::optional<int> count;
  std::optional<double> below;           ///< [Hz]
  std::optional<double> effective_mass;  ///< share, 0 to 1
};
struct SceneModes {
  enum class Frame { tangent, chord, mean_axes } frame = Frame::mean_axes;
  std::string a, b;  ///< points of the reference conditions; empty: the first and last marker of the body
  enum class Method { normal, craig_bampton, free } method = Method::normal;
  SceneKeep keep;
  bool massless = false;  ///< at clearance joints with a contact law the left-out flexibility is in series with the contact
  Place place;
};

/// Damping of the shapes: C = αM + βK, from ratios at two modes, or one ratio per shape (the last also for the rest).
struct SceneDamping {
  std::optional<std::array<double, 2>> rayleigh_ratios;
  std::array<int, 2> rayleigh_modes{1, 2};        ///< counted from 1
  std::optional<std::array<double, 2>> rayleigh;  ///< α [1/s], β [s]
  std::vector<double> ratios;
  Place place;
};

/// Which loads give a flexible body geometric stiffness, through its foreshortening: docs/theory/motion.md.
enum class Stiffening {
  none,
  rotation,  ///< its inertia: spin and accelerations of the frame
  axial,     ///< these, and loads at its points
};

/// A body of elements: exactly one of beam and plate. Without `modes` it is rigid in a mechanism.
struct SceneElastic {
  std::variant<SceneBeam, ScenePlate> shape;
  bool lumped = false;  ///< lumped instead of consistent mass
  std::vector<SceneLump> lumps;
  std::vector<SceneSupport> supports;
  std::optional<SceneModes> modes;
  std::optional<SceneDamping> damping;
  Stiffening stiffening = Stiffening::none;  ///< only with `modes`
};

struct SceneStaticLoad {
  enum class Kind { force, torque, traction, pressure, line, acceleration, spin };
  Kind kind = Kind::force;
  std::string name;
  /// Point (force, torque), group (traction, pressure), or point or empty (spin: the origin).
  std::string at;
  Pair vector{0, 0};  ///< force [N], traction [Pa], line load [N/m], acceleration [m/s²]; body axes
  double value = 0;   ///< torque [N m], pressure [Pa], spin [rad/s]
  Place place;
  std::string body = {};  ///< the loaded body; empty: that of the case
};
/// Edges or holes of two bodies that may touch without friction.
struct SceneStaticContact {
  struct Side {
    std::string body, group;
  };
  std::string name;
  Side first, second;
  Place place;
};
/// Position of the origin of a body's axes in the axes of the case.
struct SceneStaticPlace {
  std::string body;
  Pair at{0, 0};  ///< [m]
  Place place;
};
/// A static load case of one body, or of several touching bodies, held by their supports.
struct SceneStatic {
  std::string body;  ///< empty: the only elastic body
  std::vector<SceneStaticLoad> loads;
  Place place;
  std::vector<SceneStaticContact> contacts = {};
  std::vector<SceneStaticPlace> at = {};  ///< bodies not listed stay where they are drawn
  /// The body on which a load acts.
  const std::string& loaded(const SceneStaticLoad& l) const { return l.body.empty() ? body : l.body; }
};

}  // namespace pintle
