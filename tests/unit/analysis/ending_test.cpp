// How the program ends: by signals, with names of all kinds, with a limit on files. Nothing that was computed is lost.
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;

const std::string example = PINTLE_SOURCE_DIR "/examples/slider_crank_clearance.yaml";

Words run_command(const fs::path& scene, const fs::path& out, Words more = {}) {
  Words command{PINTLE_PROGRAM, "run", scene.string(), "-o", out.string()};
  command.insert(command.end(), more.begin(), more.end());
  return command;
}
/// 1 ms of the example.
const Words shortly{"--set", "run.until=1 ms", "--set", "output.frames=0"};
/// Much longer than any test waits.
const Words for_long{"--set", "run.until=4000 s",  "--set", "output.frames=0",
                     "--set", "output.every=1 ms", "--set", "run.max steps=2000000000"};

bool whole_rows(const std::string& text) { return !text.empty() && text.back() == '\n'; }

nlohmann::json report_in(const fs::path& folder) { return nlohmann::json::parse(contents(folder / "run.json"), nullptr, false); }

/// Waits until a run has written rows, in whichever folder it does.
bool has_rows(const fs::path& folder) {
  for (int k = 0; k < 1000; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(10)))
    for (const auto& entry : fs::directory_iterator(folder))
      if (std::error_code error; entry.is_directory() && fs::file_size(entry.path() / "trajectory.csv", error) > 100'000 && !error)
        return true;
  return false;
}

struct Stop {
  int signal;
  const char* word;
};
class Stopped : public testing::TestWithParam<Stop> {};

TEST_P(Stopped, ARunStoppedBySignalKeepsItsResultsAndSaysWhich) {
  const Folder folder;
  const fs::path log = folder.path() / "log", out = folder.path() / "out";
  const pid_t child = start(log, run_command(example, out, for_long));
  ASSERT_TRUE(has_rows(folder.path()));
  ::kill(child, GetParam().signal);
  const Ended end = wait_for(child, log);
  EXPECT_EQ(end.code, 6) << end.signal << end.complained;
  EXPECT_NE(end.said.find(GetParam().word), std::string::npos) << end.said;
  EXPECT_TRUE(whole_rows(contents(out / "trajectory.csv")));
  const auto report = report_in(out);
  EXPECT_EQ(report["status"], "interrupted");
  EXPECT_NE(report["reason"].get<std::string>().find(GetParam().word), std::string::npos);
}

