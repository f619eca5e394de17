#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

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

/// A .pvd: when to show which file, given relative to it.
void write_collection(const std::filesystem::path&, const std::vector<std::pair<double, std::string>>& frames);

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

/// One frame of an animation.
struct Drawing {
  double t = 0;             ///< [s]
  double exaggeration = 1;  ///< drawn clearance over true clearance
  std::vector<std::string>
      owners;  ///< names of bodies, joints and contacts; the same in each frame
  std::vector<DrawnLine> lines;
  std::vector<DrawnForce> forces;
};

/// Writes `frames/NNNNN.vtu` (one a drawing) and `mechanism.pvd` (their times) under a directory;
/// ParaView opens the second. The one pair of files of the library that knows VTK.
///
/// A frame is an unstructured grid, z = 0: a polyline for each line, then a vertex for each force.
///
/// | field                    | on     | what |
/// |--------------------------|--------|-----------------------------------------------------------|
/// | `part`                   | cells  | the Part as a number, one past the last Part for a force |
/// | `owner`                  | cells  | index into `owners` | | `force [N]`              | points
/// | vector; zero except at a force's vertex                   | | `parts`, `owners`        | frame
/// | the names of the two numberings                           | | `TimeValue`              | frame
/// | t [s]                                                     | | `clearance exaggeration` | frame
/// | drawn clearance over true clearance                       |
///
/// Every file appears whole or not at all.
/// @throws std::runtime_error  naming the path that cannot be written
class FrameWriter {
 public:
  /// Makes `directory` and `directory/frames` where they are missing.
  explicit FrameWriter(std::filesystem::path directory);
  void add(const Drawing& drawing);
  void finish();  ///< writes mechanism.pvd; what was added before is kept even if never called

 private:
  std::filesystem::path directory_;
  std::vector<std::pair<double, std::string>> frames_;
};

}  // namespace pintle
