#include <algorithm>

#include "framework/common/fingerprint.h"
#include "framework/scene/yaml/keys.h"
#include "framework/study/fit/fit.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

std::vector<Variable> read_variables(const Node& root) {
  constexpr const char* remedy = "names of parameters (or paths) and their spans: {length: {from: 20 mm, to: 60 mm, start: 40 mm}}";
  if (!root.has("vary")) root.fail(std::string("does not say what may vary; add vary, ") + remedy);
  std::vector<Variable> out;
  for (const Node& entry : root.at("vary").entries(remedy)) {
    check_keys(entry, "study.vary.*");
    Variable v{entry.name(), read_span(entry)};
    if (!(v.span.span.to > v.span.span.from)) entry.fail("is empty: to must be greater than from");
    out.push_back(v);
  }
  if (out.empty()) root.at("vary").fail(std::string("names nothing to vary; write ") + remedy);
  return out;
}

/// Initial value of a variable: `start`, or the middle.
double start_of(const Node& entry, const Variable& v) {
  if (!entry.has("start")) return 0.5;
  const Quantity start = read_value(entry.at("start"));
  const Dimension& expected = v.span.dimension;
  if (!same(start.dimension, expected) && !bare(start.dimension))
    entry.at("start").fail("is " + describe(start.dimension) + " and from is " + describe(expected) + "; give both in units of one kind");
  const double u = v.span.where(start.value);
  if (!(u >= 0 && u <= 1)) entry.at("start").fail("lies outside the range from … to; widen the range, or start inside it");
  return u;
}

/// The start, then a Latin hypercube.
Cases first_points(const Node& vary, const std::vector<Variable>& variables, std::size_t sample, std::uint64_t seed) {
  Cases out;
  out.values.resize(1 + sample);
  for (const Variable& v : variables) {
    const Node entry = vary.at(v.name);
    out.names.push_back(v.name);
    out.places.push_back(entry.place());
    out.values[0].emplace_back(v.span.text(start_of(entry, v)));
    const std::vector<double> u = Stream(seed, v.name).strata(sample);
    for (std::size_t k = 0; k < sample; ++k) out.values[k + 1].emplace_back(v.span.text(u[k]));
  }
  return out;
}

void read_method(const Node& section, FitPlan& plan) {
  if (!section.has("method")) return;
  const std::string word = section.at("method").one_of(choices("study.fit", "method"));
  for (const Optimiser m : {Optimiser::bobyqa, Optimiser::cobyla, Optimiser::nelder_mead, Optimiser::sbplx, Optimiser::slsqp,
                            Optimiser::mma, Optimiser::direct, Optimiser::crs, Optimiser::isres})
    if (word == name_of(m)) plan.method = m;
  if (!plan.method) return;
  if (!plan.goal.bounds.empty() && !takes_constraints(*plan.method))
    section.at("method").fail(word +
                              " does not support constraints, and the study has subject to; write auto, cobyla, slsqp, mma or isres");
  if (looks_everywhere(*plan.method) && section.has("starts"))
    section.at("starts").fail("has no effect with " + word + ", which searches the whole range anyway; leave it out");
  if (*plan.method == Optimiser::bobyqa && plan.variables.size() < 2)
    section.at("method").fail("bobyqa needs at least two variables; write auto, cobyla or sbplx");
}

double share_of_span(const Node& section, const char* key, double otherwise) {
  if (!section.has(key)) return otherwise;
  const double x = section.at(key).quantity({}, rule::inside_zero_one);
  return x;
}

constexpr std::size_t most_evaluations = most_cases, most_values = 20'000'000;

/// The numbers of cases of each kind.
std::size_t read_counts(const Node& root, FitPlan& plan) {
  static const Yaml nothing{Yaml::Kind::map, 0, {}, {}, {}};
  const Node section = root.has("fit") ? root.at("fit") : Node(nothing, root.source(), root.place());
  check_keys(section, "study.fit");
  const auto count = [&](const char* key, long least, std::size_t otherwise) {
    return section.has(key) ? static_cast<std::size_t>(section.at(key).count(least)) : otherwise;
  };
  read_method(section, plan);
  const bool everywhere = plan.method && looks_everywhere(*plan.method);
  plan.starts = everywhere ? 1 : count("starts", 1, 4);
  plan.evaluations = count("evaluations", 2, 1000);
  if (plan.evaluations > most_evaluations) section.at("evaluations").fail("is more than " + std::to_string(most_evaluations));
  plan.seed = count("seed", 0, 1);
  plan.precision = share_of_span(section, "precision", plan.precision);
  plan.step = share_of_span(section, "step", plan.step);
  const std::size_t sample = count("sample", 0, everywhere || plan.starts > 1 ? std::min(10 * plan.starts, plan.evaluations / 4) : 0);
  if (1 + sample + plan.starts > plan.evaluations)
    section.fail("has " + std::to_string(plan.evaluations) + " evaluations, fewer than its first points and starts need (" +
                 std::to_string(1 + sample + plan.starts) + "); allow more evaluations, or reduce sample or starts");
  if (sample > most_values / plan.variables.size())
    section.fail("has more than " + std::to_string(most_values) + " values in its sample; make it smaller");
  return sample;
}

}  // namespace

BoxPoint FitPlan::point(std::size_t k) const {
  BoxPoint out;
  for (std::size_t j = 0; j < variables.size(); ++j)
    out.push_back(std::clamp(variables[j].span.where(base.cases.quantity(k, j)->value), 0.0, 1.0));
  return out;
}

Overrides FitPlan::overrides(const BoxPoint& u) const {
  Overrides out;
  for (std::size_t j = 0; j < variables.size(); ++j) out.emplace_back(variables[j].name, variables[j].span.text(u[j]));
  return out;
}

std::vector<Optimiser> FitPlan::methods() const {
  if (method) return {*method};
  // Peaks and ranges have kinks along valleys. Methods that model the measure get stuck there, simplex methods do not.
  if (!goal.bounds.empty()) return {Optimiser::cobyla, Optimiser::nelder_mead, Optimiser::nelder_mead};
  if (variables.size() < 2) return {Optimiser::sbplx};  // bobyqa needs two
  return {Optimiser::bobyqa, Optimiser::nelder_mead, Optimiser::nelder_mead};
}

std::size_t FitPlan::share() const {
  const std::size_t left = evaluations - base.cases.size();
  return (method ? left : left - left / 5) / starts;  // the rest is for the last search
}

FitPlan read_fit(const fs::path& path, const Overrides& set) {
  StudyFile file = read_study(path);
  const Node root = file.root();
  FitPlan out;
  out.variables = read_variables(root);
  out.goal = read_goal(file, file.study);
  const std::size_t sample = read_counts(root, out);
  out.base = cases_of(file, first_points(root.at("vary"), out.variables, sample, out.seed), path, set,
                      root.has("fit") ? step_limit(root.at("fit")) : Overrides{});
  out.base.print = fingerprint("fit", out.base.print);
  validate_measures(out.base, {"case", "phase", "goal", "worst excess", "status", "reason"});
  out.source = file.study.scene;
  out.source.common.insert(out.source.common.end(), set.begin(), set.end());
  return out;
}

}  // namespace pintle
