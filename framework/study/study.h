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
/// @throws SceneError  naming file, line, key, value and remedy
StudyFile read_study(const std::filesystem::path&);
/// @throws SceneError  it measures nothing, which only a study with a goal may do
void require_measures(const StudyFile&);
/// `keep`: quantities of which each case leaves a curve. @throws SceneError  the scene has not such a thing
std::vector<Measure> read_curves(const StudyFile&);

}  // namespace pintle
