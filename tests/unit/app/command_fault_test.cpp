// What fault_test.cpp does to `run`, done to all other commands: every write, sync, rename and open fails in its turn, memory
// ends, the program is killed or asked to stop. Results are whole or kept and named; a sweep goes on to the same table.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "tests/unit/four_bar_text.h"
#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;

const std::string driven_four_bar = four_bar + R"(drivers: {motor: {angle: [ground, crank], law: 10 deg + 10 rad/s*t}}
run: {until: 0.01}
output: {frames: 3}
)";
const char* const plate = R"(
parameters: {n: 2}
bodies:
  plate:
    plate: {grid: {corners: [[0, 0], [1 m, 0], [1 m, 1 m], [0, 1 m]], cells: [n, n]}, thickness: 10 mm, element: quadrilateral8,
            young: 200 GPa, poisson: 0.3, density: 8000 kg/m^3}
    supports: {left: [x, y]}
static: {loads: {shear: {traction: [0, 1 MPa], on: right}}}
)";
const char* const study =
    "scene: scene.yaml\nmeasure: {work: work of motor}\nkeep: [angle of crank]\nsweep: {grid: {run.tolerance: [1e-6, 1e-7, 1e-8]}}\n";

struct Command {
  const char* verb;
  const char* input;
  Words more;
};
const Command commands[]{{"kinematics", "scene.yaml", {}},
                         {"inverse", "scene.yaml", {}},
                         {"statics", "scene.yaml", {}},
                         {"linearize", "scene.yaml", {}},
                         {"modes", "plate.yaml", {"--count", "1", "--frames", "2"}},
                         {"static", "plate.yaml", {}},
                         {"mesh", "plate.yaml", {}},
                         {"tradeoff", "scene.yaml", {"--quantity", "work of motor", "--budget", "50 ms", "--repeats", "1"}},
                         {"sweep", "study.yaml", {"--threads", "2"}},
                         {"merge", "part", {}}};

class Commands : public testing::TestWithParam<Command> {
 protected:
  void SetUp() override {
    folder_.write("scene.yaml", driven_four_bar), folder_.write("plate.yaml", plate), folder_.write("study.yaml", study);
    if (GetParam().verb == std::string("merge"))
      run(folder_.path() / "log", {PINTLE_PROGRAM, "sweep", (folder_.path() / "study.yaml").string(), "--shard", "1/1", "-q", "-o",
                                   (folder_.path() / "part").string()});
  }
  bool sweeps() const { return GetParam().verb == std::string("sweep"); }
  fs::path results() const { return folder_.path() / "results"; }
  fs::path out() const { return results() / "out"; }

  Words command() const {
    Words all{PINTLE_PROGRAM, GetParam().verb, (folder_.path() / GetParam().input).string(), "-o", out().string()};
    all.insert(all.end(), GetParam().more.begin(), GetParam().more.end());
    return all;
  }
  Ended run_program(const std::string& fault) {
    fs::remove_all(results());
    fs::create_directory(results());
    Words environment{"LD_PRELOAD=" PINTLE_FAULTS, "PINTLE_FAULT_UNDER=" + results().string(),
                      "PINTLE_FAULT_LOG=" + (folder_.path() / "counts").string(), "OPENBLAS_NUM_THREADS=1"};
    if (!fault.empty()) environment.push_back("PINTLE_FAULT=" + fault);
    return run(folder_.path() / "log", command(), environment);
  }
  /// What a run without faults writes, and how often it calls.
  void look() {
    const Ended end = run_program("");
    ASSERT_TRUE(end.code == 0 || (GetParam().verb == std::string("tradeoff") && end.code == 4)) << end.complained;
    code_ = end.code;
    names_ = names(out());
    if (sweeps()) table_ = contents(out() / "sweep.csv");
    std::istringstream log(contents(folder_.path() / "counts"));
    std::string name;
    for (long n = 0; log >> name >> n;) counted_[name] = n;
    ASSERT_GT(counted_["write"], 1);
  }
  static std::set<std::string> names(const fs::path& folder) {
    std::set<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) out.insert(fs::relative(entry.path(), folder).string());
    return out;
  }
  /// First, middle and last; all of them where that is asked for.
  std::set<long> places(const char* call) {
    std::set<long> out;
    const long n = counted_[call], each = dense_ ? 1 : std::max<long>(1, (n - 1) / 2);
    for (long k = 1; k <= n; k += each) out.insert(k);
    if (n > 0) out.insert(n);
    return out;
  }

  void expect_nothing_lost(const Ended& end, bool must_fail) {
    if (end.signal != SIGKILL) {
      if (end.signal != 0) {  // in a library that does not look at what it asked for: with words then
        EXPECT_NE(end.complained.find("pintle: crashed"), std::string::npos);
      }
      EXPECT_FALSE(end.code == code_ && must_fail) << "a failure is no success";
      if (end.code != code_) {
        EXPECT_FALSE(end.complained.empty());
        EXPECT_EQ(end.complained.find("bad_alloc"), std::string::npos);
      }
    }
    if (sweeps()) {
      if (fs::exists(out() / "sweep.csv") && end.complained.find("lacked memory") == std::string::npos) {
        EXPECT_EQ(contents(out() / "sweep.csv"), table_);
      }
      const Ended again = run(folder_.path() / "log", command());
      EXPECT_EQ(again.code, 0) << again.complained;
      EXPECT_EQ(contents(out() / "sweep.csv"), table_);
      return;
    }
    if (fs::exists(out()) &&
        end.complained.find("out of memory: after t =") != std::string::npos) {  // an end that is written like any other
      EXPECT_NE(contents(out() / (GetParam().verb + std::string(".json"))).find("out of memory"), std::string::npos);
    } else if (fs::exists(out())) {
      EXPECT_TRUE(std::ranges::includes(names(out()), names_)) << "not whole";
    }
    for (const auto& entry : fs::directory_iterator(results()))
      if (entry.path() != out() && end.signal != SIGKILL) {
        EXPECT_NE(end.complained.find(entry.path().string()), std::string::npos) << "kept without a word";
      }
  }
  void try_fault(const std::string& call, long k, const std::string& what, bool must_fail = false) {
    const std::string fault = call + ":" + std::to_string(k) + ":" + what;
    const Ended end = run_program(fault);
    SCOPED_TRACE(fault + ": exit code " + std::to_string(end.code) + ", signal " + std::to_string(end.signal) +
                 ", said: " + end.complained);
    expect_nothing_lost(end, must_fail);
  }

  Folder folder_;
  std::set<std::string> names_;
  std::string table_;
  std::map<std::string, long> counted_;
  int code_ = 0;
  const bool dense_ = std::getenv("PINTLE_FAULTS_DENSE") != nullptr;
};

