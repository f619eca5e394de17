#include "framework/scene/yaml/filled_in_parts.h"

namespace pintle {

namespace {

using pintle::json;

void put_elasticity(const SceneNormal& normal, bool in_joint, Json& law) {
  law["young"] = normal.bearing.young;
  law["poisson"] = normal.bearing.poisson;
  law[in_joint ? "journal" : "second"] = {{"young", normal.journal.young}, {"poisson", normal.journal.poisson}};
}

Json json(const SceneNormal& normal, bool in_joint) {
  Json law = Json::object();
  if (normal.law == "spring-damper") {
    law = {{"stiffness", *normal.stiffness}, {"damping", normal.damping}};
  } else if (normal.length > 0 || !normal.points.empty()) {
    law = {{"hysteresis", normal.hysteresis},
           {"restitution", normal.restitution},
           {"slowest impact", normal.slowest_impact},
           {"approach speed", normal.follows ? "largest" : "onset"}};
    for (const Pair& point : normal.points) law["points"].push_back(json(point));
    if (normal.points.empty()) {
      law["length"] = normal.length;
      if (normal.stiffness)
        law["stiffness"] = *normal.stiffness;
      else if (normal.layer > 0)
        law["layer"] = normal.layer, law["young"] = normal.bearing.young, law["poisson"] = normal.bearing.poisson;
      else
        put_elasticity(normal, in_joint, law);
    }
  } else {
    if (normal.law != "hertz") law["restitution"] = normal.restitution;
    law["exponent"] = normal.exponent;
    if (in_joint) law["radii"] = normal.radii == RadiusConvention::internal ? "internal" : "external";
    law["slowest impact"] = normal.slowest_impact;
    law["approach speed"] = normal.follows ? "largest" : "onset";
    if (normal.stiffness) {
      law["stiffness"] = *normal.stiffness;
    } else {
      put_elasticity(normal, in_joint, law);
    }
  }
  Json out = Json::object();
  out[normal.law] = law;
  return out;
}

void put_bristles(const SceneFriction& f, Json& law) {
  law["bristle stiffness"] = f.bristle_stiffness;
  law["viscous"] = f.viscous;
  if (f.bristle_damping) law["bristle damping"] = *f.bristle_damping;
  if (f.damping_speed) law["damping speed"] = *f.damping_speed;
  if (f.dwell > 0) law["dwell time"] = f.dwell;
}

}  // namespace

Json json(const SceneFriction& f, bool in_joint) {
  Json law = {{"coefficient", f.coefficient}};
  const bool coulomb = f.law == "coulomb", ambrosio = f.law == "ambrosio", bristles = f.bristle_stiffness > 0;
  if (bristles) put_bristles(f, law);
  if (coulomb || bristles || f.law == "bengisu-akay") law["static"] = f.holds.value_or(f.coefficient);
  if (ambrosio || f.law == "bengisu-akay") law["v0"] = f.v0;
  if (!coulomb && !bristles) law["v1"] = f.v1;
  if (f.stribeck > 0) law["stribeck speed"] = f.stribeck;
  if (in_joint && ambrosio) law["sliding"] = f.sliding == SlidingSpeed::material ? "material" : "geometric";
  return {{f.law, law}};
}

namespace {

Json json(const SceneArc& arc) {
  Json out = {{"middle", arc.middle}, {"extent", arc.extent}};
  if (arc.wall > 0) out["wall"] = arc.wall;
  if (arc.edge > 0) out["edge"] = arc.edge;
  return out;
}

void put_impact(const SceneImpact& impact, Json& out) {
  out["model"] = "impact";
  out["restitution"] = impact.restitution;
  out["restitution law"] = impact.poisson ? "poisson" : "newton";
  if (!impact.poisson) out["tangential restitution"] = impact.tangential;
}

// The normal law of a contact.
void put_law(const SceneNormal& normal, const std::optional<SceneImpact>& impact, Json& out) {
  if (impact)
    put_impact(*impact, out);
  else
    out["normal"] = json(normal, false);
}

}  // namespace

Json json(const SceneContact& c) {
  Json out = {{"between", ends(c.a, c.b)}};
  put_law(c.normal, c.impact, out);
  if (c.friction) out["friction"] = json(*c.friction, false);
  return out;
}

Json json(const SceneClearance& clearance) {
  Json out = {{"radial", clearance.radial},
              {"bearing radius", clearance.bearing_radius},
              {"bearing", clearance.bearing},
              {"model", model_name(clearance.model)}};
  if (clearance.arc) out["arc"] = json(*clearance.arc);
  if (clearance.model == ClearanceModel::impact)
    put_impact(clearance.impact, out);
  else if (clearance.normal.stiffness || clearance.normal.bearing.young > 0 || !clearance.normal.points.empty())
    out["normal"] = json(clearance.normal, true);
  if (clearance.stiffness) out["stiffness"] = *clearance.stiffness;
  if (clearance.damping) out["damping"] = *clearance.damping;
  if (clearance.friction) out["friction"] = json(*clearance.friction, true);
  return out;
}

Json json(const ScenePlay& play) {
  Json out = Json::object();
  put_law(play.normal, play.impact, out);
  const auto put = [&](const char* key, double value) {
    if (value > 0) out[key] = value;
  };
  put("gap", play.gap), put("length", play.length), put("height", play.height), put("round", play.round);
  put("backlash", play.backlash), put("pressure angle", play.pressure_angle);
  put("pin radius", play.pin_radius), put("travel", play.travel.value_or(0));
  if (play.only != ScenePlay::both) out["only"] = play.only == ScenePlay::pull ? "pull" : "push";
  if (play.friction) out["friction"] = json(*play.friction, false);
  return out;
}

}  // namespace pintle
