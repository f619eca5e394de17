#include "framework/study/sweep/merge.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string>

#include "files/files.h"
#include "framework/common/file.h"
#include "framework/common/fingerprint.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/study/sweep/curves.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
constexpr auto npos = std::string::npos;

struct Found {
  fs::path folder;
  PartFile file;
  std::vector<Row> rows = {};
};

std::string text_in_part(const fs::path& path) {
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  try {
    return read_file(path, most_bytes);
  } catch (const FileRejected& rejected) {
    throw SceneError(path.string() + ": " + rejected.what() + "; run this part again, which rewrites the file");
  }
}

Found found_in(const fs::path& folder) {
  const auto fail = [&](const std::string& why) { throw SceneError(folder.string(), {}, why); };
  const fs::path file = folder / "part.json";
  if (!fs::is_directory(folder)) fail("is not a folder; name the folders that pintle sweep STUDY --shard I/N wrote");
  if (!fs::exists(file))
    fail(fs::exists(journal_path(folder, 0)) ? "has no part.json: it is a whole sweep, or a part that ended early or was not copied whole; "
                                               "continue it with the command that began it, "
                                               "copy it again, or leave it out"
                                             : "holds no part of a sweep; name the folders that pintle sweep STUDY --shard I/N wrote");
  Found out{folder, read_part_file(file.string(), text_in_part(file))};
  if (out.file.version != PINTLE_VERSION)
    fail("was run by pintle " + out.file.version +
         ", but this is pintle " PINTLE_VERSION "; merge the parts with that program, or run all of them again with this one");
  for (const auto& [name, print] : {std::pair("study.yaml", out.file.study_text), std::pair("scene.yaml", out.file.scene_text)})
    if (fingerprint_text(fingerprint(text_in_part(folder / name))) != print)
      fail(std::string("its ") + name + " was changed after the part had begun; run this part again, which rewrites the file");
  return out;
}

/// What distinguishes a part's study from that of another.
std::string difference_of_parts(const PartFile& a, const PartFile& b) {
  if (a.study_text != b.study_text) return "its study.yaml differs";
  if (a.scene_text != b.scene_text) return "its scene.yaml differs";
  return "--set or a file that study and scene name differs";
}

void validate_together(const std::vector<Found>& parts) {
  const Found& first = parts.front();
  for (const Found& p : parts) {
    if (p.file.study != first.file.study)
      throw SceneError(p.folder.string(), {},
                       "is a part of another study than " + first.folder.string() + ": " + difference_of_parts(p.file, first.file) +
                           "; leave one of them out, or run it again with the same study");
    if (p.file.part.count != first.file.part.count)
      throw SceneError(p.folder.string(), {},
                       "is " + part_text(p.file.part) + ", but " + first.folder.string() + " is " + part_text(first.file.part) +
                           "; name the parts of one division");
  }
}

/// "parts 3 and 7 of 8"; of many, only the first ones.
std::string parts_text(const std::vector<std::size_t>& numbers, std::size_t count) {
  constexpr std::size_t most = 20;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(most, numbers.size()); ++k) words.push_back(std::to_string(numbers[k]));
  if (numbers.size() > most) words.push_back(std::to_string(numbers.size() - most) + " more");
  return (numbers.size() == 1 ? "part " : "parts ") + listed(words, "and") + " of " + std::to_string(count);
}

/// A name quoted for a shell.
std::string shell_word(const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || std::string_view("/._-+=:,@%").find(c) != npos; };
  if (!name.empty() && std::ranges::all_of(name, plain)) return name;
  std::string out = "'";
  for (const char c : name) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::string command_for(const PartFile& file, std::size_t number) {
  return "pintle sweep " + shell_word(file.file) + " --shard " + std::to_string(number) + "/" + std::to_string(file.part.count);
}
std::string command_for(const Found& part) {
  return command_for(part.file, part.file.part.number) + " --out " + shell_word(part.folder.string());
}

