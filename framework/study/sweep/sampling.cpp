#include "framework/study/sweep/sampling.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>

#include "framework/common/fingerprint.h"
#include "framework/scene/yaml/keys.h"
#include "framework/scene/yaml/override.h"

namespace pintle {

namespace {

using Texts = std::vector<std::optional<std::string>>;

constexpr const char* how_values_look = "a list such as [0.01 mm, 0.1 mm], or {from: 0.01 mm, to: 0.5 mm, count: 50, scale: log}";
constexpr const char* how_spans_look = "{from: 0.01 mm, to: 0.5 mm, scale: log}, or a list of choices";

double rounded(double x) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific, 11).ptr;
  double out = 0;
  std::from_chars(text.data(), end, out);
  return out;
}

std::string decimal(double x) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x).ptr};
}

/// ratio^u using only square roots and products, which every machine rounds equally; `pow` may differ in its last bit.
double power(double ratio, double u) {
  double out = 1, root = ratio;
  if (u >= 1) return ratio;
  for (int bit = 0; bit < 53 && u > 0; ++bit) {
    root = std::sqrt(root);
    u *= 2;
    if (u < 1) continue;
    out *= root;
    u -= 1;
  }
  return out;
}

Texts values(const Node& node) {
  Texts out;
  if (node.is_map()) {
    if (!node.has("from") && !node.has("to")) node.fail("is " + node.shown() + "; write " + how_values_look);
    check_keys(node, "study.sweep.grid.*");
    const ValueSpan range = read_span(node);
    const auto n = static_cast<std::size_t>(node.at("count").count(1));
    if (n > most_cases) node.at("count").fail("is more than " + std::to_string(most_cases) + " cases; use fewer");
    for (std::size_t k = 0; k < n; ++k) out.emplace_back(range.text(n == 1 ? 0 : static_cast<double>(k) / static_cast<double>(n - 1)));
    return out;
  }
  if (node.is_list() && node.yaml().items.empty())
    node.fail(std::string("is an empty list, so there are no cases; write ") + how_values_look);
  for (const Node& item : node.list(1, how_values_look)) out.emplace_back(override_text(item.yaml()));
  return out;
}

std::vector<Node> named(const Node& section) {
  std::vector<Node> entries =
      section.entries(std::string("names of parameters (or paths) and their values: {clearance: ") + how_values_look + "}");
  if (entries.empty()) section.fail("names nothing to vary; add for example clearance: [0.01 mm, 0.1 mm]");
  return entries;
}

/// The number of values(node), without creating them; 1 where it rejects the node.
std::size_t value_count(const Node& node) {
  if (node.is_list()) return std::max<std::size_t>(1, node.yaml().items.size());
  return node.is_map() && node.has("count") ? static_cast<std::size_t>(node.at("count").count(1)) : 1;
}

Cases grid(const Node& section) {
  Cases cases;
  std::size_t n = 1;
  for (const Node& axis : named(section)) {
    const std::size_t here = value_count(axis);
    if (here > most_cases) values(axis);  // reports it
    if (n > most_cases / here) section.fail("has more than " + std::to_string(most_cases) + " combinations; use fewer values, or random");
    n *= here;
  }
  std::vector<Texts> axes;
  for (const Node& axis : named(section)) {
    cases.names.push_back(axis.name());
    cases.places.push_back(axis.place());
    axes.push_back(values(axis));
  }
  for (std::size_t k = 0; k < n; ++k) {
    Texts one(axes.size());
    std::size_t rest = k;
    for (std::size_t a = axes.size(); a-- > 0; rest /= axes[a].size()) one[a] = axes[a][rest % axes[a].size()];
    cases.values.push_back(std::move(one));
  }
  return cases;
}

/// Checked before the values are created: a few lines could request more than any memory.
void validate_size(const Node& section, std::size_t cases, std::size_t names) {
  constexpr std::size_t most_values = 20'000'000;
  if (cases > most_values / std::max<std::size_t>(1, names))
    section.fail("has more than " + std::to_string(most_values) + " values, of " + std::to_string(names) +
                 " names together; use fewer cases");
}

Cases columns(const Node& section) {
  Cases cases;
  for (const Node& column : named(section)) {
    validate_size(section, value_count(column), named(section).size());
    const Texts texts = values(column);
    if (cases.names.empty()) cases.values.resize(texts.size());
    if (texts.size() != cases.size())
      column.fail("has " + std::to_string(texts.size()) + " values, " + cases.names.front() + " has " + std::to_string(cases.size()) +
                  "; the values of a list are combined one by one: give equally many, or write grid for all combinations");
    cases.names.push_back(column.name());
    cases.places.push_back(column.place());
    for (std::size_t k = 0; k < texts.size(); ++k) cases.values[k].push_back(texts[k]);
  }
  return cases;
}

Cases list(const Node& section) {
  if (section.is_map()) return columns(section);
  Cases cases;
  for (const Node& row : section.list(1, "a list of cases such as [{clearance: 0.01 mm}, {clearance: 0.1 mm, speed: 50 rad/s}]")) {
    Texts one(cases.names.size());
    for (const Node& entry : row.entries("names and values: {clearance: 0.1 mm}")) {
      const auto at = static_cast<std::size_t>(std::ranges::find(cases.names, entry.name()) - cases.names.begin());
      if (at == cases.names.size()) {
        cases.names.push_back(entry.name());
        cases.places.push_back(entry.place());
        for (Texts& earlier : cases.values) earlier.emplace_back();
        one.emplace_back();
      }
      one[at] = override_text(entry.yaml());
    }
    cases.values.push_back(std::move(one));
    if (cases.size() > most_cases) section.fail("has more than " + std::to_string(most_cases) + " cases; use fewer");
  }
  return cases;
}

