#include "framework/bodies/elastic_body.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <numeric>
#include <sstream>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/in_body.h"
#include "framework/common/text.h"
#include "framework/component/fe/assembly.h"
#include "framework/component/fe/from_mesh.h"
#include "meshes/rim_shape.h"
#include "meshes/soundness.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

std::string described(const WorstCell& cell) {
  std::ostringstream s;
  s << name_of(cell.shape) << " " << cell.number << " at " << shown(cell.at) << " (scaled Jacobian " << std::setprecision(3)
    << cell.quality.jacobian << ")";
  return s.str();
}

void validate_quality(const MeshQuality& q, std::vector<std::string>& warnings) {
  if (!q.inverted.empty())
    throw std::invalid_argument("its mesh has " + std::to_string(q.inverted.size()) + " inverted cell(s), the worst " +
                                described(q.inverted.front()) + "; refine there, use another element, or correct the mesh");
  if (!q.bad.empty())
    warnings.push_back(std::to_string(q.bad.size()) + " badly shaped cell(s), the worst " + described(q.bad.front()) +
                       ": the stress there is unreliable");
}

/// Warns of cells that overlap or are not connected: the body is then not the intended one.
void validate_soundness(const Mesh& mesh, std::vector<std::string>& warnings) {
  const Soundness s = soundness(mesh);
  if (!s.faults.empty()) throw std::invalid_argument("its mesh is not a single sheet: " + s.faults.front());
  warnings.insert(warnings.end(), s.warnings_of.begin(), s.warnings_of.end());
}

/// Warns of elements with too few dofs to bend at constant volume.
void validate_locking(const ScenePlate& plate, const Mesh& mesh, std::vector<std::string>& warnings) {
  constexpr double nearly = 0.48;
  const auto* solid = std::get_if<Isotropic>(&plate.material.material.elastic);
  if (!solid || plate.state != PlaneState::strain || solid->poisson < nearly) return;
  const bool triangles = std::any_of(mesh.cells.begin(), mesh.cells.end(), [](const Cells& c) { return c.shape == CellShape::triangle3; });
  if (!triangles && plate.element != "quadrilateral4-plain") return;
  std::ostringstream s;
  s << (triangles ? "triangle3" : plate.element) << " locks in plane strain at a Poisson's ratio of " << solid->poisson
    << ": it is far too stiff; use quadrilateral4, triangle6 or quadrilateral8";
  warnings.push_back(s.str());
}

/// f(element, length) of each element that bends.
template <class F>
void each_beam(const FeModel& model, F f) {
  const auto each = [&](const auto& block) {
    for (int i = 0; i < block.size(); ++i)
      if constexpr (requires { block.element(i).EI; }) {
        const auto x = block.coords(i, model.x);
        f(block.element(i), (x.col(1) - x.col(0)).norm());
      }
  };
  for (const AnyBlock& any : model.blocks) std::visit(each, any);
}

/// Warns of rounding in the bending of a slender beam, due to its much larger axial stiffness (docs/theory/elements.md).
void validate_slenderness(const FeModel& model, std::vector<std::string>& warnings) {
  constexpr double too_much = 0.01;
  double length = 0, stretch = 0, bending = std::numeric_limits<double>::infinity();
  int elements = 0;
  each_beam(model, [&](const auto& beam, double here) {
    length += here;
    stretch = std::max(stretch, beam.EA), bending = std::min(bending, beam.EI);
    ++elements;
  });
  const double lost = elements * std::numeric_limits<double>::epsilon() * stretch * length * length / (3 * bending);
  if (!(lost > too_much)) return;
  std::ostringstream s;
  s << "it is so slender (" << std::setprecision(2) << length * std::sqrt(stretch / (12 * bending))
    << " times as long as thick) that rounding may change its bending by " << 100 * lost << " %; use a thicker section or a shorter beam";
  warnings.push_back(s.str());
}

