#include <algorithm>
#include <array>

#include "framework/common/nearest.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

const std::array<KindKeys, 5> section_kinds{
    {{"rectangle", {}}, {"circle", {}}, {"tube", {}}, {"i", {}}, {"area", {"second moment", "fibre", "shear factor"}}}};

TubeSection read_tube(const Node& node) {
  const auto two = node.items(2, "two diameters [outer, inner]");
  const TubeSection tube{read_size(two[0]), read_size(two[1])};
  if (tube.inner >= tube.outer)
    two[1].fail(two[1].shown() + " must be less than the outer diameter " + two[0].shown() + "; the outer one comes first");
  return tube;
}

ISection read_i(const Node& node, const std::string& keys) {
  check_keys(node, keys);
  const ISection s{read_size(node.at("height")), read_size(node.at("width")), read_size(node.at("web")), read_size(node.at("flange"))};
  if (s.web >= s.width)
    node.at("web").fail(node.at("web").shown() + " must be less than the width " + node.at("width").shown() +
                        ": the flanges must be wider than the web");
  if (2 * s.flange >= s.height)
    node.at("flange").fail(node.at("flange").shown() + " times two must be less than the height " + node.at("height").shown() +
                           ": the web is between the flanges");
  return s;
}

GivenSection read_given(const Node& node) {
  if (!node.has("second moment")) node.fail("lacks a required key; add for example second moment: 500 mm^4");
  GivenSection s{};
  s.area = node.at("area").quantity(dimension::area, rule::positive);
  s.second_moment = node.at("second moment").quantity(dimension::second_moment, rule::positive);
  read_optional(node, "fibre", dimension::length, rule::positive, s.fibre);
  if (node.has("shear factor")) s.shear_factor = node.at("shear factor").quantity(dimension::number, rule::positive);
  return s;
}

SectionShape read_section(const Node& node, const std::string& keys) {
  check_keys(node, keys);
  switch (which_kind(node, section_kinds)) {
    case 0: {
      const auto two = node.at("rectangle").items(2, "two sizes [height, width]");
      return RectangleSection{read_size(two[0]), read_size(two[1])};
    }
    case 1: return CircleSection{read_size(node.at("circle"))};
    case 2: return read_tube(node.at("tube"));
    case 3: return read_i(node.at("i"), keys + ".i");
    default: return read_given(node);
  }
}

std::vector<std::string> read_through(const Node& node, const SceneBody& body) {
  std::vector<std::string> names;
  if (node.has("through")) {
    for (const char* key : {"from", "to"})
      if (node.has(key)) node.at(key).fail("cannot be combined with through; leave it out: through lists every point");
    for (const Node& item : node.at("through").list(2, "two or more points of the body [A, B]"))
      names.push_back(read_own_point(item, body));
  } else {
    if (!node.has("from") || !node.has("to")) node.fail("has no end points; add from: A and to: B, or through: [A, B]");
    names = {read_own_point(node.at("from"), body), read_own_point(node.at("to"), body)};
  }
  const auto place = [&](const std::string& name) { return std::ranges::find(body.points, name, &ScenePoint::name)->at; };
  for (std::size_t i = 0; i + 1 < names.size(); ++i)
    if (place(names[i]) == place(names[i + 1]))
      node.fail("has no length from " + names[i] + " to " + names[i + 1] + ": both are at the same position; move one");
  return names;
}

void read_theory(const Node& node, SceneBeam& beam) {
  std::string theory = "timoshenko";
  if (node.has("theory")) theory = node.at("theory").one_of(choices("bodies.*.beam", "theory"));
  beam.theory = theory == "timoshenko" ? BeamTheory::timoshenko : BeamTheory::euler;
  beam.bar = theory == "bar";
  if (node.has("shear factor")) {
    const Node shear = node.at("shear factor");
    if (theory != "timoshenko") shear.fail("does not belong to the theory " + theory + " but to timoshenko; leave it out");
    beam.shear = shear.one_of(choices("bodies.*.beam", "shear factor")) == "5/6" ? ShearFactor::five_sixths : ShearFactor::cowper;
  }
  if (node.has("rotary inertia")) {
    if (beam.bar) node.at("rotary inertia").fail("does not belong to a bar, which has no rotation; leave it out");
    beam.rotary = node.at("rotary inertia").yes();
  }
}

int read_pieces(const Node& node, bool bar) {
  if (bar) node.fail("are welded to each other, but a bar is hinged at every node; use the theory euler or timoshenko, or leave it out");
  const long pieces = node.count(1);
  if (pieces > 10'000) node.fail("is more than ten thousand bodies; use fewer");
  return static_cast<int>(pieces);
}

}  // namespace

SceneBeam read_beam(const Node& node, const SceneBody& body, const std::vector<SceneMaterial>& materials) {
  const std::string keys = "bodies.*.beam";
  check_keys(node, keys);
  SceneBeam beam;
  beam.through = read_through(node, body);
  beam.section = read_section(node.at("section"), keys + ".section");
  if (node.has("taper to")) {
    const Node far = node.at("taper to");
    beam.taper_to = read_section(far, keys + ".taper to");
    if (beam.taper_to->index() != beam.section.index())
      far.fail("is " + section_kinds[beam.taper_to->index()].kind + ", but section is " + section_kinds[beam.section.index()].kind +
               "; give both with the same key");
  }
  read_theory(node, beam);
  Made made = read_made(node, keys, materials);
  beam.material = std::move(made.material);
  beam.mass = made.mass;
  if (node.has("elements")) {
    const long elements = node.at("elements").count(1);
    if (elements > 1'000'000) node.at("elements").fail("is more than a million; use fewer");
    beam.elements = static_cast<int>(elements);
  }
  if (node.has("pieces")) beam.pieces = read_pieces(node.at("pieces"), beam.bar);
  return beam;
}

}  // namespace pintle
