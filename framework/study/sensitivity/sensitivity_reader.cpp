#include <algorithm>
#include <cmath>

#include "framework/common/fingerprint.h"
#include "framework/scene/units/unit.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/override.h"
#include "framework/study/sensitivity/sensitivity.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_parameters_of_corners = 10;

/// The scene's parameters with overrides applied; a bare number keeps the parameter's unit.
Parameters parameters_of(const Yaml& scene, const Overrides& set) {
  Parameters out;
  const auto group = std::ranges::find(scene.items, "parameters", &Yaml::key);
  if (group == scene.items.end()) return out;
  for (const Yaml& p : group->items) {
    Quantity q = read_quantity(p.text, out);
    for (const auto& [name, text] : set) {
      if (name != p.key) continue;
      const Quantity given = read_quantity(text, out);
      q = {given.value, bare(given.dimension) ? q.dimension : given.dimension};
    }
    out[p.key] = q;
  }
  return out;
}

/// The entry at a path; nullptr if there is none.
const Yaml* at_path(const Yaml& scene, std::string_view path) {
  const Yaml* at = &scene;
  while (at && !path.empty()) {
    const std::string_view step = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(path.size(), step.size() + 1));
    const auto next = std::ranges::find(at->items, step, &Yaml::key);
    at = next == at->items.end() ? nullptr : &*next;
  }
  return at;
}

/// The value that a parameter or path has in the scene.
Quantity nominal(const CaseSource& source, const Node& entry) {
  Yaml scene = parse_yaml(source.text, source.file.string());
  const Overrides rest = apply_paths(scene, source.file.string(), source.common);
  const Parameters parameters = parameters_of(scene, rest);
  if (const auto found = parameters.find(entry.name()); found != parameters.end()) return found->second;
  const Yaml* there = entry.name().find('.') == std::string::npos ? nullptr : at_path(scene, entry.name());
  try {
    if (there && there->kind == Yaml::Kind::scalar) return read_quantity(there->text, parameters);
  } catch (const ExpressionError&) {
  }
  entry.fail("has no readable number in the scene; name a parameter, or give its value: {at: 5 N/mm, …}");
}

double of_kind(const Node& node, const Scattered& p) {
  const Quantity q = read_value(node);
  if (!same(q.dimension, p.dimension) && !bare(q.dimension))
    node.fail("is " + describe(q.dimension) + ", but the parameter is " + describe(p.dimension) + "; give both in units of one kind");
  if (!(q.value > 0)) node.fail("must be greater than 0");
  return q.value;
}

Scattered read_parameter(const CaseSource& source, const Node& entry) {
  Scattered out;
  out.name = entry.name();
  if (!entry.is_nothing()) check_keys(entry, "study.sensitivity.parameters.*");
  const auto has = [&](const char* key) { return entry.is_map() && entry.has(key); };
  const Quantity at = has("at") ? read_value(entry.at("at")) : nominal(source, entry);
  out.at = at.value, out.dimension = at.dimension;
  if (has("uniform") && has("normal"))
    entry.fail("has two distributions; write either uniform (its half width) or normal (its standard deviation)");
  for (const char* key : {"uniform", "normal"})
    if (has(key)) {
      out.spread = std::string(key) == "uniform" ? Scattered::Spread::uniform : Scattered::Spread::normal;
      out.width = of_kind(entry.at(key), out);
    }
  out.step = has("step") ? of_kind(entry.at("step"), out) : out.width > 0 ? out.width : std::abs(out.at) / 100;
  if (!(out.step > 0)) entry.fail("is 0, so it needs a step: {step: 0.1 mm}");
  return out;
}

/// Appends a case with a value for every parameter.
void add_case(Cases& cases, const std::vector<Scattered>& parameters, const std::vector<double>& values) {
  std::vector<std::optional<std::string>> one;
  for (std::size_t i = 0; i < values.size(); ++i)
    one.emplace_back(with_unit(Span{values[i], values[i] + 1, false}.at(0), parameters[i].dimension));
  cases.values.push_back(std::move(one));
}

void add_differences(Cases& cases, const SensitivityPlan& plan, const std::vector<double>& nominal_values) {
  for (std::size_t i = 0; i < plan.parameters.size(); ++i)
    for (std::size_t k = 0; k < plan.levels; ++k)
      for (const double side : {1.0, -1.0}) {
        std::vector<double> x = nominal_values;
        x[i] += side * std::ldexp(plan.parameters[i].step, -static_cast<int>(k));
        add_case(cases, plan.parameters, x);
      }
}

void add_corners(Cases& cases, const SensitivityPlan& plan) {
  for (std::size_t corner = 0; corner < plan.corners; ++corner) {
    std::vector<double> x;
    for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
      const Scattered& p = plan.parameters[i];
      x.push_back(p.at + ((corner >> i) & 1 ? 1 : -1) * p.reach());
    }
    add_case(cases, plan.parameters, x);
  }
}

/// Columns of numbers in [0, 1), one for each parameter.
using Columns01 = std::vector<std::vector<double>>;

