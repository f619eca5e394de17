#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/units/expression.h"

/// Origin of a value in the scene's tree: its file, and its instance of an assembly or copy of a repeated entry.
namespace pintle {

/// A body or joint, or a point or profile of a body, as named in a scene.
struct PartName {
  std::string part, point;  ///< point empty: the part itself
};
/// Splits "crank.A" at its dot.
PartName part_name(std::string_view text);

/// The names defined in an assembly.
struct OwnNames {
  std::set<std::string, std::less<>> parts, ground;  ///< entries of its sections; points and profiles of its ground
  std::set<std::string, std::less<>> families;       ///< prefixes of names: of instances and of repeated entries
  std::set<std::string, std::less<>> numbers;        ///< states and outputs: expressions name them without a point
  bool has(std::string_view part) const;
};

struct Scope {
  int outer = 0;                    ///< the enclosing scope; 0: the scene
  Parameters parameters = {};       ///< all visible parameters
  std::set<std::string> own = {};   ///< those that are not the scene's
  std::string instance = {};        ///< prefix of its parts' names; empty: of a copy of a repeated entry
  std::string said = {};            ///< for messages: ` (in the instance "left front", scene.yaml:31)`
  const OwnNames* names = nullptr;  ///< of an instance
  std::map<std::string, PartName> ports = {};
  bool placed = false;    ///< its `ground` has its own position
  bool mirrored = false;  ///< counter-clockwise in the assembly is clockwise here
};

/// Data shared by all values of one scene.
struct Source {
  std::string file;
  Parameters parameters;
  std::filesystem::path folder = {};  ///< folder of the files that the scene names
  struct Included {
    std::string file;              ///< for messages
    std::filesystem::path folder;  ///< from the scene's folder to the file's
  };
  std::deque<Included> included = {};  ///< numbered from 1 in Yaml::file
  std::deque<Scope> scopes = {};       ///< likewise in Yaml::scope
  std::deque<OwnNames> names = {};     ///< of assemblies

  std::string file_of(int i) const { return i == 0 ? "" : included[static_cast<std::size_t>(i - 1)].file; }  ///< empty: the scene
  std::vector<std::string>* doubts = nullptr;  ///< receives input that is valid but may not be intended

  const Scope* scope(int i) const { return i == 0 ? nullptr : &scopes[static_cast<std::size_t>(i - 1)]; }
  const Parameters& visible(int scope_) const { return scope_ == 0 ? parameters : scope(scope_)->parameters; }
};

/// The meaning of a name in a scope, as named in the whole scene: an assembly's ports and own parts come first, then those of the enclosing
/// scope.
PartName resolved(const Source&, int scope, PartName);

/// An expression as the whole scene would write it: with the values of the scope's own parameters instead of their names, and the full
/// names of its parts.
struct SpelledOut {
  std::string text;
  bool names_parts = false;
};
SpelledOut spelled_out(const std::string& expression, const Source&, int scope);

/// Evaluates parts in { } as whole numbers: "link {index + 1}.A" is "link 4.A".
/// @throws ExpressionError
std::string numbered(const std::string& text, const Parameters&);

}  // namespace pintle
