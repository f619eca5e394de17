#include "framework/report/drawn_model.h"

#include <span>

#include <nlohmann/json.hpp>

#include "framework/common/index.h"
#include "framework/drawing/palette.h"
#include "framework/mechanism/drawn_symbols.h"
#include "framework/mechanism/drawn_wheels.h"
#include "framework/mechanism/result_tables.h"
#include "framework/report/drawn_mesh.h"
#include "framework/report/page.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;
using Line = std::vector<Eigen::Vector2d>;

Json flat(const Line& points) {
  Json out = Json::array();
  for (const Eigen::Vector2d& p : points) out.push_back(p.x()), out.push_back(p.y());
  return out;
}

Json place(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

Json rows(const Eigen::Matrix2Xd& shape) {
  Json x = Json::array(), y = Json::array();
  for (Eigen::Index k = 0; k < shape.cols(); ++k) x.push_back(shape(0, k)), y.push_back(shape(1, k));
  return {x, y};
}

Json marker_json(const Marker& m) {
  Json out{{"body", m.body}, {"at", place(m.x_BP)}, {"angle", m.angle}};
  if (m.shape.cols() > 0) {
    out["shape"] = rows(m.shape);
    out["slope"] = std::vector<double>(m.slope.begin(), m.slope.end());
  }
  return out;
}

/// The rows of the given points, `per` rows each, of a matrix with one column per shape, shape by shape.
std::string of_points(const Eigen::MatrixXd& all, int per, const std::vector<int>& points) {
  std::vector<float> out;
  for (Eigen::Index shape = 0; shape < all.cols(); ++shape)
    for (const int p : points)
      for (int k = 0; k < per; ++k) out.push_back(static_cast<float>(all(per * p + k, shape)));
  return base64(std::span<const float>(out));
}

template <std::size_t n>
std::string numbers(const std::vector<std::array<int, n>>& all) {
  std::vector<int> out;
  for (const auto& group : all) out.insert(out.end(), group.begin(), group.end());
  return base64(std::span<const int>(out));
}

Json profiles_json(const Model& model, int body) {
  Json out = Json::array();
  for (const DrawnProfile& p : model.profiles)
    if (p.body == body) out.push_back({{"marker", p.marker}, {"closed", p.solid}, {"points", flat(p.points)}});
  return out;
}

std::string css(const Rgb& rgb) {
  return "rgb(" + std::to_string(rgb[0]) + ", " + std::to_string(rgb[1]) + ", " + std::to_string(rgb[2]) + ")";
}

Json bodies_json(const Model& model, const Drafting& drafting, std::size_t mesh_bytes) {
  Json out = Json::array();
  auto flexible = model.drawings.begin();
  const std::size_t share = mesh_bytes / std::max<std::size_t>(model.drawings.size(), 1);
  for (std::size_t b = 0; b < model.system.bodies.size(); ++b) {
    const Body& body = model.system.bodies[b];
    Json one{{"name", body.name},
             {"origin", place(body.x_BO)},
             {"outline", flat(drafting.links[b])},
             {"profiles", profiles_json(model, static_cast<int>(b))},
             {"modes", body.modes()}};
    if (b < drafting.colours.size() && drafting.colours[b]) one["colour"] = css(*drafting.colours[b]);
    if (body.flex && flexible != model.drawings.end()) {
      const FlexibleDrawing& f = *flexible++;
      one["mesh"] = mesh_json({f.points(), f.cells(), f.size(), f.displacements(), &f.stresses()}, share);
    }
    out.push_back(std::move(one));
  }
  return out;
}

const char* symbol_name(JointSymbol symbol) {
  switch (symbol) {
    case JointSymbol::none: return "none";
    case JointSymbol::pin: return "pin";
    case JointSymbol::guide: return "guide";
    case JointSymbol::pin_in_guide: return "pin in guide";
    case JointSymbol::rod: return "rod";
  }
  return "";
}

std::string body_of(const System& system, int marker) {
  const int body = system.markers[at(marker)].body;
  return body == ground ? "ground" : system.bodies[at(body)].name;
}

Json joints_json(const System& system) {
  Json out = Json::array();
  for (int k = 0; k < static_cast<int>(system.joints.size()); ++k) {
    if (is_link(system, k)) continue;
    const JointEnds ends = ends_of(system.joints[at(k)]);
    const bool on_a = system.markers[at(ends.marker[1])].body == ground;
    out.push_back({{"name", system.joint_names[at(k)]},
                   {"symbol", symbol_name(properties_of(system.joints[at(k)]).symbol)},
                   {"a", ends.marker[0]},
                   {"b", ends.marker[1]},
                   {"acts", ends.marker[on_a ? 0 : 1]},
                   {"on", joint_subject(system, k)}});
  }
  return out;
}

Json contacts_json(const System& system) {
  Json out = Json::array();
  for (const ContactPair& c : system.contacts) {
    if (c.pair > 0) continue;
    const std::string& name = system.contact_names[at(&c - system.contacts.data())];
    Json one{{"name", name}, {"a", c.a}, {"b", c.b}, {"on", body_of(system, written_marker(c))}};
    if (!c.profiles) one["radius"] = bearing_radius(c.gap), one["clearance"] = c.gap.clearance();
    one["eccentric"] = !c.profiles || c.journal;  // its columns are an eccentricity, not a position
    out.push_back(std::move(one));
  }
  return out;
}

Json forces_json(const System& system) {
  Json out = Json::array();
  for (std::size_t f = 0; f < system.forces.size(); ++f) {
    const Force& force = system.forces[f];
    const bool spring = std::holds_alternative<Spring>(force) || std::holds_alternative<Maxwell>(force);
    out.push_back({{"name", system.force_names[f]},
                   {"spring", spring},
                   {"a", marker_a(force)},
                   {"b", marker_b(force)},
                   {"on", body_of(system, marker_b(force))}});
  }
  return out;
}

void add_wheels(const System& system, Json& out) {
  const DrawnWheels all = wheels_of(system);
  Json wheels = Json::array(), spans = Json::array(), lines = Json::array();
  for (const auto& w : all.wheels) wheels.push_back({{"marker", w.marker}, {"radius", w.radius}});
  for (const auto& s : all.spans) spans.push_back({{"a", s.a}, {"b", s.b}, {"radii", {s.radius_a, s.radius_b}}});
  for (const auto& l : all.lines) lines.push_back({{"a", l.a}, {"b", l.b}});
  out["wheels"] = wheels;
  out["spans"] = spans;
  out["pitch lines"] = lines;
}

const char* kind_name(DrawnActuator::Kind kind) {
  switch (kind) {
    case DrawnActuator::cylinder: return "cylinder";
    case DrawnActuator::coil: return "coil";
    case DrawnActuator::spiral: return "spiral";
  }
  return "";
}

Json actuators_json(const System& system, const Drafting& drafting) {
  Json out = Json::array();
  for (const DrawnActuator& one : actuators_of(system, drafting))
    out.push_back({{"kind", kind_name(one.kind)}, {"a", one.a}, {"b", one.b}, {"width", one.width}});
  return out;
}

}  // namespace

