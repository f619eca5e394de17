#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace pintle {

/// What kind of thing a drawn line is; written as the cell field `part` and named in field data.
enum class Part { link, joint, journal, bearing, spring, ground, trace };

/// A line of a frame, world axes [m].
struct DrawnLine {
  Part part = Part::link;
  int owner = 0;       ///< index into Drawing::owners, for colouring by body
  bool closed = false;
  std::vector<Eigen::Vector2d> points;
};
/// A force drawn as a vector at a point, world axes.
struct DrawnForce {
  Eigen::Vector2d at, force;  ///< [m], [N]
  int owner = 0;              ///< index into Drawing::owners
};

/// One frame of an animation.
struct Drawing {
  double t = 0;                      ///< [s]
  double exaggeration = 1;           ///< drawn clearance over true clearance
  std::vector<std::string> owners;   ///< names of bodies, joints and contacts; the same in each frame
  std::vector<DrawnLine> lines;
  std::vector<DrawnForce> forces;
};

/// Writes `frames/NNNNN.vtu` (one each) and `mechanism.pvd` (the times) under a directory.
/// The one file that includes VTK.
/// @throws std::runtime_error  naming the path that cannot be written
class FrameWriter {
 public:
  explicit FrameWriter(std::filesystem::path directory);
  void add(const Drawing& drawing);
  void finish();  ///< writes mechanism.pvd; what was added before is kept even if never called

 private:
  std::filesystem::path directory_;
  std::vector<std::pair<double, std::string>> frames_;
};

}  // namespace pintle
