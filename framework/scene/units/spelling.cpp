#include "framework/scene/units/spelling.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "framework/common/nearest.h"
#include "framework/scene/units/unit.h"

namespace pintle {

namespace {

using Kind = Word::Kind;
constexpr std::size_t longest_text = 2000;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// The text in ASCII, and for each of its characters the position in the original text, from 1.
struct Plain {
  std::string text;
  std::vector<std::size_t> at;
};

// Common non-ASCII characters in engineering.
Plain plain(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 12> spellings{{{"µ", "u"},
                                                                                     {"μ", "u"},
                                                                                     {"Ω", "Ohm"},
                                                                                     {"\u2126", "Ohm"},
                                                                                     {"°", " deg"},
                                                                                     {"·", "*"},
                                                                                     {"×", "*"},
                                                                                     {"−", "-"},
                                                                                     {"²", "^2"},
                                                                                     {"³", "^3"},
                                                                                     {"π", "pi"},
                                                                                     {"\u00a0", " "}}};
  const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  Plain out;
  for (std::size_t place = 0; !text.empty();) {
    if (!goes_on(text.front())) ++place;
    std::string_view from = text.substr(0, 1), to = from;
    for (const auto& [written, ascii] : spellings)
      if (text.starts_with(written)) from = written, to = ascii;
    out.text += to;
    out.at.resize(out.text.size(), place);
    text.remove_prefix(from.size());
  }
  return out;
}

// A level of parentheses, or the whole expression.
struct Level {
  std::size_t opened = 0;  // where
  bool divided = false;    // its current product
};

class Speller {
 public:
  Speller(const Plain& plain, const Vocabulary& known) : at_(plain.at), rest_(plain.text), known_(known) {}

  std::vector<Word> words() {
    for (skip_space(); !rest_.empty(); skip_space()) {
      const char c = rest_.front();
      if (signal()) continue;
      if (is_digit(c) || (c == '.' && rest_.size() > 1 && is_digit(rest_[1])))
        number();
      else if (is_letter(c))
        name();
      else if (c == '(')
        open();
      else if (c == ')')
        close();
      else if (c == ',')
        comma();
      else
        sign();
    }
    if (levels_.size() > 1) throw ExpressionError("a parenthesis is not closed" + hint_, levels_.back().opened);
    return std::move(words_);
  }

 private:
  void skip_space() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\t' || rest_.front() == '\n' || rest_.front() == '\r'))
      rest_.remove_prefix(1);
  }
  void take(Kind kind, std::size_t length, double value = 0) {
    words_.push_back({kind, std::string(rest_.substr(0, length)), at(), value});
    rest_.remove_prefix(length);
  }
  std::size_t at() const { return rest_.empty() ? 0 : at_[at_.size() - rest_.size()]; }
  [[noreturn]] void fail(const std::string& what) const { throw ExpressionError(what, at()); }
  // The last word ends a value, so an operator must follow.
  bool after_value() const {
    if (words_.empty()) return false;
    const Kind k = words_.back().kind;
    return k == Kind::number || k == Kind::name || k == Kind::signal || k == Kind::close;
  }
  std::string between(std::string_view next) const {
    return "there is no operator between " + words_.back().text + " and " + std::string(next);
  }
  [[noreturn]] void side_by_side(std::string_view next) const {
    const std::string last = words_.back().text;
    fail(between(next) + ": write " + (last == ")" ? "" : last) + "*" + std::string(next));
  }

  void number();
  bool signal();
  void refuse_dotted() const;
  void name();
  void multiply_by_unit(std::string_view unit);
  void open() {
    if (after_value()) side_by_side("(");
    levels_.push_back({at(), false});
    take(Kind::open, 1);
  }
  void close() {
    if (levels_.size() == 1) fail("a parenthesis is closed but was not opened");
    levels_.pop_back();
    take(Kind::close, 1);
  }
  void comma() {
    if (levels_.size() == 1) fail("a comma is outside a function: the decimal point is \".\"");
    levels_.back().divided = false;
    take(Kind::comma, 1);
  }
  void sign();

