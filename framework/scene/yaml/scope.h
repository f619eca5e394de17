#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/units/expression.h"

/// Where a value of the scene's tree comes from: which file, and which instance of an assembly or copy of a repeated entry.
namespace pintle {

/// A body or joint, and of a body a point or profile, as a scene names them.
struct PartName {
  std::string part, point;  ///< point empty: the part itself
};
/// "crank.A" at its dot.
PartName part_name(std::string_view text);

/// What an assembly has of its own.
struct OwnNames {
  std::set<std::string, std::less<>> parts, ground;  ///< entries of its sections; points and profiles of its ground
  std::set<std::string, std::less<>> families;       ///< names that others begin with: of instances and of repeated entries
  std::set<std::string, std::less<>> numbers;        ///< states and outputs: an expression names them without a point
  bool has(std::string_view part) const;
};

struct Scope {
  int outer = 0;                    ///< the scope around it; 0: the scene
  Parameters parameters = {};       ///< all that it sees
  std::set<std::string> own = {};   ///< those of them that are not the scene's
  std::string instance = {};        ///< its parts' names begin with this; empty: of a copy of a repeated entry
  std::string said = {};            ///< for messages: ` (in the instance "left front", scene.yaml:31)`
  const OwnNames* names = nullptr;  ///< of an instance
  std::map<std::string, PartName> ports = {};
  bool placed = false;    ///< its `ground` is a place of its own
  bool mirrored = false;  ///< what turns left in the assembly turns right here
};

/// What every value of one scene shares.
struct Source {
  std::string file;
  Parameters parameters;
  std::filesystem::path folder = {};  ///< where the files are that the scene names
  struct Included {
    std::string file;              ///< for messages
    std::filesystem::path folder;  ///< from the scene's folder to the file's
  };
  std::deque<Included> included = {};  ///< Yaml::file counts from 1
  std::deque<Scope> scopes = {};       ///< Yaml::scope likewise
  std::deque<OwnNames> names = {};     ///< of assemblies

  std::string file_of(int i) const { return i == 0 ? "" : included[static_cast<std::size_t>(i - 1)].file; }  ///< empty: the scene
  std::vector<std::string>* doubts = nullptr;  ///< gets what is readable but may not be meant

  const Scope* scope(int i) const { return i == 0 ? nullptr : &scopes[static_cast<std::size_t>(i - 1)]; }
  const Parameters& visible(int scope_) const { return scope_ == 0 ? parameters : scope(scope_)->parameters; }
};

/// What a name means that stands in a scope, as the whole scene calls it: an assembly's ports and own parts come first, then those of what holds it.
PartName resolved(const Source&, int scope, PartName);

/// An expression as the whole scene would write it: with the values of the scope's own parameters in the place of their names, and the
/// full names of its parts.
struct SpelledOut {
  std::string text;
  bool names_parts = false;
};
SpelledOut spelled_out(const std::string& expression, const Source&, int scope);

/// A text whose parts in { } are whole numbers: "link {index + 1}.A" is "link 4.A".
/// @throws ExpressionError
std::string numbered(const std::string& text, const Parameters&);

}  // namespace pintle