Json mesh_json(const ShapedMesh& body, std::size_t bytes) {
  const std::size_t shapes = at(body.displacements.cols()), a_point = sizeof(float) * (2 + (body.stresses ? 6 : 2) * shapes) + 6 * 4;
  const DrawnMesh mesh = drawn_mesh(body.points, body.cells, body.size, std::max<std::size_t>(bytes / a_point, 50));
  Line points;
  for (const int p : mesh.points) points.push_back(body.points.col(p));
  Json out{{"points", flat(points)},
           {"of", body.points.cols()},
           {"triangles", numbers(mesh.triangles)},
           {"rim", numbers(mesh.rim)},
           {"shapes", of_points(body.displacements, 2, mesh.points)}};
  if (body.stresses) out["stresses"] = of_points(*body.stresses, 4, mesh.points);
  return out;
}

Json palette_json() {
  Json bodies = Json::array(), givers = Json::object();
  for (const Rgb& rgb : body_palette) bodies.push_back(css(rgb));
  for (std::size_t k = 0; k < giver_names.size(); ++k) givers[giver_names[k]] = css(arrow_palette[k]);
  return {{"bodies", bodies}, {"givers", givers}};
}

Json drawn_model_json(const Scene& scene, const Model& model, std::size_t mesh_bytes) {
  const Drafting drafting(scene, model);
  Json markers = Json::array(), points = Json::array(), outputs = Json::array();
  for (const Marker& m : model.system.markers) markers.push_back(marker_json(m));
  for (const RecordedPoint& p : model.points) points.push_back(p.name);
  for (const SceneOutput& o : scene.outputs) outputs.push_back(o.name);
  Json out{{"length", model.system.length},
           {"pin", drafting.pin},
           {"exaggeration", drafting.exaggeration},
           {"deformation", drafting.deformation},
           {"palette", palette_json()},
           {"bodies", bodies_json(model, drafting, mesh_bytes)},
           {"ground", profiles_json(model, ground)},
           {"markers", markers},
           {"joints", joints_json(model.system)},
           {"contacts", contacts_json(model.system)},
           {"forces", forces_json(model.system)},
           {"actuators", actuators_json(model.system, drafting)},
           {"points", points},
           {"outputs", outputs}};
  add_wheels(model.system, out);
  return out;
}

std::vector<std::string> drawn_columns(const Model& model) {
  std::vector<std::string> out = pose_columns(model);
  const System& system = model.system;
  const auto add_force = [&](const std::string& name, const std::string& on) {
    for (const char* const column : {".fx on ", ".fy on ", ".torque on "}) out.push_back(name + column + on);
  };
  for (int k = 0; k < static_cast<int>(system.joints.size()); ++k) add_force(system.joint_names[at(k)], joint_subject(system, k));
  for (const Json& c : contacts_json(system)) {
    const std::string name = c["name"];
    for (const char* const column : {".ex", ".ey", ".x", ".y", ".depth", ".normal"}) out.push_back(name + column);
    add_force(name, c["on"]);
  }
  for (std::size_t f = 0; f < system.forces.size(); ++f) add_force(system.force_names[f], body_of(system, marker_b(system.forces[f])));
  for (const RecordedPoint& p : model.points)
    for (const char* const column : {".x", ".y"}) out.push_back(p.name + column);
  return out;
}

}  // namespace pintle
