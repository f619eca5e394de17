#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/scene/yaml/yaml_node.h"
#include "framework/study/case.h"

namespace pintle {

/// A study file: a scene, settings common to its cases, and measures. What is varied, and why, is in a separate section with its own
/// reader, such as `sweep` (sweep.h) or `tradeoff` (tradeoff.h).
struct Study {
  std::string file;  ///< for messages
  std::string title;
  CaseSource scene;
  std::vector<Measure> measures;
};

/// The tree of a study file, and the study in its common keys (title, scene, set, analysis, measure).
struct StudyFile {
  Yaml tree;
  Source source;
  Study study;
  Node root() const { return Node(tree, source, {tree.line, {}}); }
};
/// @param instead  an example of the key that a command requires instead of measures; empty: it requires measures
/// @throws SceneError  naming file, line, key, value and remedy
StudyFile read_study(const std::filesystem::path&, const std::string& instead = {});

/// One entry, a list of entries, or named ones: f(entry, its name, empty if it has none). @param remedy  allowed forms
template <class F>
void each_entry(const Node& node, const char* remedy, F f) {
  if (node.is_scalar())
    f(node, "");
  else if (node.is_list())
    for (const Node& entry : node.list(1, remedy)) f(entry, "");
  else
    for (const Node& entry : node.entries(remedy)) {
      if (entry.name().find_first_not_of(' ') == std::string::npos) entry.fail("has an empty name; give it one");
      f(entry, entry.name());
    }
}

/// @throws SceneError  it measures nothing, which is allowed only in a study with a goal
void require_measures(const StudyFile&);
/// The message about such a name.
inline constexpr const char* taken_name = "is the name of another column of the study's table; choose another name";
/// @param columns  of the study's table, without their units
/// @throws SceneError  at this place of the study: a name equal to one of them would give a second column of that name
void require_other_name(const std::string& name, const std::vector<std::string>& columns, const std::string& file, const Place&);
void require_other_names(const std::vector<Measure>&, const std::vector<std::string>& columns);
/// `keep`: quantities for which each case writes a curve. @throws SceneError  the scene has no such quantity
std::vector<Measure> read_curves(const StudyFile&);

}  // namespace pintle
