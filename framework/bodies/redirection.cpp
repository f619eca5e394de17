#include "framework/bodies/redirection.h"

#include <algorithm>

#include "framework/bodies/elastic_parts.h"
#include "framework/common/nearest.h"
#include "framework/scene/joint_words.h"

namespace pintle {

void Redirection::redirect(PointRef& ref) const {
  const auto found = cuts_.find(ref.body);
  if (found == cuts_.end()) return;
  const SceneBody& body = *std::ranges::find(before_.bodies, ref.body, &SceneBody::name);
  const ScenePoint& point = ref.point.empty() ? at_origin(body, ref) : point_of(before_, body, ref.point, ref.place);
  ref.body = found->second.owner.at(point.name);
}

void Redirection::redirect(PointRef& a, PointRef& b, const Place& place) const {
  if (a.body == b.body && cuts_.contains(a.body))
    throw SceneError(before_.file, place, "both ends are on \"" + a.body + "\"; join two different bodies");
  redirect(a);
  redirect(b);
}

void Redirection::redirect(SceneJoint& joint) const {
  const std::string a = joint.a.body, b = joint.b.body;
  redirect(joint.a, joint.b, joint.place);
  if (joint.c) redirect(*joint.c);
  if (joint.coupling)
    for (SceneTerm& term : joint.coupling->terms) redirect(term.a, term.b, joint.place);
  if (!joint.clearance) return;
  std::string& bearing = joint.clearance->bearing;
  bearing = bearing == a ? joint.a.body : bearing == b ? joint.b.body : bearing;
}

void Redirection::redirect(SceneContact& contact) const {
  for (PointRef* profile : {&contact.a, &contact.b}) {
    PointRef carrier = carrier_of(before_, *profile);
    redirect(carrier);
    profile->body = carrier.body;
  }
}

void Redirection::redirect(SceneLoad& load) const {
  std::visit(
      [&](auto& what) {
        if constexpr (requires { what.at; })
          redirect(what.at);
        else if constexpr (requires { what.pulleys; })
          for (PointRef& pulley : what.pulleys) redirect(pulley);
        else
          redirect(what.a, what.b, load.place);
      },
      load.what);
}

std::vector<StartBody> Redirection::starts() const {
  std::vector<StartBody> out;
  for (const StartBody& start : before_.start_bodies) {
    const auto found = cuts_.find(start.body);
    if (found == cuts_.end()) {
      out.push_back(start);
      continue;
    }
    if (!start.deflection.empty() || !start.modes.empty())
      throw SceneError(before_.file, start.place,
                       "\"" + start.body + "\" is cut into pieces, and a start deflection cannot be distributed to them; " +
                           "leave it out, or start at rest with start: equilibrium");
    for (const SceneBody& piece : found->second.bodies) {
      out.push_back(start);
      out.back().body = piece.name;
    }
  }
  return out;
}

/// The point meant by a flexible body without a point: that at the origin of its axes.
const ScenePoint& Redirection::at_origin(const SceneBody& body, const PointRef& ref) const {
  constexpr double near = 1e-12;  // [m]
  std::vector<std::string> points;
  for (const ScenePoint& p : body.points) {
    if (vector(p.at).norm() <= near) return p;
    points.push_back(p.name);
  }
  throw SceneError(before_.file, ref.place,
                   "\"" + body.name + "\" without a point means the origin of its axes, where the beam, cut into " +
                       "pieces, has no point; name one of its points: " + listed(points));
}

}  // namespace pintle
