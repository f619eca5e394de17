#include <array>

#include "framework/scene/yaml/filled_in_parts.h"

namespace pintle {

namespace {

using pintle::json;

Json elasticity(const Isotropic& m) { return {{"young", m.young}, {"poisson", m.poisson}}; }

Json elasticity(const Orthotropic& m) {
  Json young = {m.young_1, m.young_2}, poisson = m.poisson_12;
  if (m.young_3) {
    young.push_back(*m.young_3);
    poisson = {m.poisson_12, *m.poisson_13, *m.poisson_23};
  }
  return {{"orthotropic", {{"young", young}, {"poisson", poisson}, {"shear", m.shear_12}, {"angle", m.angle}}}};
}

// A material of the scene by its name, a body's own material by its constants.
void put_made(Json& out, const SceneMaterial& material, const std::optional<double>& mass) {
  if (material.name.empty())
    out.update(json(material));
  else
    out["material"] = material.name;
  if (mass) out["mass"] = *mass;
}

Json section(const RectangleSection& s) { return {{"rectangle", Json::array({s.height, s.width})}}; }
Json section(const CircleSection& s) { return {{"circle", s.diameter}}; }
Json section(const TubeSection& s) { return {{"tube", Json::array({s.outer, s.inner})}}; }
Json section(const ISection& s) { return {{"i", {{"height", s.height}, {"width", s.width}, {"web", s.web}, {"flange", s.flange}}}}; }
Json section(const GivenSection& s) {
  Json out = {{"area", s.area}, {"second moment", s.second_moment}};
  if (s.fibre > 0) out["fibre"] = s.fibre;
  if (s.shear_factor) out["shear factor"] = *s.shear_factor;
  return out;
}
Json json(const SectionShape& shape) {
  return std::visit([](const auto& s) { return section(s); }, shape);
}

Json body(const SceneBeam& beam) {
  Json out = {{"through", beam.through}, {"section", json(beam.section)}};
  if (beam.taper_to) out["taper to"] = json(*beam.taper_to);
  const bool shears = !beam.bar && beam.theory == BeamTheory::timoshenko;
  out["theory"] = beam.bar ? "bar" : shears ? "timoshenko" : "euler";
  if (shears) out["shear factor"] = beam.shear == ShearFactor::cowper ? "cowper" : "5/6";
  if (!beam.bar) out["rotary inertia"] = beam.rotary;
  put_made(out, beam.material, beam.mass);
  if (beam.elements > 0) out["elements"] = beam.elements;
  return {{"beam", out}};
}

Json json(const Eye& e) { return {{"bore", e.bore}, {"outer", e.outer}}; }
Json link(const StraightBar& l) { return {{"bar", {{"length", l.length}, {"width", l.width}}}}; }
Json link(const EyeBar& l) {
  return {{"eye bar", {{"length", l.length}, {"width", l.width}, {"eyes", Json::array({json(l.first), json(l.second)})}}}};
}
Json link(const TaperedBar& l) { return {{"tapered bar", {{"length", l.length}, {"widths", Json::array({l.width_left, l.width_right})}}}}; }
Json link(const Triangle& l) {
  Json centers = Json::array(), eyes = Json::array();
  for (int i = 0; i < 3; ++i) {
    centers.push_back(Json::array({l.center[i].x(), l.center[i].y()}));
    eyes.push_back(json(l.eye[i]));
  }
  return {{"triangle", {{"centers", centers}, {"eyes", eyes}}}};
}
Json link(const Disc& l) { return {{"disc", {{"diameter", l.diameter}, {"bore", l.bore}}}}; }

Json shape(const Link& l) {
  return {{"link", std::visit([](const auto& which) { return link(which); }, l)}};
}
Json shape(const SceneFile& file) { return {{"file", file.path}, {"scale", file.scale}}; }
Json shape(const SceneGrid& grid) {
  Json corners = Json::array();
  for (const Pair& corner : grid.corners) corners.push_back(json(corner));
  return {{"grid", {{"corners", corners}, {"cells", Json::array({grid.nx, grid.ny})}}}};
}

Json body(const ScenePlate& plate) {
  Json out = std::visit([](const auto& which) { return shape(which); }, plate.shape);
  out["thickness"] = plate.thickness;
  out["plane"] = plate.state == PlaneState::strain ? "strain" : "stress";
  if (!plate.element.empty()) out["element"] = plate.element;
  if (plate.size > 0) out["size"] = plate.size;
  if (plate.hole_size > 0) out["hole size"] = plate.hole_size;
  put_made(out, plate.material, plate.mass);
  return {{"plate", out}};
}

Json json(const SceneModes& modes) {
  using Frame = SceneModes::Frame;
  using Method = SceneModes::Method;
  Json keep = Json::object();
  if (modes.keep.count) keep["count"] = *modes.keep.count;
  if (modes.keep.below) keep["below"] = *modes.keep.below;
  if (modes.keep.effective_mass) keep["effective mass"] = *modes.keep.effective_mass;
  if (keep.empty()) keep["keep"] = modes.keep.automatic ? "auto" : "all";
  Json out = Json::object();
  if (modes.frame == Frame::mean_axes)
    out["frame"] = "mean axes";
  else if (modes.a.empty())
    out["frame"] = modes.frame == Frame::tangent ? "tangent" : "chord";
  else if (modes.frame == Frame::tangent)
    out["frame"]["tangent"] = modes.a;
  else
    out["frame"]["chord"] = Json::array({modes.a, modes.b});
  if (modes.method == Method::normal)
    out.update(keep);
  else
    out[modes.method == Method::free ? "free" : "craig-bampton"] = keep;
  if (modes.massless) out["boundary"] = "massless";
  return out;
}

Json json(const SceneDamping& damping) {
  if (damping.rayleigh) return {{"rayleigh", {{"alpha", (*damping.rayleigh)[0]}, {"beta", (*damping.rayleigh)[1]}}}};
  if (damping.rayleigh_ratios) return {{"rayleigh", {{"ratios", *damping.rayleigh_ratios}, {"modes", damping.rayleigh_modes}}}};
  return {{"ratios", damping.ratios}};
}

const char* json(Stiffening loads) {
  switch (loads) {
    case Stiffening::rotation: return "rotation";
    case Stiffening::axial: return "axial";
    case Stiffening::none: break;
  }
  return "none";
}

Json json(const SceneSupport& support) {
  Json words = Json::array();
  if (support.x) words.push_back("x");
  if (support.y) words.push_back("y");
  if (support.rotation) words.push_back("rotation");
  return words;
}

Json json(const SceneStaticLoad& load) {
  using Kind = SceneStaticLoad::Kind;
  const Json vector = json(load.vector);
  switch (load.kind) {
    case Kind::force: return {{"force", vector}, {"at", load.at}};
    case Kind::torque: return {{"torque", load.value}, {"at", load.at}};
    case Kind::traction: return {{"traction", vector}, {"on", load.at}};
    case Kind::pressure: return {{"pressure", load.value}, {"on", load.at}};
    case Kind::line: return {{"line load", vector}};
    case Kind::acceleration: return {{"acceleration", vector}};
    case Kind::spin: break;
  }
  Json out = {{"spin", load.value}};
  if (!load.at.empty()) out["about"] = load.at;
  return out;
}

}  // namespace

Json json(const SceneMaterial& m) {
  Json out = std::visit([](const auto& elastic) { return elasticity(elastic); }, m.material.elastic);
  if (m.material.density > 0) out["density"] = m.material.density;
  return out;
}

Json json(const SceneElastic& elastic) {
  Json out = std::visit([](const auto& which) { return body(which); }, elastic.shape);
  out["mass matrix"] = elastic.lumped ? "lumped" : "consistent";
  Json& lumps = out["lumps"] = Json::object();
  for (const SceneLump& l : elastic.lumps) append(lumps, l.at, {{"mass", l.mass}, {"inertia", l.inertia}});
  Json& supports = out["supports"] = Json::object();
  for (const SceneSupport& s : elastic.supports) append(supports, s.at, json(s));
  if (elastic.damping) out["damping"] = json(*elastic.damping);
  if (!elastic.modes) return out;
  out["modes"] = json(*elastic.modes);
  out["stiffening"] = json(elastic.stiffening);
  const auto* beam = std::get_if<SceneBeam>(&elastic.shape);
  if (beam && !beam->bar) out["beam"]["pieces"] = beam->pieces;
  return out;
}

Json json(const SceneStatic& statics) {
  Json loads = Json::object(), contacts = Json::object(), at = Json::object();
  for (const SceneStaticLoad& l : statics.loads) {
    Json load = json(l);
    if (!l.body.empty()) load["body"] = l.body;
    append(loads, l.name, load);
  }
  Json out = {{"body", statics.body}, {"loads", loads}};
  for (const SceneStaticContact& c : statics.contacts)
    append(contacts, c.name, {{"between", {c.first.body + "." + c.first.group, c.second.body + "." + c.second.group}}});
  for (const SceneStaticPlace& p : statics.at) append(at, p.body, json(p.at));
  if (!contacts.empty()) out["contacts"] = contacts;
  if (!at.empty()) out["at"] = at;
  return out;
}

}  // namespace pintle
