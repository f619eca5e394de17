#include "framework/study/sweep/study_folder.h"

#include <algorithm>
#include <iterator>

#include "files/files.h"
#include "framework/common/file.h"
#include "framework/common/fingerprint.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;

/// Creates the folder, or checks whether it can be continued.
void open_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error))) {
    const auto is_ours = [&](const fs::path& p) {
      const std::string name = p.filename().string();
      return name.starts_with("journal-") || name.starts_with("study.yaml") || name.starts_with("scene.yaml") ||
             name.starts_with("part.json") || name.find(".part") != std::string::npos;
    };
    if (!fs::is_directory(folder)) throw SceneError(folder.string(), {}, "exists already and is not a directory; name another with --out");
    const fs::directory_iterator entries(folder);
    if (!fs::exists(journal_path(folder, 0)) &&
        !std::all_of(begin(entries), end(entries), [&](const auto& e) { return is_ours(e.path()); }))
      throw SceneError(folder.string(), {},
                       fs::exists(folder / "study.yaml")
                           ? "lacks its journal-0.txt, which records what was done; remove the folder, or name another directory with --out"
                           : "exists already and contains no study; name another directory with --out");
  }
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error(folder.string() + ": cannot be made (" + error.message() + "); name another place with --out");
}

std::string text_or_nothing(const fs::path& path) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  try {
    return read_file(path, most_bytes);
  } catch (const FileRejected&) {
    return {};  // then it differs from the stored file
  }
}

/// The part of this study that the folder holds, if it is not the requested one; empty if the study is another.
std::string other_share(const Sweep& sweep, const fs::path& folder) {
  try {
    if (const fs::path file = folder / "part.json"; fs::exists(file)) {
      const PartFile held = read_part_file(file.string(), text_or_nothing(file));
      return held.study == fingerprint_text(sweep.print) ? part_text(held.part) + " of this sweep" : "";
    }
    if (!sweep.part) return {};
    const Journal whole(journal_path(folder, 0), sweep.print);
    return "all cases of this sweep";
  } catch (const SceneError&) {  // also OtherStudy
    return {};
  }
}

/// Why the folder of another study is rejected: what has changed, as far as known.
std::string what_differs(const Sweep& sweep, const fs::path& folder) {
  const auto differs = [&](const char* name, const std::string& now) {
    return fs::exists(folder / name) && text_or_nothing(folder / name) != now;
  };
  const bool study = differs("study.yaml", sweep.text), scene = differs("scene.yaml", sweep.study.scene.text);
  const std::string was = study && scene ? "The study and its scene differ from those"
                          : study        ? "The study differs from the one"
                                         : "The scene differs from the one";
  if (study || scene)
    return was + " that ran there (kept there as " + (study ? "study.yaml" : "") + (study && scene ? " and " : "") +
           (scene ? "scene.yaml" : "") + ")";
  return "Study and scene are those that ran there, but --set, a file that they name or the version of the program differs";
}

}  // namespace

std::unique_ptr<Journal> open_study_folder(const Sweep& sweep, const fs::path& folder, std::vector<std::string>& notes) {
  open_folder(folder);
  const fs::path own = journal_path(folder, 0);
  std::unique_ptr<Journal> journal;
  try {
    journal = std::make_unique<Journal>(own, sweep.journal_print(), &notes);
  } catch (const OtherStudy&) {
    const std::string share = other_share(sweep, folder);
    if (sweep.part && share.starts_with(part_text(*sweep.part)))
      throw SceneError(
          folder.string(), {},
          "its journal-0.txt and its part.json are not of the same part; one of them was changed or copied. Remove the folder and "
          "run " +
              part_text(*sweep.part) + " again");
    if (!share.empty())
      throw SceneError(folder.string(), {},
                       "holds " + share + ", not " + (sweep.part ? part_text(*sweep.part) : "all cases") +
                           "; name another directory with --out, or leave --out out");
    throw SceneError(
        folder.string(), {},
        "belongs to another study. " + what_differs(sweep, folder) + ". Name another directory with --out, or remove " + folder.string());
  }
  if (!journals_are_free(folder, own, 10))
    throw std::runtime_error(folder.string() + ": processes of an earlier session still work there; wait for them, or end them");
  write_synced(folder / "study.yaml", sweep.text);
  write_synced(folder / "scene.yaml", sweep.study.scene.text);
  if (sweep.part) write_synced(folder / "part.json", part_json(part_file(sweep)));
  return journal;
}

}  // namespace pintle
