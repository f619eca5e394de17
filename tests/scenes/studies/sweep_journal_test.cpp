// What a sweep keeps of its cases while it runs.
#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "framework/common/fingerprint.h"
#include "framework/scene/error.h"
#include "framework/study/sweep/journal.h"
#include "framework/study/sweep/sweep.h"
#include "tests/refusal.h"
#include "tests/scenes/studies/sweep_folder.h"

namespace pintle::sweep_journal_test {
namespace {

Row sample_row() {
  return {7,
          "failed",
          "a \"reason\", µ",
          {1.0 / 3, std::nan(""), std::numeric_limits<double>::infinity(), 5e-324},
          {"N", "", "m", "J"},
          0.1 + 0.2,
          1e-17,
          123,
          4,
          "0.1",
          0.5,
          0.25};
}

TEST(SweepJournal, NumbersComeBackToTheBit) {
  const Row r = sample_row(), back = row_of(line_of(r)).value();
  EXPECT_EQ(back.number, r.number);
  EXPECT_EQ(back.reason, r.reason);
  EXPECT_EQ(back.units, r.units);
  EXPECT_EQ(back.t_end, r.t_end);
  EXPECT_EQ(back.values[0], r.values[0]);
  EXPECT_TRUE(std::isnan(back.values[1]));
  EXPECT_EQ(back.values[2], r.values[2]);
  EXPECT_EQ(back.values[3], r.values[3]);
  EXPECT_EQ(back.impacts, 4);
}

TEST(SweepJournal, ATornOrChangedLineIsNoRow) {
  const std::string line = line_of(sample_row());
  for (std::size_t n = 0; n + 1 < line.size(); ++n) EXPECT_FALSE(row_of(line.substr(0, n))) << n;
  for (std::size_t n = 0; n + 1 < line.size(); ++n) {
    std::string changed = line;
    changed[n] = static_cast<char>(changed[n] ^ 1);
    EXPECT_FALSE(row_of(changed)) << n;
  }
}

TEST(SweepJournal, ATornLastLineIsCutOffAndItsCaseIsOpenAgain) {
  const SweepFolder folder;
  const fs::path path = journal_path(folder / "", 0);
  Row r = sample_row();
  {
    Journal journal(path, 42);
    journal.append(r);
    r.number = 8;
    journal.append(r);
  }
  const std::string whole = contents(path);
  const std::size_t second = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t cut : {second, second + 1, second + 30, whole.size() - 1}) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << whole.substr(0, cut);
    EXPECT_EQ(read_journals(folder / "", 42, 10).size(), 1u);
    {
      Journal journal(path, 42);
      journal.append(r);
    }
    EXPECT_EQ(contents(path), whole);
    EXPECT_EQ(read_journals(folder / "", 42, 10).size(), 2u);
  }
  EXPECT_THROW(read_journals(folder / "", 43, 10), SceneError);
  EXPECT_THROW(Journal(path, 43), SceneError);
}