Cases sampled(const Node& section, bool latin) {
  std::vector<Node> entries = named(section);
  if (!section.has("count")) section.fail("does not say how many cases; add for example count: 100");
  const auto n = static_cast<std::size_t>(section.at("count").count(1));
  if (n > most_cases) section.at("count").fail("is more than " + std::to_string(most_cases) + " cases; use fewer");
  const auto seed = static_cast<std::uint64_t>(section.has("seed") ? section.at("seed").count(0) : 1);

  validate_size(section, n, entries.size());
  Cases cases;
  cases.values.resize(n);
  for (const Node& entry : entries) {
    if (entry.name() == "count" || entry.name() == "seed") continue;
    cases.names.push_back(entry.name());
    cases.places.push_back(entry.place());
    Stream stream(seed, entry.name());
    std::vector<double> u;
    if (latin)
      u = stream.strata(n);
    else
      for (std::size_t k = 0; k < n; ++k) u.push_back(stream.uniform());
    if (entry.is_list()) {
      const Texts choices = values(entry);
      for (std::size_t k = 0; k < n; ++k)
        cases.values[k].push_back(choices[static_cast<std::size_t>(u[k] * static_cast<double>(choices.size()))]);
      continue;
    }
    if (!entry.is_map()) entry.fail("is " + entry.shown() + "; write " + how_spans_look);
    check_keys(entry, "study.sweep.random.*");
    const ValueSpan range = read_span(entry);
    for (std::size_t k = 0; k < n; ++k) cases.values[k].emplace_back(range.text(u[k]));
  }
  if (cases.names.empty()) section.fail("names nothing to vary; add for example clearance: {from: 0.01 mm, to: 0.5 mm}");
  return cases;
}

}  // namespace

Cases read_grid(const Node& group) { return grid(group); }

Quantity read_value(const Node& node) {
  try {
    return read_quantity(node.text("a value such as 0.1 mm"), node.source().parameters);
  } catch (const ExpressionError& error) {
    node.fail(error.what());
  }
}

ValueSpan read_span(const Node& group) {
  const Quantity a = read_value(group.at("from")), b = read_value(group.at("to"));
  const bool fits = same(a.dimension, b.dimension) || (a.value == 0 && bare(a.dimension)) || (b.value == 0 && bare(b.dimension));
  if (!fits) group.fail("from is " + describe(a.dimension) + " and to is " + describe(b.dimension) + "; give both in units of one kind");
  ValueSpan out{{a.value, b.value, false}, bare(a.dimension) ? b.dimension : a.dimension};
  if (group.has("scale")) out.span.logarithmic = group.at("scale").one_of(choices("study.sweep.random.*", "scale")) == "log";
  if (out.span.logarithmic && !(a.value > 0 && b.value > 0))
    group.fail("a logarithmic scale needs from and to greater than 0; write scale: linear");
  return out;
}

std::string with_unit(double x, const Dimension& dimension) {
  const std::string unit = si_unit(dimension);
  return unit.empty() ? decimal(x) : decimal(x) + " " + unit;
}

std::string ValueSpan::text(double u) const { return with_unit(span.at(u), dimension); }

double ValueSpan::where(double value) const { return span.where(value); }

double Span::where(double x) const { return logarithmic ? std::log(x / from) / std::log(to / from) : (x - from) / (to - from); }

Overrides Cases::overrides(std::size_t k) const {
  Overrides out;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (values[k][i]) out.emplace_back(names[i], *values[k][i]);
  return out;
}

std::optional<Quantity> Cases::quantity(std::size_t k, std::size_t i) const {
  if (!values[k][i]) return {};
  try {
    return read_quantity(*values[k][i]);
  } catch (const ExpressionError&) {
    return {};
  }
}

double Span::at(double u) const {
  if (u <= 0) return rounded(from);
  if (u >= 1) return rounded(to);
  return rounded(logarithmic ? from * power(to / from, u) : from * (1 - u) + to * u);
}

Stream::Stream(std::uint64_t seed, std::string_view name) {
  // A step of SplitMix64, so that neighbouring seeds give independent streams.
  std::uint64_t z = seed * 0x9e3779b97f4a7c15u + fingerprint(name);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  numbers_.seed(z ^ (z >> 31));
}

double Stream::uniform() { return static_cast<double>(numbers_() >> 11) * 0x1p-53; }

std::uint64_t Stream::below(std::uint64_t n) {
  // The numbers below 2^64 mod n would occur once too often.
  const std::uint64_t excess = (~n + 1) % n;
  for (;;)
    if (const std::uint64_t x = numbers_(); x >= excess) return x % n;
}

std::vector<double> Stream::strata(std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[below(k)]);
  std::vector<double> out;
  for (std::size_t k : order) out.push_back(std::min((static_cast<double>(k) + uniform()) / static_cast<double>(n), 1 - 0x1p-53));
  return out;
}

Cases read_cases(const Node& section, const char* table) {
  static const std::vector<std::string> kinds{"grid", "list", "random", "latin hypercube"};
  check_keys(section, table);
  const std::string kind = which_key(section, kinds, "which cases it has");
  const Node values = section.at(kind);
  if (kind == "grid") return grid(values);
  if (kind == "list") return list(values);
  return sampled(values, kind == "latin hypercube");
}

}  // namespace pintle
