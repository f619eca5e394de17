#include <algorithm>
#include <exception>
#include <fstream>

#include "framework/scene/text_file.h"
#include "framework/study/fingerprint.h"
#include "framework/study/sweep.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_bytes = std::size_t{100} << 20;

/// Chains the contents of every file beside the scene that a value names: tables, drawings, meshes.
std::uint64_t print_of_files(const Yaml& tree, const fs::path& folder, std::uint64_t print) {
  std::error_code error;
  if (tree.kind == Yaml::Kind::scalar && !tree.text.empty() && tree.text.size() < 256 && tree.text.find('\n') == std::string::npos &&
      fs::is_regular_file(folder / tree.text, error)) {
    std::ifstream in(folder / tree.text, std::ios::binary);
    print = fingerprint(tree.text, print);
    for (std::string part(1 << 16, '\0'); in.good();) {
      in.read(part.data(), static_cast<std::streamsize>(part.size()));
      print = fingerprint(std::string_view(part.data(), static_cast<std::size_t>(in.gcount())), print);
    }
  }
  for (const Yaml& item : tree.items) print = print_of_files(item, folder, print);
  return print;
}

/// Some cases, spread over the sweep: if the scene cannot be read in any of them, it is the study that is wrong.
void try_reading(const Sweep& sweep) {
  constexpr std::size_t most = 8;
  const std::size_t n = std::min(most, sweep.cases.size());
  std::exception_ptr first;
  for (std::size_t k = 0; k < n; ++k) {
    Overrides all = sweep.study.scene.common;
    for (auto& one : sweep.cases.overrides(k * sweep.cases.size() / n)) all.push_back(std::move(one));
    try {
      const Scene scene = read_scene_text(sweep.study.scene.text, sweep.study.scene.file.string(), all, sweep.study.scene.file.parent_path());
      require_run(scene);
      return;
    } catch (const SceneError&) {
      if (!first) first = std::current_exception();
    }
  }
  std::rethrow_exception(first);
}

}  // namespace

Sweep read_sweep(const fs::path& path, const Overrides& set) {
  StudyFile file = read_study(path);
  const Node root = file.root();
  if (!root.has("sweep")) root.fail("has no sweep; add for example sweep: {grid: {clearance: [0.01 mm, 0.1 mm]}}");
  const Node section = root.at("sweep");
  Sweep out;
  out.cases = read_cases(section);
  out.study = file.study;
  Overrides& common = out.study.scene.common;
  common.insert(common.end(), set.begin(), set.end());
  if (section.has("limit")) out.limits.seconds = section.at("limit").quantity(dimension::time, rule::positive);
  if (section.has("most steps")) common.emplace_back("run.max steps", std::to_string(section.at("most steps").count(1)));

  out.text = read_text_file(path, most_bytes);
  const CaseSource& scene = out.study.scene;
  out.print = fingerprint(scene.text, fingerprint(out.text, fingerprint(PINTLE_VERSION)));
  for (const auto& [name, value] : set) out.print = fingerprint(value, fingerprint(name + "=", out.print));
  const fs::path folder = scene.file.parent_path();
  out.print = print_of_files(parse_yaml(scene.text, scene.file.string()), folder, out.print);
  out.print = print_of_files(file.tree, folder, out.print);
  for (const auto& [name, value] : set) out.print = print_of_files({Yaml::Kind::scalar, 0, {}, value, {}}, folder, out.print);
  try_reading(out);
  return out;
}

}  // namespace pintle
