#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "framework/scene/joint_words.h"
#include "framework/scene/yaml/filled_in_parts.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

void append(Json& object, const std::string& name, Json value) {
  if (object.is_null()) object = Json::object();
  object.get_ref<Json::object_t&>().push_back({name, std::move(value)});
}

Json json(const Pair& p) { return Json::array({p[0], p[1]}); }
std::string json(const PointRef& ref) { return ref.point.empty() ? ref.body : ref.body + "." + ref.point; }
Json ends(const PointRef& a, const PointRef& b) { return Json::array({json(a), json(b)}); }

namespace {

using pintle::json;

Json json(const Law& law) {
  if (law.constant) return law.at(0).value;
  if (law.text.starts_with('{')) return Json::parse(law.text);
  return law.text;
}

/// An angle for which a reader might doubt the unit is written with it.
Json angle(double value) {
  constexpr double turn = 2 * std::numbers::pi;
  if (std::abs(value) <= turn) return value;
  return Json(value).dump() + " rad";
}

/// {name: of(x)} for each x. Room is reserved because the object copies its entries, each with all below it, when it grows.
template <class T, class Of>
Json entries(const std::vector<T>& all, const Of& of) {
  Json out = Json::object();
  out.get_ref<Json::object_t&>().reserve(all.size());
  for (const T& x : all) append(out, x.name, of(x));
  return out;
}

Json points(const std::vector<ScenePoint>& all) {
  return entries(all, [](const ScenePoint& p) {
    Json point = {{"angle", angle(p.angle)}};
    if (p.hole.empty())
      point["at"] = json(p.at);
    else
      point.update({{"hole", p.hole}, {"coupling", p.coupling == RimCoupling::average ? "average" : "rigid"}});
    return point;
  });
}

// A parameter keeps its unit, so that laws in t that use it can be read back.
Json parameter(const SceneParameter& p) {
  if (p.unit.empty()) return p.value;
  return Json(p.value).dump() + " " + p.unit;
}

Json path_point(const ScenePathPoint& p) { return p.point.empty() ? json(p.at) : Json(p.point); }

Json json(const SceneProfile& p) {
  if (p.kind == SceneProfile::disc || p.kind == SceneProfile::hole) {
    Json out = Json::object();
    out[p.kind == SceneProfile::disc ? "disc" : "hole"] = path_point(p.centre);
    out["radius"] = p.radius;
    if (!p.on.empty()) out["on"] = p.on;
    return out;
  }
  Json path = Json::array();
  for (const ScenePathPoint& point : p.points) {
    path.push_back(path_point(point));
    if (point.arc != 0) path.push_back({{"arc", point.arc}});
  }
  constexpr std::array sides{"left", "right", "inside", "outside"};
  if (p.kind == SceneProfile::polar) return {{"polar", path}, {"about", path_point(p.centre)}, {"material", sides[p.material]}};
  Json out = {{p.kind == SceneProfile::spline ? "spline" : "path", path}, {"closed", p.closed}, {"material", sides[p.material]}};
  if (p.round > 0) out["round"] = p.round;
  if (!p.on.empty()) out["on"] = p.on;
  return out;
}

Json profiles(const std::vector<SceneProfile>& all) {
  return entries(all, [](const SceneProfile& p) { return json(p); });
}

Json rigid(const SceneBody& body) {
  Json out = Json::object();
  if (body.mass > 0) out["mass"] = body.mass;
  if (body.inertia > 0) out["inertia"] = body.inertia;
  out["center"] = json(body.center);
  return out;
}

Json json(const SceneBody& body) {
  Json out = Json::object();
  if (body.elastic)
    out = json(*body.elastic);
  else
    out["rigid"] = rigid(body);
  out["points"] = points(body.points);
  if (!body.profiles.empty()) out["profiles"] = profiles(body.profiles);
  if (body.drawn_at) out["pose"]["at"] = json(body.at);
  if (body.drawn_angle) out["pose"]["angle"] = angle(body.angle);
  if (!body.colour.empty()) out["colour"] = body.colour;
  return out;
}

std::string after_present(double added, const char* unit) {
  return added == 0 ? "present" : "present + " + Json(added).dump() + " " + unit;
}

Json terms(const std::vector<SceneTerm>& all) {
  constexpr std::array words{"angle", "displacement", "distance"};
  Json out = Json::array();
  for (const SceneTerm& t : all) out.push_back({{words[t.kind], ends(t.a, t.b)}, {"ratio", t.ratio}});
  return out;
}

void put_coupling(const SceneJoint& joint, Json& out) {
  const SceneCoupling& c = *joint.coupling;
  const auto has = [&keys = word_of(joint).couples](std::string_view key) { return std::ranges::find(keys, key) != keys.end(); };
  if (c.radius > 0) out["radius"] = c.radius;
  if (c.radii[0] > 0) out["radii"] = json(c.radii);
  if (c.teeth[0] > 0) out["teeth"] = json(c.teeth);
  if (c.radius > 0 && c.teeth[1] > 0) out["teeth"] = c.teeth[1];
  if (has("inside") && c.radius == 0) out["inside"] = c.inside;
  if (has("crossed")) out["crossed"] = c.crossed;
  if (has("lead")) out["lead"] = c.lead;
  if (has("lift")) out[c.swings ? "swing" : "lift"] = json(c.curve);
}

Json json(const SceneJoint& joint) {
  const JointWord& word = word_of(joint);
  Json out = Json::object();
  if (joint.coupling && !joint.coupling->terms.empty()) return {{word.word, terms(joint.coupling->terms)}};
  for (const PointRef* point : points_of(joint)) out[word.word].push_back(json(*point));
  for (const JointNumber& number : word.numbers)
    out[number.key] = number.of == JointNumber::angle ? angle(joint.*number.value) : Json(joint.*number.value);
  if (joint.from_present) out["length"] = after_present(joint.length, "m");
  if (joint.coupling) put_coupling(joint, out);
  if (joint.clearance) out["clearance"] = json(*joint.clearance);
  if (joint.friction) {
    out["friction"] = json(joint.friction->law, false);
    out["friction"]["preload"] = joint.friction->preload;
    if (joint.friction->radius > 0) out["friction"]["radius"] = joint.friction->radius;
    if (joint.friction->length > 0) out["friction"]["length"] = joint.friction->length;
  }
  if (joint.play) out["clearance"] = json(*joint.play);
  return out;
}

Json json(const SceneDriver& driver) {
  Json out = Json::object();
  out[driver.kind == DriverKind::angle ? "angle" : "distance"] = ends(driver.a, driver.b);
  out["law"] = driver.from_present ? Json(driver.law.text) : json(driver.law);
  return out;
}

Json load(const SceneForce& f) { return {{"force", Json::array({json(f.x), json(f.y)})}, {"at", json(f.at)}, {"follows", f.follows}}; }
Json load(const SceneTorque& f) { return {{"torque", json(f.law)}, {"on", json(f.b)}, {"from", json(f.a)}}; }
Json load(const SceneSpring& f) {
  Json out = {{"spring", ends(f.a, f.b)}, {"damping", f.damping}, {"free length", f.free_length}};
  if (f.stiffness > 0) out["stiffness"] = f.stiffness;
  if (f.law) out = {{"spring", ends(f.a, f.b)}, {"law", json(*f.law)}};
  return out;
}
Json load(const SceneTorsionSpring& f) {
  Json out = {{"torsion spring", ends(f.a, f.b)}, {"damping", f.damping}, {"free angle", angle(f.free_angle)}};
  if (f.stiffness > 0) out["stiffness"] = f.stiffness;
  if (f.law) out = {{"torsion spring", ends(f.a, f.b)}, {"law", json(*f.law)}};
  return out;
}
Json load(const SceneMaxwell& f) { return {{"maxwell", ends(f.a, f.b)}, {"stiffness", f.stiffness}, {"damping", f.damping}}; }

// Written only if it is not engaged at the start.
Json with_engaged(Json element, bool engaged) {
  if (!engaged) element["engaged"] = false;
  return element;
}

Json json(const SceneState& s) {
  Json out = {{"rate", json(s.rate)}, {"start", s.start}, {"scale", s.scale}};
  if (!s.unit.empty()) out["unit"] = s.unit;
  return out;
}

Json load(const SceneBelt& f) {
  Json out = {{"stiffness", f.stiffness}, {"damping", f.damping}, {"pretension", f.pretension}};
  for (const PointRef& p : f.pulleys) out["belt"].push_back(json(p));
  out["radii"] = f.radii;
  return out;
}

Json json(const StartBody& start) {
  Json out = Json::object();
  const auto put = [&](const char* key, const std::optional<double>& value) {
    if (value) out[key] = *value;
  };
  put("x", start.x);
  put("y", start.y);
  if (start.angle) out["angle"] = angle(*start.angle);
  put("vx", start.vx);
  put("vy", start.vy);
  put("speed", start.speed);
  for (const StartDeflection& d : start.deflection) out["deflection"][d.point] = json(d.u);
  if (!start.modes.empty()) out["modes"] = start.modes;
  return out;
}

Json starts(const Scene& scene) {
  if (scene.start_at_rest) return "equilibrium";
  Json out = Json::object();
  for (const StartBody& s : scene.start_bodies) append(out, s.body, json(s));
  for (const StartJournal& s : scene.start_journals)
    append(out, s.joint, {{"eccentricity", json(s.eccentricity)}, {"speed", json(s.speed)}});
  return out;
}

Json json(const RunOptions& run) {
  Json out = {{"until", run.until}, {"method", run.method},       {"tolerance", run.tolerance},      {"constraints", run.constraints},
              {"onset", "locate"},  {"max steps", run.max_steps}, {"ledger bound", run.ledger_bound}};
  if (run.method == "generalized-alpha") out["method"] = {{run.method, {{"rho", run.rho}}}};
  if (run.method == "moreau") out["method"] = {{run.method, {{"step", run.step}}}};
  if (run.onset_cut) out["onset"] = {{"cut", *run.onset_cut}};
  if (run.max_step > 0) out["max step"] = run.max_step;
  return out;
}

Json json(const OutputOptions& output, const Scene& scene) {
  Json out = {{"frames", "auto"}};
  if (output.frames >= 0) out["frames"] = output.frames;
  if (output.every > 0)
    out["every"] = output.every;
  else if (scene.has_run)
    out["every"] = scene.run.until / 1000;
  if (output.states > 0) out["states"] = output.states;
  if (output.exaggerate > 0) out["exaggerate"] = output.exaggerate;
  if (output.deformation > 0)
    out["deformation"] = output.deformation;
  else
    out["deformation"] = "auto";
  for (const PointRef& ref : output.points) out["points"].push_back(json(ref));
  for (const PointRef& ref : output.stress) out["stress"].push_back(json(ref));
  return out;
}

}  // namespace

