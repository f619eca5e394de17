#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "framework/drawing/body_drawing.h"
#include "framework/drawing/vtk.h"

namespace pintle {

struct SupportReaction {
  std::string at;
  Eigen::Vector3d resultant;  ///< Fx, Fy and moment about the origin of the body's axes [N, N, N m]
};
struct PortDisplacement {
  std::string name;
  Eigen::Vector2d x;  ///< [m]
  Eigen::Vector3d u;  ///< u_x, u_y, φ [m, m, rad]; φ is NaN where the point has no rotation
};

struct StaticReport {
  StaticSolution solution;
  StressField stress;
  std::vector<SupportReaction> reactions;
  std::vector<PortDisplacement> ports;
  Eigen::Vector3d load = Eigen::Vector3d::Zero();  ///< resultant of all loads, as in SupportReaction [N, N, N m]
  double greatest_displacement = 0;                ///< [m]
  Eigen::Vector2d displaced_at;                    ///< body axes [m]
  double greatest_stress = 0;                      ///< von Mises [Pa]
  Eigen::Vector2d stressed_at;                     ///< body axes [m]
  double seconds = 0;                              ///< elapsed time of the solution [s]
};

/// @throws SceneError  no static case in the scene, no or too few supports, a load that does not fit
StaticReport solve_case(const Scene&, const ElasticBody&);

/// Evaluates a solution, independently of how it was found.
StaticReport report_of(const Scene&, const ElasticBody&, const std::vector<NamedSupport>&, const BodyLoad&, StaticSolution);

/// At each point of the body's drawing: displacement, von Mises, principal stresses, stress components. The fields of static.vtu.
std::vector<Field> static_fields(const BodyDrawing&, const StaticReport&);
std::string points_csv(const StaticReport&);
/// @pre the body is of line elements
std::string section_forces_csv(const ElasticBody&, const StaticReport&);

/// static.vtu (displacement, stress components, von Mises, principal stresses), points.csv; for beams section_forces.csv; static.json
void write_case(const std::filesystem::path& directory, const Scene&, const ElasticBody&, const StaticReport&);
std::string static_json(const Scene&, const ElasticBody&, const StaticReport&);

/// mesh.vtu (quality of each cell, a field for each group) and mesh.json.
void write_mesh_report(const std::filesystem::path& directory, const Scene&, const ElasticBody&);
std::string mesh_json(const Scene&, const ElasticBody&);

}  // namespace pintle
