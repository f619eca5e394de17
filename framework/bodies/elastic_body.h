#pragma once

#include <string>
#include <vector>

#include "framework/component/fe/fe_model.h"
#include "framework/component/fe/statics.h"
#include "framework/scene/scene.h"
#include "meshes/mesh.h"
#include "meshes/quality.h"

namespace pintle {

/// A body of elements made ready: meshed, numbered, assembled. Matrices are N × N, nodal.
struct ElasticBody {
  const SceneBody* scene = nullptr;
  Mesh mesh;
  MeshQuality quality;  ///< of plane meshes
  FeModel model;
  Sparse K, M;
  std::vector<Fibre> fibres;  ///< of lines, one an element
  double thickness = 0;       ///< of plates [m]
  std::vector<std::string> warnings;
  double mesh_seconds = 0, assembly_seconds = 0;
  long number = 0;  ///< in the BodyStore that has made it; 0: made for itself
  bool plate() const { return mesh.plane(); }
};

/// The body called `name`, or the only one of elements if `name` is empty.
/// @throws SceneError  there is none, or several and no name; the remedy lists them
const SceneBody& elastic_of(const Scene&, const std::string& name);

/// Its mesh alone: generated, or read from its file beside the scene. Adds to the warnings.
/// @throws SceneError  whatever is wrong with shape, file or mesh: no cell, a body in pieces, …
Mesh mesh_of(const Scene&, const SceneBody&, std::vector<std::string>& warnings);

/// @throws SceneError  as mesh_of, and whatever is wrong with points, holes, material or lumps
ElasticBody elastic_body(const Scene&, const SceneBody&);

/// What one entry of the body's supports holds.
struct NamedSupport {
  std::string at;
  Supports held;
};
/// @throws SceneError  a place that is neither a point nor a group
std::vector<NamedSupport> supports_of(const Scene&, const ElasticBody&);
/// All of them as one.
Supports together(const std::vector<NamedSupport>&);

/// The scene's static case as forces.
struct BodyLoad {
  Eigen::VectorXd independent;  ///< on independent freedoms, n
  Eigen::MatrixXd on_beams;     ///< what of it acts between the nodes of each line element: its share of the nodal
                                ///< forces [f_x f_y m] at both ends, 6 × elements, body axes; 6 × 0 of plates
};
/// @throws SceneError  a place that is not there, or a load that such a body cannot take
BodyLoad loads_of(const Scene&, const ElasticBody&);

}  // namespace pintle
