#include "meshes/gmsh_mesher.h"

#include <gmsh.h>

#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "meshes/gmsh_extract.h"
#include "meshes/gmsh_figure.h"
#include "meshes/gmsh_session.h"
#include "meshes/quality.h"
#include "meshes/reject.h"
#include "meshes/sizes.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using std::size_t;
using Tags = std::vector<int>;
namespace fs = std::filesystem;
namespace model = gmsh::model;

void set(const char* option, double value) { gmsh::option::setNumber(option, value); }

// Runs `work` with Gmsh open; an exception or logged error of Gmsh becomes a runtime_error.
template <class Work>
Mesh with_gmsh(const std::string& what, Work work) {
  const GmshSession session;
  std::string words;
  try {
    Mesh mesh = work();
    words = gmsh_errors();
    if (words.empty()) return mesh;
  } catch (const std::logic_error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    words = e.what();
  } catch (const std::string& e) {
    words = e;
  } catch (...) {  // it contains no message
  }
  if (const std::string logged = gmsh_errors(); !logged.empty()) words = logged;
  throw std::runtime_error(what + ": Gmsh cannot " + (words.empty() ? "make a mesh of it" : "make a mesh of it: " + words) +
                           "; use another size or element, or correct the drawing");
}

void generate(const Figure& f, const std::vector<Pinned>& pinned, SizeField field, double factor, CellShape shape) {
  gmsh_make_room(f, pinned, field);
  model::mesh::clear();
  model::mesh::setSizeCallback(
      [field = std::move(field), factor](int, int, double x, double y, double) { return factor * field.at(x, y); });
  if (corners_of(shape) == 4)
    for (const int s : f.surfaces) model::mesh::setRecombine(2, s);
  model::mesh::generate(1);
  gmsh_move_nodes(pinned, f.span);
  model::mesh::generate(2);
  set("Mesh.SecondOrderIncomplete", shape == CellShape::quadrilateral8 ? 1 : 0);
  if (nodes_of(shape) > corners_of(shape)) model::mesh::setOrder(2);
}

void snap(const std::string& name, Mesh& mesh, const std::vector<Vector2d>& points, double span) {
  for (const Vector2d& p : points) {
    const int node = nearest_node(mesh, p, 1e-6 * span);
    if (node < 0)
      reject(name, ": no node could be put at the point (", p.x(), ", ", p.y(),
             ") m; another point or a corner is too near for cells of this size: make `size` smaller");
    mesh.x.col(node) = p;
  }
}

// Merging triangles in pairs gives only quadrilaterals. If the first mesh has a poor one, others are made with another algorithm for
// placing points or slightly different sizes, and the best is used.
Mesh mesh_figure(const Figure& f, const SizeField& field, const MeshOptions& o, double scale) {
  struct Try {
    double algorithm, factor;
  };
  constexpr double good = 0.5;
  const bool quads = corners_of(o.shape) == 4;
  const std::vector<Pinned> pinned = gmsh_pin(f, o.points, scale);
  Mesh best;
  double best_jacobian = -2;
  for (const Try& t : {Try{6, 1}, Try{5, 1}, Try{6, 0.93}, Try{5, 0.93}, Try{6, 0.87}}) {
    set("Mesh.Algorithm", t.algorithm);
    generate(f, pinned, field, t.factor, o.shape);
    Mesh mesh = gmsh_extract(f.name, scale);
    snap(f.name, mesh, o.points, scale * f.span);
    const double jacobian = quality(mesh).least_jacobian;
    if (jacobian > best_jacobian) best_jacobian = jacobian, best = std::move(mesh);
    if (best_jacobian >= (quads ? good : bad_jacobian)) break;
  }
  return best;
}

void draw(const std::vector<Loop>& loops) {
  std::map<std::string, Tags> groups;
  Tags rings;
  for (const Loop& loop : loops) {
    Tags corners, curves;
    for (const Edge& e : loop.edges) corners.push_back(model::geo::addPoint(e.from.x(), e.from.y(), 0));
    for (size_t k = 0; k < loop.edges.size(); ++k) {
      const Edge& e = loop.edges[k];
      const int a = corners[k], b = corners[(k + 1) % corners.size()];
      curves.push_back(e.arc ? model::geo::addCircleArc(a, model::geo::addPoint(e.center.x(), e.center.y(), 0), b)
                             : model::geo::addLine(a, b));
      groups[loop.names[k]].push_back(curves.back());
    }
    rings.push_back(model::geo::addCurveLoop(curves));
  }
  model::geo::addPlaneSurface(rings);
  model::geo::synchronize();
  for (const auto& [name, curves] : groups) model::setPhysicalName(1, model::addPhysicalGroup(1, curves), name);
}

Mesh mesh_drawing(const std::string& name, const MeshOptions& o, double scale) {
  const Figure f = gmsh_figure(name, gmsh_body(2));
  const SizeField field = size_field(f.contours, o.size / scale, o.hole_size / scale);
  return mesh_figure(f, field, o, scale);
}

}  // namespace

Mesh gmsh_link(const Link& link, const MeshOptions& o) {
  return with_gmsh("link", [&] {
    draw(drawing(link));
    set("Mesh.MeshSizeFromPoints", 0);
    set("Mesh.MeshSizeExtendFromBoundary", 0);
    return mesh_drawing("link", o, 1);
  });
}

Mesh gmsh_geometry(const fs::path& path, const MeshOptions& o, double scale) {
  const std::string name = path.string(), kind = path.extension().string();
  return with_gmsh(name, [&] {
    gmsh::merge(name);
    if (const std::string words = gmsh_errors(); !words.empty()) throw std::runtime_error(words);
    gmsh::vectorpair solids;
    model::getEntities(solids, 3);
    if (!solids.empty()) reject(name, ": it contains a solid, but a body is plane: keep only the face in the plane z = 0");
    if (kind == ".msh") return gmsh_extract(name, scale);
    if (gmsh_body(2).empty())
      reject(name,
             ": it contains no surface; draw one bounded by curves (Plane Surface in a .geo, a "
             "face in a .step)");
    // The drawing may have set its own options; those requested here take precedence.
    set("Mesh.ElementOrder", 1);
    set("Mesh.RecombinationAlgorithm", 2);
    set("Mesh.SubdivisionAlgorithm", 0);
    set("Mesh.SecondOrderLinear", 0);
    const bool own_sizes = kind == ".geo" && o.size == 0;
    set("Mesh.MeshSizeFromPoints", own_sizes ? 1 : 0);
    set("Mesh.MeshSizeExtendFromBoundary", own_sizes ? 1 : 0);
    return mesh_drawing(name, o, scale);
  });
}

}  // namespace pintle
