#include "framework/run/rigid_bodies.h"

#include "framework/component/modal_model.h"
#include "framework/run/elastic_body.h"
#include "framework/scene/error.h"

namespace pintle {

void fill_rigid_bodies(Scene& scene) {
  for (SceneBody& body : scene.bodies) {
    if (!body.elastic) continue;
    if (body.elastic->modes)
      throw SceneError(scene.file, body.place,
                       "\"" + body.name + "\" asks for modes, and mechanisms of flexible bodies do not run yet; remove its "
                       "modes to run it rigid, with the mass and inertia of its shape, or look at it alone with pintle modes");
    const ElasticBody e = elastic_body(scene, body);
    const RigidInertia inertia = rigid_inertia(e.model, e.M);
    body.mass = inertia.m;
    body.center = {inertia.c.x() / inertia.m, inertia.c.y() / inertia.m};
    body.inertia = inertia.J - inertia.c.squaredNorm() / inertia.m;
    for (ScenePoint& p : body.points)
      if (!p.hole.empty()) {
        const Port* port = e.model.port(p.name);
        p.at = {port->x.x(), port->x.y()};
      }
  }
}

}  // namespace pintle
