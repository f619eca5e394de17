#pragma once

#include <deque>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pintle {

/// Position of a line of an input file.
struct InpPlace {
  int file = 0;  ///< index into InpText::files
  int line = 0;  ///< from 1
};

/// The lines of an input file and of its included files, without comments and blank lines.
struct InpText {
  struct Line {
    std::string_view text;
    InpPlace place;
  };
  std::vector<std::filesystem::path> files;
  std::deque<std::string> contents;  ///< storage for the lines
  std::vector<Line> lines;

  /// @throws std::invalid_argument  "file:line: " and the parts
  template <class... Parts>
  [[noreturn]] void reject(InpPlace at, const Parts&... parts) const {
    std::ostringstream text;
    (text << ... << parts);
    fail(at, text.str());
  }
  [[noreturn]] void fail(InpPlace at, const std::string& what) const;
};

/// @param folder  included files must be in it, below it, or in folders that the user trusts
/// @throws std::runtime_error     a file cannot be read
/// @throws std::invalid_argument  a file, or an included one, is not an input file; files include each other
InpText read_inp_text(const std::filesystem::path&, const std::filesystem::path& folder);

/// `*KEYWORD, NAME=value, FLAG`: in upper case except the values.
struct InpCard {
  std::string keyword;  ///< without the star, inner blanks reduced to one
  std::vector<std::pair<std::string, std::string>> parameters;
  InpPlace place;
  const std::string* find(std::string_view name) const;  ///< nullptr: not given
};
InpCard inp_card(std::string_view line, InpPlace);

std::string upper(std::string_view);
std::string_view trimmed(std::string_view);
/// Takes the next field off a data line; false when nothing is left. A comma at the end does not start a field.
bool next_field(std::string_view& rest, std::string_view& field);
bool to_number(std::string_view field, long& value);    ///< false: the field is not a whole number
bool to_number(std::string_view field, double& value);  ///< also reads Fortran's 1.5D+00

}  // namespace pintle
