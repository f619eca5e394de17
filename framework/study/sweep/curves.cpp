#include "framework/study/sweep/curves.h"

#include "files/files.h"
#include "framework/common/file.h"
#include "framework/common/file_names.h"
#include "framework/common/fingerprint.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

/// @throws SceneError  something else has its name
void require_place(const fs::path& path, fs::file_type type, const char* what) {
  std::error_code error;
  const fs::file_status there = fs::status(path, error);
  if (fs::exists(there) && there.type() != type)
    throw SceneError(path.string() + ": is not " + what + "; remove it, and start the same command again");
}

std::string name_begin(std::size_t number) { return "case-" + std::to_string(number); }

}  // namespace

fs::path curves_in(const fs::path& folder) { return folder / "curves"; }

void make_curves_folder(const fs::path& folder) {
  require_place(curves_in(folder), fs::file_type::directory, "a folder");
  fs::create_directories(curves_in(folder));
}

void write_curves(const std::map<std::string, std::string>& curves, const fs::path& folder, Row& row) {
  FileNames names;
  for (const auto& [situation, text] : curves) {
    const std::string name = names.add(name_begin(row.number) + (situation.empty() ? "" : "-" + situation), "") + ".csv";
    require_place(curves_in(folder) / name, fs::file_type::regular, "an ordinary file");
    write_text(curves_in(folder) / name, text);
    row.curves[name] = fingerprint_text(fingerprint(text));
  }
}

std::string read_curve(const fs::path& folder, const std::pair<const std::string, std::string>& noted) {
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  const fs::path path = curves_in(folder) / noted.first;
  std::error_code error;
  if (!fs::exists(path, error)) throw FileRejected("is missing");
  if (!fs::is_regular_file(path, error)) throw FileRejected("is not an ordinary file");
  std::string text = read_file(path, most_bytes);
  if (fingerprint_text(fingerprint(text)) != noted.second) throw FileRejected("is not as its case wrote it: it was cut off or changed");
  return text;
}

std::string fault_of_curves(const fs::path& folder, const Row& row) {
  for (const auto& noted : row.curves) try {
      read_curve(folder, noted);
    } catch (const FileRejected& why) {
      return (curves_in(folder) / noted.first).string() + " " + why.what();
    }
  return {};
}

bool is_curve_of(std::size_t number, std::string_view name) {
  const std::string begin = name_begin(number);
  return name.starts_with(begin) && name.ends_with(".csv") && name.find('/') == std::string_view::npos &&
         (name[begin.size()] == '.' || name[begin.size()] == '-');
}

}  // namespace pintle
