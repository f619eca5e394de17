#include <yaml.h>

#include <algorithm>
#include <new>
#include <set>

#include "framework/scene/yaml/yaml_node.h"

namespace pintle {

namespace {

int line_of(const yaml_mark_t& mark) { return static_cast<int>(mark.line) + 1; }

std::string remedy(const std::string& text) {
  if (text.find('\t') != std::string::npos) return "; indent with spaces, not tabs";
  return "; check indentation, colons, commas and brackets here and in the line above";
}

/// The events of libyaml's parser, one at a time.
class YamlEvents {
 public:
  YamlEvents(const std::string& text, const std::string& file) : text_(text), file_(file) {
    if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  }
  ~YamlEvents() {
    yaml_event_delete(&event_);
    yaml_parser_delete(&parser_);
  }
  YamlEvents(const YamlEvents&) = delete;
  YamlEvents& operator=(const YamlEvents&) = delete;

  /// @returns the next event, valid until the next call
  /// @throws SceneError  the text is not YAML
  const yaml_event_t& next() {
    yaml_event_delete(&event_);
    if (yaml_parser_parse(&parser_, &event_) == 0) fail();
    return event_;
  }

 private:
  [[noreturn]] void fail() const {
    if (parser_.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
    if (parser_.error == YAML_READER_ERROR) fail_to_read();
    const bool has_context = parser_.context != nullptr;
    const int line = std::min(line_of(has_context && is_about_key() ? parser_.context_mark : parser_.problem_mark), last_line());
    std::string what = parser_.problem;
    if (has_context) what += " " + std::string(parser_.context) + " that begins in line " + std::to_string(line_of(parser_.context_mark));
    throw SceneError(file_, {line, {}}, "this is not YAML: " + what + remedy(text_));
  }
  /// Such an error is noticed in the next line.
  bool is_about_key() const { return std::string_view(parser_.context) == "while scanning a simple key"; }
  /// An error at the end of the text is marked one line later.
  int last_line() const { return static_cast<int>(std::ranges::count(text_, '\n')) + (text_.ends_with('\n') ? 0 : 1); }
  /// Of single characters; libyaml knows only the offset in bytes.
  [[noreturn]] void fail_to_read() const {
    const std::string_view before = std::string_view(text_).substr(0, parser_.problem_offset);
    const int line = 1 + static_cast<int>(std::ranges::count(before, '\n'));
    const bool control = std::string_view(parser_.problem).starts_with("control");
    throw SceneError(file_, {line, {}},
                     control ? "the text contains the control character number " + std::to_string(parser_.problem_value) + "; leave it out"
                             : "this is not text in UTF-8: " + std::string(parser_.problem) + "; save the file in UTF-8");
  }

  const std::string& text_;
  const std::string& file_;
  yaml_parser_t parser_;
  yaml_event_t event_{};
};

// Builds the tree from events, so that keys keep their lines and no nodes are shared.
class TreeBuilder {
 public:
  explicit TreeBuilder(const std::string& file) : file_(file) {}
  Yaml root;

  void add(const yaml_event_t& event) {
    const yaml_mark_t& mark = event.start_mark;
    switch (event.type) {
      case YAML_ALIAS_EVENT: fail(mark, "an alias is not supported; define the value under parameters instead");
      case YAML_SCALAR_EVENT: scalar(mark, event.data.scalar); break;
      case YAML_SEQUENCE_START_EVENT: begin(mark, event.data.sequence_start, Yaml::Kind::list); break;
      case YAML_MAPPING_START_EVENT: begin(mark, event.data.mapping_start, Yaml::Kind::map); break;
      case YAML_SEQUENCE_END_EVENT:
      case YAML_MAPPING_END_EVENT: end(); break;
      case YAML_DOCUMENT_START_EVENT:
        if (++documents_ > 1) fail(mark, "a second document begins after \"---\"; a scene file contains only one");
        break;
      case YAML_DOCUMENT_END_EVENT:
      case YAML_STREAM_START_EVENT:
      case YAML_STREAM_END_EVENT:
      case YAML_NO_EVENT: break;
    }
  }

