#include <algorithm>

#include "framework/build/build.h"
#include "framework/common/text.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/override.h"
#include "framework/study/nonlinear/nonlinear.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
constexpr int most_returns = 1'000'000;

/// Checks an expression with the reader of the scene, by overriding a key with it.
class ExpressionCheck {
 public:
  ExpressionCheck(const CaseSource& source, const Overrides& set) : source_(source), set_(set) {}

  /// @throws SceneError  at the node, if the scene does not accept the overrides
  void check(const Node& node, const Overrides& put) const {
    Overrides all = set_;
    all.insert(all.end(), put.begin(), put.end());
    try {
      build(case_scene(source_, all));
    } catch (const SceneError& error) {
      const std::string of_it = about(error.what(), put);
      if (of_it.empty()) throw;  // the error concerns another override, which its message names
      node.fail(of_it);
    }
  }

 private:
  /// The part of a message after "--set PATH"; empty if it concerns none of these.
  static std::string about(const std::string& said, const Overrides& put) {
    for (const auto& [path, text] : put) {
      const std::string mark = ": --set " + path;
      const auto at = said.find(mark);
      if (at == std::string::npos) continue;
      const auto colon = said.find(": ", at + mark.size());
      if (colon == at + mark.size()) return said.substr(colon + 2);
    }
    return "";
  }

  const CaseSource& source_;
  const Overrides& set_;
};

/// An expression for a time, in the scene's parameters.
std::string read_time(const Node& node, const ExpressionCheck& expressions) {
  const std::string text = node.text("a time such as 2*pi/omega or 10 ms");
  expressions.check(node, {{"output", "null"}, {"run.until", override_text(node.yaml())}});
  return override_text(node.yaml());
}

std::vector<Recorded> read_record(const Node& node) {
  constexpr const char* remedy = "names and expressions: {height: ball.y, speed: ball.vy}, or a list of expressions";
  std::vector<Recorded> out;
  const auto add = [&](const Node& entry, const std::string& name) {
    const std::string words = entry.text("an expression of signals such as crank.speed");
    for (const Recorded& one : out)
      if (one.name == (name.empty() ? words : name)) entry.fail("is recorded twice; leave one out");
    out.push_back({name.empty() ? words : name, override_text(entry.yaml())});
  };
  each_entry(node, remedy, add);
  if (out.empty()) node.fail(std::string("records nothing; write ") + remedy);
  return out;
}

int read_count(const Node& node, long least) {
  const long n = node.count(least);
  if (n > most_returns) node.fail("is more than " + std::to_string(most_returns) + "; take fewer");
  return static_cast<int>(n);
}

SectionQuestion read_section(const Node& node, const ExpressionCheck& expressions) {
  static const std::vector<std::string> kinds{"every", "when"};
  check_keys(node, "study.section");
  SectionQuestion out;
  if (which_key(node, kinds, "where the motion is sampled") == "every")
    out.every = read_time(node.at("every"), expressions);
  else
    out.when = override_text(node.at("when").yaml());
  out.record = read_record(node.at("record"));
  if (node.has("transient")) out.transient = read_count(node.at("transient"), 0);
  if (node.has("returns")) out.returns = read_count(node.at("returns"), 2);  // fewer cannot repeat
  if (node.has("tolerance")) out.tolerance = node.at("tolerance").quantity(dimension::number, rule::inside_zero_one);
  // One after another, so that an error names the one concerned.
  OrbitQuestion question;
  question.section = out;
  const Overrides all = recording(question);
  const Node record = node.at("record");
  for (std::size_t k = 0; k < out.record.size(); ++k) {
    const Node entry = record.is_map() ? record.at(out.record[k].name) : record;
    expressions.check(entry, {all[k]});
  }
  if (!out.when.empty())
    expressions.check(node.at("when"), Overrides(all.begin() + static_cast<std::ptrdiff_t>(out.record.size()), all.end()));
  return out;
}

LyapunovQuestion read_lyapunov(const Node& node, const ExpressionCheck& expressions) {
  check_keys(node, "study.lyapunov");
  LyapunovQuestion out;
  if (node.has("exponents")) out.exponents = read_count(node.at("exponents"), 1);
  out.every = read_time(node.at("every"), expressions);
  out.over = read_time(node.at("over"), expressions);
  if (node.has("transient")) out.transient = read_time(node.at("transient"), expressions);
  if (node.has("distance")) out.distance = node.at("distance").quantity(dimension::number, rule::inside_zero_one);
  return out;
}

CycleQuestion read_cycle(const Node& node, const std::optional<SectionQuestion>& section) {
  check_keys(node, "study.orbit");
  if (!section)
    node.fail(
        "needs a section, because an orbit is a fixed point of its returns; add for example section: {every: 2*pi/omega, record: {height: "
        "ball.y}}");
  CycleQuestion out;
  if (node.has("period")) out.period = read_count(node.at("period"), 1);
  if (out.period >= section->returns)
    node.at("period").fail("is not less than section.returns, " + std::to_string(section->returns) +
                           ", from which the time of an orbit is taken; record more");
  if (node.has("tolerance")) out.tolerance = node.at("tolerance").quantity(dimension::number, rule::inside_zero_one);
  if (node.has("distance")) out.distance = node.at("distance").quantity(dimension::number, rule::inside_zero_one);
  return out;
}

