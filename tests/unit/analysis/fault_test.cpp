// Every write, sync, close, rename, open and request for memory of a run is made to fail in its turn, and the program is
// killed at each stage of the commit: nothing that was computed is lost, and the program says what happened.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;

const char* const tables[] = {"trajectory.csv", "ledger.csv", "events.csv"};

/// A scene with contacts and saved states that is run over and over; its tables take several writes.
class Faults : public testing::Test {
 protected:
  void SetUp() override {
#if defined(PINTLE_SANITIZED)
    GTEST_SKIP() << "the sanitizers have malloc to themselves";
#endif
    const Ended end = run_program("");
    ASSERT_EQ(end.code, 0) << end.complained;
    for (const char* name : tables) reference_[name] = contents(out() / name);
    ASSERT_GT(reference_["trajectory.csv"].size(), 600'000U) << "several writes";
    ASSERT_GT(std::ranges::count(reference_["events.csv"], '\n'), 1);
    std::istringstream log(contents(folder_.path() / "counts"));
    std::string name;
    for (long n = 0; log >> name >> n;) counted_[name] = n;
  }

  fs::path out() const { return folder_.path() / "results" / "out"; }

  Ended run_program(const std::string& fault, const Words& more = {}) {
    fs::remove_all(folder_.path() / "results");
    fs::create_directory(folder_.path() / "results");
    const Words command{PINTLE_PROGRAM,
                        "run",
                        PINTLE_SOURCE_DIR "/examples/slider_crank_clearance.yaml",
                        "--set",
                        "run.until=3 ms",
                        "--set",
                        "output.every=3 us",
                        "--set",
                        "output.frames=0",
                        "--set",
                        "output.states=1 ms",
                        "-o",
                        out().string()};
    Words environment{"LD_PRELOAD=" PINTLE_FAULTS, "PINTLE_FAULT_UNDER=" + (folder_.path() / "results").string(),
                      "PINTLE_FAULT_LOG=" + (folder_.path() / "counts").string()};
    if (!fault.empty()) environment.push_back("PINTLE_FAULT=" + fault);
    environment.insert(environment.end(), more.begin(), more.end());
    return run(folder_.path() / "log", command, environment);
  }

  std::vector<fs::path> stagings() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "results"))
      if (entry.path() != out()) found.push_back(entry.path());
    return found;
  }

  bool is_whole(const fs::path& folder) {
    for (const char* name : tables)
      if (contents(folder / name) != reference_[name]) return false;
    const auto json = nlohmann::json::parse(contents(folder / "run.json"), nullptr, false);
    return json.is_object() && json["status"] == "finished" && fs::exists(folder / "states" / "00003.state");
  }

  /// The rows of a folder are the first ones of the whole run. @param killed  then the last one may be cut
  void expect_readable(const fs::path& folder, bool killed) {
    for (const char* name : tables) {
      std::string text = contents(folder / name);
      if (killed) text.resize(text.rfind('\n') + 1);
      EXPECT_TRUE(text.empty() || text.back() == '\n') << name;
      const std::string& whole = reference_[name];
      // The last row of a run that ended early stands at no output time, and a contact that goes on then has no end.
      const std::size_t rows_agree = text.empty() ? 0 : text.rfind('\n', text.size() - 2) + 1;
      EXPECT_EQ(text.compare(0, rows_agree, whole, 0, rows_agree), 0) << name;
    }
  }

  /// Nothing is lost: whole results, or a folder that is named and readable, or nothing where nothing had been computed.
  void expect_nothing_lost(const Ended& end, const std::string& fault) {
    SCOPED_TRACE(fault + ": exit code " + std::to_string(end.code) + ", signal " + std::to_string(end.signal) +
                 ", said: " + end.complained);
    const bool killed = end.signal == SIGKILL;
    if (end.code == 0) {
      EXPECT_TRUE(is_whole(out()));
      EXPECT_TRUE(stagings().empty());
      return;
    }
    if (!killed) {
      EXPECT_EQ(end.signal, 0) << "it crashed";
      EXPECT_FALSE(end.complained.empty());
    }
    if (fs::exists(out())) {
      EXPECT_TRUE(is_whole(out()) || end.complained.find("memory") != std::string::npos);
      expect_readable(out(), killed);
    }
    for (const fs::path& staging : stagings()) {
      if (!killed) {
        EXPECT_NE(end.complained.find(staging.string()), std::string::npos) << "kept without a word";
      }
      expect_readable(staging, killed);
    }
    if (!fs::exists(out()) && stagings().empty()) ++nothing_left_;
  }

  void expect_nothing_lost_at_all(const std::string& call, const std::string& what) {
    for (long k = 1; k <= counted_[call]; ++k) {
      const std::string fault = call + ":" + std::to_string(k) + ":" + what;
      expect_nothing_lost(run_program(fault), fault);
    }
  }

  Folder folder_;
  std::map<std::string, std::string> reference_;
  std::map<std::string, long> counted_;
  int nothing_left_ = 0;
};