// The stiffness 12 EI/l³ of a short element rounds that of the whole, 3 EI/L³, away.
void validate_shortest_element(const FeModel& model, std::vector<std::string>& warnings) {
  constexpr double noticeable = 1e-3, too_much = 1e-2;
  double length = 0, shortest = std::numeric_limits<double>::infinity();
  each_beam(model, [&](const auto&, double here) { length += here, shortest = std::min(shortest, here); });
  const double lost = 4 * std::numeric_limits<double>::epsilon() * std::pow(length / shortest, 3);
  if (!(lost > noticeable)) return;
  std::ostringstream s;
  s << std::setprecision(2) << "its shortest element is " << shortest << " m long, and the beam " << length
    << " m: rounding may change its bending by " << 100 * std::min(lost, 1.0)
    << " %; move points that lie so close to each other together, or further apart";
  if (lost > too_much) throw std::invalid_argument(s.str());
  warnings.push_back(s.str());
}

/// The material with the density that gives `mass` to a body whose mass at density 1 is `volume`.
Material with_mass(Material material, const std::optional<double>& mass, double volume) {
  if (mass) material.density = *mass / volume;
  return material;
}

AnyBlock line_block(const SceneBeam& beam, const Mesh& mesh, std::vector<Fibre>& fibres, const Material& material) {
  const std::vector<int>& nodes = mesh.cells.front().nodes;
  const int n = static_cast<int>(mesh.cells.front().size());
  Block<Bar> bars;
  Block<BeamEuler> euler;
  Block<BeamTimoshenko> timoshenko;
  const auto along = [&](int cell) -> Vector2d {
    const int* const end = &nodes[2 * static_cast<std::size_t>(cell)];
    return mesh.x.col(end[1]) - mesh.x.col(end[0]);
  };
  double length = 0;
  for (int i = 0; i < n; ++i) length += along(i).norm();
  double begun = 0;
  std::vector<int> cells(static_cast<std::size_t>(n));
  std::iota(cells.begin(), cells.end(), 0);
  fibres.clear();
  for (int i = 0; i < n; ++i) {
    const Vector2d d = along(i);
    const double middle = (begun + d.norm() / 2) / length;
    begun += d.norm();
    const BeamModuli moduli = beam_moduli(material, std::atan2(d.y(), d.x()));
    const Section s = section(beam.taper_to ? between(beam.section, *beam.taper_to, middle) : beam.section, beam.shear, moduli.nu);
    const double EA = moduli.E * s.A, EI = moduli.E * s.I, rhoA = material.density * s.A;
    const double rhoI = beam.rotary ? material.density * s.I : 0;
    if (beam.bar)
      bars.properties.push_back({EA, rhoA});
    else if (beam.theory == BeamTheory::euler)
      euler.properties.push_back({EA, EI, rhoA, rhoI});
    else
      timoshenko.properties.push_back({EA, EI, s.kappa * moduli.G * s.A, rhoA, rhoI});
    fibres.push_back({s.A, s.I, beam.bar ? 0 : s.fibre});
  }
  const auto filled = [&](auto block) -> AnyBlock {
    block.nodes = nodes;
    block.cells = cells;
    return block;
  };
  if (beam.bar) return filled(std::move(bars));
  if (beam.theory == BeamTheory::euler) return filled(std::move(euler));
  return filled(std::move(timoshenko));
}

double total_mass(const std::vector<AnyBlock>& blocks, const Eigen::Matrix2Xd& x) {
  double m = 0;
  for (const AnyBlock& any : blocks)
    std::visit(
        [&](const auto& block) {
          for (int i = 0; i < block.size(); ++i) {
            const auto lumped = lumped_mass(block.element(i), block.coords(i, x));
            for (int k = 0; k < lumped.size(); k += static_cast<int>(lumped.size()) / static_cast<int>(block.coords(i, x).cols()))
              m += lumped[k];
          }
        },
        any);
  return m;
}

std::vector<AnyBlock> blocks_of(const SceneBody& body, const Mesh& mesh, std::vector<Fibre>& fibres) {
  const auto at_density = [&](double density, const std::optional<double>& mass, double volume) -> std::vector<AnyBlock> {
    if (const SceneBeam* beam = beam_of(body)) {
      Material material = beam->material.material;
      material.density = density;
      return {line_block(*beam, mesh, fibres, with_mass(material, mass, volume))};
    }
    const ScenePlate& plate = plate_of(body);
    Material material = plate.material.material;
    material.density = density;
    material = with_mass(material, mass, volume);
    return plane_blocks(mesh, {plane_material(material, plate.state), material.density, plate.thickness}, plate.element);
  };
  const SceneBeam* beam = beam_of(body);
  const std::optional<double>& mass = beam ? beam->mass : plate_of(body).mass;
  if (!mass) return at_density((beam ? beam->material : plate_of(body).material).material.density, {}, 1);
  return at_density(1, mass, total_mass(at_density(1, {}, 1), mesh.x));
}

