#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/scene/yaml/yaml_node.h"
#include "framework/study/case.h"

namespace pintle {

/// A study file: a scene, what is common to its cases, what is measured. What is varied and why stands in a section of
/// its own, `sweep` (sweep.h) or `tradeoff` (tradeoff.h), read by its own reader.
struct Study {
  std::string file;  ///< for messages
  std::string title;
  CaseSource scene;
  std::vector<Measure> measures;
};

/// The tree of a study file, and the study that stands in its common keys (title, scene, set, analysis, measure).
struct StudyFile {
  Yaml tree;
  Source source;
  Study study;
  Node root() const { return Node(tree, source, {tree.line, {}}); }
};
/// @param instead  an example of the key that a command asks for instead of measures; empty: it asks for these
/// @throws SceneError  naming file, line, key, value and remedy
StudyFile read_study(const std::filesystem::path&, const std::string& instead = {});

/// One entry, a list of them, or named ones: f(entry, its name, which is empty where it has none). @param remedy  what they may be
template <class F>
void each_entry(const Node& node, const char* remedy, F f) {
  if (node.is_scalar())
    f(node, "");
  else if (node.is_list())
    for (const Node& entry : node.list(1, remedy)) f(entry, "");
  else
    for (const Node& entry : node.entries(remedy)) f(entry, entry.name());
}

/// @throws SceneError  it measures nothing, which only a study with a goal may do
void require_measures(const StudyFile&);
/// `keep`: quantities of which each case leaves a curve. @throws SceneError  the scene has not such a thing
std::vector<Measure> read_curves(const StudyFile&);

}  // namespace pintle
