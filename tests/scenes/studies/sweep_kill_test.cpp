// The program itself, killed with SIGKILL ten times while it sweeps: nothing is lost, nothing runs twice, and the table
// is the one that a sweep in one go makes.
#include <csignal>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;
constexpr int cases = 400;

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream s;
  s << in.rdbuf();
  return s.str();
}

/// Started as the first of a session, by which its children are found as well.
pid_t start(const Command& command, const fs::path& log) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::setsid();
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  std::vector<char*> words;
  for (const std::string& w : command) words.push_back(const_cast<char*>(w.c_str()));
  words.push_back(nullptr);
  ::execv(words[0], words.data());
  ::_exit(127);
}

/// Every process of the session, at once: the launcher does not get to tidy up. The first is named, it may not have begun the session yet.
void kill_session(pid_t session) {
  ::kill(session, SIGKILL);
  for (int round = 0; round < 2; ++round)
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      const pid_t pid = std::stoi(name);
      if (::getsid(pid) == session) ::kill(pid, SIGKILL);
    }
}

/// Finished cases in the journals, a number for each line.
std::vector<int> journalled(const fs::path& folder) {
  std::vector<int> out;
  if (!fs::exists(folder)) return out;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.path().filename().string().starts_with("journal-")) continue;
    const std::string text = contents(entry.path());
    for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
      if (const std::size_t key = text.find("{\"case\":", at); key < end) out.push_back(std::stoi(text.substr(key + 8)));
  }
  return out;
}

// A folder in memory, if there is one: what a killed process has written remains there as on a disk, and nothing waits for a disk.
std::optional<fs::path> in_memory() {
  const char* folder = "/dev/shm";
  return ::access(folder, W_OK | X_OK) == 0 ? std::optional<fs::path>(folder) : std::nullopt;
}

