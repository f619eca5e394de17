// Films as ffprobe sees them, made by the program itself; skipped where ffmpeg is not installed.
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;

std::string in_path(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((fs::path(folder) / program).c_str(), X_OK) == 0) return (fs::path(folder) / program).string();
  return "";
}

/// Eleven frames of 0.1 s.
constexpr const char* pendulum = R"(
gravity: [0, -9.81]
bodies: {rod: {rigid: {mass: 1, inertia: 0.1, center: [0, -1]}, points: {O: [0, 0], tip: [0, -1.5]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: 0.5}}
run: {until: 0.1}
output: {every: 0.01, frames: 11}
)";

class Film : public testing::Test {
 protected:
  void SetUp() override {
    if (fs::path(PINTLE_BESIDE).empty()) GTEST_SKIP() << "the program that draws was not built: apt-get install libcairo2-dev pkgconf";
    if (in_path("ffmpeg").empty() || in_path("ffprobe").empty()) GTEST_SKIP() << "there is no ffmpeg here: apt-get install ffmpeg";
    ASSERT_EQ(run_with(pendulum).code, 0);
  }
  Ended run_with(const std::string& scene) {
    folder_.write("scene.yaml", scene);
    fs::remove_all(folder_.path() / "out");
    return program({"run", "scene.yaml", "-q", "-o", "out"});
  }
  /// In the folder of this test.
  Words command(const Words& words) const {
    Words all{"/usr/bin/env", "-C", folder_.path().string(), PINTLE_PROGRAM};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  }
  Ended program(const Words& words, const Words& environment = {}) const {
    return pintle_test::run(folder_.path() / "log", command(words), environment);
  }
  /// What ffprobe says of a film: "width", "height", "nb_read_frames", "r_frame_rate".
  std::string probed(const std::string& film, const std::string& what) const {
    const Ended end =
        pintle_test::run(folder_.path() / "probe",
                         {in_path("ffprobe"), "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries", "stream=" + what,
                          "-of", "default=nokey=1:noprint_wrappers=1", "file:" + (folder_.path() / film).string()});
    return end.said.substr(0, end.said.find('\n'));
  }
  /// Files whose names begin so.
  long files(const std::string& beginning) const {
    long count = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      count += entry.path().filename().string().starts_with(beginning) ? 1 : 0;
    return count;
  }
  Folder folder_;
};

TEST_F(Film, HasEveryFrameOnceInTheSizeAndAtTheRateAskedFor) {
  const Ended end = program({"film", "out", "film.mp4", "--size", "640x361", "--fps", "20"});
  ASSERT_EQ(end.code, 0) << end.complained;
  EXPECT_EQ(probed("film.mp4", "nb_read_frames"), "11");
  EXPECT_EQ(probed("film.mp4", "width"), "640");
  EXPECT_EQ(probed("film.mp4", "height"), "360");  // even, as H.264 asks
  EXPECT_EQ(probed("film.mp4", "r_frame_rate"), "20/1");
  EXPECT_NEAR(std::stod(probed("film.mp4", "duration")), 11 / 20.0, 1e-3);
}

TEST_F(Film, LastsTheTimeOfTheRunOverItsSpeed) {
  // 0.05 s at a fortieth: 2 s, from the first picture to the last 20 steps of a tenth
  const Ended end =
      program({"film", "out", "slow.mp4", "--size", "400", "--fps", "10", "--speed", "0.025", "--from", "0.02", "--to", "0.07"});
  ASSERT_EQ(end.code, 0) << end.complained;
  EXPECT_EQ(probed("slow.mp4", "nb_read_frames"), "21");
}

TEST_F(Film, IsPackedAsItsNameEnds) {
  for (const auto& [file, codec] : {std::pair("film.webm", "vp9"), std::pair("film.gif", "gif"), std::pair("film.mp4", "h264")}) {
    const Ended end = program({"film", "out", file, "--size", "300x200"});
    ASSERT_EQ(end.code, 0) << end.complained;
    EXPECT_EQ(probed(file, "codec_name"), codec);
    EXPECT_EQ(probed(file, "nb_read_frames"), "11") << file;
  }
}

TEST_F(Film, TakesAnyNameForANameAlone) {
  for (const std::string name : {"-y $(touch owned) `touch owned`; touch owned.mp4", "http:nowhere|concat:%03d.mp4"}) {
    const Ended end = program({"film", "-q", "--size", "300x200", "--", "out", name});
    EXPECT_EQ(end.code, 0) << end.complained;
    EXPECT_EQ(probed(name, "nb_read_frames"), "11") << name;
  }
  EXPECT_EQ(files("owned"), 0);
}

TEST_F(Film, WithoutFfmpegSaysHowToGetItAndLeavesNothing) {
  const Ended end = program({"film", "out", "film.mp4"}, {"PATH=/nowhere"});
  EXPECT_EQ(end.code, 1);
  EXPECT_NE(end.complained.find("apt-get install ffmpeg"), std::string::npos) << end.complained;
  EXPECT_EQ(files("film"), 0);
}

TEST_F(Film, OfARunWithoutFramesSaysHowToGetThem) {
  ASSERT_EQ(program({"run", "scene.yaml", "-q", "-o", "bare", "--set", "output.frames=0"}).code, 0);
  const Ended end = program({"film", "bare", "film.mp4"});
  EXPECT_EQ(end.code, 1);
  EXPECT_NE(end.complained.find("--set output.frames="), std::string::npos) << end.complained;
}

TEST_F(Film, IsNotThereWhereItsFolderIsNot) {
  const Ended end = program({"film", "out", "missing/film.mp4", "--size", "300x200"});
  EXPECT_EQ(end.code, 1);
  EXPECT_NE(end.complained.find("missing/film.mp4"), std::string::npos) << end.complained;
}

TEST_F(Film, StoppedByTheUserLeavesNothingAndEndsWithCodeSix) {
  // Fifty thousand pictures would take minutes; it is stopped as soon as ffmpeg has begun its file.
  const pid_t child =
      start(folder_.path() / "stopped", command({"film", "out", "long.mp4", "--size", "1600x1200", "--fps", "100", "--speed", "0.0002"}));
  using clock = std::chrono::steady_clock;
  for (const auto begin = clock::now(); files("long") == 0 && clock::now() - begin < std::chrono::minutes(2);)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child, SIGINT);
  const Ended end = wait_for(child, folder_.path() / "stopped");
  EXPECT_EQ(end.code, 6) << end.complained;
  EXPECT_EQ(files("long"), 0);
}

TEST_F(Film, ARunWritesAFrameAtEachHundredthUnlessItIsToldOtherwise) {
  std::string scene = pendulum;
  scene.replace(scene.find(", frames: 11"), std::string(", frames: 11").size(), "");
  ASSERT_EQ(run_with(scene).code, 0);
  long frames = 0;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "out" / "frames"))
    frames += std::isdigit(static_cast<unsigned char>(entry.path().filename().string().front())) != 0 ? 1 : 0;
  EXPECT_EQ(frames, 101);
}

}  // namespace
