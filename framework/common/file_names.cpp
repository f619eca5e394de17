#include "framework/common/file_names.h"

#include <algorithm>

namespace pintle {

namespace {

constexpr std::size_t longest = 120;  // of the 255 that file systems allow, leaving room for numbers and endings

bool is_letter_or_digit(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); }

std::string stem_of(const std::string& name) {
  std::string stem;
  for (const char c : name.substr(0, longest))
    stem += is_letter_or_digit(c) || c == '-' || c == '_' || (c == '.' && !stem.empty()) ? c : '_';
  return stem;
}

std::string lower(std::string s) {
  for (char& c : s)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return s;
}

}  // namespace

std::string ending_of(const std::filesystem::path& file) { return lower(file.extension().string()); }

FileNames::FileNames(std::vector<std::string> taken) {
  for (std::string& name : taken) taken_.push_back(lower(std::move(name)));
}

std::string FileNames::add(const std::string& name, const std::string& otherwise) {
  const std::string stem = name.empty() ? otherwise : stem_of(name);
  std::string found = stem;
  const auto is_taken = [&] { return std::ranges::find(taken_, lower(found)) != taken_.end(); };
  for (int i = 2; is_taken(); ++i) found = stem + "_" + std::to_string(i);
  taken_.push_back(lower(found));
  return found;
}

}  // namespace pintle
