#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/error.h"
#include "framework/scene/units/expression.h"
#include "framework/scene/yaml/scope.h"

/// A YAML file as a tree that stores the line of each key and value. Only yaml_tree.cpp includes libyaml.
namespace pintle {

struct Yaml {
  enum class Kind { nothing, scalar, list, map } kind = Kind::nothing;
  int line = 0;                  ///< from 1; of the key, if it has one
  std::string key = {};          ///< in a map, where it is unique
  std::string text = {};         ///< scalar
  std::vector<Yaml> items = {};  ///< of a list or map, in the order written
  int file = 0, scope = 0;       ///< its origin in Source::included and Source::scopes, from 1; 0: the scene
};

/// Anchors, aliases, tags, repeated keys and a second document are rejected: a scene is a tree without repetition.
/// @throws SceneError  with the line
Yaml parse_yaml(const std::string& text, const std::string& file);

/// A condition on a value, and its wording: "must be greater than 0".
struct Rule {
  bool (*holds)(double);
  const char* words;
};
namespace rule {
inline constexpr Rule any{[](double) { return true; }, ""};
inline constexpr Rule positive{[](double x) { return x > 0; }, "must be greater than 0"};
inline constexpr Rule not_negative{[](double x) { return x >= 0; }, "must not be negative"};
inline constexpr Rule zero_to_one{[](double x) { return x >= 0 && x <= 1; }, "must lie between 0 and 1"};
inline constexpr Rule at_least_one{[](double x) { return x >= 1; }, "must be at least 1"};
inline constexpr Rule solid_poisson{[](double x) { return x > -1 && x < 0.5; },
                                    "must be greater than -1 and less than 0.5; use 0.4999 for a nearly incompressible solid"};
inline constexpr Rule poisson{[](double x) { return x > -1 && x <= 0.5; }, "must lie between -1 and 0.5"};
/// Below 1e-14 the rounding of one step exceeds its allowed error.
inline constexpr Rule tolerance{[](double x) { return x >= 1e-14 && x < 1; },
                                "must lie between 0 and 1, and not below 1e-14, which is rounding"};
inline constexpr Rule inside_zero_one{[](double x) { return x > 0 && x < 1; }, "must lie between 0 and 1, both excluded"};
}  // namespace rule

inline constexpr const char* hint_about_commas = "Inside { } or [ ] a comma separates entries: put an expression with commas in quotes.";

/// A value with its place: knows the file, the key path and the line, for error messages. Cheap to copy; must not outlive tree and source.
class Node {
 public:
  Node(const Yaml& yaml, const Source& source, Place place, std::string_view name = {})
      : yaml_(&yaml), source_(&source), place_(std::move(place)), name_(name) {}

  [[noreturn]] void fail(const std::string& message) const;
  const Place& place() const { return place_; }
  const Source& source() const { return *source_; }
  const Parameters& parameters() const { return source_->visible(yaml_->scope); }  ///< available to expressions here
  std::string name() const { return std::string(name_); }                          ///< the last key

  const Yaml& yaml() const { return *yaml_; }  ///< the value here

  bool is_map() const { return yaml_->kind == Yaml::Kind::map; }
  bool is_list() const { return yaml_->kind == Yaml::Kind::list; }
  bool is_nothing() const { return yaml_->kind == Yaml::Kind::nothing; }
  bool is_scalar() const { return yaml_->kind == Yaml::Kind::scalar; }
  /// The text in the file, shortened for messages.
  std::string shown() const;

  /// @throws SceneError  not a map; `remedy` shows such a map
  std::vector<Node> entries(const std::string& remedy) const;
  /// @throws SceneError  not a list of n
  std::vector<Node> items(std::size_t n, const std::string& remedy) const;
  /// @throws SceneError  not a list with at least this many entries
  std::vector<Node> list(std::size_t least, const std::string& remedy) const;
  bool has(std::string_view key) const;
  Node at(std::string_view key) const;  ///< @pre has(key)
  std::vector<std::string> keys() const;

  std::string text(const std::string& remedy) const;
  double quantity(const Dimension&, Rule = rule::any) const;
  double frequency(Rule = rule::any) const;  ///< [Hz]
  Pair pair(const Dimension&) const;
  long count(long least) const;  ///< a whole number ≥ least
  bool yes() const;              ///< true or false
  bool is_mirrored() const;      ///< it is in a mirrored instance
  /// The body or joint, and point, named here, with the names of the whole scene.
  PartName part(const std::string& remedy) const;
  /// The file named here, relative to the scene's folder.
  std::string file(const std::string& remedy) const;
  std::string one_of(std::span<const std::string> choices) const;
  /// An expression as the whole scene would write it.
  std::string expression(const std::string& remedy) const;
  Law law(const Dimension&) const;  ///< an expression in t

 private:
  void doubt_radians(double value) const;
  Node child(const Yaml& entry) const;
  std::vector<Node> children() const;  // of a list
  const Yaml* yaml_;
  const Source* source_;
  Place place_;
  std::string_view name_;
};

}  // namespace pintle
