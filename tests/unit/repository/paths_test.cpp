// Every path that a command, a scene or a study may name: what is no ordinary file, or nothing, is refused at once with its
// name and a remedy, before anything is computed.
#include <sys/stat.h>

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;

const char* const scene_commands[] = {"run", "check", "statics", "kinematics", "inverse", "linearize", "modes", "static", "mesh"};
const char* const study_commands[] = {"sweep", "fit", "sensitivity", "tradeoff", "nonlinear"};

const char* const wheel = R"(
bodies: {wheel: {rigid: {mass: 1, inertia: 1}}}
joints: {pin: {revolute: [ground, wheel]}}
drivers: {motor: {angle: [ground, wheel], law: t^2}}
run: {until: 1e-3}
)";

class Paths : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(mkfifo((at("fifo")).c_str(), 0600), 0);
    fs::create_directory(at("folder"));
    folder_.write("empty", "");
    folder_.write("scene.yaml", wheel);
    folder_.write("study.yaml", "scene: scene.yaml\nmeasure: {work: work of motor}\nsweep: {grid: {run.tolerance: [1e-6, 1e-7]}}\n");
    folder_.write(
        "sought.yaml",
        "scene: scene.yaml\nmeasure: {work: work of motor}\ngoal: {minimise: work}\nvary: {run.tolerance: {from: 1e-7, to: 1e-6}}\n"
        "fit: {starts: 1, evaluations: 2}\nsensitivity: {parameters: {run.tolerance: {at: 1e-6}}}\n");
    folder_.write("returns.yaml", "scene: scene.yaml\nsection: {every: 1e-4 s, record: {angle: wheel.angle}, transient: 1, returns: 4}\n");
    folder_.write("trade.yaml", "scene: scene.yaml\nmeasure: {work: work of motor}\n");
    fs::create_directory(at("inside"));
    folder_.write("inside/file", "text\n");
  }
  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }

  /// @param named  what the message must name
  void expect_refused(const Words& arguments, const std::string& named) {
    Words command{"/usr/bin/timeout", "20", PINTLE_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    std::string shown;
    for (const std::string& a : arguments) shown += a.empty() ? " \"\"" : " " + a;
    const Ended end = run(folder_.path() / "log", command);
    EXPECT_TRUE(end.code == 1 || end.code == 2) << shown << ": exit code " << end.code << (end.code == 124 ? ", it hung" : "");
    EXPECT_NE(end.complained.find(named), std::string::npos) << shown << ": " << end.complained;
    EXPECT_NE(end.complained.find("; "), std::string::npos) << "no remedy:" << shown << ": " << end.complained;
  }
  Folder folder_;
};

TEST_F(Paths, ASceneOrStudyIsAnOrdinaryFileThatSaysSomething) {
  for (const auto& [verbs, many] :
       {std::pair(scene_commands, std::size(scene_commands)), std::pair(study_commands, std::size(study_commands))})
    for (std::size_t k = 0; k < many; ++k) {
      for (const std::string& path : {at("fifo"), at("folder"), at("empty"), at("none"), std::string("/dev/zero")})
        expect_refused({verbs[k], path}, path);
      expect_refused({verbs[k], ""}, "is empty");
    }
}

TEST_F(Paths, ResultsGoWhereNothingIs) {
  for (const auto& [command, file] : std::map<std::string, std::string>{{"run", "scene.yaml"},
                                                                        {"statics", "scene.yaml"},
                                                                        {"kinematics", "scene.yaml"},
                                                                        {"inverse", "scene.yaml"},
                                                                        {"linearize", "scene.yaml"},
                                                                        {"modes", "scene.yaml"},
                                                                        {"static", "scene.yaml"},
                                                                        {"mesh", "scene.yaml"},
                                                                        {"sweep", "study.yaml"},
                                                                        {"merge", "folder"},
                                                                        {"fit", "sought.yaml"},
                                                                        {"sensitivity", "sought.yaml"},
                                                                        {"tradeoff", "trade.yaml"},
                                                                        {"nonlinear", "returns.yaml"}}) {
    const std::string input = at(file);
    expect_refused({command, input, "--out", ""}, "--out");
    // Commands on a body refuse this scene for want of elements; they share the rest with the others.
    if (command == "modes" || command == "static" || command == "mesh") continue;
    for (const std::string& path :
         {at("fifo"), at("inside"), at("empty"), std::string("/dev/null"), std::string("/dev/null/x"), at("empty/x"), at("fifo/x")})
      expect_refused({command, input, "--out", path}, path);
  }
}