std::string filled_in(const Scene& scene) {
  const auto entry = [](const auto& x) { return with_engaged(json(x), x.engaged); };
  const auto force = [](const SceneLoad& l) {
    return with_engaged(std::visit([](const auto& what) { return load(what); }, l.what), l.engaged);
  };
  Json out = Json::object();
  if (!scene.title.empty()) out["title"] = scene.title;
  out["gravity"] = json(scene.gravity);
  Json& named = out["parameters"] = Json::object();
  for (const SceneParameter& p : scene.parameters) append(named, p.name, parameter(p));
  out["materials"] = entries(scene.materials, [](const SceneMaterial& m) { return json(m); });
  out["ground"]["points"] = points(scene.ground);
  if (!scene.ground_profiles.empty()) out["ground"]["profiles"] = profiles(scene.ground_profiles);
  out["bodies"] = entries(scene.bodies, [](const SceneBody& b) { return json(b); });
  out["joints"] = entries(scene.joints, entry);
  out["contacts"] = entries(scene.contacts, entry);
  out["drivers"] = entries(scene.drivers, entry);
  out["forces"] = entries(scene.loads, force);
  for (const SceneState& s : scene.states)
    if (!s.place.key.starts_with("parameters.")) append(out["states"], s.name, json(s));
  for (const SceneOutput& o : scene.outputs) append(out["outputs"], o.name, json(o.law));
  for (const SceneEvent& e : scene.events) append(out["events"], e.name, json(e));
  out["start"] = starts(scene);
  if (scene.statics) out["static"] = json(*scene.statics);
  if (scene.has_run) out["run"] = json(scene.run);
  out["output"] = json(scene.output, scene);
  return json_text(out);
}

}  // namespace pintle