constexpr const char* and_set = ", with the --set of the other parts if they had any";

/// @pre in the order of their numbers
void validate_numbers(const std::vector<Found>& parts) {
  const PartFile& first = parts.front().file;
  std::vector<std::size_t> missing;
  std::size_t next = 1;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::size_t number = parts[k].file.part.number;
    if (k > 0 && parts[k - 1].file.part.number == number)
      throw SceneError(parts[k].folder.string(), {},
                       "is " + part_text(parts[k].file.part) + ", and so is " + parts[k - 1].folder.string() + "; leave one of them out");
    for (; next < number; ++next) missing.push_back(next);
    ++next;
  }
  for (; next <= first.part.count; ++next) missing.push_back(next);
  if (!missing.empty())
    throw SceneError(parts_text(missing, first.part.count) + (missing.size() == 1 ? " is" : " are") +
                     " missing; name the folders of all parts, or run " + (missing.size() == 1 ? "it" : "them") + ": " +
                     command_for(first, missing.front()) + and_set);
}

/// Reads the cases of a part. @throws SceneError  the journals are damaged, or not of this part
void read_rows(Found& part, std::vector<std::string>& notes) {
  if (!journals_are_free(part.folder, {}, 0))
    throw std::runtime_error(part.folder.string() + ": a process still works on " + part_text(part.file.part) +
                             "; merge when all parts have ended");
  if (!fs::exists(journal_path(part.folder, 0)))
    throw SceneError(
        part.folder.string(), {},
        "lacks its journal-0.txt, which records what was done; copy the folder again with all that is in it, or remove it and run "
        "the part again: " +
            command_for(part) + and_set);
  try {
    const std::string again = "remove " + shell_word(part.folder.string()) + " and run the part again: " + command_for(part) + and_set;
    part.rows = read_journals(part.folder, part.file.print, part.file.cases, &notes, again);
  } catch (const OtherStudy&) {
    throw SceneError(part.folder.string(), {},
                     "its journal and its part.json are not of the same part of the same study; one of them was changed or copied. Remove "
                     "the folder and run " +
                         part_text(part.file.part) + " again");
  }
  for (const Row& row : part.rows)
    if (!part.file.part.has(row.number))
      throw SceneError(part.folder.string(), {},
                       "its journal holds case " + std::to_string(row.number) + ", which does not belong to " + part_text(part.file.part) +
                           "; remove the folder and run the part again");
}

/// The part of the study that tables show.
void read_study_of(const Found& part, Merged& merged) {
  const std::string path = (part.folder / "study.yaml").string();
  StudyFile file;
  file.source.file = path;
  Sweep& out = merged.sweep;
  out.text = text_in_part(path);
  file.tree = parse_yaml(out.text, path);
  const Node root = file.root();
  out.cases = read_cases(root.at("sweep"));
  out.study.file = part.file.file;
  if (root.has("title")) out.study.title = root.at("title").text("a line of text");
  for (const std::string& name : part.file.measures) out.study.measures.emplace_back().name = name;
  out.study.scene.text = text_in_part(part.folder / "scene.yaml");
  std::from_chars(part.file.study.data(), part.file.study.data() + part.file.study.size(), out.print, 16);
  merged.keeps_curves = root.has("keep");
}

/// @throws SceneError  a curve is missing or changed
void validate_curves(const Found& part, bool keeps) {
  for (const Row& row : part.rows) {
    if (keeps && row.curves.empty() && row.status == status_text(Status::finished))
      throw SceneError(part.folder.string(), {},
                       "its journal names no curve of case " + std::to_string(row.number) +
                           ", which the study keeps: another build of pintle wrote it; remove the folder and run the part again: " +
                           command_for(part) + and_set);
    if (const std::string fault = fault_of_curves(part.folder, row); !fault.empty())
      throw SceneError(
          fault + "; copy the folder of " + part_text(part.file.part) +
          " again with all its contents, or remove that file, if it exists, and continue the part, which runs its case again: " +
          command_for(part) + and_set);
  }
}

