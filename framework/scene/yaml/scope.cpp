#include "framework/scene/yaml/scope.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "framework/common/text.h"

namespace pintle {

namespace {

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool within_name(char c) { return begins_name(c) || (c >= '0' && c <= '9'); }

// The length of the number or name that begins here; otherwise 1.
std::size_t word_length(std::string_view rest) {
  if (begins_name(rest.front())) return static_cast<std::size_t>(std::ranges::find_if_not(rest, within_name) - rest.begin());
  double value = 0;
  const auto end = std::from_chars(rest.data(), rest.data() + rest.size(), value).ptr;
  const bool number = rest.front() == '.' || (rest.front() >= '0' && rest.front() <= '9');
  return number && end != rest.data() ? static_cast<std::size_t>(end - rest.data()) : 1;
}

// The longest name that the text begins with, where `goes_on` checks that the name is complete.
template <class Names, class GoesOn>
void take_longest(const Names& names, std::string_view rest, GoesOn goes_on, std::string_view& longest) {
  for (const auto& entry : names) {
    const std::string* name = nullptr;
    if constexpr (requires { entry.first; })
      name = &entry.first;
    else
      name = &entry;
    if (name->size() > longest.size() && rest.starts_with(*name) && goes_on(rest.substr(name->size())))
      longest = rest.substr(0, name->size());
  }
}

// The name of a part of an instance, known to the scope, that the text begins with; empty if there is none.
std::string_view part_ahead(std::string_view rest, const Source& source, int scope) {
  const auto dot = [](std::string_view after) { return after.starts_with('.'); };
  const auto space = [](std::string_view after) { return after.starts_with(' ') && after.find('.') != std::string_view::npos; };
  const auto end = [](std::string_view after) { return after.empty() || (!within_name(after.front()) && after.front() != '.'); };
  std::string_view longest;
  for (const Scope* s = source.scope(scope); s; s = source.scope(s->outer)) {
    if (!s->names) continue;
    take_longest(s->names->parts, rest, dot, longest);
    take_longest(s->ports, rest, dot, longest);
    take_longest(s->names->families, rest, space, longest);
    take_longest(s->names->numbers, rest, end, longest);
  }
  return longest;
}

}  // namespace

PartName part_name(std::string_view text) {
  const std::size_t dot = text.find('.');
  return {std::string(text.substr(0, dot)), dot == std::string_view::npos ? "" : std::string(text.substr(dot + 1))};
}

bool OwnNames::has(std::string_view part) const {
  if (parts.contains(part)) return true;
  for (std::size_t space = part.find(' '); space != std::string_view::npos; space = part.find(' ', space + 1))
    if (families.contains(part.substr(0, space))) return true;
  return false;
}

PartName resolved(const Source& source, int scope, PartName name) {
  for (const Scope* s = source.scope(scope); s; s = source.scope(s->outer)) {
    if (!s->names) continue;
    if (name.part == "ground") {
      if (name.point.empty() && s->placed) return {"ground", s->instance};
      if (s->names->ground.contains(name.point)) return {"ground", s->instance + " " + name.point};
      continue;
    }
    if (const auto port = s->ports.find(name.part); port != s->ports.end())
      return name.point.empty() ? port->second : PartName{port->second.part, name.point};
    if (s->names->has(name.part)) return {s->instance + " " + name.part, name.point};
  }
  return name;
}

SpelledOut spelled_out(const std::string& expression, const Source& source, int scope) {
  SpelledOut out;
  const Scope& own = *source.scope(scope);
  for (std::string_view rest = expression; !rest.empty();) {
    const bool begins = begins_name(rest.front());
    const std::string_view part = begins ? part_ahead(rest, source, scope) : std::string_view();
    const std::string_view word = part.empty() ? rest.substr(0, word_length(rest)) : part;
    rest.remove_prefix(word.size());
    if (!part.empty()) {
      const PartName named = resolved(source, scope, {std::string(part), ""});
      out.text += named.part + (named.point.empty() ? "" : "." + named.point);
      out.names_parts = true;
    } else if (begins && own.own.contains(std::string(word))) {
      out.text += exact_text(own.parameters.find(word)->second);
    } else {
      out.text += word;
    }
    if (begins && rest.starts_with('.')) {  // a point or column of that name follows, not a separate name
      const std::size_t end =
          std::min(rest.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_0123456789.", 1), rest.size());
      out.text += rest.substr(0, end);
      rest.remove_prefix(end);
    }
  }
  return out;
}

std::string numbered(const std::string& text, const Parameters& parameters) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('{', at), close = text.find('}', open);
    out += text.substr(at, open - at);
    if (open == std::string::npos) break;
    if (close == std::string::npos) throw ExpressionError("\"" + text + "\": a brace is not closed");
    const double value = read_quantity(text.substr(open + 1, close - open - 1), dimension::number, parameters);
    if (value != std::round(value) || std::abs(value) > 1e9)
      throw ExpressionError("\"" + text + "\": the value in { } is " + number_text(value) + "; it must be a whole number");
    out += std::to_string(static_cast<long>(value));
    at = close + 1;
  }
  return out;
}

}  // namespace pintle