void add_rows(Cases& cases, const SensitivityPlan& plan, const Columns01& u, std::size_t rows) {
  for (std::size_t k = 0; k < rows; ++k) {
    std::vector<double> x;
    for (std::size_t i = 0; i < plan.parameters.size(); ++i) x.push_back(plan.parameters[i].drawn(u[i][k]));
    add_case(cases, plan.parameters, x);
  }
}

void add_random(Cases& cases, const SensitivityPlan& plan) {
  Columns01 u;
  for (const Scattered& p : plan.parameters) {
    Stream stream(plan.seed, p.name);
    u.emplace_back();
    for (std::size_t k = 0; k < plan.random; ++k) u.back().push_back(stream.uniform());
  }
  add_rows(cases, plan, u, plan.random);
}

/// A and B, then A with one column of B at a time.
void add_sobol(Cases& cases, const SensitivityPlan& plan) {
  Columns01 a, b;
  for (const Scattered& p : plan.parameters) {
    a.push_back(Stream(plan.sobol_seed, p.name + " in A").strata(plan.sobol));
    b.push_back(Stream(plan.sobol_seed, p.name + " in B").strata(plan.sobol));
  }
  add_rows(cases, plan, a, plan.sobol);
  add_rows(cases, plan, b, plan.sobol);
  for (std::size_t i = 0; i < plan.parameters.size(); ++i) {
    Columns01 mixed = a;
    mixed[i] = b[i];
    add_rows(cases, plan, mixed, plan.sobol);
  }
}

void read_counts(const Node& section, SensitivityPlan& plan) {
  const auto in = [&](const char* group, const char* key, std::size_t otherwise) {
    if (!section.has(group)) return otherwise;
    const Node node = section.at(group);
    check_keys(node, std::string("study.sensitivity.") + group);
    return node.has(key) ? static_cast<std::size_t>(node.at(key).count(std::string_view(key) == "seed" ? 0 : 2)) : otherwise;
  };
  if (section.has("levels")) plan.levels = static_cast<std::size_t>(section.at("levels").count(1));
  if (plan.levels > 10) section.at("levels").fail("is more than 10; halved so often, the steps would be lost in rounding");
  plan.random = in("monte carlo", "count", 0), plan.seed = in("monte carlo", "seed", 1);
  plan.sobol = in("sobol", "count", 0), plan.sobol_seed = in("sobol", "seed", 1);
  const bool scatters = std::ranges::any_of(plan.parameters, [](const Scattered& p) { return p.width > 0; });
  const bool small = plan.parameters.size() <= most_parameters_of_corners;
  const bool wanted = section.has("corners") ? section.at("corners").yes() : scatters && small;
  for (const char* group : {"monte carlo", "sobol", "corners"})
    if (section.has(group) && !scatters && (std::string_view(group) != "corners" || wanted))
      section.at(group).fail("needs parameters with a distribution; give them {uniform: 0.1 mm} or {normal: 0.05 mm}");
  if (wanted && !small)
    section.at("corners").fail("number 2 to the power of the number of parameters; with more than " +
                               std::to_string(most_parameters_of_corners) + " parameters leave them out");
  plan.corners = wanted ? std::size_t{1} << plan.parameters.size() : 0;
  constexpr std::size_t most_values = 20'000'000;
  if (plan.random > most_cases || plan.sobol > most_cases || plan.cases() > std::min(most_cases, most_values / plan.parameters.size()))
    section.fail("has more than " + std::to_string(most_cases) + " cases, or " + std::to_string(most_values) + " values; reduce them");
}

}  // namespace

SensitivityPlan read_sensitivity(const fs::path& path, const Overrides& set) {
  StudyFile file = read_study(path);
  const Node root = file.root();
  if (!root.has("sensitivity")) root.fail("has no sensitivity; add for example sensitivity: {parameters: {length: {uniform: 0.1 mm}}}");
  require_measures(file);
  const Node section = root.at("sensitivity");
  check_keys(section, "study.sensitivity");
  CaseSource source = file.study.scene;
  source.common.insert(source.common.end(), set.begin(), set.end());

  SensitivityPlan plan;
  Cases cases;
  std::vector<double> nominal_values;
  for (const Node& entry :
       section.at("parameters").entries("names of parameters (or paths): {length: {uniform: 0.1 mm}, mass: {step: 1 g}}")) {
    plan.parameters.push_back(read_parameter(source, entry));
    nominal_values.push_back(plan.parameters.back().at);
    cases.names.push_back(entry.name()), cases.places.push_back(entry.place());
  }
  if (plan.parameters.empty()) section.at("parameters").fail("names no parameter; write for example {length: {uniform: 0.1 mm}}");
  read_counts(section, plan);
  add_case(cases, plan.parameters, nominal_values);
  add_differences(cases, plan, nominal_values);
  add_corners(cases, plan);
  add_random(cases, plan);
  add_sobol(cases, plan);
  plan.sweep = cases_of(file, std::move(cases), path, set, step_limit(section));
  plan.sweep.print = fingerprint("sensitivity", plan.sweep.print);
  validate_measures(plan.sweep);
  return plan;
}

}  // namespace pintle
