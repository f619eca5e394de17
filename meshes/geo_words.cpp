#include "meshes/geo_words.h"

#include <algorithm>
#include <string_view>

#include "files/files.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

/// Text between two marks; empty if they are missing.
std::string between(const std::string& words, const std::string& before, const std::string& after) {
  const std::size_t begin = words.find(before);
  if (begin == std::string::npos) return "";
  const std::size_t from = begin + before.size(), to = words.find(after, from);
  return to == std::string::npos ? "" : words.substr(from, to - from);
}

struct Line {
  long number = 0;  ///< 0: none
  std::string_view text;
};
/// The first line that contains part of it.
Line line_with(std::string_view text, std::string_view part) {
  const std::size_t at = part.empty() ? text.npos : text.find(part);
  if (at == text.npos) return {};
  const std::size_t begin = text.rfind('\n', at) + 1;
  return {1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'),
          text.substr(begin, text.find('\n', at) - begin)};
}

/// Why a file named by the script could not be opened.
std::string refusal_of(const std::string& opened, const fs::path& file, const Line& line, const fs::path& read_from) {
  std::error_code error;
  if (line.text.find('>') != line.text.npos || line.text.find("Save") != line.text.npos || line.text.find("Print") != line.text.npos)
    return "a drawing must not write files; remove that command, or allow it with --trust-geo if you trust the source of the drawing";
  if (!fs::exists(file.parent_path() / opened, error))
    return "there is no such file; check its path, which is relative to the folder of the drawing";
  try {
    contained_file(opened, file.parent_path(), read_from);
  } catch (const FileRejected& rejected) {
    return rejected.what();
  }
  return "it cannot be read; check its permissions";
}

}  // namespace

std::string with_line_of_script(const fs::path& file, const std::string& text, const std::string& words, const fs::path& read_from) {
  const std::string name = file.string(), head = name + ": ";
  if (!words.starts_with(head)) return words;
  std::string said = words.substr(head.size()), number = between(said, "'" + name + "', line ", ":");
  if (const std::string opened = between(said, "Unable to open file '", "'"); !opened.empty()) {
    Line line = line_with(text, "\"" + opened + "\"");
    if (line.number == 0) line = line_with(text, fs::path(opened).filename().string() + "\"");
    if (line.number > 0 && number.empty()) number = std::to_string(line.number);
    said = said.substr(0, said.rfind("; use another size")) + "; " + refusal_of(opened, file, line, read_from);
  } else if (said.find("SystemCall") != std::string::npos && number.empty()) {
    if (const Line line = line_with(text, "SystemCall"); line.number > 0) number = std::to_string(line.number);
  }
  return number.empty() ? words.substr(0, head.size()) + said : name + ":" + number + ": " + said;
}

}  // namespace pintle
