#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "files/files.h"
#include "framework/common/text.h"
#include "framework/scene/joint_words.h"
#include "framework/scene/units/law_pole.h"
#include "framework/scene/units/law_scale.h"
#include "framework/scene/units/table.h"
#include "framework/scene/yaml/filled_in_parts.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

// ---- present + … ----

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

Law law_at_present(const Node& node, const Dimension& expected, double present) {
  Parameters parameters = node.source().parameters;
  parameters["present"] = {present, expected};
  try {
    return read_law(node.expression(describe(expected)), expected, parameters);
  } catch (const ExpressionError& error) {
    node.fail(error.what());
  }
}

// ---- the parts of a coupling ----

Pair read_two(const Node& node, const Dimension& expected, const char* example) {
  const std::vector<double> two = read_quantities(node, 2, expected, rule::positive, std::string("one for each of its points: ") + example);
  return {two[0], two[1]};
}

void read_wheels(const Node& node, const JointWord& word, SceneCoupling& out) {
  const std::string kind = word.word;
  const bool line = node.has("radius"), radii = node.has("radii"), of_pinion = kind == "rack" && node.has("teeth");
  const bool teeth = node.has("teeth") && !of_pinion;
  if (line + teeth + radii > 1) {
    const char* second = teeth ? "teeth" : "radius";
    node.at(second).fail(std::string("gives the size of the wheels, as radii does; keep one of them"));
  }
  if (line) {
    out.radius = read_size(node.at("radius"));
    if (node.has("inside")) node.at("inside").fail("is for two discs with radii; a disc on a line has radius only");
  }
  if (of_pinion) {
    out.teeth = {0, node.at("teeth").quantity(dimension::number, rule::positive)};
    if (out.teeth[1] != std::round(out.teeth[1])) node.at("teeth").fail("is " + number_text(out.teeth[1]) + ", but must be a whole number");
  }
  if (radii) out.radii = read_two(node.at("radii"), dimension::length, "[20 mm, 60 mm]");
  if (teeth) {
    out.teeth = read_two(node.at("teeth"), dimension::number, "[20, 60]");
    for (const double n : out.teeth)
      if (n != std::round(n))
        node.at("teeth").fail("contains " + number_text(n) + ", but must be whole numbers; otherwise write the radii of the pitch circles");
  }
  if (line || radii || teeth) return;
  node.fail(std::string("lacks a required key; add for example ") + (kind == "rack"   ? "radius: 20 mm"
                                                                     : kind == "gear" ? "radii: [20 mm, 60 mm], or teeth: [20, 60]"
                                                                     : kind == "rolling"
                                                                         ? "radius: 50 mm on a line, or radii: [80 mm, 20 mm] on a disc"
                                                                         : "radii: [20 mm, 60 mm]"));
}

// ---- the curve of a cam ----

// A curve over a whole turn that ends where it begins is periodic: samples are added on both sides, as many as affect a spline.
struct Periodic {
  Spline spline;
  double begin;
  Jet operator()(double angle) const {
    const double x = angle - begin;
    return spline(begin + x - full_turn * std::floor(x / full_turn));
  }
};
Periodic periodic(const Samples& turn) {
  constexpr std::size_t felt = 40;  // the influence of a sample on a spline decays by 0.27 per sample, 0.27⁴⁰ = 1e-23
  const std::size_t n = turn.t.size() - 1;
  const int turns = static_cast<int>(felt / n) + 1;
  Samples all;
  for (int k = -turns; k <= turns; ++k)
    for (std::size_t i = 0; i < n; ++i) all.t.push_back(turn.t[i] + k * full_turn), all.value.push_back(turn.value[i]);
  all.t.push_back(turn.t[0] + (turns + 1) * full_turn), all.value.push_back(turn.value[0]);
  return {Spline(all), turn.t[0]};
}

// Beyond the table the curve is undefined.
struct Bounded {
  Spline spline;
  Jet operator()(double angle) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (angle < spline.samples().t.front() || angle > spline.samples().t.back()) return {none, none, none};
    return spline(angle);
  }
};

/// A curve whose angle is counted from `zero`, clockwise or counter-clockwise.
Law from_zero(Law law, double zero, bool clockwise) {
  if (zero == 0 && !clockwise) return law;
  law.at = [of = law.at, zero, sign = clockwise ? -1.0 : 1.0](double angle) {
    const Jet jet = of(sign * (angle - zero));
    return Jet{jet.value, sign * jet.rate, jet.accel};
  };
  return law;
}

