// Parts of a sweep, each run by a process that does not know of the others: together they are the whole.
#include "framework/study/sweep/merge.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/refusal.h"
#include "tests/scenes/studies/sweep_folder.h"

namespace pintle::sweep_part_test {
namespace {

const std::string pendulum = pendulum_scene("{until: 0.05 s, tolerance: 1e-6}");
const std::string head = "title: A pendulum\nscene: scene.yaml\n";
const std::string grid = head +
                         "measure: {\"turn [rad]\": final angle of rod, load: peak force at hinge}\n"
                         "sweep: {grid: {angle: [-90 deg, 0 deg, 45 deg, 80 deg], mass: [0.5 kg, -1 kg, 2 kg]}}\n";

Sweep sweep_in(const SweepFolder& folder, const std::string& study) {
  folder.write("scene.yaml", pendulum);
  folder.write("study.yaml", study);
  return read_sweep(folder / "study.yaml");
}

/// The folders of all parts of a sweep, run.
std::vector<fs::path> parts_in(const SweepFolder& folder, Sweep sweep, std::size_t count) {
  std::vector<fs::path> out;
  for (std::size_t i = 1; i <= count; ++i) {
    sweep.part = SweepPart{i, count};
    out.push_back(folder / (std::to_string(i) + "-of-" + std::to_string(count)));
    run_sweep(sweep, out.back(), {1, nullptr, {}});
  }
  return out;
}

/// Without checksums, times, and the worker of each case.
std::string without_times(const fs::path& path) {
  static const std::regex own(
      R"re((^|\n)[0-9a-f]{16} |"(worker|build|run)":"[^"]*"|"(computing time of all cases|elapsed|busy) \[s\]": [^,\n]*|"(workers|efficiency)": [^,\n]*)re"
      R"re(|"this session": \{\s*"cases": \d+)re");
  return std::regex_replace(contents(path), own, "$1");
}

void expect_same(const fs::path& whole, const fs::path& merged) {
  std::vector<std::string> files{"sweep.csv", "study.yaml", "scene.yaml"};
  if (fs::exists(whole / "warnings.csv")) files.emplace_back("warnings.csv");
  if (fs::exists(whole / "curves"))
    for (const auto& entry : fs::directory_iterator(whole / "curves")) files.push_back("curves/" + entry.path().filename().string());
  for (const std::string& file : files) EXPECT_EQ(contents(merged / file), contents(whole / file)) << file;
  for (const char* file : {"journal-0.txt", "sweep.json"}) EXPECT_EQ(without_times(merged / file), without_times(whole / file)) << file;
  const auto count = [](const fs::path& folder) {
    return std::distance(fs::recursive_directory_iterator(folder), fs::recursive_directory_iterator());
  };
  EXPECT_EQ(count(merged), count(whole));
}

void merge(const std::vector<fs::path>& parts, const fs::path& out) {
  const Merged merged = read_parts(parts);
  fs::create_directory(out);
  write_merged(merged, out);
}

std::string refusal_of(const std::vector<fs::path>& parts) {
  return pintle_test::refusal_by([&] { read_parts(parts); });
}

TEST(SweepPart, EveryCaseIsInOnePartAndPartsDifferByOneCase) {
  for (std::size_t count = 1; count < 45; ++count)
    for (std::size_t cases = 0; cases < 100; ++cases) {
      std::size_t all = 0, least = cases, most = 0;
      std::vector<int> times(cases + 1, 0);
      for (std::size_t i = 1; i <= count; ++i) {
        std::size_t own = 0;
        for (std::size_t k = 1; k <= cases; ++k)
          if (SweepPart{i, count}.has(k)) ++own, ++times[k];
        ASSERT_EQ(cases_in({i, count}, cases), own);
        all += own, least = std::min(least, own), most = std::max(most, own);
      }
      ASSERT_EQ(all, cases);
      ASSERT_TRUE(std::all_of(times.begin() + 1, times.end(), [](int n) { return n == 1; }));
      ASSERT_LE(most - std::min(least, most), 1u);
    }
}

TEST(SweepPart, NoPartHasOneValueOfAGridAlone) {
  const SweepFolder folder;
  const std::string values_of_two = "sweep: {grid: {angle: [0 deg, 1 deg, 2 deg, 3 deg], mass: [1 kg, 2 kg, 3 kg, 4 kg]}}\n";
  const Sweep sweep = sweep_in(folder, head + "measure: {turn: final angle of rod}\n" + values_of_two);
  for (std::size_t i = 1; i <= 4; ++i)
    for (std::size_t name : {0u, 1u}) {
      std::set<std::string> values;
      for (std::size_t k = 1; k <= 16; ++k)
        if (SweepPart{i, 4}.has(k)) values.insert(*sweep.cases.values[k - 1][name]);
      EXPECT_EQ(values.size(), 4u) << i;
    }
}

TEST(SweepPart, AreTogetherTheWholeToTheBit) {
  const std::string measure = "measure: {turn: final angle of rod, load: peak force at hinge}\n";
  const std::vector<std::string> studies{
      grid,
      head + measure +
          "keep: [angle of rod]\nsweep: {random: {count: 11, seed: 5, angle: {from: 0 deg, to: 90 deg}, mass: [1 kg, 2 kg, -3 kg]}}\n",
      head + measure +
          "keep: [angle of rod]\nsituations: {light: {mass: 0.1 kg}, heavy: {mass: 9 kg}}\n"
          "sweep: {latin hypercube: {count: 9, angle: {from: 0 deg, to: 90 deg}, length: {from: 1 cm, to: 1 m, scale: log}}}\n",
      head + measure + "sweep: {list: [{mass: 1 kg}, {length: 0.1 m, run.max steps: 3}]}\n",
      head + measure + "sweep: {grid: {run.method: [dopri5, generalized-alpha], run.tolerance: [1e-4, 1e-6]}}\n"};
  for (std::size_t s = 0; s < studies.size(); ++s) {
    const SweepFolder folder;
    const Sweep sweep = sweep_in(folder, studies[s]);
    run_sweep(sweep, folder / "whole", {1, nullptr, {}});
    for (const std::size_t count : {1u, 2u, 3u, 7u}) {
      SCOPED_TRACE(std::to_string(s) + " in " + std::to_string(count));
      std::vector<fs::path> parts = parts_in(folder, sweep, count);
      std::ranges::reverse(parts);
      const fs::path merged = folder / ("merged-" + std::to_string(count));
      merge(parts, merged);
      expect_same(folder / "whole", merged);
      EXPECT_EQ(run_sweep(sweep, merged, {1, nullptr, {}}).count.done, 0u);  // the whole sweep continues there
    }
  }
}

TEST(SweepPart, IsMergedFromElsewhereWithoutTheStudy) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder, grid);
  run_sweep(sweep, folder / "whole", {1, nullptr, {}});
  const std::vector<fs::path> parts = parts_in(folder, sweep, 2);
  fs::remove(folder / "study.yaml");
  fs::remove(folder / "scene.yaml");
  merge(parts, folder / "merged");
  expect_same(folder / "whole", folder / "merged");
  const std::string timings = contents(folder / "merged/timings.csv");  // processes are numbered consecutively across all parts
  EXPECT_NE(timings.find("\n1,0.0,"), std::string::npos) << timings;
  EXPECT_NE(timings.find("\n2,1.0,"), std::string::npos) << timings;
}

