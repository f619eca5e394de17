#include <algorithm>

#include "framework/scene/joint_words.h"
#include "framework/scene/yaml/keys.h"

namespace pintle {

namespace {

using presence::optional, presence::required;

// Groups that occur in several places.
const std::vector<Key> orthotropic_keys{
    {"young", required, "[140 GPa, 10 GPa]"}, {"poisson", required, "0.3"}, {"shear", required, "5 GPa"}, {"angle"}};
const std::vector<Key> section_keys{{"rectangle"}, {"circle"}, {"tube"}, {"i"}, {"area"}, {"second moment"}, {"fibre"}, {"shear factor"}};
const std::vector<Key> i_section_keys{
    {"height", required, "100 mm"}, {"width", required, "55 mm"}, {"web", required, "4 mm"}, {"flange", required, "6 mm"}};
const std::vector<Key> eye_keys{{"bore", required, "10 mm"}, {"outer", required, "20 mm"}};
const std::vector<Key> keep_keys{{"keep", optional, "", {"all", "auto"}}, {"count"}, {"below"}, {"effective mass"}};
const std::vector<std::string> element_names{
    "triangle3", "triangle6", "quadrilateral4", "quadrilateral4-plain", "quadrilateral8", "quadrilateral8-reduced", "quadrilateral9"};
const std::vector<Key> profile_keys{{"disc"},
                                    {"hole"},
                                    {"path"},
                                    {"spline"},
                                    {"polar"},
                                    {"about"},
                                    {"radius"},
                                    {"closed", optional, "", {"true", "false"}},
                                    {"material", optional, "", {"left", "right", "inside", "outside"}},
                                    {"round"},
                                    {"on"}};
const std::vector<Key> friction_laws{{"coulomb"}, {"lugre"}, {"gonthier"}, {"ambrosio"}, {"threlfall"}, {"tanh"}, {"bengisu-akay"}};
const std::vector<Key> coulomb_keys{{"coefficient", required, "0.3"}, {"static"}, {"stribeck speed"}};
const std::vector<Key> lugre_keys{{"coefficient", required, "0.3"},
                                  {"static"},
                                  {"stribeck speed"},
                                  {"bristle stiffness", required, "1e5 1/m"},
                                  {"bristle damping"},
                                  {"damping speed"},
                                  {"viscous"}};
const std::vector<Key> gonthier_keys{
    {"coefficient", required, "0.3"}, {"static"}, {"stribeck speed"}, {"bristle stiffness", required, "1e5 1/m"}, {"bristle damping"},
    {"dwell time", required, "2 s"},  {"viscous"}};
const std::vector<Key> curve_keys{{"coefficient", required, "0.1"}, {"v1"}};
const std::vector<Key> peak_keys{{"coefficient", required, "0.1"}, {"static"}, {"v0"}, {"v1"}};
const std::vector<Key> material_keys{{"young", required, "207 GPa"}, {"poisson", required, "0.3"}};
const std::vector<std::string> hysteresis_factors{
    "hunt-crossley", "herbert-mcwhannell", "lee-wang", "lankarani-nikravesh", "gonthier", "zhiying-qishao", "flores", "hu-guo", "exact"};
const std::vector<Key> arc_keys{{"arc", required, "20 mm"}};
const std::vector<Key> spline_keys{{"file", required, "cam.csv"}, {"length unit"}};
const std::vector<Key> polar_keys{{"file", required, "cam.csv"}, {"angle unit"}, {"radius unit"}};
const Key engaged_key{"engaged", optional, "", {"true", "false"}};
const std::vector<Key> doing_keys{
    {"release"}, {"engage"}, {"set"}, {"stop"}, {"save", optional, "", {"true", "false"}}, {"row", optional, "", {"true", "false"}}};
const std::vector<Key> load_table_keys{{"table", required, "torque.csv"},
                                       {"interpolation", optional, "", {"spline", "linear"}},
                                       {"over"},
                                       {"over unit"},
                                       {"outside", optional, "", {"hold", "refuse"}},
                                       {"periodic", optional, "", {"true", "false"}},
                                       {"time unit"},
                                       {"value unit"}};
const std::vector<Key> curve_table_keys{
    {"table", required, "cam.csv"}, {"angle unit"}, {"value unit"}, {"zero"}, {"clockwise", optional, "", {"false", "true"}}};
constexpr const char* two_eyes = "[{bore: 10 mm, outer: 20 mm}, {bore: 10 mm, outer: 20 mm}]";

std::vector<Key> joint_keys() {
  std::vector<Key> keys{{"clearance"}, {"friction"}, {"repeat"}, engaged_key};
  const auto add = [&](const char* key) {
    if (std::ranges::find(keys, key, &Key::name) == keys.end()) keys.push_back({key});
  };
  for (const JointWord& word : joint_words()) {
    add(word.word);
    for (const JointNumber& number : word.numbers) add(number.key);
    for (const char* key : word.couples) add(key);
  }
  for (Key& key : keys)
    if (key.name == "inside" || key.name == "crossed") key.choices = {"false", "true"};
  return keys;
}

/// For a law of normal force; additional keys in the bearing of a joint.
std::vector<Key> normal_law_keys(const std::vector<Key>& of_bearings) {
  std::vector<Key> keys{{"restitution"}, {"young"},    {"poisson"},        {"stiffness"},
                        {"damping"},     {"exponent"}, {"slowest impact"}, {"approach speed", optional, "", {"onset", "largest"}},
                        {"second"},      {"length"},   {"layer"},          {"hysteresis", optional, "", hysteresis_factors},
                        {"points"},      {"file"},     {"depth unit"},     {"force unit"}};
  keys.insert(keys.end(), of_bearings.begin(), of_bearings.end());
  return keys;
}

/// Keys of contact laws common to clearances and contacts.
void add_contact_laws(const std::string& path, std::vector<KeyTable>& tables) {
  tables.push_back({path + ".normal.*.second", material_keys});
  tables.push_back({path + ".friction", friction_laws});
  tables.push_back({path + ".friction.threlfall", curve_keys});
  tables.push_back({path + ".friction.tanh", curve_keys});
  tables.push_back({path + ".friction.bengisu-akay", peak_keys});
  tables.push_back({path + ".friction.coulomb", coulomb_keys});
  tables.push_back({path + ".friction.lugre", lugre_keys});
  tables.push_back({path + ".friction.gonthier", gonthier_keys});
}

std::vector<KeyTable> scene_tables() {
  std::vector<KeyTable> all{
      {"", {{"title"},     {"include"}, {"assemblies"}, {"instances"}, {"gravity"},  {"parameters"},
            {"materials"}, {"ground"},  {"bodies"},     {"joints"},    {"contacts"}, {"drivers"},
            {"forces"},    {"states"},  {"outputs"},    {"events"},    {"static"},   {"start", optional, "", {"equilibrium"}},
            {"run"},       {"output"}}},
      {"assemblies.*",
       {{"include"},
        {"parameters"},
        {"ports"},
        {"assemblies"},
        {"instances"},
        {"materials"},
        {"ground"},
        {"bodies"},
        {"joints"},
        {"contacts"},
        {"drivers"},
        {"forces"},
        {"states"},
        {"outputs"},
        {"events"},
        {"start"},
        {"output"}}},
      {"assemblies.*.output", {{"points"}, {"stress"}}},
      {"instances.*", {{"of", required, "leg"}, {"at"}, {"angle"}, {"mirror", optional, "", {"x", "y"}}, {"with"}, {"ports"}, {"repeat"}}},
      {"materials.*", {{"young"}, {"poisson"}, {"orthotropic"}, {"density"}}},
      {"materials.*.orthotropic", orthotropic_keys},
      {"ground", {{"points"}, {"profiles"}}},
      {"ground.points.*", {{"at", required, "[10 mm, 0]"}, {"angle"}, {"repeat"}}},
      {"ground.profiles.*", profile_keys},
      {"ground.profiles.*.path.*", arc_keys},
      {"ground.profiles.*.spline", spline_keys},
      {"ground.profiles.*.polar", polar_keys},
      {"bodies.*",
       {{"rigid"},
        {"beam"},
        {"plate"},
        {"points"},
        {"profiles"},
        {"pose"},
        {"colour"},
        {"repeat"},
        {"modes"},
        {"damping"},
        {"stiffening", optional, "", {"none", "rotation", "axial"}},
        {"mass matrix", optional, "", {"consistent", "lumped"}},
        {"lumps"},
        {"supports"}}},
      {"bodies.*.rigid", {{"mass"}, {"inertia"}, {"center"}}},
      {"bodies.*.points.*", {{"at"}, {"world"}, {"angle"}, {"hole"}, {"coupling", optional, "", {"rigid", "average"}}}},
      {"bodies.*.profiles.*", profile_keys},
      {"bodies.*.profiles.*.path.*", arc_keys},
      {"bodies.*.profiles.*.spline", spline_keys},
      {"bodies.*.profiles.*.polar", polar_keys},
      {"bodies.*.pose", {{"at"}, {"angle"}}},
      {"bodies.*.beam",
       {{"from"},
        {"to"},
        {"through"},
        {"section", required, "{rectangle: [10 mm, 5 mm]}"},
        {"taper to"},
        {"theory", optional, "", {"timoshenko", "euler", "bar"}},
        {"shear factor", optional, "", {"cowper", "5/6"}},
        {"rotary inertia", optional, "", {"true", "false"}},
        {"material"},
        {"young"},
        {"poisson"},
        {"orthotropic"},
        {"density"},
        {"mass"},
        {"elements"},
        {"pieces"}}},
      {"bodies.*.beam.section", section_keys},
      {"bodies.*.beam.section.i", i_section_keys},
      {"bodies.*.beam.taper to", section_keys},
      {"bodies.*.beam.taper to.i", i_section_keys},
      {"bodies.*.beam.orthotropic", orthotropic_keys},
      {"bodies.*.plate",
       {{"file"},
        {"link"},
        {"grid"},
        {"thickness", required, "8 mm"},
        {"plane", optional, "", {"stress", "strain"}},
        {"element", optional, "", element_names},
        {"size"},
        {"hole size"},
        {"scale"},
        {"unit", optional, "", {"m", "km", "cm", "mm", "um", "nm"}},
        {"material"},
        {"young"},
        {"poisson"},
        {"orthotropic"},
        {"density"},
        {"mass"}}},
      {"bodies.*.plate.orthotropic", orthotropic_keys},
      {"bodies.*.plate.link", {{"bar"}, {"eye bar"}, {"tapered bar"}, {"triangle"}, {"disc"}}},
      {"bodies.*.plate.link.bar", {{"length", required, "100 mm"}, {"width", required, "20 mm"}}},
      {"bodies.*.plate.link.eye bar", {{"length", required, "100 mm"}, {"width", required, "12 mm"}, {"eyes", required, two_eyes}}},
      {"bodies.*.plate.link.eye bar.eyes.*", eye_keys},
      {"bodies.*.plate.link.tapered bar", {{"length", required, "100 mm"}, {"widths", required, "[20 mm, 10 mm]"}}},
      {"bodies.*.plate.link.triangle",
       {{"centers", required, "[[0, 0], [100 mm, 0], [40 mm, 60 mm]]"},
        {"eyes", required, "a list of three such as {bore: 10 mm, outer: 20 mm}"}}},
      {"bodies.*.plate.link.triangle.eyes.*", eye_keys},
      {"bodies.*.plate.link.disc", {{"diameter", required, "100 mm"}, {"bore", required, "20 mm"}}},
      {"bodies.*.plate.grid", {{"corners", required, "[[0, 0], [1 m, 0], [1 m, 0.5 m], [0, 0.5 m]]"}, {"cells", required, "[10, 5]"}}},
      {"bodies.*.modes",
       {{"frame", optional, "", {"tangent", "chord", "mean axes"}},
        {"keep", optional, "", {"all", "auto"}},
        {"count"},
        {"below"},
        {"effective mass"},
        {"craig-bampton"},
        {"free"},
        {"boundary", optional, "", {"massless"}}}},
      {"bodies.*.modes.frame", {{"tangent"}, {"chord"}}},
      {"bodies.*.modes.craig-bampton", keep_keys},
      {"bodies.*.modes.free", keep_keys},
      {"bodies.*.damping", {{"rayleigh"}, {"ratios"}}},
      {"bodies.*.damping.rayleigh", {{"ratios"}, {"modes"}, {"alpha"}, {"beta"}}},
      {"bodies.*.lumps.*", {{"mass"}, {"inertia"}}},
      {"static", {{"body"}, {"loads", required, "{pull: {at: B, force: [1 kN, 0]}}"}, {"contacts"}, {"at"}}},
      {"static.loads.*",
       {{"force"}, {"torque"}, {"at"}, {"pressure"}, {"traction"}, {"on"}, {"acceleration"}, {"spin"}, {"about"}, {"line load"}, {"body"}}},
      {"static.contacts.*", {{"between", required, "[pin.outline, rocker.bore]"}}},
      {"joints.*", joint_keys()},
      {"joints.*.differential.*", {{"angle"}, {"displacement"}, {"distance"}, {"ratio"}}},
      {"joints.*.lift", curve_table_keys},
      {"joints.*.swing", curve_table_keys},
      {"joints.*.friction", {{"coulomb"}, {"lugre"}, {"gonthier"}, {"radius"}, {"length"}, {"preload"}}},
      {"joints.*.friction.coulomb", coulomb_keys},
      {"joints.*.friction.lugre", lugre_keys},
      {"joints.*.friction.gonthier", gonthier_keys},
      {"joints.*.clearance",
       {{"radial"},
        {"bearing radius"},
        {"bearing"},
        {"arc"},
        {"gap"},
        {"length"},
        {"height"},
        {"round"},
        {"pin radius"},
        {"travel"},
        {"only", optional, "", {"pull", "push"}},
        {"backlash"},
        {"pressure angle"},
        {"model", optional, "", {"contact", "massless link", "spring-damper", "impact"}},
        {"restitution"},
        {"tangential restitution"},
        {"restitution law", optional, "", {"newton", "poisson"}},
        {"normal"},
        {"stiffness"},
        {"damping"},
        {"friction"}}},
      {"joints.*.clearance.arc", {{"middle", required, "-90 deg"}, {"extent", required, "200 deg"}, {"wall"}, {"edge"}}},
      {"joints.*.clearance.normal.*", normal_law_keys({{"radii", optional, "", {"internal", "external"}}, {"journal"}})},
      {"joints.*.clearance.normal.*.journal", material_keys},
      {"joints.*.clearance.friction.ambrosio",
       {{"coefficient", required, "0.1"}, {"v0"}, {"v1"}, {"sliding", optional, "", {"material", "geometric"}}}},
      {"contacts.*",
       {{"between", required, "[cam.rim, follower.roller]"},
        {"model", optional, "", {"contact", "impact"}},
        {"restitution"},
        {"tangential restitution"},
        {"restitution law", optional, "", {"newton", "poisson"}},
        {"normal"},
        {"friction"},
        {"repeat"},
        engaged_key}},
      {"contacts.*.normal.*", normal_law_keys({})},
      {"contacts.*.friction.ambrosio", {{"coefficient", required, "0.1"}, {"v0"}, {"v1"}}},
      {"drivers.*", {{"angle"}, {"distance"}, {"law", required, "150 rad/s*t"}, {"repeat"}, engaged_key}},
      {"drivers.*.law",
       {{"table", required, "motion.csv"}, {"interpolation", optional, "", {"spline", "linear"}}, {"time unit"}, {"value unit"}}},
      {"forces.*",
       {{"force"},
        {"at"},
        {"follows", optional, "", {"true", "false"}},
        {"torque"},
        {"on"},
        {"from"},
        {"spring"},
        {"torsion spring"},
        {"maxwell"},
        {"belt"},
        {"stiffness"},
        {"damping"},
        {"free length"},
        {"free angle"},
        {"law"},
        {"radii"},
        {"crossed", optional, "", {"true", "false"}},
        {"pretension"},
        {"repeat"},
        engaged_key}},
      {"forces.*.torque", load_table_keys},
      {"forces.*.force.*", load_table_keys},
      {"forces.*.law", load_table_keys},
      {"states.*",
       {{"rate"},
        {"lag"},
        {"time"},
        {"lead"},
        {"pid"},
        {"gains"},
        {"filter"},
        {"limits"},
        {"tracking"},
        {"rate limit"},
        {"most"},
        {"start"},
        {"unit"},
        {"scale"},
        {"repeat"}}},
      {"states.*.rate", load_table_keys},
      {"outputs.*", load_table_keys},
      {"events.*",
       {{"when", required, "crank.angle > 30 deg"},
        {"once", optional, "", {"true", "false"}},
        {"from start", optional, "", {"true", "false"}},
        {"do", required, "{release: latch pin}"},
        {"else"},
        {"repeat"}}},
      {"events.*.do", doing_keys},
      {"events.*.else", doing_keys},
      {"start.*",
       {{"at"}, {"x"}, {"y"}, {"angle"}, {"velocity"}, {"vx"}, {"vy"}, {"speed"}, {"deflection"}, {"modes"}, {"eccentricity"}, {"repeat"}}},
      {"run",
       {{"until", required, "0.1 s"},
        {"method", optional, "", {"auto", "rkf45", "dopri5", "verner87", "generalized-alpha", "moreau"}},
        {"tolerance"},
        {"constraints", optional, "", {"projection", "partitioning"}},
        {"onset", optional, "", {"locate"}},
        {"max step"},
        {"max steps"},
        {"ledger bound"}}},
      {"run.method", {{"generalized-alpha"}, {"moreau"}}},
      {"run.method.moreau", {{"step", required, "0.1 ms"}}},
      {"run.method.generalized-alpha", {{"rho", required, "0.8"}}},
      {"run.onset", {{"cut", required, "1e-8 m"}}},
      {"output",
       {{"every"},
        {"states"},
        {"frames", optional, "", {"auto"}},
        {"exaggerate"},
        {"deformation", optional, "", {"auto"}},
        {"points"},
        {"stress"}}}};
  for (const char* path : {"joints.*.clearance", "contacts.*"}) add_contact_laws(path, all);
  return all;
}

}  // namespace

std::span<const KeyTable> key_tables() {
  static const std::vector<KeyTable> all = scene_tables();
  return all;
}

}  // namespace pintle
