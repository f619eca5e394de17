#include "framework/bodies/holding_warnings.h"

#include <algorithm>

#include "framework/bodies/modal_basis.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

struct Hold {
  std::string point;
  bool clamps;  ///< also fixes the direction
};

std::vector<Hold> holds_on(const Scene& scene, const MechanismBody& b) {
  std::vector<Hold> holds;
  for (const SceneJoint& j : scene.joints)
    for (const PointRef* ref : points_of(j)) {
      if (ref->body != b.body.name) continue;
      if (const int port = port_of(b.elastic, ref->point); port >= 0)
        holds.push_back({b.elastic.model.ports[static_cast<std::size_t>(port)].name, word_of(j).clamps});
    }
  return holds;
}

std::string tied_to(const MechanismBody& b) {
  return b.conditions.a < 0 ? "" : b.elastic.model.ports[static_cast<std::size_t>(b.conditions.a)].name;
}

bool keeps_all(const SceneKeep& k) { return !k.automatic && !k.count && !k.below && !k.effective_mass; }

/// The first name, and the number of the others.
std::string first_of(const std::vector<std::string>& names) {
  return names.front() + (names.size() > 1 ? " (and " + std::to_string(names.size() - 1) + " more)" : "");
}

}  // namespace

std::vector<std::string> holding_warnings(const Scene& scene, const std::vector<std::optional<MechanismBody>>& bodies) {
  std::vector<std::string> clamped, elsewhere;
  for (const auto& b : bodies) {
    if (!b || !b->body.flex) continue;
    const SceneElastic& said = *b->elastic.scene->elastic;
    const std::vector<Hold> holds = holds_on(scene, *b);
    const bool tangent = b->conditions.kind == ReferenceConditions::tangent;
    if (said.modes->method == SceneModes::Method::normal && !keeps_all(said.modes->keep))
      for (const Hold& h : holds)
        if (h.clamps && !(tangent && h.point == tied_to(*b))) clamped.push_back("\"" + b->body.name + "." + h.point + "\"");
    if (said.stiffening != Stiffening::rotation || holds.empty()) continue;
    if (std::none_of(holds.begin(), holds.end(), [&](const Hold& h) { return h.point == tied_to(*b); }))
      elsewhere.push_back("\"" + b->body.name + "\"");
  }
  std::vector<std::string> out;
  if (!clamped.empty())
    out.push_back(first_of(clamped) +
                  " is clamped, but its shapes are normal modes with other supports; a few of them bend too little there and give wrong "
                  "stress: use craig-bampton");
  if (!elsewhere.empty())
    out.push_back(
        "stiffening: rotation computes the pull of inertia as if the body were held by its reference conditions, but joints hold " +
        first_of(elsewhere) + " elsewhere; use axial, or choose the frame at the joint that holds the body");
  return out;
}

}  // namespace pintle
