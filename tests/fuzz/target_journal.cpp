#include <cstdlib>
#include <string>

#include "framework/common/fingerprint.h"
#include "framework/study/sweep/journal.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/targets.h"

namespace pintle {

namespace {

constexpr std::uint64_t study = 1;
constexpr std::size_t cases = 6;

/// Each line with the checksum of what follows its own.
std::string forged_journal(std::string_view text) {
  constexpr std::size_t checksum = 17;
  std::string out;
  for (std::size_t begin = 0, end; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin), content = line.substr(std::min(checksum, line.size()));
    out.append(fingerprint_text(fingerprint(content))).append(" ").append(content);
    if (end < text.size()) out += '\n';
  }
  return out;
}

void read_journal(std::string_view text) {
  const auto path = fuzz_folder().write("journal-0.txt", text);
  std::vector<Row> rows;
  try {
    rows = read_journals(path.parent_path(), study, cases);
    Journal(path, study).append(Row{cases, "finished", {}, {}, {}, 0, 0, 0, 0, {}, 0, 0});
    if (read_journals(path.parent_path(), study, cases).empty()) std::abort();
  } catch (const SceneError&) {
  }
  for (const Row& row : rows)
    if (row.number < 1 || row.number > cases || !row_of(line_of(row))) std::abort();
}

}  // namespace

void fuzz_journal(std::string_view bytes) {
  read_journal(bytes);
  read_journal(forged_journal(bytes));
}

}  // namespace pintle