/// Whether sides form a closed loop around the body: the outline, not a hole.
bool is_outline(const Mesh& mesh, const std::vector<Cells>& sides) {
  std::vector<int> begins, ends;
  double twice_area = 0;
  for (const Cells& c : sides)
    for (std::size_t i = 0; i < c.size(); ++i) {
      const int a = c.nodes[i * static_cast<std::size_t>(nodes_of(c.shape))],
                b = c.nodes[i * static_cast<std::size_t>(nodes_of(c.shape)) + 1];
      begins.push_back(a);
      ends.push_back(b);
      twice_area += mesh.x(0, a) * mesh.x(1, b) - mesh.x(1, a) * mesh.x(0, b);
    }
  std::sort(begins.begin(), begins.end());
  std::sort(ends.begin(), ends.end());
  return begins == ends && twice_area > 0;
}

/// Warns of a rim that is not one closed curve: its point is then the centre of that part, not of the hole. Rejects large single arcs.
void validate_rim(const Scene& scene, const Mesh& mesh, const ScenePoint& p, const RimPort& port, const std::vector<Cells>& sides,
                  std::vector<std::string>& warnings) {
  constexpr double bent = 10 * std::numbers::pi / 180, round = 45 * std::numbers::pi / 180, on_circle = 0.02;
  const RimShape rim = rim_shape(mesh, sides);
  const std::string name = "\"" + p.hole + "\"", stands = "point \"" + p.name + "\" is at " + shown(port.x);
  if (rim.loops + rim.open > 1)
    warnings.push_back(name + " is " + std::to_string(rim.loops + rim.open) + " separate rims or edges, coupled to each other: " + stands +
                       ", at the centre of all of them; if this is not intended, give each its own name and point");
  if (rim.open == 0 || rim.angle < bent) return;
  if (rim.misfit > on_circle) {
    warnings.push_back(name + " is not a closed rim: its sides do not form a closed curve, and " + stands +
                       ", their centre; if a hole is meant, name the whole rim");
    return;
  }
  const double grain = 1e-9 * rim.radius;
  const Vector2d center = (rim.center / grain).array().round() * grain;
  const std::string part = name + " covers " + number_text(rim.angle * 180 / std::numbers::pi) + " of 360 deg of a circle of radius " +
                           number_text(rim.radius) + " m about " + shown(center) + ", but its ";
  if (rim.open == 1 && rim.angle >= round)
    throw SceneError(scene.file, p.place,
                     part + "point would be at " + shown(port.x) + ", the centre of that arc; give the whole rim this name");
  warnings.push_back(part + stands + ", the centre of that arc; if a hole is meant, give the whole rim this name");
}

RimPort rim_port(const Scene& scene, const Mesh& mesh, const ScenePoint& p, std::vector<std::string>& warnings) {
  Group rim = group_of(scene, mesh, p.hole, p.place, "give the curve of the hole a physical name in the drawing");
  rim.sides = sides_of(mesh, rim);
  if (rim.sides.empty())
    throw SceneError(scene.file, p.place, "\"" + p.hole + "\" is not a rim: no side of the mesh lies along it; name the curve of a hole");
  if (is_outline(mesh, rim.sides))
    throw SceneError(scene.file, p.place,
                     "\"" + p.hole + "\" is the outline of the body, not a hole in it; name a hole, or hold the edge under supports");
  RimPort port{p.name, Vector2d::Zero(), rim.nodes, rim_weights(mesh, rim),
               p.coupling == RimCoupling::average ? Coupling::average : Coupling::rigid};
  double length = 0;
  for (std::size_t i = 0; i < rim.nodes.size(); ++i) {
    port.x += port.weights[i] * mesh.x.col(rim.nodes[i]);
    length += port.weights[i];
  }
  port.x /= length;
  validate_rim(scene, mesh, p, port, rim.sides, warnings);
  return port;
}