TEST(SweepPart, WritesATableOfItsOwnName) {
  const SweepFolder folder;
  const std::vector<fs::path> parts = parts_in(folder, sweep_in(folder, grid), 20);
  EXPECT_FALSE(fs::exists(parts[0] / "sweep.csv"));
  EXPECT_EQ(std::ranges::count(contents(parts[0] / "sweep-part.csv"), '\n'), 2);
  EXPECT_EQ(std::ranges::count(contents(parts[19] / "sweep-part.csv"), '\n'), 1);
}

TEST(SweepPart, StoppedItGoesOnAndIsNotMergedBefore) {
  const SweepFolder folder;
  Sweep sweep = sweep_in(folder, grid);
  run_sweep(sweep, folder / "whole", {1, nullptr, {}});
  const std::vector<fs::path> parts = parts_in(folder, sweep, 2);
  // As a killed process leaves it: three of six lines, the last one torn.
  const std::string journal = contents(parts[1] / "journal-0.txt");
  std::size_t end = 0;
  for (int line = 0; line < 4; ++line) end = journal.find('\n', end) + 1;
  folder.write("2-of-2/journal-0.txt", journal.substr(0, end + 30));
  pintle_test::expect_says(refusal_of(parts), {"part 2 of 2 (" + parts[1].string() + ") has 3 of its 6 cases. Finish it with the command",
                                               "--shard 2/2 --out " + parts[1].string()});
  folder.write("1-of-2/journal-0.txt", contents(parts[0] / "journal-0.txt").substr(0, 60));
  pintle_test::expect_says(refusal_of(parts), {"part 1 of 2 (", "has 0 of its 6 cases; part 2 of 2", "has 3 of its 6", "Finish them"});
  for (std::size_t i : {1u, 2u}) {
    sweep.part = SweepPart{i, 2};
    EXPECT_EQ(run_sweep(sweep, parts[i - 1], {1, nullptr, {}}).count.done, i == 1 ? 6u : 3u);
  }
  merge(parts, folder / "merged");
  EXPECT_EQ(contents(folder / "merged/sweep.csv"), contents(folder / "whole/sweep.csv"));
}