Law read_curve_table(const Node& node, const Dimension& expected, const std::string& keys) {
  check_keys(node, keys);
  const std::string file = node.at("table").file("the name of a file beside the scene");
  const double angle_unit = unit_factor(node, "angle unit", dimension::angle), value_unit = unit_factor(node, "value unit", expected);
  std::filesystem::path path;
  try {
    path = contained_file(file, node.source().folder);
  } catch (const FileRejected& rejected) {
    node.at("table").fail(rejected.what());
  }
  const Samples samples = read_samples(path, angle_unit, value_unit, node.place().key, "angle");
  Json text = {{"table", file}};
  if (angle_unit != 1) text["angle unit"] = Json(angle_unit).dump() + " rad";
  if (value_unit != 1) text["value unit"] = Json(value_unit).dump() + " " + si_unit(expected);
  const double zero = node.has("zero") ? node.at("zero").quantity(dimension::angle) : 0;
  const bool clockwise = node.has("clockwise") && node.at("clockwise").yes();
  if (zero != 0) text["zero"] = Json(zero).dump() + " rad";
  if (clockwise) text["clockwise"] = true;
  const auto [least, most] = std::ranges::minmax_element(samples.value);
  constexpr double turn_known = 1e-6, level = 1e-9;
  const bool turns = std::abs(samples.t.back() - samples.t.front() - full_turn) < turn_known;
  if (!turns) return from_zero({Bounded{Spline(samples)}, text.dump(), false}, zero, clockwise);
  if (!(std::abs(samples.value.back() - samples.value.front()) <= level * (*most - *least)))
    node.fail("the table " + file + " covers a full turn but does not end with its first value: " + number_text(samples.value.front()) +
              " and " + number_text(samples.value.back()) + "; make the last value equal to the first");
  return from_zero({periodic(samples), text.dump(), false}, zero, clockwise);
}

/// A curve has different values or slopes on both sides of an angle; a curve that ends there has none.
bool jumps_at(const TimeLaw& curve, double angle) {
  constexpr double near = 1e-7, smooth = 1e-3;
  const Jet before = curve(angle - near), after = curve(angle + near);
  const double bend = 4 * near * std::max(std::abs(before.accel), std::abs(after.accel));
  const double rate = std::max(std::abs(before.rate), std::abs(after.rate));
  const bool turns = std::abs(after.rate - before.rate) > smooth * rate + bend;
  return turns || std::abs(after.value - before.value) > 4 * near * rate + near * bend;
}

Law read_cam_curve(const Node& node, const Dimension& expected, const std::string& keys) {
  if (node.is_map()) return read_curve_table(node, expected, keys);
  Law law;
  try {
    law = read_curve(node.expression("an expression in angle, or {table: cam.csv, angle unit: deg, value unit: mm}"), "angle",
                     dimension::angle, expected, node.source().parameters);
  } catch (const ExpressionError& error) {
    node.fail(error.what());
  }
  const LawScale scale = scale_of(law.at, full_turn);
  const auto not_finite = [&](double angle) {
    node.fail(node.shown() + " is not finite at " + number_text(angle) + " rad; it and its first two derivatives must be");
  };
  const auto kinked = [&](double angle) {
    node.fail(node.shown() + " jumps, or its slope jumps, at " + number_text(angle) +
              " rad, which means an impact on the follower; write step(angle, …) instead of if, min, max or abs");
  };
  if (!std::isnan(scale.not_finite)) not_finite(scale.not_finite);
  if (const auto pole = pole_of(law.at, full_turn, true)) not_finite(*pole);
  for (const LawBreak& b : scale.breaks)
    if (value_jumps(b) || speed_jumps(b, scale.fastest)) kinked(b.after);
  for (const double end : {-full_turn, 0.0, full_turn})  // a cam continues to rotate there
    if (jumps_at(law.at, end)) kinked(end);
  return law;
}

}  // namespace

bool says_present(const Node& node) {
  if (!node.is_scalar()) return false;
  const std::string& text = node.yaml().text;
  constexpr std::string_view word = "present";
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !is_letter_or_digit(text[at - 1])) && (end == text.size() || !is_letter_or_digit(text[end]))) return true;
  }
  return false;
}

