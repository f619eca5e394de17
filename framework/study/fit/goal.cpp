#include "framework/study/fit/goal.h"

#include <algorithm>
#include <cmath>

#include "framework/common/nearest.h"
#include "framework/scene/yaml/keys.h"
#include "framework/study/sweep/sampling.h"

namespace pintle {

namespace {

/// "N m", "1/s", or nothing: values in a unit that the scene language lacks (of modal coordinates) are bare numbers.
Quantity one_of_unit(const std::string& unit) {
  try {
    if (!unit.empty()) return read_quantity(unit.starts_with("1/") ? unit : "1 " + unit);
  } catch (const ExpressionError&) {
  }
  return {1, {}};
}

/// The scene against which words are checked, and the study to which measures are added.
struct GoalReader {
  const StudyFile& file;
  Study& study;
  Scene scene = common_scene(file.study.scene);

  /// The measure with this name or these words.
  std::size_t measure(const Node& at, const std::string& words) const {
    for (std::size_t i = 0; i < study.measures.size(); ++i)
      if (study.measures[i].name == words || (study.measures[i].words == words && file.study.scene.situations.empty())) return i;
    if (!file.study.scene.situations.empty()) at.fail("must name a measure and its situation here" + known_measures());
    return add({words, words, at.place(), study.file, file.study.scene.question, {}});
  }
  std::string known_measures() const {
    std::vector<std::string> names;
    for (const Measure& m : study.measures) names.push_back(m.name);
    return names.empty() ? "; name measures under measure" : "; there are " + listed(names, "and");
  }
  std::size_t add(const Measure& m) const {
    validate({m}, scene);
    study.measures.push_back(m);
    return study.measures.size() - 1;
  }

  /// A value in the unit of a measure.
  double in_unit_of(std::size_t m, const Node& node) const {
    const std::string unit = measured_unit(study.measures[m], scene);
    if (unit == "Hz") return node.frequency();
    const Quantity one = one_of_unit(unit);
    return node.quantity(one.dimension) / one.value;
  }
};

Aim read_aim(const GoalReader& reader, const Node& entry, bool& exact) {
  Aim out{reader.measure(entry, entry.name()), 0, 0};
  if (entry.is_map()) check_keys(entry, "study.goal.reach.*");
  out.to = reader.in_unit_of(out.measure, entry.is_map() ? entry.at("to") : entry);
  out.tolerance = std::abs(out.to) / 1000;
  if (entry.is_map() && entry.has("tolerance")) {
    out.tolerance = reader.in_unit_of(out.measure, entry.at("tolerance"));
    if (!(out.tolerance > 0)) entry.at("tolerance").fail("must be greater than 0");
    exact = true;
  }
  if (out.tolerance == 0) entry.fail("has the goal 0, so it needs a tolerance: {to: 0, tolerance: 0.1 mm}");
  return out;
}

PathTarget read_path(const Node& node) {
  check_keys(node, "study.goal.path");
  PathTarget out;
  out.point = node.at("point").text("a point such as coupler.M");
  for (const Node& p : node.at("through").list(2, "at least two points such as [[0, 0], [10 mm, 0]]")) {
    const Pair at = p.pair(dimension::length);
    out.through.push_back({at[0], at[1]});
  }
  if (node.has("times")) {
    for (const Node& t : node.at("times").list(1, "a time for each point"))
      out.times.push_back(t.quantity(dimension::time, rule::not_negative));
    if (out.times.size() != out.through.size())
      node.at("times").fail("has " + std::to_string(out.times.size()) + " times, through has " + std::to_string(out.through.size()) +
                            " points; give one for each, or leave times out");
    if (node.has("order"))
      node.at("order").fail("has no effect with times, which already assign a time to each point; leave one of them out");
  }
  if (node.has("order")) {
    const std::string order = node.at("order").one_of(choices("study.goal.path", "order"));
    out.order = order == "along" ? Passing::along : order == "any" ? Passing::any : Passing::either_way;
  }
  if (!(out.extent() > 0)) node.at("through").fail("repeats one point; give points that differ");
  return out;
}

void read_path_goal(const GoalReader& reader, const Node& node, Goal& goal) {
  if (!reader.file.study.scene.situations.empty()) node.fail("supports one situation only; leave out situations");
  const PathTarget path = read_path(node);
  goal.measure = reader.add({"distance to path", "", node.place(), reader.study.file, reader.file.study.scene.question, path});
  goal.exact = node.has("tolerance");
  goal.aims = {{goal.measure, 0, goal.exact ? node.at("tolerance").quantity(dimension::length, rule::positive) : path.extent() / 1000}};
}

void read_bounds(const GoalReader& reader, const Node& section, Goal& goal) {
  for (const Node& entry : section.entries("measures and their limits: {\"peak torque of motor\": {at most: 5 N m}}")) {
    check_keys(entry, "study.subject to.*");
    const std::size_t m = reader.measure(entry, entry.name());
    if (!entry.has("at most") && !entry.has("at least")) entry.fail("has no limit; write {at most: …} or {at least: …}");
    for (const char* side : {"at most", "at least"})
      if (entry.has(side)) goal.bounds.push_back({m, reader.in_unit_of(m, entry.at(side)), std::string(side) == "at most"});
  }
}

}  // namespace

Worth Goal::worth(const std::vector<double>& values) const {
  Worth out{true, 0, {}};
  if (kind == Kind::minimise || kind == Kind::maximise) out.value = kind == Kind::minimise ? values[measure] : -values[measure];
  for (const Aim& a : aims) out.value += std::pow((values[a.measure] - a.to) / a.tolerance, 2);
  for (const Bound& b : bounds) {
    const double past = b.at_most ? values[b.measure] - b.limit : b.limit - values[b.measure];
    out.excess.push_back(past / (b.limit == 0 ? 1 : std::abs(b.limit)));
  }
  out.known = !std::isnan(out.value) && std::ranges::none_of(out.excess, [](double e) { return std::isnan(e); });
  return out;
}

bool Goal::reached(const std::vector<double>& values) const {
  return std::ranges::all_of(aims, [&](const Aim& a) { return std::abs(values[a.measure] - a.to) <= a.tolerance; });
}

double Goal::good_enough() const { return aims.empty() ? -1 : 1e-8; }

Goal read_goal(const StudyFile& file, Study& study) {
  static const std::vector<std::string> kinds{"minimise", "maximise", "reach", "path"};
  const Node root = file.root();
  if (!root.has("goal")) root.fail("has no goal; add for example goal: {minimise: peak force at crank pin}");
  const GoalReader reader{file, study};
  const Node section = root.at("goal");
  check_keys(section, "study.goal");
  const std::string kind = which_key(section, kinds, "what is wanted");
  const Node node = section.at(kind);
  Goal goal;
  goal.kind = static_cast<Goal::Kind>(std::ranges::find(kinds, kind) - kinds.begin());
  switch (goal.kind) {
    case Goal::Kind::minimise:
    case Goal::Kind::maximise: goal.measure = reader.measure(node, node.text("a measure such as peak force at crank pin")); break;
    case Goal::Kind::reach:
      for (const Node& entry : node.entries("measures and values: {\"frequency of mode 1\": 5 Hz}"))
        goal.aims.push_back(read_aim(reader, entry, goal.exact));
      if (goal.aims.empty()) node.fail("names nothing to reach; write for example {\"frequency of mode 1\": 5 Hz}");
      break;
    case Goal::Kind::path: read_path_goal(reader, node, goal); break;
  }
  if (root.has("subject to")) read_bounds(reader, root.at("subject to"), goal);
  return goal;
}

}  // namespace pintle
