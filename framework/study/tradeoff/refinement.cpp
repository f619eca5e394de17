#include "framework/study/tradeoff/refinement.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "framework/common/printed.h"
#include "framework/scene/yaml/override.h"

namespace pintle {

namespace {

constexpr std::array<std::string_view, 4> more_is_finer{"elements", "pieces", "count", "below"};
constexpr std::array<std::string_view, 4> less_is_finer{"size", "hole size", "tolerance", "max step"};
constexpr std::array<std::string_view, 6> words{"method", "constraints", "onset", "model", "theory", "element"};
/// For values that are words: those considered most accurate, in decreasing order of preference.
constexpr std::array<std::string_view, 6> faithful{"auto", "verner87", "dopri5", "projection", "contact", "timoshenko"};

template <class List>
bool in(const List& list, std::string_view word) {
  return std::ranges::find(list, word) != list.end();
}

std::string last_key(const std::string& path) {
  const auto dot = path.find_last_of('.');
  return dot == std::string::npos ? path : path.substr(dot + 1);
}

/// A count is doubled as a number, so that it remains a count; a quantity keeps its unit.
bool refine(Yaml& yaml, const std::string& key) {
  bool changed = false;
  for (Yaml& item : yaml.items) changed |= refine(item, yaml.kind == Yaml::Kind::map ? item.key : key);
  if (yaml.kind != Yaml::Kind::scalar) return changed;
  const bool more = in(more_is_finer, key);
  if (!more && !(in(less_is_finer, key) && key.ends_with("size"))) return false;
  long count = 0;
  const char* const end = yaml.text.data() + yaml.text.size();
  if (more && std::from_chars(yaml.text.data(), end, count).ptr == end)
    yaml.text = std::to_string(std::max(1L, 2 * count));
  else if (key == "elements" || key == "pieces" || key == "count")
    return false;  // a word or a parameter: its doubled value is unknown here
  else
    yaml.text = (more ? "2*(" : "0.5*(") + yaml.text + ")";
  return true;
}

bool begins_with_run(const std::pair<std::string, std::string>& set) { return set.first.starts_with("run."); }

std::optional<double> number_in(const std::string& text) {
  for (const Dimension& d : {dimension::number, dimension::length, dimension::time}) try {
      return read_quantity(text, d);
    } catch (const ExpressionError&) {
    }
  try {
    return read_frequency(text);
  } catch (const ExpressionError&) {
    return {};
  }
}

/// Sorts by the number that the axis sets, if every value sets the same quantity.
void sort_by_number(FidelityAxis& axis, bool descending) {
  std::vector<std::pair<double, AxisValue>> sorted;
  for (const AxisValue& v : axis.values) {
    const std::optional<double> x = number_in(v.set.front().second);
    if (!x) return;
    sorted.emplace_back(descending ? -*x : *x, v);
  }
  std::ranges::stable_sort(sorted, {}, &std::pair<double, AxisValue>::first);
  for (std::size_t i = 0; i < sorted.size(); ++i) axis.values[i] = sorted[i].second;
}

}  // namespace

void validate_axis(FidelityAxis& axis) {
  axis.numerical = true;
  axis.ordered = true;
  std::string key;
  bool one_key = true;
  for (const AxisValue& v : axis.values) {
    if (!std::ranges::all_of(v.set, begins_with_run)) axis.numerical = false;
    one_key = one_key && v.set.size() == 1 && (key.empty() || key == v.set.front().first);
    if (!v.set.empty()) key = v.set.front().first;
    for (const auto& [path, text] : v.set) axis.ordered = axis.ordered && !in(words, last_key(path));
  }
  if (one_key && in(more_is_finer, last_key(key))) sort_by_number(axis, false);
  if (one_key && in(less_is_finer, last_key(key))) sort_by_number(axis, true);
  axis.finest = axis.values.size() - 1;
  for (std::size_t rank = faithful.size(); rank-- > 0;)
    for (std::size_t i = 0; i < axis.values.size() && !axis.ordered; ++i)
      for (const auto& [path, text] : axis.values[i].set)
        if (in(words, last_key(path)) && text == faithful[rank]) axis.finest = i;
}

std::optional<std::string> refined(const std::string& path, const std::string& text) {
  Yaml yaml = parse_yaml(text, "--set " + path);
  if (!refine(yaml, last_key(path))) return {};
  return override_text(yaml);
}

std::optional<Overrides> refined(const Overrides& set) {
  Overrides out = set;
  bool any = false;
  for (auto& [path, text] : out)
    if (!path.starts_with("run."))
      if (const auto finer = refined(path, text)) text = *finer, any = true;
  if (!any) return {};
  return out;
}

Overrides finest(const TradePlan& plan, bool model_only) {
  Overrides out;
  for (const FidelityAxis& axis : plan.axes)
    for (const auto& set : axis.values[axis.finest].set)
      if (!model_only || !begins_with_run(set)) out.push_back(set);
  return out;
}

Overrides setting(const TradePlan& plan, const std::vector<std::size_t>& at) {
  Overrides out;
  for (std::size_t i = 0; i < at.size(); ++i)
    out.insert(out.end(), plan.axes[i].values[at[i]].set.begin(), plan.axes[i].values[at[i]].set.end());
  return out;
}

double tolerance_of(const TradePlan& plan, const Overrides& set) {
  double tolerance = plan.tolerance;
  for (const auto& [path, text] : set)
    if (path == "run.tolerance")
      if (const auto x = number_in(text)) tolerance = *x;
  return tolerance;
}

Overrides with_tolerance(Overrides set, double tolerance) {
  std::erase_if(set, [](const auto& s) { return s.first == "run.tolerance"; });
  set.emplace_back("run.tolerance", printed("%.17g", tolerance));
  return set;
}

Overrides member(const TradePlan& plan, const Overrides& set, int k) {
  if (k == 0) return set;
  return with_tolerance(set, tolerance_of(plan, set) * (k % 2 == 0 ? 1 + 0.01 * k : 1 / (1 + 0.01 * (k + 1))));
}

}  // namespace pintle
