#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

namespace {

// Builds the tree from yaml-cpp's events, so that keys keep their lines and no nodes are shared.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(std::string file) : file_(std::move(file)) {}
  Yaml root;

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
    fail(mark, "the anchor &" + name + " is not supported; define the value under parameters instead");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail(mark, "an alias is not supported; define the value under parameters instead");
  }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { place(mark, {.kind = Yaml::Kind::nothing}); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override {
    reject_tag(mark, tag);
    reject_control_characters(mark, value);
    if (!open_.empty() && open_.back().yaml.kind == Yaml::Kind::map && !open_.back().has_key)
      key(mark, value);
    else
      place(mark, {.kind = Yaml::Kind::scalar, .text = value});
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, YAML::EmitterStyle::value) override {
    begin(mark, tag, Yaml::Kind::list);
  }
  void OnSequenceEnd() override { end(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, YAML::EmitterStyle::value) override {
    begin(mark, tag, Yaml::Kind::map);
  }
  void OnMapEnd() override { end(); }

 private:
  struct Open {
    Yaml yaml;
    std::set<std::string> seen = {};  // keys so far
    std::string key = {};             // key waiting for its value
    int key_line = 0;
    bool has_key = false;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& message) const {
    throw SceneError(file_, {mark.line + 1, {}}, message);
  }
  void reject_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!") fail(mark, "the tag " + tag + " is not supported; leave it out");
  }
  /// No XML file can hold them, and a terminal obeys them.
  void reject_control_characters(const YAML::Mark& mark, const std::string& text) const {
    const auto bad = std::ranges::find_if(text, [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; });
    if (bad != text.end()) fail(mark, "a text contains the control character number " + std::to_string(int{*bad}) + "; leave it out");
  }
  void key(const YAML::Mark& mark, const std::string& text) {
    Open& map = open_.back();
    if (!map.seen.insert(text).second) fail(mark, "the key \"" + text + "\" is given here a second time; keep one");
    map.key = text;
    map.key_line = mark.line + 1;
    map.has_key = true;
  }
  void begin(const YAML::Mark& mark, const std::string& tag, Yaml::Kind kind) {
    reject_tag(mark, tag);
    need_plain_key(mark);
    open_.push_back({.yaml = {.kind = kind, .line = mark.line + 1}});
  }
  void end() {
    Yaml done = std::move(open_.back().yaml);
    open_.pop_back();
    attach(std::move(done));
  }
  void place(const YAML::Mark& mark, Yaml yaml) {
    need_plain_key(mark);
    yaml.line = mark.line + 1;
    attach(std::move(yaml));
  }
  void need_plain_key(const YAML::Mark& mark) const {
    if (!open_.empty() && open_.back().yaml.kind == Yaml::Kind::map && !open_.back().has_key)
      fail(mark, "a key must be a word, not empty and not a list or a group");
  }
  void attach(Yaml yaml) {
    if (++values_ > most_values) throw SceneError(file_, {yaml.line, {}}, "more than five million values; is it the right file?");
    if (open_.empty()) {
      root = std::move(yaml);
      return;
    }
    Open& parent = open_.back();
    if (parent.has_key) {
      yaml.key = std::move(parent.key);
      yaml.line = parent.key_line;
    }
    parent.yaml.items.push_back(std::move(yaml));
    parent.has_key = false;
  }

  static constexpr int most_values = 5'000'000;
  std::string file_;
  int values_ = 0;
  std::vector<Open> open_;
};

std::string remedy(const std::string& text) {
  if (text.find('\t') != std::string::npos) return "; indent with spaces, not tabs";
  return "; check indentation, colons, commas and brackets here and in the line above";
}

}  // namespace

Yaml parse_yaml(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  TreeBuilder builder(file);
  try {
    YAML::Parser parser(in);
    parser.HandleNextDocument(builder);
    if (TreeBuilder second(file); parser.HandleNextDocument(second))
      throw SceneError(file, {second.root.line, {}}, "a second document begins after \"---\"; a scene file contains only one");
  } catch (const YAML::Exception& error) {
    throw SceneError(file, {error.mark.line + 1, {}}, "this is not YAML: " + error.msg + remedy(text));
  }
  return std::move(builder.root);
}

}  // namespace pintle