/// @throws SceneError  naming all parts that lack cases
void validate_finished(const std::vector<Found>& parts) {
  constexpr std::size_t most = 20;
  std::string said;
  std::size_t count = 0;
  const Found* first = nullptr;
  for (const Found& p : parts) {
    const std::size_t all = cases_in(p.file.part, p.file.cases);
    if (p.rows.size() == all) continue;
    if (++count > most) continue;
    if (!first) first = &p;
    said += (said.empty() ? "" : "; ") + part_text(p.file.part) + " (" + p.folder.string() + ") has " + std::to_string(p.rows.size()) +
            " of its " + counted(all, "case");
  }
  if (count > most) said += "; and " + std::to_string(count - most) + " more parts lack cases";
  if (first)
    throw SceneError(said + ". Finish " + (count == 1 ? "it" : "them") + " with the command that began " + (count == 1 ? "it" : "them") +
                     ": " + command_for(*first) + and_set);
}

/// Renumbers the processes of a part after those of the parts before. @returns the number of its processes
std::size_t shift_workers(std::vector<Row>& rows, std::size_t before) {
  std::size_t processes = 0;
  for (Row& row : rows) {
    const auto dot = row.worker.find('.');
    std::size_t process = 0;
    std::from_chars(row.worker.data(), row.worker.data() + row.worker.size(), process);
    processes = std::max(processes, process + 1);
    if (dot != std::string::npos) row.worker = std::to_string(before + process) + row.worker.substr(dot);
  }
  return processes;
}

}  // namespace

Merged read_parts(const std::vector<fs::path>& folders) {
  std::vector<Found> parts;
  for (const fs::path& folder : folders) parts.push_back(found_in(folder));
  if (parts.empty()) throw SceneError("there is no part to merge; name the folders that pintle sweep STUDY --shard I/N wrote");
  validate_together(parts);
  std::ranges::stable_sort(parts, {}, [](const Found& p) { return p.file.part.number; });
  validate_numbers(parts);
  Merged out;
  for (Found& p : parts) read_rows(p, out.end.notes);
  validate_finished(parts);
  read_study_of(parts.front(), out);
  std::size_t processes = 0;
  for (Found& p : parts) {
    validate_curves(p, out.keeps_curves);
    processes += shift_workers(p.rows, processes);
    out.end.rows.insert(out.end.rows.end(), p.rows.begin(), p.rows.end());
    out.folders.push_back(p.folder);
  }
  std::ranges::sort(out.end.rows, {}, &Row::number);
  out.end.whole = true;
  out.end.count.cases = out.end.rows.size();
  return out;
}

void write_merged(const Merged& merged, const fs::path& folder) {
  {
    Journal journal(journal_path(folder, 0), merged.sweep.print);
    for (const Row& row : merged.end.rows) journal.append(row);
  }
  write_text(folder / "study.yaml", merged.sweep.text);
  write_text(folder / "scene.yaml", merged.sweep.study.scene.text);
  write_text(folder / "timings.csv", timings_csv(merged.end.rows));
  if (const std::string warnings = warnings_csv(merged.end.rows); !warnings.empty()) write_text(folder / "warnings.csv", warnings);
  write_text(folder / "sweep.json", sweep_json(merged.sweep, merged.end));
  write_text(folder / table_name(merged.sweep), sweep_csv(merged.sweep, merged.end.rows));
  if (!merged.keeps_curves) return;
  std::error_code error;
  fs::create_directory(curves_in(folder), error);
  if (error) throw FileError(curves_in(folder), error.value(), "cannot be made");
  for (const Row& row : merged.end.rows)
    for (const auto& noted : row.curves) {
      const std::size_t part = SweepPart::with(row.number, merged.folders.size());
      write_text(curves_in(folder) / noted.first, read_curve(merged.folders[part - 1], noted));
    }
}

}  // namespace pintle