Cases read_varied(const Node& root) {
  if (root.has("basins")) return read_cases(root.at("basins"), "study.basins");
  if (!root.has("over")) return {{}, {{}}, {}};
  Cases cases = read_grid(root.at("over"));
  if (cases.names.size() != 1)
    root.at("over").fail("names " + std::to_string(cases.names.size()) + " parameters; name one, and set the others");
  return cases;
}

BasinsQuestion read_basins(const Node& root) {
  const Node node = root.at("basins");
  if (root.has("over")) root.at("over").fail("does not go with basins, which vary the start alone; leave one of them out");
  if (!root.has("section"))
    node.fail(
        "need a section, whose returns show where a motion ends; add for example section: {every: 2*pi/omega, record: {height: ball.y}}");
  BasinsQuestion out;
  if (node.has("tolerance")) out.tolerance = node.at("tolerance").quantity(dimension::number, rule::inside_zero_one);
  out.random = node.has("random");
  return out;
}

std::string without_units(std::string heading) {
  while (heading.ends_with(']') && heading.rfind(" [") != std::string::npos) heading.resize(heading.rfind(" ["));
  return heading;
}

/// @throws SceneError  the parameter or something recorded is called like another column of a table
void require_other_names(const Nonlinear& study, const Node& root) {
  std::vector<std::pair<std::string, Node>> given;
  if (study.question.section) {
    const Node record = root.at("section").at("record");
    for (const Recorded& one : study.question.section->record) given.emplace_back(one.name, record.is_map() ? record.at(one.name) : record);
  }
  for (const std::string& name : study.sweep.cases.names)  // last: they cannot be renamed here
    given.emplace_back(name, root.at(study.basins ? "basins" : "over"));
  for (const std::vector<std::string>& table : headings_of_tables(study))
    for (const auto& [name, node] : given)
      if (std::ranges::count(table, without_units(name), without_units) > 1) node.fail(quoted(name) + " " + taken_name);
}

}  // namespace

Nonlinear read_nonlinear(const fs::path& path, const Overrides& set) {
  constexpr const char* example = "section: {every: 2*pi/omega, record: {height: ball.y}}";
  const StudyFile file = read_study(path, example);
  const Node root = file.root();
  if (!root.has("section") && !root.has("lyapunov")) root.fail(std::string("has neither section nor lyapunov; add for example ") + example);
  for (const char* other : {"measure", "analysis", "situations", "sweep"})
    if (root.has(other)) root.at(other).fail("belongs to other studies; leave it out beside section and lyapunov");
  if (root.has("direction") && !root.has("over"))
    root.at("direction").fail("belongs to studies over a parameter; add over, or leave it out");
  CaseSource source = file.study.scene;
  source.common.insert(source.common.end(), set.begin(), set.end());
  Nonlinear out;
  if (root.has("basins")) out.basins = read_basins(root), out.order = Order::from_start;
  const Cases cases = read_varied(root);
  if (!cases.names.empty()) cases_of(file, cases, path, set, {});  // so that errors of the values are reported at them
  const Overrides first = cases.overrides(0);
  const ExpressionCheck expressions(source, first);
  if (root.has("direction")) {
    const auto words = choices("study", "direction");
    out.order = static_cast<Order>(std::ranges::find(words, root.at("direction").one_of(words)) - words.begin());
  }
  if (!cases.names.empty() && cases.names.front().starts_with("start.")) {
    if (root.has("direction") && out.order != Order::from_start)
      root.at("direction")
          .fail("makes each value continue from the end of the previous one, so that " + cases.names.front() +
                " would have no effect; write direction: from start");
    out.order = Order::from_start;
  }
  if (root.has("section")) out.question.section = read_section(root.at("section"), expressions);
  if (root.has("orbit")) out.question.cycle = read_cycle(root.at("orbit"), out.question.section);
  if (root.has("lyapunov")) {
    out.question.lyapunov = read_lyapunov(root.at("lyapunov"), expressions);
    try {
      lyapunov_times(source, first, *out.question.lyapunov);
    } catch (const std::invalid_argument& error) {
      root.at("lyapunov").fail(error.what());
    }
  }
  Overrides common = recording(out.question);
  for (const auto& limit : step_limit(root)) common.push_back(limit);
  out.sweep = cases_of(file, cases, path, set, common);
  require_other_names(out, root);
  if (root.has("limit")) out.sweep.limits.seconds = root.at("limit").quantity(dimension::time, rule::positive);
  return out;
}

}  // namespace pintle
