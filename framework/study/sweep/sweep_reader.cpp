#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "files/files.h"
#include "framework/common/fingerprint.h"
#include "framework/common/text.h"
#include "framework/scene/text_file.h"
#include "framework/scene/yaml/include.h"
#include "framework/study/sweep/sweep.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_bytes = std::size_t{100} << 20, most_file_bytes = std::size_t{1} << 30;

/// The contents of a file next to the scene, if the value names one: a table, drawing or mesh.
std::optional<std::string> file_named(const std::string& text, const fs::path& folder) {
  if (text.empty() || text.size() >= 256 || text.find('\n') != std::string::npos) return {};
  try {
    const fs::path path = contained_file(text, folder);
    std::error_code error;
    if (fs::is_regular_file(path, error)) return read_file(path, most_file_bytes);
  } catch (const FileRejected&) {  // reported where it is read
  }
  return {};
}

std::uint64_t print_of_files(const Yaml& tree, const fs::path& folder, std::uint64_t print) {
  if (tree.kind == Yaml::Kind::scalar)
    if (const std::optional<std::string> file = file_named(tree.text, folder)) print = fingerprint(*file, fingerprint(tree.text, print));
  for (const Yaml& item : tree.items) print = print_of_files(item, folder, print);
  return print;
}

/// Fingerprint of the files that a scene includes, and of those that they name.
std::uint64_t print_of_included(const CaseSource& scene, std::uint64_t print) {
  Source source{scene.file.string(), {}, scene.file.parent_path()};
  Yaml tree = parse_yaml(scene.text, source.file);
  include_files(tree, source);
  for (const Source::Included& file : source.included) {
    const std::string text = read_file(file.file, most_bytes);
    print = print_of_files(parse_yaml(text, file.file), source.folder / file.folder, fingerprint(text, print));
  }
  return print;
}

/// " mm" of "0.1 mm": the same for numbers in the same unit.
std::string behind_number(const std::string& text) {
  double number = 0;
  return std::from_chars(text.data(), text.data() + text.size(), number).ptr;
}

/// Distinguishes an error in the study from one in a case, by the reader's errors for some of the cases.
class CaseCheck {
 public:
  explicit CaseCheck(const Sweep& sweep) : sweep_(sweep) {}

  void validate() const {
    for (std::size_t i = 0; i < sweep_.cases.names.size(); ++i) validate_name(i), validate_units(i);
    validate_all();
  }

 private:
  static constexpr std::size_t most = 8;

  /// The reader's error for case k; empty if it can be read. Name i may be given another value.
  std::string refusal(std::size_t k, std::size_t i = 0, const std::string* value = nullptr) const {
    Overrides set = sweep_.cases.overrides(k);
    for (auto& [name, text] : set)
      if (value && name == sweep_.cases.names[i]) text = *value;
    try {
      case_scene(sweep_.study.scene, set);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  }

  /// The part of an error about the value of name i, or about what it sets; empty if it is about something else.
  std::string about(std::size_t i, const std::string& refusal) const {
    const std::string mark = ": --set ", &name = sweep_.cases.names[i];
    const auto at = refusal.find(mark);
    if (at == std::string::npos) return "";
    const std::string rest = refusal.substr(at + mark.size()), of_part = name.substr(0, rest.find(": "));
    if (of_part.size() < name.size() && name[of_part.size()] == '.' && rest.starts_with(of_part + ": "))
      return rest.substr(of_part.size() + 2);
    if (!rest.starts_with(name)) return "";
    const std::string behind = rest.substr(name.size());
    if (behind.starts_with(": ")) return behind.substr(2);
    return behind.starts_with('.') || behind.starts_with('[') ? behind.substr(1) : "";
  }

  [[noreturn]] void fail(std::size_t i, const std::string& message) const {
    throw SceneError(sweep_.study.file, sweep_.cases.places[i], message);
  }

  /// Checks for a name whose values are all rejected because of the value: a typing error.
  void validate_name(std::size_t i) const {
    std::vector<std::size_t> with;
    for (std::size_t k = 0; k < sweep_.cases.size(); ++k)
      if (sweep_.cases.values[k][i]) with.push_back(k);
    const std::size_t n = std::min(most, with.size());
    std::string first;
    for (std::size_t k = 0; k < n; ++k) {
      const std::string said = about(i, refusal(with[k * with.size() / n]));
      if (said.empty()) return;
      if (first.empty()) first = said;
    }
    if (n > 0) fail(i, first);
  }

  /// Checks for values without a unit besides values in units of another kind.
  void validate_units(std::size_t i) const {
    std::map<std::string, std::size_t> kinds;  // with the first case that has it
    std::set<std::string, std::less<>> seen;
    for (std::size_t k = 0; k < sweep_.cases.size(); ++k) {
      if (!sweep_.cases.values[k][i] || !seen.insert(behind_number(*sweep_.cases.values[k][i])).second) continue;
      if (const std::optional<Quantity> q = sweep_.cases.quantity(k, i)) kinds.emplace(si_unit(q->dimension), k);
    }
    if (kinds.size() < 2) return;
    for (const auto& [unit, k] : kinds) {
      const std::string said = unit.empty() ? "" : about(i, refusal(k));
      std::string number;
      append_number(number, sweep_.cases.quantity(k, i)->value);
      if (!said.empty() && about(i, refusal(k, i, &number)).empty()) fail(i, said);
    }
  }

  /// If the scene cannot be read in any of the tested cases, the error is in the study.
  void validate_all() const {
    const std::size_t n = std::min(most, sweep_.cases.size());
    std::string first;
    for (std::size_t k = 0; k < n; ++k) {
      const std::string said = refusal(k * sweep_.cases.size() / n);
      if (said.empty()) return;
      if (first.empty()) first = said;
    }
    throw SceneError(first);
  }

  const Sweep& sweep_;
};

}  // namespace

