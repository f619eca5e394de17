// Sweeps: that the table does not depend on who did the work.
#include "framework/study/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <mutex>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "framework/common/text.h"
#include "tests/scenes/studies/sweep_folder.h"
#include "tests/unit/scarce_threads.h"
#include "tests/refusal.h"

namespace pintle::sweep_test {
namespace {

const std::string pendulum = pendulum_scene();
constexpr const char* study = R"(
scene: scene.yaml
measure: {turn: angle of rod at 0.2 s, load: peak force at hinge}
sweep: {grid: {angle: {from: -90 deg, to: 80 deg, count: 9}, length: [0.1 m, -0.2 m, 0.3 m], mass: [0.5 kg, -1 kg]}}
)";

/// The pendulum and a study of it, written and read.
Sweep sweep_in(const SweepFolder& folder, const std::string& text = study) {
  folder.write("scene.yaml", pendulum);
  folder.write("study.yaml", text);
  return read_sweep(folder / "study.yaml");
}
Sweep turned(const SweepFolder& folder, const std::string& sweep) {
  return sweep_in(folder, "scene: scene.yaml\nmeasure: {turn: final angle of rod}\nsweep: " + sweep + "\n");
}

/// What is said of a study of the pendulum.
std::string refusal_of(const SweepFolder& folder, const std::string& sweep) {
  return pintle_test::refusal_by([&] { turned(folder, sweep); });
}

TEST(Sweep, TheTableIsTheSameToTheBitForOneAndFourThreads) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  const SweepEnd one = run_sweep(sweep, folder / "one", {1, nullptr, {}}), four = run_sweep(sweep, folder / "four", {4, nullptr, {}});
  EXPECT_TRUE(one.whole && four.whole);
  EXPECT_EQ(one.rows.size(), 54u);
  EXPECT_EQ(contents(folder / "one/sweep.csv"), contents(folder / "four/sweep.csv"));
  EXPECT_EQ(contents(folder / "four/scene.yaml"), pendulum);
  EXPECT_EQ(contents(folder / "four/study.yaml"), study);
}

TEST(Sweep, ACaseThatFailsIsARowWithItsReason) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  const SweepEnd end = run_sweep(sweep, folder / "out", {2, nullptr, {}});
  for (const Row& r : end.rows) {
    const bool negative = r.number % 2 == 0;  // every second mass is
    EXPECT_EQ(r.status, negative ? "refused" : "finished") << r.number << ": " << r.reason;
    EXPECT_EQ(r.reason.empty(), !negative);
    EXPECT_EQ(std::isnan(r.values.at(0)), negative);
  }
  EXPECT_EQ(statuses(end.rows).at("refused"), 27u);
}

// Forces at a loose tolerance by generalised-alpha: `run` warns of them.
TEST(Sweep, ListsTheWarningsOfItsCases) {
  const SweepFolder folder;
  const Sweep sweep = turned(folder, "{grid: {run.method: [dopri5, generalized-alpha], run.tolerance: [1e-4, 1e-6]}}");
  const SweepEnd end = run_sweep(sweep, folder / "out", {1, nullptr, {}});
  ASSERT_EQ(end.rows.at(2).warnings.size(), 1u);
  EXPECT_NE(end.rows.at(2).warnings.front().find("generalised-α at a tolerance of 0.0001"), std::string::npos);
  EXPECT_EQ(contents(folder / "out/warnings.csv"), "case,warning\n3," + csv_field(end.rows.at(2).warnings.front()) + "\n");
  EXPECT_EQ(warnings_text(end.rows, "w.csv"), "1 case of 4 has warnings, see w.csv; case 3: " + end.rows.at(2).warnings.front());
  EXPECT_EQ(nlohmann::json::parse(contents(folder / "out/sweep.json")).at("cases with warnings"), 1);
  run_sweep(turned(folder, "{grid: {run.method: [dopri5]}}"), folder / "none", {1, nullptr, {}});
  EXPECT_FALSE(fs::exists(folder / "none/warnings.csv"));
}

TEST(Sweep, StepsMayBeLimitedForAllCases) {
  const SweepFolder folder;
  const SweepEnd end = run_sweep(turned(folder, "{list: [{angle: 0 deg}], most steps: 3}"), folder / "out", {1, nullptr, {}});
  EXPECT_EQ(end.rows.at(0).status, "failed");
  EXPECT_EQ(end.rows.at(0).steps, 3);
  EXPECT_LT(end.rows.at(0).t_end, 0.2);
}