  const std::vector<std::size_t>& at_;
  std::string_view rest_;
  const Vocabulary& known_;
  std::vector<Word> words_;
  std::vector<Level> levels_{Level{}};
  const std::string hint_ = "; inside { } or [ ] an expression with commas must be in quotes";
};

void Speller::number() {
  double value = 0;
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  const auto length = static_cast<std::size_t>(end - rest_.data());
  const bool reciprocal = length == 1 && value == 1 && rest_.size() > 2 && rest_[1] == '/' && is_letter(rest_[2]) && !words_.empty() &&
                          words_.back().kind == Kind::number && !levels_.back().divided;
  if (reciprocal)
    words_.push_back({Kind::sign, "*", at()});
  else if (after_value())
    side_by_side(rest_.substr(0, length));
  if (error != std::errc()) fail(std::string(rest_.substr(0, length)) + " is too large or too small for a number");
  take(Kind::number, length, value);
}

// "gudgeon pin.normal": names may contain blanks and signs, so the known names determine where one ends.
bool Speller::signal() {
  if (!known_.signals || known_.signals->empty()) return false;
  constexpr std::size_t longest_name = 170;
  for (std::size_t length = std::min(rest_.size(), longest_name); length > 0; --length) {
    const auto within = [&](std::size_t i) { return i < rest_.size() && (is_letter(rest_[i]) || is_digit(rest_[i])); };
    if ((within(length) && within(length - 1)) || !known_.signals->contains(rest_.substr(0, length))) continue;
    if (after_value()) side_by_side(rest_.substr(0, length));
    take(Kind::signal, length);
    return true;
  }
  return false;
}

/// The parts after the owner's dot, of names without a further dot.
std::vector<std::string> columns_of(const std::vector<std::string>& signals, const std::string& owner) {
  std::vector<std::string> out;
  for (const std::string& signal : signals)
    if (signal.starts_with(owner) && signal.find('.', owner.size()) == std::string::npos) out.push_back(signal.substr(owner.size()));
  return out;
}

/// Suggests a column of the owner instead of one that it lacks. If only joints with clearance have that column and this joint has no
/// clearance, the hint says so, since the clearance may have been deleted.
/// @param columns  columns that this expression may name   @param joint  the owner has an angle and a reaction
std::string hint_of(const std::string& owner, const std::string& column, const std::vector<std::string>& columns, bool joint) {
  static const std::vector<std::string> worn{"normal", "depth", "ex", "ey", "rate", "friction", "sliding"};
  const std::string name = "\"" + owner.substr(0, owner.size() - 1) + "\"", known = listed(columns, "and");
  if (joint && std::ranges::find(worn, column) != worn.end())
    return " " + name + " is an ideal joint and has " + known + "; only joints with clearance" +
           (column == "friction" || column == "sliding" ? " or friction" : "") + " have " + column +
           (column == "normal" ? ". The size of its force is sqrt(" + owner + "fx^2 + " + owner + "fy^2)" : "");
  const std::string near = nearest(column, columns);
  return near.empty() ? " " + name + " has " + known : " Did you mean \"" + owner + near + "\"?";
}

// A dotted name that looks like a signal but is unknown: owner, point, letter.
void Speller::refuse_dotted() const {
  const std::size_t end = std::min(rest_.find_first_of("+*/^()<>=&|!,"), rest_.find(" - "));
  std::string_view word = rest_.substr(0, end);
  while (word.ends_with(' ')) word.remove_suffix(1);
  const std::size_t dot = word.find('.');
  if (dot == std::string_view::npos || dot + 1 >= word.size() || !is_letter(word[dot + 1])) return;
  const std::string name(word);
  if (!known_.signals) fail("\"" + name + "\" changes with the motion, but this value cannot: write numbers, units and parameters");
  std::vector<std::string> names;
  for (const auto& [known, what] : *known_.signals)
    if (what.not_allowed.empty()) names.push_back(known);
  const std::string owner = name.substr(0, name.rfind('.') + 1);
  const std::vector<std::string> columns = columns_of(names, owner);
  const bool joint = known_.signals->contains(owner + "angle") && known_.signals->contains(owner + "fx");
  std::string hint = columns.empty() ? did_you_mean(name, names) : hint_of(owner, name.substr(owner.size()), columns, joint);
  constexpr std::size_t most = 300;
  if (columns.empty() && hint.size() > most)
    hint = " Signals are written owner.column, as trajectory.csv does: crank.angle, slider.P.vx, coil.length";
  fail("there is no signal \"" + name + "\"." + hint);
}

void Speller::name() {
  refuse_dotted();
  std::size_t length = 0;
  while (length < rest_.size() && (is_letter(rest_[length]) || is_digit(rest_[length]))) ++length;
  const std::string_view text = rest_.substr(0, length);
  std::size_t next = length;
  while (next < rest_.size() && rest_[next] == ' ') ++next;
  const bool calls = next < rest_.size() && rest_[next] == '(';
  if (after_value()) {
    const bool value = calls || text == known_.variable || text == "pi" || known_.parameters.contains(text);
    if (value) side_by_side(text);
    if (!known_.unit(text)) fail(between(text) + ", and " + no_unit(std::string(text)));
    multiply_by_unit(text);
  }
  take(calls ? Kind::function : Kind::name, length);
}

// A space before a unit multiplies, left to right. After a division this could be misread (N/m s, 10 deg/2 deg), so there only the plain
// fraction 1/2 mm is allowed.
void Speller::multiply_by_unit(std::string_view unit) {
  const std::size_t n = words_.size();
  const bool fraction = n >= 3 && words_[n - 1].kind == Kind::number && words_[n - 2].text == "/" && words_[n - 3].kind == Kind::number &&
                        (n == 3 || words_[n - 4].text != "/");
  if (levels_.back().divided && !fraction) {
    const std::string last = words_.back().text, u(unit);
    fail("\"" + last + " " + u + "\" after a \"/\" can be read two ways: write /(" + last + "*" + u + ") or *" + u);
  }
  levels_.back().divided = false;
  words_.push_back({Kind::sign, "*", at()});
}

void Speller::sign() {
  static constexpr std::array<std::string_view, 15> signs{"<=", ">=", "==", "!=", "&&", "||", "+", "-", "*", "/", "^", "<", ">", "**", "="};
  std::size_t length = 0;
  for (const std::string_view s : signs)
    if (rest_.starts_with(s) && s.size() > length) length = s.size();
  const std::string_view s = rest_.substr(0, length);
  if (s == "**") fail("a power is written ^");
  if (s == "=") fail("= is not an operator: write == to compare");
  if (length == 0) {
    const bool condition = rest_.front() == '?' || rest_.front() == ':';
    if (condition) fail("a choice is written if(condition, a, b)");
    fail("\"" + std::string(rest_.substr(0, rest_.front() < 0 ? 2 : 1)) +
         "\" has no meaning in an expression: it is made of numbers, units, "
         "parameters, t, functions and + - * / ^ ( )");
  }
  const bool prefix = !after_value();
  if (!prefix && s != "^") levels_.back().divided = s == "/";
  take(Kind::sign, length);
}

}  // namespace

const Unit* Vocabulary::unit(std::string_view name) const {
  const auto found = std::ranges::find(more_units, name, &Unit::name);
  return found != more_units.end() ? &*found : find_unit(name);
}

std::vector<Word> spell(std::string_view text, const Vocabulary& known) {
  if (text.size() > longest_text)
    throw ExpressionError("it is longer than " + std::to_string(longest_text) +
                          " characters: name parts of it in parameters, or use a table");
  const Plain ascii = plain(text);
  std::vector<Word> words = Speller(ascii, known).words();
  if (words.empty()) throw ExpressionError("it is empty: write a value");
  return words;
}

}  // namespace pintle