#if defined(PINTLE_SANITIZED)
#define PINTLE_NEEDS_MALLOC GTEST_SKIP() << "the sanitizers have malloc to themselves"
#else
#define PINTLE_NEEDS_MALLOC static_cast<void>(0)
#endif

TEST_P(Commands, SayWhatCouldNotBeWrittenAndWhereTheRestIs) {
  PINTLE_NEEDS_MALLOC;
  look();
  for (const char* call : {"write", "sync", "rename", "open"})
    for (const long k : places(call)) {
      try_fault(call, k, std::to_string(ENOSPC) + ":on", true);
      if (dense_ || k == 1) try_fault(call, k, std::to_string(EIO) + ":once");
    }
}

TEST_P(Commands, KilledAtAnyStageLeaveNoPartOfAResult) {
  PINTLE_NEEDS_MALLOC;
  look();
  for (const char* call : {"write", "sync", "rename"})
    for (const long k : places(call))
      for (const char* when : {"kill:once", "kill-after:once"})
        if (dense_ || (k == 1) == (when[4] == ':')) try_fault(call, k, when);
}

TEST_P(Commands, SayInWordsThatMemoryEnds) {
  PINTLE_NEEDS_MALLOC;
  look();
  const long asked = counted_["memory"], samples = dense_ ? 200 : 4;
  ASSERT_GT(asked, 100);
  for (long i = 0; i < samples; ++i)
    for (const char* how : {"once", "on"}) try_fault("memory", 1 + asked * i / samples, std::to_string(ENOMEM) + ":" + how);
}

/// Waits until the program takes this signal itself.
bool catches(pid_t program, int signal) {
  for (int k = 0; k < 2000; ++k, std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
    std::istringstream status(contents("/proc/" + std::to_string(program) + "/status"));
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:") && ((std::stoull(line.substr(7), nullptr, 16) >> (signal - 1)) & 1) != 0) return true;
  }
  return false;
}

TEST_P(Commands, StoppedBySignalEndWithSixAndAWord) {
  const std::pair<int, const char*> signals[]{{SIGINT, "Ctrl-C"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}};
  // Much longer than any test waits.
  const std::string verb = GetParam().verb;
  if (verb == "merge") GTEST_SKIP() << "computes nothing that could take long";
  Words longer{"--set", "run.until=4000 s", "--set", "run.max steps=2000000000", "--set", "output.every=1 ms", "--set", "output.frames=0"};
  if (GetParam().input == std::string("plate.yaml")) longer = {"--set", "n=200"};
  Words all = command();
  if (verb == "tradeoff") all[static_cast<std::size_t>(std::ranges::find(all, "--budget") - all.begin()) + 1] = "1 h";
  if (verb == "statics" || verb == "linearize") {  // of a body whose shapes take long
    std::string text = plate;
    text.replace(text.find("    supports"), text.find("static:") - text.find("    supports"),
                 "    points: {O: [0, 0]}\n    modes: {frame: {tangent: O}, count: 4}\n");
    text.resize(text.find("static:"));
    folder_.write("scene.yaml", text + "joints: {pin: {revolute: [ground, plate.O]}}\n");
    longer = {"--set", "n=200"};
  }
  all.insert(all.end(), longer.begin(), longer.end());
  for (const auto& [signal, word] : signals) {
    fs::remove_all(results());
    fs::create_directory(results());
    const pid_t child = start(folder_.path() / "log", all);
    ASSERT_TRUE(catches(child, signal));
    // Until it writes, if it does that while it computes.
    for (int k = 0; k < 20 && fs::is_empty(results()); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ::kill(child, signal);
    const Ended end = wait_for(child, folder_.path() / "log");
    EXPECT_EQ(end.code, 6) << word << ", signal " << end.signal << ": " << end.complained;
    EXPECT_NE((end.said + end.complained).find(word), std::string::npos) << end.said << end.complained;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Commands, testing::ValuesIn(commands), [](const auto& one) { return std::string(one.param.verb); });

}  // namespace
