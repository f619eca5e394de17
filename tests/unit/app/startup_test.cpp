// What a run pays before its first step: the program itself is started, on scenes written here. What is loaded is
// told by the system's loader (LD_DEBUG of glibc), at the start and whenever a part is called for.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tests/unit/four_bar_text.h"
#include "tests/unit/program.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle_test;

const std::string started_four_bar = four_bar + R"(start: {crank: {angle: 10 deg, speed: 10 rad/s}}
run: {until: 1e-6}
)";
constexpr std::string_view every_step = "output: {every: 1e-6, frames: 0}\n";
constexpr std::string_view two_frames = "output: {every: 1e-6, frames: 2}\n";
constexpr std::string_view meshed = R"(
bodies:
  arm:
    plate: {link: {eye bar: {length: 0.3, width: 0.03, eyes: [{bore: 0.03, outer: 0.06}, {bore: 0.02, outer: 0.04}]}},
            thickness: 5 mm, size: 10 mm, young: 207 GPa, poisson: 0.3, density: 7850}
    points: {O: {hole: eye 1, coupling: rigid}}
joints: {bearing: {revolute: [ground, arm.O]}}
run: {until: 1e-6}
output: {every: 1e-6, frames: 0}
)";

/// A folder of its own with a scene in it, gone afterwards.
class Place {
 public:
  explicit Place(std::string_view scene) { folder_.write("scene.yaml", std::string(scene)); }
  /// Runs the scene, or asks another question, with `extra` before the environment. @returns its exit code
  int run(const std::string& extra, const std::string& verb) const {
    const fs::path out = folder_.path() / "out";
    fs::remove_all(out);
    Words environment{"LD_DEBUG_OUTPUT=" + (folder_.path() / "loader").string()};
    if (!extra.empty()) environment.push_back(extra);
    const Ended end = pintle_test::run(
        folder_.path() / "log", {PINTLE_PROGRAM, verb, (folder_.path() / "scene.yaml").string(), "-q", "-o", out.string()}, environment);
    return end.code;
  }
  /// What the loader said of all that it loaded.
  std::string loaded() const {
    std::string all;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      if (entry.path().filename().string().starts_with("loader")) all += contents(entry.path());
    return all;
  }

 private:
  Folder folder_;
};

std::string loaded_by(const std::string& scene, const std::string& verb = "run") {
  const Place place(scene);
  EXPECT_EQ(place.run("LD_DEBUG=files", verb), 0);
  return place.loaded();
}

bool holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(StartUp, ARigidSceneLoadsNeitherGmshNorVtkNorMpi) {
  const std::string loaded = loaded_by(started_four_bar + std::string(every_step));
  ASSERT_TRUE(holds(loaded, "libyaml")) << "the loader says nothing: this test sees nothing";
  for (const char* heavy : {"libgmsh", "libTK", "libvtk", "libmpi", "libopen-rte", "libpintle_", "pintle-mesher", "libfltk", "libxml2",
                            "libminizip", "libhdf5"})
    EXPECT_FALSE(holds(loaded, heavy)) << heavy;
}

TEST(StartUp, FramesAreWrittenWithoutVtk) {
  const std::string loaded = loaded_by(started_four_bar + std::string(two_frames));
  ASSERT_TRUE(holds(loaded, "libyaml"));
  for (const char* heavy : {"libpintle_", "libvtk", "libgmsh"}) EXPECT_FALSE(holds(loaded, heavy)) << heavy;
}

TEST(StartUp, VtkIsLoadedByFilesOfABodyAlone) {
  const std::string loaded = loaded_by(std::string(meshed), "mesh");
  EXPECT_TRUE(holds(loaded, "libpintle_vtk") && holds(loaded, "libvtkIOXML"));
}

TEST(StartUp, GmshIsLoadedByMeshesAlone) {
  const std::string loaded = loaded_by(std::string(meshed));
  EXPECT_TRUE(holds(loaded, "pintle-mesher") && holds(loaded, "libgmsh"));
  EXPECT_FALSE(holds(loaded, "libvtk"));
}