/// A journal of the study 42 with cases 1, 2 and 3.
std::string three_cases(const SweepFolder& folder) {
  const fs::path path = journal_path(folder / "", 0);
  Journal journal(path, 42);
  Row r = sample_row();
  for (r.number = 1; r.number <= 3; ++r.number) journal.append(r);
  return contents(path);
}
void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary | std::ios::trunc) << text; }
/// Why the journals of the folder are refused; empty: they are not.
std::string refusal(const SweepFolder& folder) {
  try {
    read_journals(folder / "", 42, 10);
  } catch (const OtherStudy&) {
    return "another study";
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(SweepJournal, AFolderThatHasLostItIsTold) {
  const SweepFolder folder;
  folder.write("scene.yaml", pendulum_scene());
  folder.write("study.yaml", "scene: scene.yaml\nmeasure: {turn: final angle of rod}\nsweep: {grid: {mass: [1 kg, 2 kg]}}\n");
  const Sweep sweep = read_sweep(folder / "study.yaml");
  run_sweep(sweep, folder / "out", {1, nullptr, {}});
  fs::remove(journal_path(folder / "out", 0));
  EXPECT_NE(pintle_test::refusal_by([&] {
              run_sweep(sweep, folder / "out", {1, nullptr, {}});
            }).find("lacks its journal-0.txt"),
            std::string::npos);
}

TEST(SweepJournal, SaysWhatWasTornAndWhatWasDone) {
  const SweepFolder folder;
  const fs::path path = journal_path(folder / "", 0);
  const std::string whole = three_cases(folder);
  put(path, whole.substr(0, whole.size() - 5));
  std::vector<std::string> read, opened;
  EXPECT_EQ(read_journals(folder / "", 42, 10, &read).size(), 2u);
  { const Journal journal(path, 42, &opened); }
  for (const auto& notes : {read, opened}) {
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("journal-0.txt:4: is incomplete"), std::string::npos) << notes[0];
    EXPECT_NE(notes[0].find("its case counts as not run"), std::string::npos) << notes[0];
  }
  read.clear();
  EXPECT_EQ(read_journals(folder / "", 42, 10, &read).size(), 2u);
  EXPECT_TRUE(read.empty());
}

TEST(SweepJournal, ADamagedLineIsRefusedByItsNumber) {
  const SweepFolder folder;
  const fs::path path = journal_path(folder / "", 0);
  const std::string whole = three_cases(folder);
  const std::size_t second = whole.find('\n', whole.find('\n') + 1) + 1, third = whole.find('\n', second) + 1;
  for (std::size_t i = second; i + 1 < third; ++i)
    for (const int bit : {1, 4, 0x80}) {
      std::string changed = whole;
      changed[i] = static_cast<char>(changed[i] ^ bit);
      put(path, changed);
      if (changed[i] == '\n') continue;  // two lines, of which the first is refused as well
      ASSERT_NE(refusal(folder).find("journal-0.txt:3: is damaged"), std::string::npos) << i << " " << refusal(folder);
    }
  std::string without = whole;
  put(path, without.erase(second, third - second));  // the remedy
  EXPECT_EQ(refusal(folder), "");
}

TEST(SweepJournal, ADamagedHeadingIsRefusedAndNothingIsDiscarded) {
  const SweepFolder folder;
  const fs::path path = journal_path(folder / "", 0);
  const std::string whole = three_cases(folder);
  for (std::size_t i = 0; i < whole.find('\n') + 1; ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    put(path, changed);
    ASSERT_NE(refusal(folder).find("journal-0.txt:1: is damaged"), std::string::npos) << i;
    ASSERT_THROW(Journal(path, 42), SceneError);
    ASSERT_EQ(contents(path), changed);
  }
}

TEST(SweepJournal, AHeadingTornByAKillBeginsAgain) {
  const SweepFolder folder;
  const fs::path path = journal_path(folder / "", 0);
  const std::string whole = three_cases(folder), heading = whole.substr(0, whole.find('\n') + 1);
  for (std::size_t n = 0; n + 1 < heading.size(); ++n) {
    put(path, heading.substr(0, n) + std::string(n % 3, '\0'));
    ASSERT_EQ(refusal(folder), "") << n;
    { const Journal journal(path, 42); }
    ASSERT_EQ(contents(path), heading) << n;
  }
}

TEST(SweepJournal, ACaseThatTheStudyHasNotIsRefused) {
  const SweepFolder folder;
  const fs::path path = journal_path(folder / "", 0);
  const std::string whole = three_cases(folder);
  for (const std::size_t number : {std::size_t{0}, std::size_t{11}, std::size_t{1} << 40, ~std::size_t{0}}) {
    Row forged = sample_row();
    forged.number = number;
    put(path, whole + line_of(forged));
    EXPECT_NE(refusal(folder).find("journal-0.txt:5: "), std::string::npos) << number << " " << refusal(folder);
  }
}

TEST(SweepJournal, WhatIsSealedButNoCaseIsNoRow) {
  const auto sealed = [](const std::string& text) { return fingerprint_text(fingerprint(text)) + " " + text + "\n"; };
  for (const char* text : {"{}", "[]", "1", "null", "\"case\"", "{\"case\":1}"}) EXPECT_FALSE(row_of(sealed(text))) << text;
  const std::string line = line_of(sample_row());
  const auto whole = nlohmann::ordered_json::parse(line.substr(17));
  EXPECT_TRUE(row_of(sealed(whole.dump())));
  for (const auto& [key, value] : whole.items()) {
    nlohmann::ordered_json less = whole;
    less.erase(key);
    EXPECT_FALSE(row_of(sealed(less.dump()))) << key;
    for (const char* other : {"null", "-1", "1.5", "{}", "[[]]", "\"x1\"", "1e300", "18446744073709551615"}) {
      nlohmann::ordered_json changed = whole;
      changed[key] = nlohmann::ordered_json::parse(other);
      const bool text = value.is_string() && changed[key].is_string() && (key == "status" || key == "reason" || key == "worker");
      EXPECT_EQ(row_of(sealed(changed.dump())).has_value(), text) << key << " " << other;
    }
  }
}

TEST(SweepJournal, IsHeldByItsProcess) {
  const SweepFolder folder;
  {
    Journal journal(journal_path(folder / "", 1), 42);
    EXPECT_FALSE(journals_are_free(folder / "", journal_path(folder / "", 0), 0));
    EXPECT_TRUE(journals_are_free(folder / "", journal_path(folder / "", 1), 0));
  }
  EXPECT_TRUE(journals_are_free(folder / "", journal_path(folder / "", 0), 0));
}

}  // namespace
}  // namespace pintle::sweep_journal_test