TEST(SweepPart, AFolderOfAnotherPartIsRefused) {
  const SweepFolder folder;
  Sweep sweep = sweep_in(folder, grid);
  run_sweep(sweep, folder / "whole", {1, nullptr, {}});
  const std::vector<fs::path> parts = parts_in(folder, sweep, 3);
  const auto refusal = [&](std::optional<SweepPart> part, const fs::path& out) {
    sweep.part = part;
    return pintle_test::refusal_by([&] { run_sweep(sweep, out, {1, nullptr, {}}); });
  };
  pintle_test::expect_says(refusal(SweepPart{2, 3}, parts[0]), {"holds part 1 of 3 of this sweep, not part 2 of 3", "--out"});
  pintle_test::expect_says(refusal({}, parts[0]), {"holds part 1 of 3 of this sweep, not all cases", "--out"});
  pintle_test::expect_says(refusal(SweepPart{2, 3}, folder / "whole"), {"holds all cases of this sweep, not part 2 of 3", "--out"});
  sweep = sweep_in(folder, grid + "# changed\n");
  pintle_test::expect_says(refusal(SweepPart{1, 3}, parts[0]), {"belongs to another study. The study differs"});
}

TEST(SweepPart, PartsThatAreNotAllPartsOfOneStudyAreRefused) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder, grid);
  run_sweep(sweep, folder / "whole", {1, nullptr, {}});
  const std::vector<fs::path> p = parts_in(folder, sweep, 8), of_two = parts_in(folder, sweep, 2);
  pintle_test::expect_says(refusal_of({p[0], p[1], p[3], p[4], p[5], p[7]}), {"parts 3 and 7 of 8 are missing", "--shard 3/8"});
  pintle_test::expect_says(refusal_of({p[0], p[1], p[2], p[3], p[4], p[5], p[6]}), {"part 8 of 8 is missing", "run it"});
  pintle_test::expect_says(refusal_of({p[0], p[1], p[0]}), {"is part 1 of 8, and so is", "leave one of them out"});
  pintle_test::expect_says(refusal_of({p[0], of_two[1]}), {"is part 2 of 2, but ", " is part 1 of 8", "of one division"});
  pintle_test::expect_says(refusal_of({p[0], folder / "whole"}), {"has no part.json", "leave it out"});
  pintle_test::expect_says(refusal_of({folder / "none"}), {"none: is not a folder", "--shard I/N"});
  pintle_test::expect_says(refusal_of({folder / "."}), {"holds no part", "--shard I/N"});
  pintle_test::expect_says(refusal_of({}), {"no part"});
  Sweep other = sweep_in(folder, grid + "# changed\n");
  other.part = SweepPart{2, 2};
  run_sweep(other, folder / "other", {1, nullptr, {}});
  pintle_test::expect_says(refusal_of({of_two[0], folder / "other"}), {"another study than", "its study.yaml differs"});
  other = read_sweep(folder / "study.yaml", {{"run.tolerance", "1e-5"}});
  other.part = SweepPart{1, 2};
  run_sweep(other, folder / "set", {1, nullptr, {}});
  pintle_test::expect_says(refusal_of({folder / "other", folder / "set"}), {"another study than", "--set or a file"});
  Sweep first = sweep;
  first.part = SweepPart{1, 2};
  const Journal working(of_two[0] / "journal-0.txt", first.journal_print());
  pintle_test::expect_says(pintle_test::refusal_by<std::runtime_error>([&] { read_parts(of_two); }),
                           {"a process still works on part 1 of 2"});
}

