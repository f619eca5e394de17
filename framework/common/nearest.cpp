#include "framework/common/nearest.h"

#include <algorithm>
#include <cctype>

namespace pintle {

namespace {
std::string lower(std::string_view s) {
  std::string out(s);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}
}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> candidates) {
  if (word.size() > 100) return {};
  const std::string small = lower(word);
  std::string best;
  std::size_t least = std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::string other = lower(candidate);
    const std::size_t distance = small == other ? 0 : edit_distance(small, other);
    const bool shares_something = distance < std::max(word.size(), candidate.size());
    if (distance < least && shares_something) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string listed(std::span<const std::string> words, std::string_view last) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 < words.size() || last == "," ? ", " : std::string(" ").append(last).append(" ");
    out += words[i];
  }
  return out;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> candidates) {
  const std::string best = nearest(word, candidates);
  if (!best.empty()) return " Did you mean \"" + best + "\"?";
  if (candidates.empty()) return " None is known here.";
  constexpr std::size_t most = 20;
  std::vector<std::string> shown;  // each once
  for (const std::string& one : candidates)
    if (shown.size() <= most && std::ranges::find(shown, one) == shown.end()) shown.push_back(one);
  const bool more = shown.size() > most;
  if (more) shown.pop_back();
  if (more) return " Known here: " + listed(shown, ",").append(" and others.");
  return " Known here: " + listed(shown) + ".";
}

}  // namespace pintle
