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

/// Values at points or cells, a column each: 1 row a scalar, 2 a vector of the plane.
struct Field {
  std::string name;  ///< with its unit: "von Mises [Pa]"
  Eigen::MatrixXd values;
};

/// Points, z = 0, and cells with fields on them, as an unstructured grid in one .vtu.
/// @throws std::runtime_error  naming the path that cannot be written
void write_grid(const std::filesystem::path&, const Eigen::Matrix2Xd& points, const std::vector<Cells>&,
                const std::vector<Field>& on_points, const std::vector<Field>& on_cells = {}, double t = 0);

/// A file of a collection. Files of one time are shown together, as its parts.
struct CollectedFile {
  double t = 0;
  std::string file;  ///< relative to the collection
  int part = 0;
};
/// A .pvd: when to show which file.
void write_collection(const std::filesystem::path&, const std::vector<CollectedFile>&);

/// Red, green, blue.
using Rgb = std::array<unsigned char, 3>;

/// What kind of thing a drawn line is; written as the cell field `part` and named in field data.
enum class Part { link, joint, journal, bearing, spring, guide, trace };

/// A line of a frame, world axes [m]. One point alone is drawn as a vertex, none as nothing.
struct DrawnLine {
  Part part = Part::link;
  int owner = 0;        ///< index into Drawing::owners, for colouring by body
  bool closed = false;  ///< the last point is joined to the first, which is not repeated
  std::vector<Eigen::Vector2d> points;
};
/// A force drawn as a vector at a point, world axes.
struct DrawnForce {
  Eigen::Vector2d at, force;  ///< [m], [N]
  int owner = 0;              ///< index into Drawing::owners
};

/// A flexible body of a frame: its grid as it is drawn, with fields on its points.
struct DrawnBody {
  std::string name;
  Eigen::Matrix2Xd points;  ///< deformed, world axes [m]
  std::vector<Cells> cells;
  std::vector<Field> fields;
};

/// One frame of an animation.
struct Drawing {
  double t = 0;                             ///< [s]
  double exaggeration = 1;                  ///< drawn clearance over true clearance
  double deformation = 1;                   ///< drawn deformation of the flexible bodies over the true one
  std::vector<std::string> owners;          ///< names of bodies, joints and contacts; the same in each frame
  std::vector<std::optional<Rgb>> colours;  ///< of the first owners, the bodies; empty where no body has one
  std::vector<DrawnLine> lines;
  std::vector<DrawnForce> forces;
  std::vector<DrawnBody> bodies;  ///< flexible ones; the same, with the same cells, in each frame
};

/// Writes `frames/NNNNN.vtu` (the lines of a drawing), `frames/BODY_NNNNN.vtu` (a flexible body of
/// it) and `mechanism.pvd` (their times) under a directory; ParaView opens the last. VTK is loaded
/// when the first grid is written (meshes/module.h); only vtk_encoder.cpp knows it.
///
/// The lines are an unstructured grid, z = 0: a polyline for each line, then a vertex for each
/// force; part 0 of the collection.
///
/// | field                    | on     | what                                                     |
/// |--------------------------|--------|----------------------------------------------------------|
/// | `part`                   | cells  | the Part as a number, one past the last Part for a force |
/// | `owner`                  | cells  | index into `owners`                                      |
/// | `force [N]`              | points | vector; zero except at a force's vertex                  |
/// | `parts`, `owners`        | frame  | the names of the two numberings                          |
/// | `colours`                | frame  | #rrggbb of the owners that the scene gives one, if any   |
/// | `colour`                 | cells  | the same in red, green, blue, 0 to 255; grey for others  |
/// | `TimeValue`              | frame  | t [s]                                                    |
/// | `clearance exaggeration` | frame  | drawn clearance over true clearance                      |
///
/// A body is its own grid with its own fields in single precision (points in double), parts 1, 2, …
/// in the order of the drawing:
///
/// | field                      | on     | what                                  |
/// |----------------------------|--------|---------------------------------------|
/// | those of DrawnBody         | points | a field of 2 rows gets z = 0          |
/// | `body`                     | frame  | its name                              |
/// | `TimeValue`                | frame  | t [s]                                 |
/// | `deformation exaggeration` | frame  | drawn deformation over the true one   |
///
/// BODY is the name made one of a file (file_names.h). Every file appears whole or not at all.
/// @throws std::runtime_error  naming the path that cannot be written
class FrameWriter {
 public:
  /// Makes `directory` and `directory/frames` where they are missing.
  explicit FrameWriter(std::filesystem::path directory);
  ~FrameWriter();
  void add(const Drawing& drawing);
  void finish();  ///< writes mechanism.pvd; what was added before is kept even if never called

 private:
  struct Bodies;  ///< what of the bodies is the same in each frame
  std::filesystem::path directory_;
  int frames_ = 0;
  std::vector<CollectedFile> files_;
  std::unique_ptr<Bodies> bodies_;
};

}  // namespace pintle
