#include <array>
#include <cctype>

#include "framework/scene/joint_words.h"
#include "framework/scene/yaml/placing_parts.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle::placing_parts {

namespace {

/// In a relation angles change sign, displacements and distances do not.
void mirror_terms(const Spot& differential) {
  if (!differential.node.is_list()) return;
  for (const Spot& term : differential.list("two or three terms")) {
    if (!term.node.is_map() || !term.has("angle")) continue;
    const std::string ratio = term.has("ratio") ? term.at("ratio").node.text("a ratio") : "1";
    put(term.yaml, scalar_like(term.yaml, "ratio", "-(" + ratio + ")"));
  }
}

bool is_of_a_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Substitutes an expression for a name in another expression.
std::string substituted(const std::string& text, const std::string& name, const std::string& by) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin;
    while (end < text.size() && is_of_a_name(text[end])) ++end;
    const std::string word = text.substr(begin, end == begin ? 1 : end - begin);
    out += word == name ? by : word;
    begin += word.size();
  }
  return out;
}

/// Rotates the curve of a cam with its drawing: angles relative to the ground rotate with the instance, and its mirror image
/// turns the other way. A body used as reference is rotated and mirrored with it.
void place_cam(const Spot& joint, const Placing& placing) {
  const std::vector<Spot> points = joint.at("cam").list("two points, or three: [camshaft, valve.P, frame.G]");
  const bool against_ground = points.size() < 3 || read_point_ref(points[2].node).body == "ground";
  const double turned = against_ground ? placing.direction(0) : 0;
  const char* key = joint.has("swing") ? "swing" : "lift";
  if ((turned == 0 && !placing.mirrored) || !joint.has(key)) return;
  const Spot curve = joint.at(key);
  if (curve.node.is_map()) {
    const double zero = curve.has("zero") ? curve.at("zero").node.quantity(dimension::angle) : 0;
    const bool clockwise = curve.has("clockwise") && curve.at("clockwise").node.yes();
    put(curve.yaml, angle_like(curve.yaml, "zero", turned + placing.sign() * zero));
    put(curve.yaml, scalar_like(curve.yaml, "clockwise", clockwise != placing.mirrored ? "true" : "false"));
  } else {
    std::string from;
    append_number(from, turned);
    set_text(curve, substituted(curve.node.text("an expression in angle"), "angle",
                                placing.mirrored ? "((-1)*(angle - (" + from + " rad)))" : "(angle - (" + from + " rad))"));
  }
  if (key == std::string("swing") && placing.mirrored) negate_law(joint.at(key), "rad");
}

void mirror_joint(const Spot& joint) {
  std::vector<std::string> known{"clearance", "friction", "engaged"};
  if (joint.has("differential")) mirror_terms(joint.at("differential"));
  if (joint.has("screw")) negate(joint, "lead", dimension::length);
  for (const JointWord& word : joint_words()) {
    const bool is_it = joint.has(word.word);
    known.emplace_back(word.word);
    known.insert(known.end(), word.couples.begin(), word.couples.end());
    for (const JointNumber& number : word.numbers) {
      known.emplace_back(number.key);
      if (is_it && number.of == JointNumber::angle) negate(joint, number.key, dimension::angle);
    }
  }
  for (const Node& entry : joint.node.entries("keys and values"))
    if (std::ranges::find(known, entry.name()) == known.end()) cannot_mirror(entry, "write this joint into the scene for each side");
  if (joint.has("clearance") && joint.at("clearance").has("arc")) negate(joint.at("clearance").at("arc"), "middle", dimension::angle);
}

/// A mirrored belt runs round each pulley in the opposite direction.
void mirror_belt(Spot force) {
  const std::vector<Spot> radii = force.at("radii").list("a radius for each of the pulleys");
  const bool crossed = force.has("crossed") && force.at("crossed").node.yes();
  for (const Spot& radius : radii) set(radius, -radius.node.quantity(dimension::length));
  if (!crossed || radii.size() != 2) return;
  set(radii[1], -radii[1].node.quantity(dimension::length));
  std::erase_if(force.yaml.items, [](const Yaml& key) { return key.key == "crossed"; });
}

/// Components in rotated and mirrored axes.
void place_components(const Spot& force, const Placing& placing) {
  const std::vector<Spot> two = force.list("two components [x, y]");
  if (two.size() != 2) return;  // reported by the reader
  const auto [c, s] = placing.turn();
  if (c != 0 && s != 0) {
    for (const Spot& part : two)
      if (part.node.is_map()) part.node.fail("is a table, which cannot be turned; add follows: true, or write it as an expression");
    const std::string x = two[0].node.text("a force"), y = two[1].node.text("a force");
    const auto times = [](double factor, const std::string& of) {
      std::string text = "(";
      append_number(text, factor);
      return text + ")*(" + of + ")";
    };
    set_text(two[0], times(c, x) + " + " + times(-s * placing.sign(), y));
    set_text(two[1], times(s, x) + " + " + times(c * placing.sign(), y));
    return;
  }
  const std::array<double, 2> signs = c != 0 ? std::array{c, c * placing.sign()} : std::array{s, -s * placing.sign()};
  for (std::size_t i = 0; i < 2; ++i)
    if (signs[i] < 0) negate_law(two[i], "N");
  if (c == 0) std::swap(two[0].yaml, two[1].yaml);
}

}  // namespace

void place_joint(const Spot& joint, const Placing& placing) {
  if (joint.has("cam")) place_cam(joint, placing);
  if (placing.mirrored) mirror_joint(joint);
}

void mirror_driver(const Spot& driver) {
  if (!driver.has("angle") || !driver.has("law")) return;
  const Spot law = driver.at("law");
  if (says_present(law.node))
    set_text(law, "2*present - (" + law.node.text("a law of time") + ")");  // `present` minus the part added to it
  else
    negate_law(law, "rad");
}

void place_force(const Spot& force, const Placing& placing) {
  if (force.has("force")) {
    const bool follows = force.has("follows") && force.at("follows").node.yes();
    place_components(force.at("force"), follows ? Placing{{0, 0}, 0, placing.mirrored} : placing);
  }
  if (!placing.mirrored) return;
  static const std::vector<std::string> known{
      "force",          "at",         "follows", "torque",  "on",   "from",  "spring",  "maxwell",   "stiffness", "damping", "free length",
      "torsion spring", "free angle", "law",     "engaged", "belt", "radii", "crossed", "pretension"};
  for (const Node& entry : force.node.entries("keys and values"))
    if (std::ranges::find(known, entry.name()) == known.end()) cannot_mirror(entry, "write this force into the scene for each side");
  if (force.has("belt") && force.has("radii")) mirror_belt(force);
  if (force.has("torque")) negate_law(force.at("torque"), "N*m");
  negate(force, "free angle", dimension::angle);
}

}  // namespace pintle::placing_parts
