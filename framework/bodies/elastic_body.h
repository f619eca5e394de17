#pragma once

#include <string>
#include <vector>

#include "framework/component/fe/fe_model.h"
#include "framework/component/fe/statics.h"
#include "framework/scene/scene.h"
#include "meshes/mesh.h"
#include "meshes/quality.h"

namespace pintle {

/// A prepared body of elements: meshed, numbered, assembled. Matrices are N × N, nodal.
struct ElasticBody {
  const SceneBody* scene = nullptr;
  Mesh mesh;
  MeshQuality quality;  ///< for plane meshes
  FeModel model;
  Sparse K, M;
  std::vector<Fibre> fibres;  ///< for line elements, one per element
  double thickness = 0;       ///< for plates [m]
  std::vector<std::string> warnings;
  double mesh_seconds = 0, assembly_seconds = 0;
  long number = 0;  ///< in the BodyStore that made it; 0: made separately
  bool plate() const { return mesh.plane(); }
};

/// The body called `name`, or the only one of elements if `name` is empty.
/// @throws SceneError  there is none, or several and no name; the remedy lists them
const SceneBody& elastic_of(const Scene&, const std::string& name);

/// Its mesh alone: generated, or read from its file next to the scene. Adds to the warnings.
/// @throws SceneError  any error in shape, file or mesh: no cell, a body in pieces, …
Mesh mesh_of(const Scene&, const SceneBody&, std::vector<std::string>& warnings);

/// @throws SceneError  as mesh_of, and any error in points, holes, material or lumps
ElasticBody elastic_body(const Scene&, const SceneBody&);
/// That a beam's section gives no bending stress; empty: it does, or is that of bars.
std::string fibre_warning(const ElasticBody&);

/// The dofs fixed by one entry of the body's supports.
struct NamedSupport {
  std::string at;
  Supports held;
};
/// @throws SceneError  a place that is neither a point nor a group
std::vector<NamedSupport> supports_of(const Scene&, const ElasticBody&);
/// All of them combined.
Supports together(const std::vector<NamedSupport>&);

/// The scene's static case as forces.
struct BodyLoad {
  Eigen::VectorXd independent;  ///< on independent dofs, n
  Eigen::MatrixXd on_beams;     ///< the part that acts between the nodes of each line element: its share of the nodal
                                ///< forces [f_x f_y m] at both ends, 6 × elements, body axes; 6 × 0 for plates
};
/// @throws SceneError  a place that does not exist, or a load that is not possible on such a body
BodyLoad loads_of(const Scene&, const ElasticBody&);

}  // namespace pintle
