#include <stdexcept>

#include "framework/common/nearest.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

// One ratio, or one per axis.
std::vector<double> ratios(const Node& node, std::size_t axes) {
  if (!node.is_list()) return {node.quantity(dimension::number)};
  return read_quantities(node, 3, dimension::number, rule::any, axes == 3 ? "three ratios [12, 13, 23]" : "one ratio, of axes 1 and 2");
}

Orthotropic read_orthotropic(const Node& node, std::string_view keys) {
  check_keys(node, keys);
  Orthotropic m;
  const Node young = node.at("young"), poisson = node.at("poisson");
  const char* remedy = "[E1, E2], or [E1, E2, E3] for plane strain";
  const std::size_t axes = young.list(2, remedy).size();
  const auto E = read_quantities(young, axes == 2 ? 2 : 3, dimension::stress, rule::positive, remedy);
  const std::vector<double> nu = ratios(poisson, axes);
  if ((E.size() == 3) != (nu.size() == 3))
    poisson.fail("has " + std::to_string(nu.size()) + (nu.size() == 1 ? " value" : " values") + " for " + std::to_string(E.size()) +
                 " of young; give one for two, or for plane strain three of each: poisson: "
                 "[12, 13, 23]");
  m.young_1 = E[0];
  m.young_2 = E[1];
  m.poisson_12 = nu[0];
  if (E.size() == 3) {
    m.young_3 = E[2];
    m.poisson_13 = nu[1];
    m.poisson_23 = nu[2];
  }
  m.shear_12 = node.at("shear").quantity(dimension::stress, rule::positive);
  read_optional(node, "angle", dimension::angle, rule::any, m.angle);
  return m;
}

// From a group with young or orthotropic.
Material read_elasticity(const Node& node, std::string_view keys) {
  Material material;
  if (node.has("orthotropic")) {
    if (node.has("poisson")) node.at("poisson").fail("is a key of orthotropic; move it into its braces");
    const Node group = node.at("orthotropic");
    material.elastic = read_orthotropic(group, std::string(keys) + ".orthotropic");
    try {
      plane_material(material, PlaneState::stress);
    } catch (const std::invalid_argument& error) {
      group.fail(error.what());
    }
    return material;
  }
  Isotropic m;
  m.young = node.at("young").quantity(dimension::stress, rule::positive);
  if (!node.has("poisson")) node.fail("lacks a required key; add for example poisson: 0.3");
  m.poisson = node.at("poisson").quantity(dimension::number, rule::solid_poisson);
  material.elastic = m;
  return material;
}

const SceneMaterial& named(const Node& node, const std::vector<SceneMaterial>& all) {
  const std::string name = node.part("the name of a material of the scene").part;
  std::vector<std::string> known;
  for (const SceneMaterial& m : all) {
    if (m.name == name) return m;
    known.push_back(m.name);
  }
  if (known.empty())
    node.fail("\"" + name + "\" is not known: the scene has no materials; add for example " + "materials: {" + name +
              ": {young: 207 GPa, poisson: 0.3, density: 7850 kg/m^3}}");
  node.fail("there is no material \"" + name + "\"." + did_you_mean(name, known));
}

SceneMaterial read_either(const Node& owner, std::string_view keys, const std::vector<SceneMaterial>& all) {
  static const std::vector<std::string> ways{"material", "young", "orthotropic"};
  if (which_key(owner, ways, "what it is made of") != "material") return {"", read_elasticity(owner, keys), owner.place()};
  if (owner.has("poisson"))
    owner.at("poisson").fail("is given by the material already; leave it out, or write young and poisson instead of material");
  SceneMaterial material = named(owner.at("material"), all);
  auto* layered = std::get_if<Orthotropic>(&material.material.elastic);
  if (layered && layered->angle != 0 && owner.is_mirrored()) layered->angle = -layered->angle, material.name.clear();
  return material;
}

}  // namespace

void read_materials(const Node& root, Scene& scene) {
  if (!root.has("materials")) return;
  static const std::vector<std::string> ways{"young", "orthotropic"};
  for (const Node& node : root.at("materials")
                              .entries("names and materials: {steel: {young: 207 GPa, poisson: "
                                       "0.3, density: 7850 kg/m^3}}")) {
    check_keys(node, "materials.*");
    which_key(node, ways, "how stiff it is");
    SceneMaterial m{checked_name(node), read_elasticity(node, "materials.*"), node.place()};
    read_optional(node, "density", dimension::density, rule::positive, m.material.density);
    scene.materials.push_back(std::move(m));
  }
}

Made read_made(const Node& owner, std::string_view keys, const std::vector<SceneMaterial>& all) {
  Made made{read_either(owner, keys, all), {}};
  double& density = made.material.material.density;
  if (owner.has("density") && owner.has("mass")) owner.at("mass").fail("cannot be combined with density; keep one of them");
  if (owner.has("density") && density > 0)
    owner.at("density").fail("is given by the material already; leave it out, or give the mass of the body");
  read_optional(owner, "density", dimension::density, rule::positive, density);
  if (owner.has("mass")) made.mass = owner.at("mass").quantity(dimension::mass, rule::positive);
  if (density == 0 && !made.mass) owner.fail("has neither density nor mass; add for example density: 7850 kg/m^3");
  return made;
}

}  // namespace pintle