 private:
  struct Open {
    Yaml yaml;
    std::set<std::string> seen = {};  // keys so far
    std::string key = {};             // key waiting for its value
    int key_line = 0;
    bool has_key = false;
  };

  [[noreturn]] void fail(const yaml_mark_t& mark, const std::string& message) const {
    throw SceneError(file_, {line_of(mark), {}}, message);
  }
  template <class Event>
  void reject_anchor_and_tag(const yaml_mark_t& mark, const Event& event) const {
    const auto text = [](const yaml_char_t* chars) { return std::string(reinterpret_cast<const char*>(chars)); };
    if (event.anchor != nullptr)
      fail(mark, "the anchor &" + text(event.anchor) + " is not supported; define the value under parameters instead");
    if (event.tag != nullptr && text(event.tag) != "!") fail(mark, "the tag " + text(event.tag) + " is not supported; leave it out");
  }
  /// No XML file can hold them, and a terminal obeys them.
  void reject_control_characters(const yaml_mark_t& mark, const std::string& text) const {
    const auto bad = std::ranges::find_if(text, [](unsigned char c) { return c < 0x20 && c != '\t' && c != '\n' && c != '\r'; });
    if (bad != text.end()) fail(mark, "the text contains the control character number " + std::to_string(int{*bad}) + "; leave it out");
  }
  static bool is_null(std::string_view plain) {
    return plain.empty() || plain == "~" || plain == "null" || plain == "Null" || plain == "NULL";
  }

  template <class Scalar>
  void scalar(const yaml_mark_t& mark, const Scalar& event) {
    reject_anchor_and_tag(mark, event);
    std::string text(reinterpret_cast<const char*>(event.value), event.length);
    reject_control_characters(mark, text);
    if (event.style == YAML_PLAIN_SCALAR_STYLE && event.tag == nullptr && is_null(text))
      place(mark, {.kind = Yaml::Kind::nothing});
    else if (awaits_key())
      key(mark, std::move(text));
    else
      place(mark, {.kind = Yaml::Kind::scalar, .text = std::move(text)});
  }
  void key(const yaml_mark_t& mark, std::string text) {
    Open& map = open_.back();
    if (!map.seen.insert(text).second) fail(mark, "the key \"" + text + "\" is given here a second time; keep one");
    map.key = std::move(text);
    map.key_line = line_of(mark);
    map.has_key = true;
  }
  template <class Start>
  void begin(const yaml_mark_t& mark, const Start& event, Yaml::Kind kind) {
    reject_anchor_and_tag(mark, event);
    need_plain_key(mark);
    if (open_.size() == deepest) fail(mark, "more than " + std::to_string(deepest) + " lists and groups inside one another");
    open_.push_back({.yaml = {.kind = kind, .line = line_of(mark)}});
  }
  void end() {
    Yaml done = std::move(open_.back().yaml);
    open_.pop_back();
    attach(std::move(done));
  }
  void place(const yaml_mark_t& mark, Yaml yaml) {
    need_plain_key(mark);
    yaml.line = line_of(mark);
    attach(std::move(yaml));
  }
  bool awaits_key() const { return !open_.empty() && open_.back().yaml.kind == Yaml::Kind::map && !open_.back().has_key; }
  void need_plain_key(const yaml_mark_t& mark) const {
    if (awaits_key()) fail(mark, "a key must be a word, not empty and not a list or a group");
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
  static constexpr std::size_t deepest = 500;
  const std::string& file_;
  int values_ = 0, documents_ = 0;
  std::vector<Open> open_;
};

}  // namespace

Yaml parse_yaml(const std::string& text, const std::string& file) {
  YamlEvents events(text, file);
  TreeBuilder builder(file);
  for (bool more = true; more;) {
    const yaml_event_t& event = events.next();
    builder.add(event);
    more = event.type != YAML_STREAM_END_EVENT;
  }
  return std::move(builder.root);
}

}  // namespace pintle