Sweep cases_of(const StudyFile& file, Cases cases, const fs::path& path, const Overrides& set, const Overrides& common) {
  Sweep out;
  out.cases = std::move(cases);
  out.study = file.study;
  Overrides& all = out.study.scene.common;
  all.insert(all.end(), set.begin(), set.end());
  all.insert(all.end(), common.begin(), common.end());
  out.text = read_text_file(path, most_bytes);
  const CaseSource& scene = out.study.scene;
  out.print = fingerprint(scene.text, fingerprint(out.text, fingerprint(PINTLE_VERSION)));
  for (const auto& [name, value] : set) out.print = fingerprint(value, fingerprint(name + "=", out.print));
  const fs::path folder = scene.file.parent_path();
  out.print = print_of_files(parse_yaml(scene.text, scene.file.string()), folder, out.print);
  out.print = print_of_included(scene, out.print);
  out.print = print_of_files(file.tree, folder, out.print);
  for (const auto& [name, value] : set) out.print = print_of_files({Yaml::Kind::scalar, 0, {}, value, {}}, folder, out.print);
  CaseCheck(out).validate();
  return out;
}

void validate_measures(const Sweep& sweep, std::vector<std::string> columns) {
  for (std::size_t i = 0; i < sweep.cases.names.size(); ++i)
    require_other_name(sweep.cases.names[i], columns, sweep.study.file, sweep.cases.places[i]);
  const std::vector<Situation>& situations = sweep.study.scene.situations;
  for (std::size_t i = 0; i < sweep.cases.names.size(); ++i) {
    const auto sets = [&](const Situation& s) {
      return std::ranges::find(s.set, sweep.cases.names[i], &Overrides::value_type::first) != s.set.end();
    };
    if (!situations.empty() && std::ranges::all_of(situations, sets))
      throw SceneError(sweep.study.file, sweep.cases.places[i],
                       "is also set by every situation, which comes after it, so that varying it would have no effect; remove one of them");
  }
  columns.insert(columns.end(), sweep.cases.names.begin(), sweep.cases.names.end());
  require_other_names(sweep.study.measures, columns);
  const Scene all_have = common_scene(sweep.study.scene);
  validate(sweep.study.measures, all_have);
  validate_flexible(sweep.study.measures, all_have, sweep.cases.names);
}

Overrides step_limit(const Node& section) {
  if (!section.has("most steps")) return {};
  return {{"run.max steps", std::to_string(section.at("most steps").count(1))}};
}

Sweep read_sweep(const fs::path& path, const Overrides& set) {
  const StudyFile file = read_study(path);
  const Node root = file.root();
  if (!root.has("sweep")) root.fail("has no sweep; add for example sweep: {grid: {clearance: [0.01 mm, 0.1 mm]}}");
  require_measures(file);
  const Node section = root.at("sweep");
  Sweep out = cases_of(file, read_cases(section), path, set, step_limit(section));
  if (section.has("limit")) out.limits.seconds = section.at("limit").quantity(dimension::time, rule::positive);
  out.keep = read_curves(file);
  validate_measures(out);
  return out;
}

}  // namespace pintle
