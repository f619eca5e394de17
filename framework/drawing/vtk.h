#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "meshes/mesh.h"

namespace pintle {

/// Values at points or cells, one column each: 1 row for a scalar, 2 for a vector in the plane.
struct Field {
  std::string name;  ///< including its unit: "von Mises [Pa]"
  Eigen::MatrixXd values;
};

/// Writes points, with z = 0, and cells with fields on them, as an unstructured grid in one .vtu file.
/// @throws std::runtime_error  naming the path that cannot be written
void write_grid(const std::filesystem::path&, const Eigen::Matrix2Xd& points, const std::vector<Cells>&,
                const std::vector<Field>& on_points, const std::vector<Field>& on_cells = {}, double t = 0);

/// A file of a collection. Files with the same time are shown together, as its parts.
struct CollectedFile {
  double t = 0;
  std::string file;  ///< relative to the collection
  int part = 0;
};
/// Writes a .pvd: which file to show at which time.
void write_collection(const std::filesystem::path&, const std::vector<CollectedFile>&);

/// Red, green, blue.
using Rgb = std::array<unsigned char, 3>;

/// Kind of a drawn line; written as the cell field `part`, with names in field data. A trace is the path of a point, hatch the ground.
enum class Part { link, joint, journal, bearing, spring, guide, trace, cylinder, hatch };
inline constexpr int line_parts = static_cast<int>(Part::hatch) + 1;
/// Source of a drawn force; numbered in `part` after the lines.
enum class Giver { joint, contact, spring, load };

/// A line of a frame, world axes [m]. A single point is drawn as a vertex, an empty line not at all.
struct DrawnLine {
  Part part = Part::link;
  int owner = 0;        ///< index into Drawing::owners, for colouring by body
  bool closed = false;  ///< the last point is connected to the first, which is not repeated
  std::vector<Eigen::Vector2d> points;
};
/// A force drawn as a vector at a point, world axes, and the associated couple.
struct DrawnForce {
  Eigen::Vector2d at, force;  ///< [m], [N]
  int owner = 0;              ///< index into Drawing::owners
  Giver giver = Giver::contact;
  double couple = 0;  ///< counter-clockwise [N m]
};
/// A point whose path over the frames is drawn.
struct FollowedPoint {
  std::string name;
  Eigen::Vector2d at;  ///< world axes [m]
};
/// An impact of surfaces, at a position between two frames.
struct DrawnImpact {
  int place;  ///< index into Drawing::touching
  double t, approach, peak_force;
};

/// A flexible body of a frame: its drawn grid, with fields on its points.
struct DrawnBody {
  std::string name;
  Eigen::Matrix2Xd points;  ///< deformed, world axes [m]
  std::vector<Cells> cells;
  std::vector<Field> fields;
};

/// One frame of an animation.
struct Drawing {
  double t = 0;                             ///< [s]
  double exaggeration = 1;                  ///< ratio of drawn to true clearance
  double deformation = 1;                   ///< ratio of drawn to true deformation of flexible bodies
  std::vector<std::string> owners;          ///< names of bodies, joints, contacts and forces, the ground; the same in each frame
  std::vector<std::optional<Rgb>> colours;  ///< of the first owners, the bodies; empty if no body has one
  std::vector<DrawnLine> lines;
  std::vector<DrawnForce> forces;
  std::vector<DrawnBody> bodies;        ///< flexible ones; the same bodies, with the same cells, in each frame
  std::vector<FollowedPoint> followed;  ///< the same points in each frame
  std::vector<FollowedPoint> touching;  ///< contact points, or their positions while open: the same contacts in each frame
};

/// Writes `frames/NNNNN.vtu` (the lines of a drawing), `frames/BODY_NNNNN.vtu` (its flexible bodies), `frames/paths.vtu` and
/// `frames/impacts.vtu` (for the whole run), `mechanism.pvd` (their times) and `mechanism.py` (which shows them) in a directory; ParaView
/// opens the last two. They are written without VTK (frame_text.h); write_grid loads it when first called (meshes/module.h), and only
/// vtk_encoder.cpp uses it.
///
/// The lines are an unstructured grid, z = 0: a polygon for each closed line of a link or cylinder, a polyline for each other line, then a
/// vertex for each force; part 0 of the collection.
///
/// | field                    | on     | what                                                     |
/// |--------------------------|--------|----------------------------------------------------------|
/// | `part`                   | cells  | the Part as a number, for a force its Giver after these  |
/// | `owner`                  | cells  | index into `owners`                                      |
/// | `name`                   | cells  | the owner's name                                         |
/// | `force [N]`              | points | vector; zero except at a force's vertex                  |
/// | `couple [N m]`           | points | likewise, a number                                       |
/// | `parts`, `owners`        | frame  | the names of the two numberings                          |
/// | `colours`                | frame  | #rrggbb of the owners that the scene gives one, if any   |
/// | `colour`                 | cells  | as drawn: red, green, blue, 0 to 255; grey if no body's  |
/// | `TimeValue`              | frame  | t [s]                                                    |
/// | `clearance exaggeration` | frame  | drawn clearance over true clearance                      |
///
/// A body has its own grid with its own fields in single precision (points in double), parts 1, 2, … in the order of the drawing:
///
/// | field                      | on     | what                                  |
/// |----------------------------|--------|---------------------------------------|
/// | those of DrawnBody         | points | a field of 2 rows gets z = 0          |
/// | `body`                     | frame  | its name                              |
/// | `TimeValue`                | frame  | t [s]                                 |
/// | `deformation exaggeration` | frame  | drawn deformation over the true one   |
///
/// Paths connect the followed points of the frames; their cells have `name`. Impacts are vertices with `name`, `time [s]`, `approach speed
/// [m/s]` and `peak force [N]`, at positions interpolated between the frames before and after. Both are listed with every frame, after the
/// bodies.
///
/// BODY is the name converted to a file name (file_names.h). Every file appears complete or not at all.
/// @throws std::runtime_error  naming the path that cannot be written
class FrameWriter {
 public:
  /// Creates `directory` and `directory/frames` if they do not exist.
  explicit FrameWriter(std::filesystem::path directory);
  ~FrameWriter();
  void add(const Drawing& drawing);
  /// Writes mechanism.pvd, mechanism.py, paths and impacts; the frames are kept even if it is never called.
  void finish(const std::vector<DrawnImpact>& = {});

 private:
  struct Bodies;  ///< data of the bodies that are the same in each frame
  struct Paths;   ///< points followed so far
  void write_whole_run(const std::string& name, const std::string& vtu);

  std::filesystem::path directory_;
  int frames_ = 0;
  std::vector<CollectedFile> files_;
  std::unique_ptr<Bodies> bodies_;
  std::unique_ptr<Paths> paths_;
};

}  // namespace pintle
