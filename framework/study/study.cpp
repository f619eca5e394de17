#include "framework/study/study.h"

#include "framework/scene/keys.h"
#include "framework/scene/override.h"
#include "framework/scene/text_file.h"

namespace pintle {

namespace {

Overrides read_set(const Node& node) {
  Overrides out;
  for (const Node& entry : node.entries("overrides of the scene: {run.until: 0.05 s, clearance: 0.1 mm}"))
    out.emplace_back(entry.name(), override_text(entry.yaml()));
  return out;
}

std::vector<Measure> read_measures(const Node& node, const std::string& file) {
  constexpr const char* remedy = "names and what they are: {peak: peak force at crank pin, lost: energy lost}";
  std::vector<Measure> out;
  const auto add = [&](const Node& entry, const std::string& name) {
    const std::string words = entry.text("words such as peak force at crank pin");
    out.push_back({name.empty() ? words : name, words, entry.place(), file});
  };
  if (node.is_scalar())
    add(node, "");
  else if (node.is_list())
    for (const Node& entry : node.list(1, remedy)) add(entry, "");
  else
    for (const Node& entry : node.entries(remedy)) add(entry, entry.name());
  if (out.empty()) node.fail(std::string("measures nothing; write ") + remedy);
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (out[i].name == out[k].name) node.fail("measures \"" + out[i].name + "\" twice; leave one out");
  return out;
}

}  // namespace

StudyFile read_study(const std::filesystem::path& path) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  StudyFile file;
  file.source.file = file.study.file = path.string();
  file.tree = parse_yaml(read_text_file(path, most_bytes), path.string());
  const Node root = file.root();
  check_keys(root, "study");
  if (root.has("title")) file.study.title = root.at("title").text("a line of text");
  const Node scene = root.at("scene");
  const std::filesystem::path scene_path = path.parent_path() / scene.text("the scene's file, beside the study");
  if (!std::filesystem::exists(scene_path)) scene.fail("there is no file " + scene_path.string() + "; it is sought beside the study");
  file.study.scene = read_case_source(scene_path, root.has("set") ? read_set(root.at("set")) : Overrides{});
  file.study.measures = read_measures(root.at("measure"), path.string());
  const Scene common = common_scene(file.study.scene);
  require_run(common);
  judge(file.study.measures, common);
  return file;
}

}  // namespace pintle
