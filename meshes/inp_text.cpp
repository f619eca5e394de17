#include "meshes/inp_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "files/files.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_bytes = std::size_t{1} << 30;  // of all files together
constexpr std::size_t most_files = 1000;

/// Whether a line may be a card or data, by its first character.
bool may_begin(std::string_view line) { return line.find_first_of("*0123456789+-.") == 0; }

struct Reader {
  InpText& out;
  const fs::path& folder;
  std::vector<fs::path> open{};
  std::size_t bytes = 0;

  std::string content_of(const fs::path& path) {
    try {
      std::string text = read_file(path, most_bytes - bytes);
      bytes += text.size();
      return text;
    } catch (const FileRejected& e) {
      throw std::runtime_error(path.string() + ": " + e.what());
    }
  }

  void read(const fs::path& path) {
    const int file = static_cast<int>(out.files.size());
    out.files.push_back(path);
    out.contents.push_back(content_of(path));
    open.push_back(fs::weakly_canonical(path));
    const std::string_view all = out.contents.back();
    int number = 0;
    bool begun = false;
    for (std::size_t at = 0; at < all.size();) {
      const std::size_t end = std::min(all.find('\n', at), all.size());
      const std::string_view text = trimmed(all.substr(at, end - at));
      at = end + 1, ++number;
      if (text.empty() || text.starts_with("**")) continue;
      // The content of a file that is not an input file is not shown.
      if (!std::exchange(begun, true) && !may_begin(text))
        out.reject({file, number}, "is not an input file of CalculiX or Abaqus: it begins with neither a card (*NODE) nor numbers");
      if (text[0] == '*' && upper(text.substr(0, 8)) == "*INCLUDE")
        include(text, {file, number});
      else
        out.lines.push_back({text, {file, number}});
    }
    open.pop_back();
  }

  void include(std::string_view text, InpPlace place) {
    const InpCard card = inp_card(text, place);
    const std::string* input = card.find("INPUT");
    if (!input || input->empty()) out.reject(place, "*INCLUDE names no file; write *INCLUDE, INPUT=file");
    const fs::path beside = out.files[static_cast<std::size_t>(place.file)].parent_path();
    fs::path path;
    try {
      path = contained_file(*input, beside, folder);
    } catch (const FileRejected& e) {
      out.reject(place, "*INCLUDE of ", e.what());
    }
    if (std::find(open.begin(), open.end(), fs::weakly_canonical(path)) != open.end())
      out.reject(place, "*INCLUDE of ", *input, ", which includes this file itself; remove it");
    if (!fs::exists(path)) out.reject(place, "*INCLUDE of ", *input, ": there is no file ", path.string());
    if (out.files.size() >= most_files)
      out.reject(place, "*INCLUDE of ", *input, ": more than ", most_files, " files are included; put them together");
    read(path);
  }
};

}  // namespace

void InpText::fail(InpPlace at, const std::string& what) const {
  throw std::invalid_argument(files[static_cast<std::size_t>(at.file)].string() + ":" + std::to_string(at.line) + ": " + what);
}

InpText read_inp_text(const fs::path& path, const fs::path& folder) {
  InpText text;
  Reader{text, folder}.read(path);
  return text;
}

const std::string* InpCard::find(std::string_view name) const {
  for (const auto& [key, value] : parameters)
    if (key == name) return &value;
  return nullptr;
}

InpCard inp_card(std::string_view line, InpPlace place) {
  InpCard card{{}, {}, place};
  std::string_view rest = line.substr(1), field;
  while (next_field(rest, field)) {
    const std::size_t equals = field.find('=');
    std::string key = upper(trimmed(field.substr(0, equals)));
    key.erase(std::unique(key.begin(), key.end(), [](char a, char b) { return a == ' ' && b == ' '; }), key.end());
    if (card.keyword.empty()) {
      card.keyword = key;
      continue;
    }
    std::string_view value = equals == field.npos ? std::string_view{} : trimmed(field.substr(equals + 1));
    if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
    card.parameters.emplace_back(std::move(key), value);
  }
  return card;
}

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

bool next_field(std::string_view& rest, std::string_view& field) {
  if (trimmed(rest).empty()) return false;
  const std::size_t comma = rest.find(',');
  field = trimmed(rest.substr(0, comma));
  rest = comma == rest.npos ? std::string_view{} : rest.substr(comma + 1);
  return true;
}

bool to_number(std::string_view field, long& value) {
  if (field.starts_with('+')) field.remove_prefix(1);
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc{} && end == field.data() + field.size();
}

bool to_number(std::string_view field, double& value) {
  if (field.starts_with('+')) field.remove_prefix(1);
  std::array<char, 64> copy{};
  if (const std::size_t d = field.find_first_of("dD"); d != field.npos && field.size() < copy.size()) {
    std::copy(field.begin(), field.end(), copy.begin());
    copy[d] = 'e';
    field = {copy.data(), field.size()};
  }
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc{} && end == field.data() + field.size();
}

}  // namespace pintle