// As `timeout` sends it, to the program and to its group.
TEST_P(Stopped, ASignalThatComesTwiceAtOnceIsOneRequest) {
  const Folder folder;
  const fs::path log = folder.path() / "log", out = folder.path() / "out";
  const pid_t child = start(log, run_command(example, out, for_long));
  ASSERT_TRUE(has_rows(folder.path()));
  for (const int signal : {GetParam().signal, GetParam().signal}) {
    ::kill(child, signal);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const Ended end = wait_for(child, log);
  EXPECT_EQ(end.code, 6) << end.signal << end.complained;
  EXPECT_EQ(report_in(out)["status"], "interrupted");
}

// Of a hundred thousand frames hardly any is there when the signal comes.
TEST_P(Stopped, WritingEndsBySignalAndSaysWhereItsBeginningIs) {
  const Folder folder;
  const fs::path log = folder.path() / "log", results = folder.path() / "results";
  fs::create_directory(results);
  const pid_t child = start(log, {PINTLE_PROGRAM, "modes", PINTLE_SOURCE_DIR "/examples/modes_beam.yaml", "--count", "1", "--frames",
                                  "100000", "-o", (results / "out").string()});
  const auto writes = [&] {
    for (const auto& entry : fs::recursive_directory_iterator(results))
      if (entry.path().filename() == "frames" && !fs::is_empty(entry.path())) return true;
    return false;
  };
  for (int k = 0; k < 1000 && !writes(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ::kill(child, GetParam().signal);
  const Ended end = wait_for(child, log);
  EXPECT_EQ(end.code, 6) << end.signal << end.complained;
  EXPECT_NE(end.complained.find(GetParam().word), std::string::npos) << end.complained;
  EXPECT_NE(end.complained.find("while writing the results; what was computed is in " + (results / "out.part-").string()),
            std::string::npos)
      << end.complained;
  EXPECT_FALSE(fs::exists(results / "out"));
}
INSTANTIATE_TEST_SUITE_P(Signals, Stopped, testing::Values(Stop{SIGINT, "Ctrl-C"}, Stop{SIGTERM, "SIGTERM"}, Stop{SIGHUP, "SIGHUP"}));

TEST(Ending, ARunUnderNohupOutlivesItsTerminal) {
  const Folder folder;
  const fs::path log = folder.path() / "log", out = folder.path() / "out";
  std::signal(SIGHUP, SIG_IGN);  // what nohup hands on
  const pid_t child = start(log, run_command(example, out, for_long));
  std::signal(SIGHUP, SIG_DFL);
  ASSERT_TRUE(has_rows(folder.path()));
  ::kill(child, SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << "it goes on";
  ::kill(child, SIGINT);
  EXPECT_EQ(wait_for(child, log).code, 6);
}

TEST(Ending, ARunThatIsKilledLeavesWholeRowsAndTheNextIsToldOfThem) {
  const Folder folder;
  const fs::path log = folder.path() / "log", out = folder.path() / "out";
  const pid_t child = start(log, run_command(example, out, for_long));
  ASSERT_TRUE(has_rows(folder.path()));
  ::kill(child, SIGKILL);
  EXPECT_EQ(wait_for(child, log).signal, SIGKILL);
  EXPECT_FALSE(fs::exists(out));
  const Ended next = run(log, run_command(example, out, shortly));
  EXPECT_EQ(next.code, 0) << next.complained;
  EXPECT_NE(next.complained.find("out.part-"), std::string::npos) << next.complained;
  EXPECT_TRUE(fs::exists(out / "run.json"));
}

// In a container every run may have the same process number: a folder named by it would be taken for one's own.
TEST(Ending, TheFolderOfAKilledRunIsNeverWrittenTo) {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  for (int pid = 1; pid < 70'000; pid += pid < 400 ? 1 : 977) fs::create_directory(out.string() + ".part-" + std::to_string(pid));
  const fs::path own = out.string() + ".part-" + std::to_string(::getpid() + 1);  // about the number that the program gets
  fs::create_directories(own);
  EXPECT_EQ(run(folder.path() / "log", run_command(example, out, shortly)).code, 0);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (entry.path().filename().string().starts_with("out.part-")) {
      EXPECT_TRUE(fs::is_empty(entry.path())) << entry.path();
    }
}

TEST(Ending, ALimitOnTheSizeOfFilesEndsTheRunInOrder) {
  const Folder folder;
  const fs::path log = folder.path() / "log", out = folder.path() / "out";
  const Ended end = run(log, {"/bin/bash", "-c", "ulimit -f 400; exec \"$@\"", "bash", PINTLE_PROGRAM, "run", example, "-o", out.string(),
                              "--set", "run.until=9 ms", "--set", "output.every=3 us", "--set", "output.frames=0"});
  EXPECT_EQ(end.signal, 0) << "SIGXFSZ";
  EXPECT_EQ(end.code, 1) << end.complained;
  EXPECT_NE(end.complained.find("ulimit -f"), std::string::npos) << end.complained;
  const std::size_t named = end.complained.find(out.string() + ".part-");
  ASSERT_NE(named, std::string::npos) << end.complained;
  const fs::path staging = end.complained.substr(named, out.string().size() + 12);
  EXPECT_TRUE(whole_rows(contents(staging / "trajectory.csv")));
  EXPECT_GT(contents(staging / "trajectory.csv").size(), 300'000U);
  EXPECT_EQ(report_in(staging)["status"], "results not written");
}

TEST(Ending, ALimitThatTheRowsMustPassRefusesTheRunBeforeItIsComputed) {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  const Ended end = run(folder.path() / "log", {"/bin/bash", "-c", "ulimit -f 400; exec \"$@\"", "bash", PINTLE_PROGRAM, "run", example,
                                                "-o", out.string(), "--set", "run.until=20 s", "--set", "output.every=3 us"});
  EXPECT_EQ(end.code, 1) << end.complained;
  EXPECT_NE(end.complained.find("trajectory.csv needs at least"), std::string::npos) << end.complained;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 2) << "the two logs alone";
}

// A file system of 400 kB, where this process may mount one for itself.
TEST(Ending, ADiskThatFillsKeepsItsRowsAndStatesAndSaysWhere) {
  const Folder folder;
  const fs::path disk = folder.path() / "disk", kept = folder.path() / "kept", log = folder.path() / "log";
  fs::create_directory(disk);
  const std::string mount = "mount -t tmpfs -o size=400k none '" + disk.string() + "'";
  if (run(log, {"/usr/bin/unshare", "-rm", "/bin/sh", "-c", mount}).code != 0) GTEST_SKIP() << "no file system can be mounted here";
  // The clearances of the example make a row of some 750 bytes every 3 us; a state every 100 us.
  const Ended end = run(log, {"/usr/bin/unshare", "-rm", "/bin/bash", "-c",
                              mount + " && { \"$@\"; code=$?; cp -r '" + disk.string() + "' '" + kept.string() + "'; exit $code; }", "bash",
                              PINTLE_PROGRAM, "run", example, "-o", (disk / "out").string(), "--set", "run.until=9 ms", "--set",
                              "output.every=3 us", "--set", "output.states=100 us", "--set", "output.frames=0"});
  EXPECT_EQ(end.code, 1) << end.complained;
  EXPECT_NE(end.complained.find((disk / "out.part-").string()), std::string::npos) << end.complained;
  EXPECT_NE(end.complained.find("make room"), std::string::npos) << end.complained;
  ASSERT_EQ(std::distance(fs::directory_iterator(kept), fs::directory_iterator()), 1);
  const fs::path staging = fs::directory_iterator(kept)->path();
  EXPECT_EQ(report_in(staging)["status"], "results not written");
  const auto rows_until = [&](const char* table) {
    const std::string text = contents(staging / table);
    EXPECT_TRUE(whole_rows(text)) << table;
    return std::stod(text.substr(text.rfind('\n', text.size() - 2) + 1));
  };
  // No saved state is later than the rows, and of the disk little is left.
  double last_state = 0;
  std::uintmax_t used = 0;
  for (const auto& entry : fs::recursive_directory_iterator(staging))
    if (entry.is_regular_file()) used += entry.file_size();
  for (const auto& entry : fs::directory_iterator(staging / "states")) {
    const std::string text = contents(entry.path());
    last_state = std::max(last_state, std::stod(text.substr(text.find("\nt ") + 3)));
  }
  EXPECT_GT(last_state, 0);
  EXPECT_GE(rows_until("trajectory.csv"), last_state - 3e-6);
  EXPECT_GE(rows_until("ledger.csv"), last_state - 3e-6);
  EXPECT_GT(used, 250'000U);
}

TEST(Ending, AReaderThatGoesAwayIsAnErrorAndNoSignal) {
  const Folder folder;
  const fs::path log = folder.path() / "log", out = folder.path() / "out";
  const Ended end = run(log, {"/bin/bash", "-c", "(sleep 0.1; \"$@\"; echo $? > " + (folder.path() / "code").string() + ") | true", "bash",
                              PINTLE_PROGRAM, "run", example, "-o", out.string(), "--set", "run.until=1 ms", "--set", "output.frames=0"});
  EXPECT_EQ(contents(folder.path() / "code"), "1\n");
  EXPECT_NE(end.complained.find("standard output"), std::string::npos) << end.complained;
  EXPECT_TRUE(fs::exists(out / "run.json"));
}

TEST(Ending, MemoryThatRowsWouldFillDoesNotGrowWithThem) {
#if defined(PINTLE_SANITIZED)
  GTEST_SKIP() << "the sanitizers reserve more than the limit";
#endif
  const Folder folder;
  // 3·10⁵ rows of 57 numbers: 140 MB as numbers, as much again as text.
  const Ended end = run(folder.path() / "log", {"/bin/bash", "-c", "ulimit -v 400000; exec \"$@\"", "bash", PINTLE_PROGRAM, "run", example,
                                                "-o", (folder.path() / "out").string(), "--set", "run.until=3 ms", "--set",
                                                "output.every=10 ns", "--set", "output.frames=0"});
  EXPECT_EQ(end.code, 0) << end.complained;
}

// OpenBLAS starts threads as it is loaded, and each wants 134 MB: one that gets none asks for ever, and the end of the program waits for it.
TEST(Ending, ALimitOnMemoryDoesNotMakeLibraryThreadsHoldTheProgram) {
#if defined(PINTLE_SANITIZED)
  GTEST_SKIP() << "the sanitizers reserve more than the limit";
#endif
  const Folder folder;
  for (const char* limit : {"-v 100000", "-v 150000", "-d 100000"}) {
    const Ended end = run(folder.path() / "log", {"/bin/bash", "-c", std::string("ulimit ") + limit + "; exec timeout -s KILL 60 \"$@\"",
                                                  "bash", PINTLE_PROGRAM, "--version"});
    EXPECT_EQ(end.code, 0) << limit << end.complained;
  }
}

// Shapes of a mesh come from BLAS, which sums in another order for each number of threads.
TEST(Ending, ARunIsTheSameByAnyNumberOfThreadsAndGoesOnByAnother) {
  const Folder folder;
  const fs::path scene = folder.write("scene.yaml", R"(
gravity: [0, -9.81]
bodies:
  arm:
    plate: {link: {eye bar: {length: 0.3, width: 0.03, eyes: [{bore: 0.03, outer: 0.06}, {bore: 0.02, outer: 0.04}]}},
            thickness: 5 mm, size: 12 mm, young: 207 GPa, poisson: 0.3, density: 7850}
    modes: {frame: {tangent: O}, count: 4}
    points: {O: {hole: eye 1, coupling: rigid}}
joints: {bearing: {revolute: [ground, arm.O]}}
run: {until: 1e-5, tolerance: 1e-4}
output: {states: 5e-6}
)");
  const auto out = [&](const std::string& threads) { return folder.path() / ("out" + threads); };
  for (const std::string threads : {"1", "2"}) {
    const Ended end = run(folder.path() / "log", run_command(scene, out(threads)), {"OPENBLAS_NUM_THREADS=" + threads});
    ASSERT_EQ(end.code, 0) << end.complained;
    EXPECT_EQ(contents(out(threads) / "trajectory.csv"), contents(out("1") / "trajectory.csv")) << threads;
    const std::string state = (out(threads) / "states" / "00001.state").string();
    const Ended rest =
        run(folder.path() / "log", run_command(scene, folder.path() / ("rest" + threads), {"--restart", state, "--set", "run.until=2e-5"}),
            {"OPENBLAS_NUM_THREADS=1"});
    EXPECT_EQ(rest.code, 0) << rest.complained;
  }
}

TEST(Names, ASlashAtTheEndOfTheFolderIsNoPartOfItsName) {
  const Folder folder;
  for (const char* name : {"new/", "new2//", "deep/er/", "./dot/."}) {
    const Ended end = run(folder.path() / "log", run_command(example, folder.path().string() + "/" + name, shortly));
    EXPECT_EQ(end.code, 0) << name << end.complained;
    EXPECT_TRUE(fs::exists(folder.path() / name / "run.json")) << name;
  }
}

// Latin-1, a line's end, quotes, an emoji, as long as names can be.
TEST(Names, FilesAndFoldersOfAnyNameAreWritten) {
  const Folder folder;
  for (const std::string& name : {std::string("K\xfcrbel"), std::string("two\nlines"), std::string("\"quoted\" 'twice'"),
                                  std::string("\xf0\x9f\x98\x80"), std::string(255, 'x'), std::string("-q"), std::string("a,b;c")}) {
    const fs::path scene = folder.write(name.substr(0, 200) + ".yaml", contents(example)), out = folder.path() / "results" / name;
    const Ended end = run(folder.path() / "log", run_command(scene, out, shortly));
    EXPECT_EQ(end.code, 0) << name << ": " << end.complained;
    const auto report = report_in(out);
    ASSERT_TRUE(report.is_object()) << name;
    EXPECT_EQ(report["status"], "finished");
    EXPECT_EQ(run(folder.path() / "log", {PINTLE_PROGRAM, "check", scene.string(), "--json", "--set", "run.until=1 ms"}).code, 0) << name;
  }
}

TEST(Names, ANameThatIsTooLongOrAFolderThatCannotBeWrittenIsRefusedAtOnce) {
  const Folder folder;
  const auto begin = std::chrono::steady_clock::now();
  const Ended longer = run(folder.path() / "log", run_command(example, folder.path() / std::string(256, 'x'), for_long));
  EXPECT_EQ(longer.code, 1);
  EXPECT_NE(longer.complained.find("shorter name"), std::string::npos) << longer.complained;
  const fs::path file = folder.write("file", "text");
  EXPECT_EQ(run(folder.path() / "log", run_command(example, file / "out", for_long)).code, 1);
  EXPECT_EQ(run(folder.path() / "log", run_command(example, "/proc/out", for_long)).code, 1);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(Names, TitlesThatAreNotUtf8AreRefusedWithTheirLine) {
  const Folder folder;
  std::string text = contents(example);
  for (const std::string& wrong :
       {std::string("K\xfcrbel"), std::string("\xed\xa0\x80"), std::string("\xe0\x80\x80"), std::string("\xf4\x90\x80\x80")}) {
    const fs::path scene = folder.write("scene.yaml", "\ntitle: " + wrong + "\n" + text.substr(text.find("gravity:")));
    const Ended end = run(folder.path() / "log", run_command(scene, folder.path() / "out", shortly));
    EXPECT_EQ(end.code, 2) << end.complained;
    EXPECT_NE(end.complained.find("scene.yaml:2"), std::string::npos) << end.complained;
    const Ended set = run(folder.path() / "log", run_command(example, folder.path() / "out", {"--set", "title=" + wrong}));
    EXPECT_EQ(set.code, 2) << set.complained;
    EXPECT_NE(set.complained.find("UTF-8"), std::string::npos) << set.complained;
  }
}

TEST(Names, DriversWhoseNamesMeetAsFilesHaveAFileEach) {
  const Folder folder;
  const fs::path scene = folder.write("scene.yaml", R"(
bodies:
  a: {rigid: {mass: 1, inertia: 1}}
  b: {rigid: {mass: 2, inertia: 2}}
  c: {rigid: {mass: 3, inertia: 3}}
  d: {rigid: {mass: 4, inertia: 4}}
joints:
  ja: {revolute: [ground, a]}
  jb: {revolute: [ground, b]}
  jc: {revolute: [ground, c]}
  jd: {revolute: [ground, d]}
drivers:
  "d d": {angle: [ground, a], law: t^2}
  "d_d": {angle: [ground, b], law: t^2}
  "D_d_2": {angle: [ground, c], law: t^2}
  "trajectory": {angle: [ground, d], law: t^2}
run: {until: 1}
)");
  const Ended end =
      run(folder.path() / "log", {PINTLE_PROGRAM, "inverse", scene.string(), "-o", (folder.path() / "out").string(), "--json"});
  ASSERT_EQ(end.code, 0) << end.complained;
  const auto drivers = nlohmann::json::parse(end.said)["drivers"];
  ASSERT_EQ(drivers.size(), 4U);
  double inertia = 0;
  for (const char* name : {"d d", "d_d", "D_d_2", "trajectory"}) {
    const std::string text = contents(folder.path() / "out" / drivers[name]["file"].get<std::string>());
    ASSERT_NE(text.find('\n'), std::string::npos) << name;
    const std::size_t row = text.find('\n') + 1, comma = text.find(',', row);
    EXPECT_NEAR(std::stod(text.substr(comma + 1)), 2 * ++inertia, 1e-9) << name;
  }
}

}  // namespace