// --- exit codes: nothing done is not 0 ---

/// The program's exit code for `verb` on the first of the files, written to a folder; `said` ← what it printed to standard error.
int exit_code(const Words& verb, const std::vector<std::pair<std::string, std::string>>& files, std::string& said) {
  const Folder folder;
  for (const auto& [name, text] : files) folder.write(name, text);
  Words command{"/usr/bin/env", "-C", folder.path().string(), PINTLE_PROGRAM};
  command.insert(command.end(), verb.begin(), verb.end());
  command.push_back(files.front().first);
  const Ended end = run(folder.path() / "log", command);
  said = end.complained;
  return end.code;
}

// A ram that pushes a slider farther than crank and rod reach: after 0.1 s no pose is left.
const std::string out_of_reach = R"(
ground: {points: {O: [0, 0]}}
bodies:
  crank: {rigid: {mass: 1, inertia: 0.1}, points: {A: [0, 0], B: [1, 0]}, pose: {angle: 0.5}}
  rod: {rigid: {mass: 1, inertia: 0.1}, points: {A: [0, 0], B: [1, 0]}, pose: {at: [0.88, 0.48], angle: -0.5}}
  slider: {rigid: {mass: 1, inertia: 0.1}, points: {P: [0, 0]}, pose: {at: [1.75, 0]}}
joints:
  pivot: {revolute: [ground.O, crank.A]}
  knee: {revolute: [crank.B, rod.A]}
  pin: {revolute: [rod.B, slider.P]}
  guide: {prismatic: [ground, slider]}
drivers: {ram: {distance: [ground.O, slider.P], law: "1.8 m + 2 m/s*t"}}
run: {until: 1, method: dopri5}
)";

TEST(ExitCodes, CheckOfARunThatFailsWhenTriedOutIsFour) {
  std::string said;
  EXPECT_EQ(exit_code({"check"}, {{"scene.yaml", out_of_reach}}, said), 4);
  EXPECT_TRUE(holds(said, "the run fails") && holds(said, "t = 0.1 s")) << said;
  EXPECT_EQ(exit_code({"check", "--json"}, {{"scene.yaml", out_of_reach}}, said), 4);
  EXPECT_EQ(exit_code({"check"}, {{"scene.yaml", started_four_bar}}, said), 0);
  EXPECT_EQ(said, "");
}

// Three cranks on one bar, a pin a nanometre beside its place: it closes where the cranks stand upright, and nowhere else.
const std::string misfitting_cranks = R"(
ground: {points: {A: [0, 0], B: [1, 0], C: [2, 0]}}
bodies:
  a: {rigid: {mass: 1, inertia: 0.1}, points: {P: [0.5, 0]}, pose: {at: [0, 0], angle: 90 deg}}
  b: {rigid: {mass: 1, inertia: 0.1}, points: {P: [0.5, 0]}, pose: {at: [1, 0], angle: 90 deg}}
  c: {rigid: {mass: 1, inertia: 0.1}, points: {P: [0.5, 0]}, pose: {at: [2, 0], angle: 90 deg}}
  bar: {rigid: {mass: 1, inertia: 0.5}, points: {P: [0, 0], Q: [1.000000001, 0], R: [2, 0]}, pose: {at: [0, 0.5]}}
joints:
  base a: {revolute: [ground.A, a]}
  base b: {revolute: [ground.B, b]}
  base c: {revolute: [ground.C, c]}
  top a: {revolute: [a.P, bar.P]}
  top b: {revolute: [b.P, bar.Q]}
  top c: {revolute: [c.P, bar.R]}
start: {a: {angle: 90 deg, speed: 2}}
run: {until: 5}
)";

const std::string leaves_its_table = R"yaml(
bodies: {b: {rigid: {mass: 1 kg, inertia: 1 kg m^2}}}
forces: {push: {force: [{table: spring.csv, over: b.x, outside: refuse}, 0], at: b}}
run: {until: 1 s}
)yaml";

