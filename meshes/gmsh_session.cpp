#include "meshes/gmsh_session.h"

#include <gmsh.h>

#include <algorithm>
#include <utility>

namespace pintle {

namespace {

constexpr std::pair<const char*, double> defaults[]{{"General.Terminal", 0},
                                                    {"General.NumThreads", 1},
                                                    {"General.AbortOnError", 0},
                                                    {"Mesh.Algorithm", 6},               // Frontal-Delaunay
                                                    {"Mesh.RecombinationAlgorithm", 2},  // quadrilaterals only, by subdivision
                                                    {"Mesh.RecombineAll", 0},
                                                    {"Mesh.SubdivisionAlgorithm", 0},
                                                    {"Mesh.RandomSeed", 1},
                                                    {"Mesh.RandomFactor", 1e-9},
                                                    {"Mesh.Smoothing", 1},
                                                    {"Mesh.ElementOrder", 1},
                                                    {"Mesh.SecondOrderLinear", 0},
                                                    {"Mesh.SecondOrderIncomplete", 0},
                                                    {"Mesh.HighOrderOptimize", 0},
                                                    {"Mesh.MeshSizeFactor", 1},
                                                    {"Mesh.MeshSizeMin", 0},
                                                    {"Mesh.MeshSizeMax", 1e22},
                                                    {"Mesh.MeshSizeFromPoints", 1},
                                                    {"Mesh.MeshSizeFromCurvature", 0},
                                                    {"Mesh.MeshSizeExtendFromBoundary", 1}};

}  // namespace

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);
  for (const auto& [name, value] : defaults) gmsh::option::setNumber(name, value);
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  gmsh::logger::start();
  gmsh::model::add("pintle");
}

GmshSession::~GmshSession() {
  try {
    gmsh::logger::stop();
    gmsh::model::mesh::removeSizeCallback();
    gmsh::finalize();
  } catch (...) {  // nothing can be saved any more
  }
}

std::string gmsh_errors() {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::string all;
  for (const std::string& line : log)
    if (line.starts_with("Error") && all.size() < 500)
      all += (all.empty() ? "" : "; ") + line.substr(std::min(line.size(), line.find(": ") + 2));
  return all;
}

}  // namespace pintle