/// The file of the first of two parts, with a piece replaced.
void replace_in(const SweepFolder& folder, const std::string& file, const std::string& piece, const std::string& by) {
  std::string text = contents(folder / ("1-of-2/" + file));
  ASSERT_NE(text.find(piece), std::string::npos) << file;
  folder.write("1-of-2/" + file, text.replace(text.find(piece), piece.size(), by));
}

TEST(SweepPart, ADamagedOrChangedPartIsRefused) {
  struct Change {
    std::string file, piece, by, says;
  };
  for (const Change& c : std::vector<Change>{{"journal-0.txt", "\"steps\":", "\"steps\":9", "journal-0.txt:2: is damaged"},
                                             {"journal-0.txt", "pintle sweep", "pintle swoop", "journal-0.txt:1: is damaged"},
                                             {"part.json", "\"of\": 2", "\"of\": 0", "part.json: is damaged"},
                                             {"part.json", "\"cases\": 12", "\"cases\": twelve", "part.json: is damaged"},
                                             {"part.json", "\"turn\"", "\"torn\"", "journal and its part.json are not of the same part"},
                                             {"part.json", "\"version\": \"", "\"version\": \"0.0.9-", "was run by pintle 0.0.9-"},
                                             {"study.yaml", "-90 deg", "-80 deg", "its study.yaml was changed"},
                                             {"scene.yaml", "0.2 m", "0.3 m", "its scene.yaml was changed"}}) {
    const SweepFolder folder;
    const std::vector<fs::path> parts = parts_in(folder, sweep_in(folder, grid), 2);
    replace_in(folder, c.file, c.piece, c.by);
    const std::string said = refusal_of(parts);
    pintle_test::expect_says(said, {c.says, "; "});
    if (c.file == "journal-0.txt")
      pintle_test::expect_says(said, {"run the part again: pintle sweep", "--shard 1/2 --out " + parts[0].string()});
    EXPECT_EQ(said.find("run the study again"), std::string::npos) << said;
  }
}

