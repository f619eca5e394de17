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

class Picture : public testing::Test {
 protected:
  void SetUp() override {
    if (fs::path(PINTLE_BESIDE).empty()) GTEST_SKIP() << "the program that draws was not built: apt-get install libcairo2-dev pkgconf";
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
  /// Files whose names begin so.
  long files(const std::string& beginning) const {
    long count = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      count += entry.path().filename().string().starts_with(beginning) ? 1 : 0;
    return count;
  }
  /// In one line that begins as every error does, with all these parts.
  void expect_refused(const Words& words, const Words& parts, int code = 2) const {
    std::string line;
    for (const std::string& word : words) line += word + ' ';
    const Ended end = program(words);
    EXPECT_EQ(end.code, code) << line << end.complained;
    EXPECT_EQ(end.complained.find("pintle: "), 0U) << line << end.complained;
    EXPECT_EQ(end.complained.find('\n'), end.complained.size() - 1) << line << end.complained;
    for (const std::string& part : parts) EXPECT_NE(end.complained.find(part), std::string::npos) << line << end.complained;
  }
  Folder folder_;
};

class Film : public Picture {
 protected:
  void SetUp() override {
    Picture::SetUp();
    if (IsSkipped()) return;
    if (in_path("ffmpeg").empty() || in_path("ffprobe").empty()) GTEST_SKIP() << "there is no ffmpeg here: apt-get install ffmpeg";
  }
  /// What ffprobe says of a film: "width", "height", "nb_read_frames", "r_frame_rate".
  std::string probed(const std::string& film, const std::string& what) const {
    const Ended end =
        pintle_test::run(folder_.path() / "probe",
                         {in_path("ffprobe"), "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries", "stream=" + what,
                          "-of", "default=nokey=1:noprint_wrappers=1", "file:" + (folder_.path() / film).string()});
    return end.said.substr(0, end.said.find('\n'));
  }
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

TEST_F(Picture, SizesTimesAndSpeedsThatAreNoneAreRefusedByName) {
  for (const std::string size : {"0x0", "12", "axb", "-5x5", "400x", "400x300x", "400y300", "1e3", "9000", "4294967696", ""})
    expect_refused({"picture", "out", "a.png", "--size", size}, {"--size " + size, "such as 1400x800"});
  for (const std::string speed : {"0", "-1", "nan", "inf", "slow"})
    expect_refused({"film", "out", "a.mp4", "--speed", speed}, {"--speed", speed, "above 0"});
  expect_refused({"picture", "out", "a.png", "--time", "nan"}, {"--time", "number of seconds"});
  expect_refused({"film", "out", "a.mp4", "--fps", "0"}, {"--fps"});
  expect_refused({"picture", "out", "a.png", "--frame", "11"}, {"--frame", "0 to 10", "11"});
  EXPECT_EQ(files("a."), 0);
}

TEST_F(Picture, OptionsOfTheOtherCommandAreRefusedByName) {
  for (const std::string option : {"--speed", "--fps", "--from", "--to"})
    expect_refused({"picture", "out", "a.png", option, "1"}, {option, "pintle film"});
  for (const std::string option : {"--frame", "--time"}) expect_refused({"film", "out", "a.mp4", option, "1"}, {option, "pintle picture"});
  expect_refused({"picture", "out", "a.mp4"}, {"a.mp4", "pintle film"});
  expect_refused({"film", "out", "a.png"}, {"a.png", "pintle picture"});
  expect_refused({"picture", "out", "a.jpg"}, {"a.jpg", ".png"});
}

TEST_F(Picture, SlipsOfNamesAreToldWithTheNameThatWasMeant) {
  expect_refused({"picture", "out", "a.png", "--arround", "rod"}, {"--arround", "\"--around\""});
  expect_refused({"picture", "out"}, {"out is required", "pintle picture --help"});
  expect_refused({"picture", "out", "a.png", "--around", "rodd"}, {"--around rodd", "\"rod\""});
  expect_refused({"picture", "out", "a.png", "--field", "heat"}, {"--field", "heat"});
  expect_refused({"fim", "out", "a.mp4"}, {"\"film\"", "\"fit\""});
  expect_refused({"flim", "out", "a.mp4"}, {"\"film\""});
  expect_refused({}, {"pintle --help"});
}

TEST_F(Picture, FilesInPlaceOfAFolderOfResultsAreToldWhatToGive) {
  expect_refused({"picture", "out/mechanism.pvd", "a.png"}, {"name its folder, out"});
  expect_refused({"film", "out/mechanism.pvd", "a.mp4"}, {"name its folder, out"});
  expect_refused({"picture", "out/frames/00000.vtu", "a.png"}, {"--field NAME"});
  expect_refused({"film", "out/frames/00000.vtu", "a.mp4"}, {"folder of a run"});
  expect_refused({"picture", "scene.yaml", "a.png"}, {"scene.yaml", "pintle run"});
  expect_refused({"picture", "nowhere", "a.png"}, {"nowhere", "pintle run"}, 1);
  expect_refused({"picture", "nowhere.vtu", "a.png", "--field", "x"}, {"nowhere.vtu: there is no such"}, 1);
  expect_refused({"picture", "out", "missing/a.png"}, {"missing/a.png"}, 1);
}

/// Many long names, a clearance drawn larger and forces leave room for the mechanism in the smallest picture.
TEST_F(Picture, OfTwoHundredPixelsHasRoomForTheMechanism) {
  std::string scene = "gravity: [0, -9.81]\nbodies:\n", joints =
                                                            "joints:\n  first: {revolute: [ground, link of the chain 0.A], "
                                                            "clearance: {radial: 0.1 mm, bearing radius: 10 mm, bearing: ground, normal: "
                                                            "{hunt-crossley: {restitution: 0.5, stiffness: 1e7 N/m^1.5}}}}\n";
  for (int k = 0; k < 9; ++k) {
    const std::string n = std::to_string(k), name = "link of the chain " + n;
    scene += "  " + name + ": {rigid: {mass: 1, inertia: 0.01}, points: {A: [0, 0], B: [1, 0]}, pose: {at: [" + n + ", 0]}}\n";
    if (k > 0) joints += "  pin " + n + ": {revolute: [link of the chain " + std::to_string(k - 1) + ".B, " + name + ".A]}\n";
  }
  ASSERT_EQ(run_with(scene + joints + "run: {until: 0.001}\noutput: {frames: 2}\n").code, 0);
  for (const std::string size : {"200", "200x200", "320x200", "480", "8000x200"}) {
    const Ended end = program({"picture", "out", "a.png", "--size", size});
    EXPECT_EQ(end.code, 0) << size << ": " << end.complained;
  }
}

/// No frame is looked at: the frames of this run are gone.
TEST_F(Film, WhatKeepsItFromBeingWrittenIsForeseen) {
  fs::remove_all(folder_.path() / "out" / "frames");
  fs::create_directory(folder_.path() / "folder.mp4");
  expect_refused({"film", "out", "missing/film.mp4"}, {"missing/film.mp4: cannot be written", "existing folder"}, 1);
  expect_refused({"film", "out", "/proc/film.mp4"}, {"/proc/film.mp4: cannot be written"}, 1);
  expect_refused({"film", "out", "folder.mp4"}, {"folder.mp4: cannot be written"}, 1);
}

}  // namespace
