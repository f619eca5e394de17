#include "framework/scene/yaml/yaml_node.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/common/nearest.h"
#include "framework/common/text.h"

namespace pintle {

void Node::fail(const std::string& message) const {
  const Scope* scope = source_->scope(yaml_->scope);
  throw SceneError(source_->file, place_, scope ? message + scope->said : message);
}

std::string Node::shown() const {
  constexpr std::size_t most = 40;
  if (is_map()) return "a group of keys";
  if (is_list()) return "a list of " + std::to_string(yaml_->items.size());
  if (!is_scalar()) return "nothing";
  if (place_.key.empty()) return "a plain text, not a mapping of keys";  // the user may have named any file, so its content is not shown
  const bool cut = yaml_->text.size() > most;
  return std::string("\"").append(yaml_->text, 0, most).append(cut ? "…\"" : "\"");
}

Node Node::child(const Yaml& entry) const {
  const std::string path = place_.key.empty() ? entry.key : place_.key + "." + entry.key;
  return {entry, *source_, {entry.line, path, source_->file_of(entry.file)}, entry.key};
}

std::vector<Node> Node::entries(const std::string& remedy) const {
  if (!is_map()) fail("is " + shown() + "; write " + remedy);
  std::vector<Node> out;
  out.reserve(yaml_->items.size());
  for (const Yaml& entry : yaml_->items) out.push_back(child(entry));
  return out;
}

std::vector<Node> Node::items(std::size_t n, const std::string& remedy) const {
  if (!is_list() || yaml_->items.size() != n) {
    const bool torn = std::ranges::any_of(
        yaml_->items, [](const Yaml& item) { return std::ranges::count(item.text, '(') != std::ranges::count(item.text, ')'); });
    fail("is " + shown() + "; write " + remedy + (torn ? std::string(". ") + hint_about_commas : ""));
  }
  return children();
}

std::vector<Node> Node::list(std::size_t least, const std::string& remedy) const {
  if (!is_list() || yaml_->items.size() < least) fail("is " + shown() + "; write " + remedy);
  return children();
}

std::vector<Node> Node::children() const {
  std::vector<Node> out;
  for (std::size_t i = 0; i < yaml_->items.size(); ++i)
    out.push_back({yaml_->items[i], *source_, {yaml_->items[i].line, place_.key + "[" + std::to_string(i + 1) + "]", place_.file}});
  return out;
}

bool Node::has(std::string_view key) const {
  return std::ranges::any_of(yaml_->items, [&](const Yaml& e) { return e.key == key; });
}

Node Node::at(std::string_view key) const {
  return child(*std::ranges::find_if(yaml_->items, [&](const Yaml& e) { return e.key == key; }));
}

std::vector<std::string> Node::keys() const {
  std::vector<std::string> out;
  for (const Yaml& e : yaml_->items) out.push_back(e.key);
  return out;
}

std::string Node::text(const std::string& remedy) const {
  if (!is_scalar() || yaml_->text.empty()) fail("is " + shown() + "; write " + remedy);
  return yaml_->text;
}

double Node::quantity(const Dimension& expected, Rule must) const {
  const std::string written = text(describe(expected));
  double value = 0;
  try {
    value = read_quantity(written, expected, parameters());
    if (expected.angle == 1 && same(expected, dimension::number)) doubt_radians(value);
  } catch (const ExpressionError& error) {
    fail(error.what());
  }
  if (!must.holds(value)) fail(shown() + " " + must.words);
  return value;
}

void Node::doubt_radians(double value) const {
  constexpr double turn = 2 * std::numbers::pi;
  constexpr std::size_t most = 20;
  if (!source_->doubts || source_->doubts->size() >= most || std::abs(value) <= turn ||
      !bare(read_quantity(yaml_->text, parameters()).dimension))
    return;
  source_->doubts->push_back(SceneError(source_->file, place_,
                                        shown() + " without a unit is in rad, " + number_text(value / turn, 3) +
                                            " turns; if degrees are meant, write \"" + yaml_->text + " deg\", else \"" + yaml_->text +
                                            " rad\"")
                                 .what());
}

double Node::frequency(Rule must) const {
  const std::string written = text("a frequency such as 5 kHz");
  double value = 0;
  try {
    value = read_frequency(written, parameters());
  } catch (const ExpressionError& error) {
    fail(error.what());
  }
  if (!must.holds(value)) fail(shown() + " " + must.words);
  return value;
}

Pair Node::pair(const Dimension& expected) const {
  const std::vector<Node> two = items(2, "two values [x, y], each " + describe(expected));
  return {two[0].quantity(expected), two[1].quantity(expected)};
}

long Node::count(long least) const {
  const double value = quantity(dimension::number);
  if (value != std::floor(value) || value < static_cast<double>(least) || value > 1e15)
    fail(shown() + " must be a whole number, at least " + std::to_string(least));
  return static_cast<long>(value);
}

bool Node::yes() const {
  const std::string written = text("true or false");
  if (written != "true" && written != "false") fail(shown() + " must be true or false");
  return written == "true";
}

std::string Node::one_of(std::span<const std::string> choices) const {
  std::string written = text(listed(choices));
  if (std::ranges::find(choices, written) == choices.end())
    fail(shown() + " must be " + listed(choices) + "." + (nearest(written, choices).empty() ? "" : did_you_mean(written, choices)));
  return written;
}

bool Node::is_mirrored() const {
  const Scope* scope = source_->scope(yaml_->scope);
  return scope && scope->mirrored;
}

PartName Node::part(const std::string& remedy) const {
  std::string name = text(remedy);
  try {
    if (name.find('{') != std::string::npos) name = numbered(name, parameters());
  } catch (const ExpressionError& error) {
    fail(error.what());
  }
  return resolved(*source_, yaml_->scope, part_name(name));
}

std::string Node::file(const std::string& remedy) const {
  const std::string name = text(remedy);
  return yaml_->file == 0 ? name : (source_->included[static_cast<std::size_t>(yaml_->file - 1)].folder / name).lexically_normal().string();
}

std::string Node::expression(const std::string& remedy) const {
  std::string written = text(remedy);
  try {
    if (written.find('{') != std::string::npos) written = numbered(written, parameters());
  } catch (const ExpressionError& error) {
    fail(error.what());
  }
  if (yaml_->scope == 0) return written;
  SpelledOut out = spelled_out(written, *source_, yaml_->scope);
  if (out.names_parts && is_mirrored())
    fail(shown() + " names quantities of the motion, which are not mirrored with their instance; write this into the scene for each side");
  return std::move(out.text);
}

Law Node::law(const Dimension& expected) const {
  try {
    return read_law(expression("an expression in t, " + describe(expected)), expected, source_->parameters);
  } catch (const ExpressionError& error) {
    fail(error.what());
  }
}

}  // namespace pintle