/// What may happen to the curve of case 1: its file, and what stands in the message.
struct Harm {
  std::function<void(const fs::path&)> harm;
  std::string says;
};
std::vector<Harm> harms() {
  const auto text = [](const std::function<std::string(const std::string&)>& changed) {
    return [changed](const fs::path& file) {
      const std::string now = changed(contents(file));
      std::ofstream(file, std::ios::binary) << now;
    };
  };
  const std::string torn = "was cut off or changed";
  return {
      {text([](const std::string&) { return ""; }), torn},
      {text([](const std::string& whole) { return whole.substr(0, whole.size() / 2); }), torn},
      {text([](const std::string& whole) { return whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1); }), torn},
      {text([](const std::string& whole) { return whole + "1,2\n"; }), torn},
      {[](const fs::path& file) { fs::copy_file(file.parent_path() / "case-4.csv", file, fs::copy_options::overwrite_existing); }, torn},
      {[](const fs::path& file) { fs::remove(file); }, "is missing"},
      {[](const fs::path& file) { fs::remove(file), fs::create_directory(file); }, "is not an ordinary file"}};
}

TEST(SweepPart, ACurveThatIsNotAsItsCaseWroteItIsRefused) {
  for (const Harm& each : harms()) {
    const SweepFolder folder;
    const std::vector<fs::path> parts = parts_in(folder, sweep_in(folder, grid + "keep: [angle of rod]\n"), 2);
    ASSERT_EQ(refusal_of(parts), "accepted");
    each.harm(parts[0] / "curves/case-1.csv");
    pintle_test::expect_says(refusal_of(parts), {"curves/case-1.csv", each.says, "continue the part", "--shard 1/2"});
  }
}

// As an earlier build wrote it, which did not note curves.
TEST(SweepPart, AJournalThatNamesNoCurvesIsRefused) {
  const SweepFolder folder;
  const std::vector<fs::path> parts = parts_in(folder, sweep_in(folder, grid + "keep: [angle of rod]\n"), 2);
  std::istringstream lines(contents(parts[0] / "journal-0.txt"));
  std::string text, line;
  for (bool heading = true; std::getline(lines, line); heading = false)
    if (std::optional<Row> row = heading ? std::nullopt : row_of(line)) {
      row->curves.clear();
      text += line_of(*row);
    } else {
      text += line + "\n";
    }
  std::ofstream(parts[0] / "journal-0.txt", std::ios::binary) << text;
  pintle_test::expect_says(refusal_of(parts), {"its journal names no curve of case 1", "run the part again: pintle sweep"});
}

TEST(SweepPart, ACaseWhoseCurveIsLostIsRunAgain) {
  for (const Harm& each : harms()) {
    const SweepFolder folder;
    Sweep sweep = sweep_in(folder, grid + "keep: [angle of rod]\n");
    const std::vector<fs::path> parts = parts_in(folder, sweep, 2);
    const fs::path file = parts[0] / "curves/case-1.csv";
    const std::string whole = contents(file);
    each.harm(file);
    sweep.part = SweepPart{1, 2};
    if (fs::is_directory(file)) {
      pintle_test::expect_refused(
          [&] {
            run_sweep(sweep, parts[0], {1, nullptr, {}});
          },
          {"case-1.csv: is not an ordinary file; remove it"});
      fs::remove(file);
    }
    const SweepEnd end = run_sweep(sweep, parts[0], {1, nullptr, {}});
    EXPECT_EQ(end.count.done, 1u);
    ASSERT_EQ(end.notes.size(), 1u);
    pintle_test::expect_says(end.notes[0], {"curves/case-1.csv", "its case is run again"});
    EXPECT_EQ(contents(file), whole);
    EXPECT_EQ(refusal_of(parts), "accepted");
  }
}

// Whatever has become of the tables, they are written again from the journal.
TEST(SweepPart, TablesAreThoseOfTheJournalAgain) {
  const SweepFolder folder;
  Sweep sweep = sweep_in(folder, grid);
  const fs::path out = parts_in(folder, sweep, 2)[0];
  sweep.part = SweepPart{1, 2};
  for (const std::string file : {"sweep-part.csv", "timings.csv", "sweep.json"}) {
    const std::string whole = contents(out / file);
    std::ofstream(out / file, std::ios::binary) << "";
    EXPECT_EQ(run_sweep(sweep, out, {1, nullptr, {}}).count.done, 0u);
    const std::string again = contents(out / file);
    EXPECT_TRUE(file == "sweep.json" ? !again.empty() : again == whole) << file;  // its session has run no case
  }
}