Law read_after_present(const Node& node, const Dimension& expected, double until) {
  Law law = law_at_present(node, expected, 0), more = law_at_present(node, expected, 1);
  constexpr double rounding = 1e-9;
  for (const double t : {0.0, 0.37, 5.1})
    if (!(std::abs(more.at(t).value - law.at(t).value - 1) < rounding) || !(std::abs(more.at(t).rate - law.at(t).rate) < rounding))
      node.fail(node.shown() + " may only add to present; write for example present + 50 mm*step(t, 0, 1 s)");
  must_be_finite(node, law, Smoothness::driver, until);
  return law;
}

namespace {

bool measures_the_same(const SceneTerm& one, const SceneTerm& other) {
  const auto same = [&](const PointRef& p, const PointRef& q) {
    return p.body == q.body && (one.kind == SceneTerm::angle || p.point == q.point);
  };
  const bool either_way = one.kind != SceneTerm::displacement && same(one.a, other.b) && same(one.b, other.a);
  return one.kind == other.kind && ((same(one.a, other.a) && same(one.b, other.b)) || either_way);
}

}  // namespace

bool read_terms(const Node& list, SceneJoint& joint) {
  constexpr std::size_t most = 3;
  if (!list.is_list() || list.yaml().items.empty() || list.yaml().items.front().kind != Yaml::Kind::map) return false;
  const std::string remedy = "two or three terms: [{angle: [ground, shaft]}, {displacement: [frame.G, slide.P], ratio: 400 rad/m}]";
  const std::vector<Node> terms = list.list(2, remedy);
  if (terms.size() > most) list.fail("is " + list.shown() + "; write " + remedy);
  SceneCoupling& out = joint.coupling.emplace();
  Dimension sum;
  for (const Node& node : terms) {
    if (!node.is_map()) node.fail("is " + node.shown() + "; write a term such as {angle: [ground, shaft], ratio: 2}");
    check_keys(node, "joints.*.differential.*");
    SceneTerm& term = out.terms.emplace_back();
    const std::string kind = which_key(node, std::vector<std::string>{"angle", "displacement", "distance"}, "what it measures");
    term.kind = kind == "angle" ? SceneTerm::angle : kind == "distance" ? SceneTerm::distance : SceneTerm::displacement;
    std::tie(term.a, term.b) = read_ends(node.at(kind));
    const Dimension of = term.kind == SceneTerm::angle ? dimension::angle : dimension::length;
    if (&node == &terms.front()) sum = of;
    if (node.has("ratio")) term.ratio = node.at("ratio").quantity(product(sum, power(of, -1)));
    if (term.ratio == 0) node.at("ratio").fail("must not be 0; leave the term out");
    for (const SceneTerm& other : out.terms)
      if (&other != &term && measures_the_same(other, term)) node.at(kind).fail("is also measured by another term; add their ratios");
  }
  joint.a = out.terms.front().a, joint.b = out.terms.front().b;
  return true;
}

void read_coupling(const Node& node, const JointWord& word, SceneJoint& joint) {
  if (word.couples.empty()) {
    if (joint.coupling && node.has("ratio")) node.at("ratio").fail("is for two shafts; here each term has its own ratio");
    return;
  }
  SceneCoupling& out = joint.coupling.emplace();
  if (node.has("inside")) out.inside = node.at("inside").yes();
  if (node.has("crossed")) out.crossed = node.at("crossed").yes();
  switch (word.kind) {
    case JointKind::screw:
      if (!node.has("lead")) node.fail("lacks a required key; add for example lead: 5 mm (travel of the nut per turn)");
      out.lead = node.at("lead").quantity(dimension::length);
      if (out.lead == 0) node.at("lead").fail("must not be 0: the nut would be fixed; use prismatic or weld");
      return;
    case JointKind::cam: {
      const std::string key = which_key(node, std::vector<std::string>{"lift", "swing"}, "how its follower moves");
      out.swings = key == "swing";
      out.curve = read_cam_curve(node.at(key), out.swings ? dimension::angle : dimension::length, "joints.*." + key);
      return;
    }
    default: read_wheels(node, word, out);
  }
}

}  // namespace pintle