NodePort node_port(const Scene& scene, const SceneBody& body, const Mesh& mesh, const ScenePoint& p) {
  const double size = (mesh.x.rowwise().maxCoeff() - mesh.x.rowwise().minCoeff()).norm();
  const int node = nearest_node(mesh, vector(p.at), size);
  const double gap = (mesh.x.col(node) - vector(p.at)).norm();
  const bool given = !beam_of(body) && is_finished_mesh(plate_of(body));
  if (gap > (given ? 1e-4 : 1e-7) * size) {
    const auto* file = beam_of(body) ? nullptr : std::get_if<SceneFile>(&plate_of(body).shape);
    const int far = file && !file->unit_given ? nearest_node(mesh, 1000 * vector(p.at), 1e-4 * size) : -1;
    if (far >= 0 && vector(p.at).norm() > 0)
      throw SceneError(scene.file, p.place,
                       "no node lies at " + shown(vector(p.at)) + ", but one lies at " + shown(mesh.x.col(far)) +
                           ", a thousand times as far: " + file->path +
                           " is read in m because the scene gives no unit; if it is in mm, add unit: mm");
    throw SceneError(
        scene.file, p.place,
        "no node lies at " + shown(vector(p.at)) + "; the nearest, " + std::to_string(mesh.node_numbers[static_cast<std::size_t>(node)]) +
            ", is at " + shown(mesh.x.col(node)) + ", " + number_text(gap, 3) + " m away" +
            (beam_of(body) ? "; put the point on the beam's axis" : "; put the point there, or mesh a drawing, where points become nodes"));
  }
  return {p.name, node};
}

void add_ports(const Scene& scene, const SceneBody& body, const Mesh& mesh, FeModel& model, std::vector<std::string>& warnings) {
  std::vector<NodePort> nodes;
  std::vector<RimPort> rims;
  for (const ScenePoint& p : body.points)
    if (p.hole.empty())
      nodes.push_back(node_port(scene, body, mesh, p));
    else
      rims.push_back(rim_port(scene, mesh, p, warnings));
  pintle::add_ports(model, nodes, rims);
}

std::vector<Lump> lumps_of(const Scene& scene, const SceneBody& body, const Mesh& mesh) {
  std::vector<Lump> lumps;
  for (const SceneLump& l : body.elastic->lumps) {
    const ScenePoint& p = point_of(scene, body, l.at, l.place);
    if (!p.hole.empty())
      throw SceneError(
          scene.file, l.place,
          "\"" + l.at + "\" is the centre of a hole, where there is no material; attach the lump to a point of the plate itself");
    lumps.push_back({node_port(scene, body, mesh, p).node, {l.mass, l.inertia}});
  }
  return lumps;
}

double seconds(std::chrono::steady_clock::time_point since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

}  // namespace

ElasticBody elastic_body(const Scene& scene, const SceneBody& body) {
  ElasticBody e;
  e.scene = &body;
  const auto start = std::chrono::steady_clock::now();
  e.mesh = mesh_of(scene, body, e.warnings);
  e.mesh_seconds = seconds(start);
  const auto meshed = std::chrono::steady_clock::now();
  in_body(scene, body, [&] {
    if (e.mesh.plane()) {
      e.quality = quality(e.mesh);
      validate_quality(e.quality, e.warnings);
      validate_soundness(e.mesh, e.warnings);
      validate_locking(plate_of(body), e.mesh, e.warnings);
      e.thickness = plate_of(body).thickness;
    }
    e.model = fe_model(e.mesh.x, blocks_of(body, e.mesh, e.fibres), lumps_of(scene, body, e.mesh));
    validate_slenderness(e.model, e.warnings);
    validate_shortest_element(e.model, e.warnings);
    add_ports(scene, body, e.mesh, e.model, e.warnings);
    const Assembler assembler(e.model);
    e.K = assembler.stiffness();
    e.M = assembler.mass(body.elastic->lumped ? MassKind::lumped : MassKind::consistent);
  });
  e.assembly_seconds = seconds(meshed);
  return e;
}

std::string fibre_warning(const ElasticBody& e) {
  const SceneBeam* beam = beam_of(*e.scene);
  if (!beam || beam->bar || std::ranges::none_of(e.fibres, [](const Fibre& f) { return f.distance == 0; })) return "";
  return "its section has no `fibre`, the distance of the outermost fibre from the axis: its stress is N/A alone, without bending";
}

}  // namespace pintle