TEST(SweepPart, AJournalOfAnotherPartIsRefusedByTheSweepToo) {
  for (const bool whole : {true, false}) {
    const SweepFolder folder;
    Sweep sweep = sweep_in(folder, grid);
    const std::vector<fs::path> parts = parts_in(folder, sweep, 2);
    const std::string first = contents(parts[0] / "journal-0.txt"), second = contents(parts[1] / "journal-0.txt");
    const std::size_t line = first.find('\n') + 1;
    std::ofstream(parts[1] / "journal-0.txt", std::ios::binary)
        << (whole ? first : second + first.substr(line, first.find('\n', line) + 1 - line));
    sweep.part = SweepPart{2, 2};
    pintle_test::expect_refused(
        [&] {
          run_sweep(sweep, parts[1], {1, nullptr, {}});
        },
        {whole ? "are not of the same part" : "holds case 1, which does not belong to part 2 of 2", "emove the folder"});
  }
}

TEST(SweepPart, APartThatHasLostItsJournalIsRefused) {
  const SweepFolder folder;
  const std::vector<fs::path> parts = parts_in(folder, sweep_in(folder, grid), 2);
  fs::remove(parts[1] / "journal-0.txt");
  pintle_test::expect_says(refusal_of(parts), {"lacks its journal-0.txt", "remove it and run the part again: pintle sweep"});
}

TEST(SweepPart, ACaseThatFailsAtItsStartHasACurveWithoutRows) {
  const SweepFolder folder;
  folder.write(
      "scene.yaml",
      "parameters: {w: 1 rad/s}\nbodies: {rod: {rigid: {mass: 1 kg, inertia: 1}}}\nstart: {rod: {speed: w}}\nrun: {until: 1 ms}\n");
  folder.write("study.yaml",
               head + "measure: {turn: final angle of rod}\nsweep: {grid: {w: [1 rad/s, 1e200 rad/s]}}\nkeep: [angle of rod]\n");
  const std::vector<fs::path> parts = parts_in(folder, read_sweep(folder / "study.yaml"), 2);
  EXPECT_EQ(std::ranges::count(contents(parts[1] / "curves/case-2.csv"), '\n'), 1);
  EXPECT_EQ(refusal_of(parts), "accepted");
  std::ofstream(parts[0] / "curves/case-1.csv", std::ios::binary) << contents(parts[1] / "curves/case-2.csv");
  pintle_test::expect_says(refusal_of(parts), {"case-1.csv is not as its case wrote it"});
}

TEST(SweepPart, IsWrittenAsOneOfMany) {
  EXPECT_TRUE(read_part("3/8").number == 3 && read_part("3/8").count == 8);
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{{"0/4", "numbered from 1; write 1/4 to 4/4"},
                                                                                   {"5/4", "no part 5 of 4; write 1/4 to 4/4"},
                                                                                   {"a/b", "for example --shard 3/8"},
                                                                                   {"3", "for example --shard 3/8"},
                                                                                   {"1.5/4", "for example --shard 3/8"},
                                                                                   {"-1/4", "for example --shard 3/8"},
                                                                                   {"1/4/2", "for example --shard 3/8"},
                                                                                   {"", "is a variable of the script not set?"},
                                                                                   {"/8", "is a variable of the script not set?"},
                                                                                   {"99999999999999999999/4", "for example --shard 3/8"},
                                                                                   {"1/0", "from 1 to 1000000 parts"},
                                                                                   {"1/1000001", "from 1 to 1000000 parts"}})
    pintle_test::expect_refused([text = text] { read_part(text); }, {"--shard ", says});
}

}  // namespace
}  // namespace pintle::sweep_part_test