class SweepKilled : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = in_memory().value_or(fs::temp_directory_path()) / ("pintle-killed-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "study.yaml")
        << "scene: " PINTLE_SOURCE_DIR
           "/examples/paper/fig05_clearance_001.yaml\n"
           "set: {run.tolerance: 1e-7, length: 4 ms}\n"
           "measure: {lost: energy lost, x: x of slider at 3 ms}\n"
           "sweep: {latin hypercube: {count: "
        << cases
        << ", seed: 7, "
           "clearance: {from: 0.01 mm, to: 0.5 mm, scale: log}, speed: {from: 50 rad/s, to: 200 rad/s}}}\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// @param enough  when to kill it  @returns exit code; −9: killed before it ended
  int run(
      const Command& command, const std::function<bool()>& enough = [] { return false; }) {
    const pid_t child = start(command, folder_ / "log");
    for (;;) {
      int status = 0;
      pid_t over = ::waitpid(child, &status, WNOHANG);
      if (over == 0 && enough()) {
        kill_session(child);
        over = ::waitpid(child, &status, 0);
      }
      if (over == child) return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  void kill_ten_times(const Command& launcher, const Command& more) {
    const auto command = [&](const char* out) {
      Command all = launcher;
      all.insert(all.end(), {PINTLE_PROGRAM, "sweep", folder_ / "study.yaml", "-q", "--out", folder_ / out});
      all.insert(all.end(), more.begin(), more.end());
      return all;
    };
    ASSERT_EQ(run(command("whole")), 0) << contents(folder_ / "log");

    // A machine may finish a sweep before its next kill: it is then judged and begun again.
    const auto judge = [&] {
      EXPECT_EQ(journalled(folder_ / "killed").size(), static_cast<std::size_t>(cases));
      EXPECT_EQ(contents(folder_ / "killed/sweep.csv"), contents(folder_ / "whole/sweep.csv"));
    };
    std::random_device seed;
    std::mt19937_64 random(seed());
    std::vector<int> ended;
    std::size_t most = 0;
    for (int kills = 0; kills < 10;) {
      // The first at any moment of the start; the others when up to some thirty more cases have ended, and a moment later.
      const std::size_t target = kills == 0 ? 0 : ended.size() + random() % 30;
      const auto moment = std::chrono::microseconds(random() % (kills == 0 ? 300'000 : 10'000));
      const auto enough = [&] {
        if (journalled(folder_ / "killed").size() < target) return false;
        std::this_thread::sleep_for(moment);
        return true;
      };
      const int code = run(command("killed"), enough);
      ASSERT_TRUE(code == -SIGKILL || code == 0) << code << '\n' << contents(folder_ / "log");
      const std::vector<int> now = journalled(folder_ / "killed");
      const std::set<int> unique(now.begin(), now.end());
      EXPECT_EQ(unique.size(), now.size()) << "a case was run twice";
      for (int k : ended) EXPECT_TRUE(unique.contains(k)) << "case " << k << " was lost";
      ended = now;
      most = std::max(most, ended.size());
      if (code == -SIGKILL) {
        ++kills;
      } else {
        judge();
        fs::remove_all(folder_ / "killed");
        ended.clear();
      }
    }
    EXPECT_GT(most, 10u);
    ASSERT_EQ(run(command("killed")), 0) << contents(folder_ / "log");
    judge();
    const std::string table = contents(folder_ / "whole/sweep.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), cases + 1);
  }

  fs::path folder_;
};

TEST_F(SweepKilled, TenTimesItLosesNothingAndRunsNothingTwice) { kill_ten_times({}, {"--threads", "2"}); }

TEST_F(SweepKilled, TenTimesUnderMpiItLosesNothingAndRunsNothingTwice) {
  if (std::string(PINTLE_MPIRUN).empty()) GTEST_SKIP() << "built without MPI";
  kill_ten_times({PINTLE_MPIRUN, "--oversubscribe", "-n", "2"}, {});
}

TEST_F(SweepKilled, APartLosesNothingAndIsMergedWhenItIsFinished) {
  const auto command = [&](const char* out, const Command& more) {
    Command all{PINTLE_PROGRAM, "sweep", folder_ / "study.yaml", "-q", "--threads", "2", "--out", folder_ / out};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const Command first = command("first", {"--shard", "1/2"});
  const Command merge{PINTLE_PROGRAM, "merge", "-q", folder_ / "second", folder_ / "first", "--out", folder_ / "merged"};
  ASSERT_EQ(run(command("whole", {})), 0) << contents(folder_ / "log");
  ASSERT_EQ(run(command("second", {"--shard", "2/2"})), 0) << contents(folder_ / "log");
  for (const std::size_t target : {0u, 20u, 60u}) {
    const std::vector<int> before = fs::exists(folder_ / "first") ? journalled(folder_ / "first") : std::vector<int>();
    ASSERT_EQ(run(first, [&] { return fs::exists(folder_ / "first") && journalled(folder_ / "first").size() >= target; }), -SIGKILL);
    const std::vector<int> now = journalled(folder_ / "first");
    EXPECT_TRUE(std::ranges::equal(before, std::vector<int>(now.begin(), now.begin() + static_cast<std::ptrdiff_t>(before.size()))));
    EXPECT_EQ(run(merge), 2) << contents(folder_ / "log");
    EXPECT_FALSE(fs::exists(folder_ / "merged"));
  }
  const std::string said = contents(folder_ / "log");
  EXPECT_NE(said.find("of its 200 cases. Finish it with the command that began it: pintle sweep "), std::string::npos) << said;
  ASSERT_EQ(run(first), 0) << contents(folder_ / "log");
  EXPECT_EQ(journalled(folder_ / "first").size(), cases / 2u);
  ASSERT_EQ(run(merge), 0) << contents(folder_ / "log");
  EXPECT_EQ(contents(folder_ / "merged/sweep.csv"), contents(folder_ / "whole/sweep.csv"));
}

TEST_F(SweepKilled, AFitComesToTheSameBits) {
  std::ofstream(folder_ / "fit.yaml")
      << "scene: " PINTLE_SOURCE_DIR
         "/examples/paper/fig05_clearance_001.yaml\n"
         "set: {run.tolerance: 1e-7, length: 4 ms}\ngoal: {minimise: energy lost}\n"
         "vary: {speed: {from: 50 rad/s, to: 200 rad/s}, clearance: {from: 0.01 mm, to: 0.5 mm, scale: log}}\n"
         "fit: {starts: 2, evaluations: 120}\n";
  const auto command = [&](const char* out, const char* threads) {
    return Command{PINTLE_PROGRAM, "fit", folder_ / "fit.yaml", "-q", "--threads", threads, "--out", folder_ / out};
  };
  ASSERT_EQ(run(command("whole", "1")), 0) << contents(folder_ / "log");
  for (const std::size_t most : {1u, 20u, 60u}) run(command("killed", "2"), [&] { return journalled(folder_ / "killed").size() >= most; });
  ASSERT_EQ(run(command("killed", "3")), 0) << contents(folder_ / "log");
  for (const char* file : {"fit.csv", "fitted.yaml"})
    EXPECT_EQ(contents(folder_ / "killed" / file), contents(folder_ / "whole" / file)) << file;
}

/// Sockets that the program's processes listen at, from all networks: the inodes that they hold, looked up in /proc/net.
int open_to_networks(const std::string& program) {
  std::set<std::string> listening;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream in(table);
    std::string line;
    for (std::getline(in, line); std::getline(in, line);) {
      std::istringstream fields(line);
      std::string number, local, remote, state, queues, timer, retransmissions, user, timeout, inode;
      fields >> number >> local >> remote >> state >> queues >> timer >> retransmissions >> user >> timeout >> inode;
      const bool anywhere = local.substr(0, local.find(':')).find_first_not_of('0') == std::string::npos;
      if (state == "0A" && anywhere) listening.insert("socket:[" + inode + "]");
    }
  }
  int count = 0;
  std::error_code gone;
  for (const auto& process : fs::directory_iterator("/proc", gone)) {
    if (fs::read_symlink(process.path() / "exe", gone) != fs::canonical(program)) continue;
    for (const auto& file : fs::directory_iterator(process.path() / "fd", gone))
      count += listening.contains(fs::read_symlink(file.path(), gone).string());
  }
  return count;
}

TEST_F(SweepKilled, OnOneMachineNoProcessListensToTheNetwork) {
  if (std::string(PINTLE_MPIRUN).empty()) GTEST_SKIP() << "built without MPI";
  const Command command{
      PINTLE_MPIRUN, "--allow-run-as-root", "--oversubscribe", "-n", "2", PINTLE_PROGRAM, "sweep", folder_ / "study.yaml", "-q",
      "--out",       folder_ / "out"};
  const pid_t child = start(command, folder_ / "log");
  while (journalled(folder_ / "out").size() < 2) {
    ASSERT_EQ(::waitpid(child, nullptr, WNOHANG), 0) << contents(folder_ / "log");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(open_to_networks(PINTLE_PROGRAM), 0);
  ::kill(child, SIGINT);
  ::waitpid(child, nullptr, 0);
}

TEST_F(SweepKilled, AskedToStopItLeavesWhatItHasAndExitsWithSix) {
  const Command command{PINTLE_PROGRAM, "sweep", folder_ / "study.yaml", "-q", "--out", folder_ / "out", "--threads", "1"};
  const pid_t child = start(command, folder_ / "log");
  while (journalled(folder_ / "out").size() < 3 && ::kill(child, 0) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::kill(child, SIGINT);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 6) << contents(folder_ / "log");
  EXPECT_FALSE(fs::exists(folder_ / "out/sweep.csv"));
  const std::string table = contents(folder_ / "out/sweep-so-far.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + static_cast<std::ptrdiff_t>(journalled(folder_ / "out").size()));
}

TEST_F(SweepKilled, NeverBeginsWithANumberOfThreadsThatIsNone) {
  for (const std::string number : {"0", "2.5", "-1", "many", "4097"}) {
    fs::remove(folder_ / "log");
    EXPECT_EQ(run({PINTLE_PROGRAM, "sweep", folder_ / "study.yaml", "--out", folder_ / "out", "--threads=" + number}), 2);
    const std::string said = contents(folder_ / "log");
    EXPECT_NE(said.find("--threads: must be a whole number from 1 to 4096, not \"" + number + "\""), std::string::npos) << said;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

}  // namespace