TEST(Sweep, TimeMayBeLimitedForEachCase) {
  const SweepFolder folder;
  const SweepEnd end = run_sweep(turned(folder, "{list: [{angle: 0 deg}], limit: 1 ns}"), folder / "out", {1, nullptr, {}});
  EXPECT_TRUE(end.whole);
  EXPECT_EQ(end.rows.at(0).status, "over its limit");
  EXPECT_FALSE(end.rows.at(0).reason.empty());
}

TEST(Sweep, StoppedItGoesOnAndNothingRunsTwice) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  run_sweep(sweep, folder / "whole", {1, nullptr, {}});
  // Three sessions of at most some cases, as if stopped by hand.
  SweepEnd end;
  for (int session = 0; session < 3; ++session) {
    const SweepCount before = end.count;
    end = run_sweep(sweep, folder / "out", {1, nullptr, [](const SweepCount&) { return false; }});
    EXPECT_GE(end.count.before, before.before + before.done);
    EXPECT_EQ(fs::exists(folder / "out/sweep.csv"), end.whole);
    EXPECT_EQ(fs::exists(folder / "out/sweep-so-far.csv"), !end.whole);
    const std::string table = contents(folder / "out" / (end.whole ? "sweep.csv" : "sweep-so-far.csv"));
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + static_cast<std::ptrdiff_t>(end.rows.size()));
    EXPECT_EQ(table.find("case,"), 0u);
    EXPECT_EQ(table.find("case,", 1), std::string::npos) << "a second header";
  }
  end = run_sweep(sweep, folder / "out", {2, nullptr, {}});
  EXPECT_TRUE(end.whole);
  EXPECT_FALSE(fs::exists(folder / "out/sweep-so-far.csv"));
  EXPECT_EQ(contents(folder / "out/sweep.csv"), contents(folder / "whole/sweep.csv"));
  const std::string journal = contents(journal_path(folder / "out", 0));
  EXPECT_EQ(std::count(journal.begin(), journal.end(), '\n'), 1 + 54);
  run_sweep(sweep, folder / "out", {2, nullptr, {}});
  EXPECT_EQ(contents(journal_path(folder / "out", 0)), journal);
}