TEST(ExitCodes, CheckNamesWhyTheRunFailsAsTheRunDoes) {
  for (const Words& verb : {Words{"check"}, Words{"run", "-q"}}) {
    std::string said;
    EXPECT_EQ(exit_code(verb, {{"scene.yaml", misfitting_cranks}}, said), 4);
    EXPECT_TRUE(holds(said, "redundant joints") && holds(said, "b\" stays open by") && holds(said, "more digits")) << said;
    EXPECT_EQ(exit_code(verb, {{"scene.yaml", leaves_its_table}, {"spring.csv", "x [m],F [N]\n0,1\n0.01,2\n"}}, said), 4);
    EXPECT_TRUE(holds(said, "leaves its table at t = ") && holds(said, "spring.csv") && holds(said, "lengthen the table")) << said;
  }
}

TEST(ExitCodes, ASweepOfWhichNoCaseRanIsFour) {
  const std::string study = "scene: scene.yaml\nmeasure: {turned: energy lost}\nsweep: {grid: {run.tolerance: [1e-6, 1e-7]}}\n";
  std::string said;
  EXPECT_EQ(exit_code({"sweep", "-q"}, {{"study.yaml", study}, {"scene.yaml", out_of_reach}}, said), 4);
  EXPECT_TRUE(holds(said, "none of 2 cases ran") && holds(said, "failed")) << said;
  EXPECT_EQ(exit_code({"sweep", "-q"}, {{"study.yaml", study}, {"scene.yaml", started_four_bar}}, said), 0);
}

TEST(ExitCodes, AFitOrSensitivityThatCanMeasureNothingIsFour) {
  const std::string study =
      "scene: scene.yaml\nmeasure: {lost: energy lost}\ngoal: {minimise: lost}\nvary: {run.tolerance: {from: 1e-7, to: 1e-6}}\n"
      "fit: {starts: 1, evaluations: 2}\nsensitivity: {levels: 1, parameters: {run.tolerance: {at: 1e-6}}}\n";
  for (const char* verb : {"fit", "sensitivity"}) {
    std::string said;
    EXPECT_EQ(exit_code({verb, "-q"}, {{"study.yaml", study}, {"scene.yaml", out_of_reach}}, said), 4);
    EXPECT_TRUE(holds(said, "none of") && holds(said, "failed")) << said;
    EXPECT_EQ(exit_code({verb, "-q"}, {{"study.yaml", study}, {"scene.yaml", started_four_bar}}, said), 0) << said;
  }
}

// --- a plot of what is no column: a signal of the scene is told how it becomes one, another name is corrected ---

TEST(Plot, OfASignalThatIsNoColumnSaysHowToHaveItWritten) {
  const Folder folder;
  folder.write("scene.yaml", started_four_bar + "forces: {coil: {spring: [ground.O, crank.A], stiffness: 10, free length: 1}}\n");
  const auto act = [&](const Words& words) {
    Words command{"/usr/bin/env", "-C", folder.path().string(), PINTLE_PROGRAM};
    command.insert(command.end(), words.begin(), words.end());
    return run(folder.path() / "log", command);
  };
  ASSERT_EQ(act({"run", "-q", "scene.yaml", "--out", "r"}).code, 0);
  const auto complaint = [&](const char* column) { return act({"plot", "r", column}).complained; };
  EXPECT_TRUE(holds(complaint("coil.length"), "has no column \"coil.length\", which is a signal of its scene")) << complaint("coil.length");
  EXPECT_TRUE(holds(complaint("coil.length"), "add `outputs: {coil length: coil.length}` to the scene"));
  EXPECT_TRUE(holds(complaint("coil.lenght"), "did you mean \"coil.length\"? That is a signal of its scene"));
  EXPECT_TRUE(holds(complaint("crank.anlge"), "did you mean \"crank.angle\"?") && !holds(complaint("crank.anlge"), "signal"));
}

}  // namespace
