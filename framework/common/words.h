#pragma once

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

/// A text read word by word from its beginning, ignoring case.
namespace pintle {

using Names = std::vector<std::string>;

inline std::string lower(std::string s) {
  for (char& c : s) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

/// One space between words, none at the ends.
inline std::string even(const std::string& s) {
  std::string out;
  for (const char c : s) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (blank && (out.empty() || out.back() == ' ')) continue;
    out += blank ? ' ' : c;
  }
  if (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// Words taken from the front.
class Words {
 public:
  explicit Words(const std::string& s) : all_(even(s)), low_(lower(all_)) {}
  bool done() const { return at_ >= all_.size(); }
  std::string rest() const { return done() ? "" : all_.substr(at_); }

  bool take(std::string_view words) {
    if (low_.compare(at_, words.size(), words) != 0) return false;
    const std::size_t end = at_ + words.size();
    if (end < all_.size() && all_[end] != ' ') return false;
    at_ = std::min(all_.size(), end + 1);
    return true;
  }
  std::string take_any(std::initializer_list<const char*> several) {
    for (const char* words : several)
      if (take(words)) return words;
    return "";
  }
  /// The longest of the names at this place, in its own spelling or apart from case; an article before it is skipped.
  std::string take_name(const Names& names) {
    const std::size_t before = at_;
    for (const char* article : {"", "the", "a", "an"}) {
      at_ = before;
      if (article[0] && !take(article)) continue;
      std::string best;
      for (const bool exact : {true, false})
        for (const std::string& name : names)
          if (name.size() > best.size() && stands(name, exact)) best = name;
      if (!best.empty()) {
        at_ = std::min(all_.size(), at_ + best.size() + 1);
        return best;
      }
    }
    at_ = before;
    return "";
  }
  void skip_articles() {
    while (!take_any({"the", "an"}).empty()) {
    }
  }
  std::size_t place() const { return at_; }
  void back_to(std::size_t place) { at_ = place; }

 private:
  bool stands(const std::string& name, bool exact) const {
    const std::size_t end = at_ + name.size();
    if (end > all_.size() || (end < all_.size() && all_[end] != ' ')) return false;
    return exact ? all_.compare(at_, name.size(), name) == 0 : low_.compare(at_, name.size(), lower(name)) == 0;
  }
  std::string all_, low_;
  std::size_t at_ = 0;
};

}  // namespace pintle