TEST(Sweep, AFolderOfAnotherStudyIsRefused) {
  const SweepFolder folder;
  run_sweep(turned(folder, "{list: [{angle: 0 deg}]}"), folder / "out", {1, nullptr, {}});
  const auto refusal = [&] {
    return pintle_test::refusal_by([&] { run_sweep(read_sweep(folder / "study.yaml"), folder / "out", {1, nullptr, {}}); });
  };
  EXPECT_EQ(refusal(), "accepted");
  folder.write("scene.yaml", pendulum + "# changed\n");
  EXPECT_NE(refusal().find("belongs to another study. The scene differs from the one that ran there"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("--out"), std::string::npos);
  fs::create_directories(folder / "other");
  folder.write("other/thesis.txt", "x");
  EXPECT_THROW(run_sweep(read_sweep(folder / "study.yaml"), folder / "other", {1, nullptr, {}}), SceneError);
}

TEST(Sweep, ATableThatTheSceneNamesBelongsToTheStudy) {
  const SweepFolder folder;
  folder.write("push.csv", "0 0\n1 2\n");
  folder.write("scene.yaml", pendulum + "forces: {push: {torque: {table: push.csv}, on: rod}}\n");
  folder.write("study.yaml", "scene: scene.yaml\nmeasure: {turn: final angle of rod}\nsweep: {list: [{angle: 0 deg}]}\n");
  const std::uint64_t before = read_sweep(folder / "study.yaml").print;
  EXPECT_EQ(read_sweep(folder / "study.yaml").print, before);
  folder.write("push.csv", "0 0\n1 3\n");
  EXPECT_NE(read_sweep(folder / "study.yaml").print, before);
}

TEST(Sweep, AStudyThatIsWrongIsRefusedBeforeAnyCaseRuns) {
  struct Wrong {
    const char *sweep, *place, *says;
  };
  for (const Wrong& w : std::vector<Wrong>{
           {"{grid: {lenght: [0.1 m, 0.2 m]}}", "sweep.grid.lenght: ", "Did you mean \"length\"?"},
           {"{grid: {angle: [0, 1], bodies.rod.rigid.mas: [1]}}", "sweep.grid.bodies.rod.rigid.mas: ", "Did you mean \"mass\"?"},
           {"{list: [{angle: 0}, {angle: 1, run.tolerence: 1e-6}]}", "sweep.list[2].run.tolerence: ", "Did you mean \"tolerance\"?"},
           {"{random: {count: 3, length: {from: 1 kg, to: 2 kg}}}", "sweep.random.length: ", "kg\" is a mass"},
           {"{grid: {length: [0.1 mm, 5 kg, 0.3 mm]}}", "sweep.grid.length: ", "\"5 kg\" is a mass"},
           {"{grid: {length: [0.1, 5 kg, 0.3]}}", "sweep.grid.length: ", "\"5 kg\" is a mass"},
           {"{grid: {bodies.rod.rigid.mass: [5 m, 1, 2 kg]}}", "sweep.grid.bodies.rod.rigid.mass: ", "\"5 m\" is a length"},
           {"{list: {length: [0.1 mm, 0.2 mm], mass: [1 kg, 1 s]}}", "sweep.list.mass: ", "\"1 s\" is a time"},
           {"{grid: {length: []}}", "sweep.grid.length: ", "is an empty list"},
           {"{random: {count: 3, length: []}}", "sweep.random.length: ", "is an empty list"}}) {
    SCOPED_TRACE(w.sweep);
    const SweepFolder folder;
    pintle_test::expect_says(refusal_of(folder, w.sweep), {std::string("study.yaml:3: ") + w.place, w.says});
  }
}

TEST(Sweep, AValueThatTheSceneRefusesForItselfIsACase) {
  for (const char* sweep : {"{grid: {mass: [1 kg, -1 kg]}}", "{grid: {length: [0.1 m, 0.2 m], mass: [-1 kg, -2 kg, 1]}}",
                            "{list: [{angle: 0, mass: -1}, {angle: 1, mass: 2}]}", "{grid: {run.method: [dopri5, euler]}}"}) {
    const SweepFolder folder;
    EXPECT_EQ(refusal_of(folder, sweep), "accepted") << sweep;
  }
}

TEST(Sweep, AHeaderHasTheUnitThatTheSceneTook) {
  const SweepFolder folder;
  struct Column {
    std::string sweep, header;
  };
  const std::string mass = "bodies.rod.rigid.mass";  // -3 is wrong in any unit
  for (const Column& c : std::vector<Column>{{"{grid: {bodies.rod.rigid.mass: [1, -3 m, 2 kg]}}", mass + " [kg]"},
                                             {"{grid: {bodies.rod.rigid.mass: [-3 m, 2]}}", mass},
                                             {"{list: [{angle: 1}, {angle: 5 deg}, {angle: wrong}]}", "angle [rad]"},
                                             {"{list: [{run.method: dopri5}, {run.method: rkf45}]}", "run.method"}}) {
    const Sweep sweep = turned(folder, c.sweep);
    fs::remove_all(folder / "out");
    const std::string table = sweep_csv(sweep, run_sweep(sweep, folder / "out", {1, nullptr, {}}).rows);
    EXPECT_TRUE(table.starts_with("case," + c.header + ",turn [rad],")) << table;
  }
}

TEST(Sweep, RunsItsCasesInTheThreadsThatCanBeStartedAndSaysSo) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  run_sweep(sweep, folder / "plenty", {1, nullptr, {}});
  for (int allowed : {0, 1, 3}) {
    const fs::path out = folder / std::to_string(allowed);
    SweepEnd end;
    {
      const ScarceThreads scarce(allowed);
      end = run_sweep(sweep, out, {4, nullptr, {}});
    }
    EXPECT_TRUE(end.whole) << allowed;
    EXPECT_EQ(end.workers, std::max(allowed, 1));
    EXPECT_EQ(contents(out / "sweep.csv"), contents(folder / "plenty/sweep.csv")) << allowed;
    EXPECT_TRUE(end.shortage.starts_with(std::to_string(allowed) + " of 4 threads could be started")) << end.shortage;
    EXPECT_NE(end.shortage.find("--threads"), std::string::npos) << end.shortage;
  }
}

TEST(Sweep, WithoutAThreadItCanStillBeStopped) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  const ScarceThreads scarce(0);
  EXPECT_FALSE(run_sweep(sweep, folder / "out", {2, nullptr, [](const SweepCount&) { return false; }}).whole);
  EXPECT_TRUE(run_sweep(sweep, folder / "out", {2, nullptr, {}}).whole);
}

