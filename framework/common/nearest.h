#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pintle {

/// Damerau–Levenshtein distance in its restricted form: insertions, deletions, substitutions and transpositions of neighbours, none of them
/// edited twice.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, or empty if none is near enough: within a third of the word's letters, at least one. Case is ignored.
std::string nearest(std::string_view word, std::span<const std::string> candidates);

/// "a, b or c"; with "," for the last word "a, b, c".
std::string listed(std::span<const std::string> words, std::string_view last = "or");

/// The same, each word in double quotes.
std::string listed_in_quotes(std::span<const std::string> words, std::string_view last = "and");

/// " Did you mean "x"?" or, without a near candidate, " Known here: a, b or c."
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace pintle
