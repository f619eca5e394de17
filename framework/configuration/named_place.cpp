#include "framework/configuration/named_place.h"

namespace pintle {

namespace {

/// The place in the scene that defines this name.
Place place_of(const Scene& scene, const std::string& name) {
  for (const SceneJoint& j : scene.joints)
    if (j.name == name) return j.place;
  for (const SceneDriver& d : scene.drivers)
    if (d.name == name) return d.place;
  for (const StartBody& s : scene.start_bodies)
    if (s.body == name) return s.place;
  for (const SceneContact& c : scene.contacts)
    if (c.name == name) return c.place;
  return {};
}

}  // namespace

Place named_place(const Scene& scene, const std::string& name) {
  Place place = place_of(scene, name);
  if (place.key.empty()) place.key = "\"" + name + "\"";
  return place;
}

}  // namespace pintle