/// Processes played by threads: what MPI does, without it.
class Post {
 public:
  explicit Post(int size) : boxes_(static_cast<std::size_t>(size)) {}
  struct Letter {
    int from;
    std::vector<std::int64_t> text;
  };
  std::vector<std::vector<Letter>> boxes_;
  std::mutex mutex_;
};
class Played : public Communicator {
 public:
  Played(Post& post, int rank) : post_(post), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(post_.boxes_.size()); }
  void send(int to, std::span<const std::int64_t> text) override {
    const std::lock_guard lock(post_.mutex_);
    post_.boxes_[static_cast<std::size_t>(to)].push_back({rank_, {text.begin(), text.end()}});
  }
  bool receive(int& from, std::vector<std::int64_t>& text) override {
    const std::lock_guard lock(post_.mutex_);
    auto& box = post_.boxes_[static_cast<std::size_t>(rank_)];
    if (box.empty()) return false;
    from = box.front().from, text = box.front().text;
    box.erase(box.begin());
    return true;
  }

 private:
  Post& post_;
  int rank_;
};

TEST(Sweep, ProcessesShareTheCasesAndEachIsRunOnce) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  run_sweep(sweep, folder / "alone", {1, nullptr, {}});
  for (int size : {1, 2, 5}) {
    const fs::path out = folder / std::to_string(size);
    Post post(size);
    std::vector<std::thread> processes;
    SweepEnd end;
    for (int rank = size - 1; rank >= 0; --rank)
      processes.emplace_back([&, rank] {
        Played communicator(post, rank);
        const SweepEnd mine = run_sweep(sweep, out, {rank == 1 ? 2 : 1, &communicator, {}});
        if (rank == 0) end = mine;
      });
    for (std::thread& p : processes) p.join();
    EXPECT_TRUE(end.whole);
    EXPECT_EQ(end.count.done, 54u);
    EXPECT_EQ(contents(out / "sweep.csv"), contents(folder / "alone/sweep.csv"));
    std::ptrdiff_t lines = 0;
    for (int rank = 0; rank < size; ++rank) {
      const std::string journal = contents(journal_path(out, rank));
      lines += std::count(journal.begin(), journal.end(), '\n');
    }
    EXPECT_EQ(lines, 54 + size);
    for (const auto& box : post.boxes_) EXPECT_TRUE(box.empty()) << "a message was left unread";
  }
}

TEST(Sweep, ProcessesShareTheCasesOfAPart) {
  const SweepFolder folder;
  Sweep sweep = sweep_in(folder);
  sweep.part = SweepPart{2, 3};
  const SweepEnd alone = run_sweep(sweep, folder / "alone", {1, nullptr, {}});
  EXPECT_EQ(alone.rows.size(), 18u);
  Post post(2);
  SweepEnd ends[2];
  const auto play = [&](int rank) {
    Played communicator(post, rank);
    ends[rank] = run_sweep(sweep, folder / "out", {1, &communicator, {}});
  };
  std::thread second(play, 1);
  play(0);
  second.join();
  EXPECT_TRUE(ends[0].whole);
  EXPECT_EQ(ends[0].count.done, 18u);
  EXPECT_EQ(contents(folder / "out/sweep-part.csv"), contents(folder / "alone/sweep-part.csv"));
}

TEST(Sweep, ProcessesWithoutThreadsShareTheCasesToo) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  Post post(2);
  SweepEnd ends[2];
  const auto play = [&](int rank) {
    Played communicator(post, rank);
    ends[rank] = run_sweep(sweep, folder / "out", {1, &communicator, {}});
  };
  const ScarceThreads scarce(1);  // for the second process; neither has one for its cases
  std::thread second(play, 1);
  play(0);
  second.join();
  EXPECT_TRUE(ends[0].whole);
  EXPECT_EQ(ends[0].count.done, 54u);
  for (const SweepEnd& end : ends) EXPECT_TRUE(end.shortage.starts_with("0 of 1 threads")) << end.shortage;
}

TEST(Sweep, OneProcessThatIsStoppedStopsAll) {
  const SweepFolder folder;
  const Sweep sweep = sweep_in(folder);
  Post post(3);
  std::vector<std::thread> processes;
  SweepEnd end;
  for (int rank = 0; rank < 3; ++rank)
    processes.emplace_back([&, rank] {
      Played communicator(post, rank);
      const SweepEnd mine = run_sweep(sweep, folder / "out", {1, &communicator, [rank](const SweepCount&) { return rank != 2; }});
      if (rank == 0) end = mine;
    });
  for (std::thread& p : processes) p.join();
  EXPECT_LE(end.rows.size(), 54u);
  EXPECT_EQ(end.whole, end.rows.size() == 54);
  end = run_sweep(sweep, folder / "out", {1, nullptr, {}});
  EXPECT_TRUE(end.whole);
}

}  // namespace
}  // namespace pintle::sweep_test