std::string with(int error, const char* how) { return std::to_string(error) + ":" + how; }

TEST_F(Faults, ADiskThatIsFullFromAnyWriteOnKeepsTheRowsThatFit) {
  ASSERT_GE(counted_["write"], 7);
  expect_nothing_lost_at_all("write", with(ENOSPC, "on"));
  EXPECT_EQ(nothing_left_, 0);
}

TEST_F(Faults, AWriteThatFailsOnceIsAnErrorThatIsSaid) {
  expect_nothing_lost_at_all("write", with(EIO, "once"));
  EXPECT_EQ(nothing_left_, 0);
}

TEST_F(Faults, InterruptedAndShortWritesAreGoneOnWith) {
  for (long k = 1; k <= counted_["write"]; ++k)
    for (const std::string& what : {with(EINTR, "once"), std::string("short:once")}) {
      const Ended end = run_program("write:" + std::to_string(k) + ":" + what);
      EXPECT_EQ(end.code, 0) << k << ' ' << what << ' ' << end.complained;
      EXPECT_TRUE(is_whole(out()));
    }
}

TEST_F(Faults, ASyncOrACloseThatFailsIsNoSuccess) {
  for (const char* call : {"sync", "close"})
    for (long k = 1; k <= counted_[call]; ++k) {
      const std::string fault = call + (":" + std::to_string(k) + ":") + with(EIO, "once");
      const Ended end = run_program(fault);
      expect_nothing_lost(end, fault);
      if (std::string(call) == "sync") {
        EXPECT_EQ(end.code, 1) << fault;
      }
    }
}

TEST_F(Faults, FoldersAndNamesThatCannotBeMadeAreSaid) {
  for (const char* call : {"rename", "mkdir", "open", "allocate"}) expect_nothing_lost_at_all(call, with(ENOSPC, "once"));
}

TEST_F(Faults, KilledAtAnyStageOfTheCommitLeavesWholeRowsOrAWholeFolder) {
  for (const char* call : {"sync", "rename", "write"})
    for (const char* when : {"kill:once", "kill-after:once"}) expect_nothing_lost_at_all(call, when);
}

TEST_F(Faults, WantOfMemoryAnywhereIsSaidInWords) {
  const long asked = counted_["memory"];
  ASSERT_GT(asked, 1000);
  const char* dense = std::getenv("PINTLE_FAULTS_DENSE");
  const int samples = dense ? std::atoi(dense) : 24;
  for (int i = 0; i < samples; ++i)
    for (const char* how : {"once", "on"}) {
      // Everywhere, and once more near the end, where results are written.
      const long k = i % 2 == 0 ? 1 + asked * i / samples : asked - (asked / 20) * i / samples;
      const std::string fault = "memory:" + std::to_string(k) + ":" + with(ENOMEM, how);
      const Ended end = run_program(fault);
      expect_nothing_lost(end, fault);
      EXPECT_EQ(end.complained.find("bad_alloc"), std::string::npos) << fault << ": " << end.complained;
    }
}

TEST_F(Faults, AClockThatJumpsBackAndALocaleWithACommaChangeNothing) {
  for (const Words& more : {Words{"PINTLE_FAULT_CLOCK=1"}, Words{"LC_ALL=de_DE.UTF-8"}, Words{"LC_ALL=C"}}) {
    const Ended end = run_program("", more);
    EXPECT_EQ(end.code, 0) << end.complained;
    EXPECT_TRUE(is_whole(out())) << more[0];
  }
}

}  // namespace