TEST_F(Paths, OfOptionsAreWhatTheyMustBe) {
  for (const std::string& path : {at("fifo"), at("folder"), at("empty"), at("none"), std::string("/dev/zero")})
    expect_refused({"run", at("scene.yaml"), "--out", at("out"), "--restart", path}, path);
  expect_refused({"run", at("scene.yaml"), "--restart", ""}, "--restart");
  for (const std::string& path : {at("fifo"), at("folder"), at("none/page.md"), std::string("/dev/null")})
    expect_refused({"tradeoff", at("trade.yaml"), "--out", at("out"), "--markdown", path}, path);
  expect_refused({"tradeoff", at("trade.yaml"), "--markdown", ""}, "--markdown");
  expect_refused({"check", at("scene.yaml"), "--allow-path", ""}, "--allow-path");
  for (const std::string& path : {at("fifo"), at("empty"), at("none")})
    expect_refused({"check", at("scene.yaml"), "--allow-path", path}, path);
}

TEST_F(Paths, ASceneOrStudyNamesOrdinaryFilesThatSaySomething) {
  for (const char* name : {"fifo", "folder", "empty", "none"}) {
    folder_.write("table.yaml", std::string("bodies: {wheel: {rigid: {mass: 1, inertia: 1}}}\njoints: {pin: {revolute: [ground, wheel]}}\n"
                                            "drivers: {motor: {angle: [ground, wheel], law: {table: ") +
                                    name + "}}}\nrun: {until: 1e-3}\n");
    for (const char* command : {"run", "check", "kinematics", "inverse", "statics", "linearize"})
      expect_refused(
          command == std::string("check") ? Words{command, at("table.yaml")} : Words{command, at("table.yaml"), "--out", at("out")}, name);
    folder_.write("of.yaml",
                  std::string("scene: ") + name + "\nmeasure: {work: work of motor}\nsweep: {grid: {run.tolerance: [1e-6, 1e-7]}}\n");
    for (const char* command : study_commands) expect_refused({command, at("of.yaml"), "--out", at("out")}, name);
  }
  for (const std::string kind : {".inp", ".msh", ".geo", ".step", ".stp", ".brep"})
    for (const std::string what : {"fifo", "folder", "empty", "none"}) {
      const std::string name = what + kind;
      if (what == "fifo") mkfifo(at(name).c_str(), 0600);
      if (what == "folder") fs::create_directory(at(name));
      if (what == "empty") folder_.write(name, "");
      folder_.write("mesh.yaml",
                    "bodies: {plate: {plate: {file: " + name + ", thickness: 1 mm, young: 1 GPa, poisson: 0.3, density: 1}}}\n");
      expect_refused({"mesh", at("mesh.yaml"), "--out", at("out")}, name);
      expect_refused({"mesh", at("mesh.yaml"), "--out", at("out")}, "bodies.plate");
    }
}

TEST_F(Paths, AJournalIsAnOrdinaryFile) {
  fs::create_directory(at("swept"));
  ASSERT_EQ(mkfifo(at("swept/journal-0.txt").c_str(), 0600), 0);
  expect_refused({"sweep", at("study.yaml"), "--out", at("swept")}, at("swept/journal-0.txt"));
  expect_refused({"fit", at("sought.yaml"), "--out", at("swept")}, at("swept/journal-0.txt"));
  expect_refused({"nonlinear", at("returns.yaml"), "--out", at("swept")}, at("swept/journal-0.txt"));
}

}  // namespace
