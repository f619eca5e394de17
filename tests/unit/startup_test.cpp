// What a run pays before its first step: the program itself is started, on scenes written here. What is loaded is
// told by the system's loader (LD_DEBUG of glibc), at the start and whenever a part is called for.

#include <gtest/gtest.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

extern char** environ;

namespace {

namespace fs = std::filesystem;

constexpr std::string_view four_bar = R"(
gravity: [0, -9.81]
ground: {points: {O: [0, 0], C: [0.3, 0]}}
bodies:
  crank: {rigid: {mass: 0.3, inertia: 1e-4}, points: {O: [-50 mm, 0], A: [50 mm, 0]}, pose: {at: [0.05, 0]}}
  coupler: {rigid: {mass: 0.5, inertia: 1e-2}, points: {A: [-150 mm, 0], B: [150 mm, 0]}, pose: {at: [0.25, 0.05], angle: 40 deg}}
  rocker: {rigid: {mass: 0.4, inertia: 5e-3}, points: {B: [0, 0.1], C: [0, -0.1]}, pose: {at: [0.3, 0.1]}}
joints:
  main bearing: {revolute: [ground.O, crank.O]}
  crank pin: {revolute: [crank.A, coupler.A]}
  rocker pin: {revolute: [coupler.B, rocker.B]}
  rocker bearing: {revolute: [ground.C, rocker.C]}
start: {crank: {angle: 10 deg, speed: 10 rad/s}}
run: {until: 1e-6}
)";
constexpr std::string_view every_step = "output: {every: 1e-6}\n";
constexpr std::string_view two_frames = "output: {every: 1e-6, frames: 2}\n";
constexpr std::string_view meshed = R"(
bodies:
  arm:
    plate: {link: {eye bar: {length: 0.3, width: 0.03, eyes: [{bore: 0.03, outer: 0.06}, {bore: 0.02, outer: 0.04}]}},
            thickness: 5 mm, size: 10 mm, young: 207 GPa, poisson: 0.3, density: 7850}
    points: {O: {hole: eye 1, coupling: rigid}}
joints: {bearing: {revolute: [ground, arm.O]}}
run: {until: 1e-6}
output: {every: 1e-6}
)";

/// A folder of its own with a scene in it, gone afterwards.
class Place {
 public:
  explicit Place(std::string_view scene) {
    std::string name = (fs::temp_directory_path() / "pintle_startup_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::ofstream(folder_ / "scene.yaml") << scene;
  }
  ~Place() { fs::remove_all(folder_); }
  /// Runs the scene, with `extra` before the environment. @returns its exit code   @param ms  from start to end
  int run(const std::string& extra, double* ms = nullptr) const {
    using clock = std::chrono::steady_clock;
    fs::remove_all(folder_ / "out");
    std::string program = PINTLE_PROGRAM, verb = "run", scene = (folder_ / "scene.yaml").string(), quiet = "-q", option = "-o",
                out = (folder_ / "out").string(), own = extra;
    char* arguments[] = {program.data(), verb.data(), scene.data(), quiet.data(), option.data(), out.data(), nullptr};
    std::vector<char*> environment;
    if (!own.empty()) environment.push_back(own.data());
    std::string log = "LD_DEBUG_OUTPUT=" + (folder_ / "loader").string();
    environment.push_back(log.data());
    for (char** e = environ; *e != nullptr; ++e) environment.push_back(*e);
    environment.push_back(nullptr);
    const auto begin = clock::now();
    pid_t child = 0;
    int status = 0;
    if (posix_spawn(&child, program.c_str(), nullptr, nullptr, arguments, environment.data()) != 0) return -1;
    if (waitpid(child, &status, 0) != child) return -1;
    if (ms) *ms = std::chrono::duration<double, std::milli>(clock::now() - begin).count();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// What the loader said of all that it loaded.
  std::string loaded() const {
    std::string all;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      if (!entry.path().filename().string().starts_with("loader")) continue;
      std::ifstream in(entry.path());
      all.append(std::istreambuf_iterator<char>(in), {});
    }
    return all;
  }

 private:
  fs::path folder_;
};

std::string loaded_by(const std::string& scene) {
  const Place place(scene);
  EXPECT_EQ(place.run("LD_DEBUG=files"), 0);
  return place.loaded();
}

bool holds(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(StartUp, ARigidSceneLoadsNeitherGmshNorVtk) {
  const std::string loaded = loaded_by(std::string(four_bar) + std::string(every_step));
  ASSERT_TRUE(holds(loaded, "libyaml-cpp")) << "the loader says nothing: this test sees nothing";
  for (const char* heavy : {"libgmsh", "libTK", "libvtk", "libpintle_", "pintle-mesher", "libfltk"}) EXPECT_FALSE(holds(loaded, heavy)) << heavy;
}

TEST(StartUp, VtkIsLoadedByFramesAlone) {
  const std::string loaded = loaded_by(std::string(four_bar) + std::string(two_frames));
  EXPECT_TRUE(holds(loaded, "libpintle_vtk") && holds(loaded, "libvtkIOXML"));
  EXPECT_FALSE(holds(loaded, "libgmsh"));
}

TEST(StartUp, GmshIsLoadedByMeshesAlone) {
  const std::string loaded = loaded_by(std::string(meshed));
  EXPECT_TRUE(holds(loaded, "pintle-mesher") && holds(loaded, "libgmsh"));
  EXPECT_FALSE(holds(loaded, "libvtk"));
}

// From exec to exit, so with reading, assembling, one step and the files: more than to the first step. Other
// programs may hold the machine for a while, hence the least of many.
TEST(StartUp, ARigidFourBarIsReadSteppedAndWrittenWithinFiftyMilliseconds) {
#if !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "not the program that people run";
#endif
  constexpr double bound = 50;
  const Place place(std::string(four_bar) + std::string(every_step));
  double least = 1e9;
  for (int i = 0; i < 40 && least >= bound; ++i) {
    double ms = 0;
    ASSERT_EQ(place.run("", &ms), 0);
    least = std::min(least, ms);
  }
  EXPECT_LT(least, bound) << "ms";
}

// --- exit codes: nothing done is not 0 ---

/// The program's exit code for `verb` on files written to a folder; `said` ← what it printed to standard error.
int exit_code(const std::string& verb, const std::vector<std::pair<std::string, std::string>>& files, std::string& said) {
  std::string folder = (fs::temp_directory_path() / "pintle_exit_XXXXXX").string();
  mkdtemp(folder.data());
  for (const auto& [name, text] : files) std::ofstream(fs::path(folder) / name) << text;
  const std::string command = "cd " + folder + " && " + PINTLE_PROGRAM + " " + verb + " " + files.front().first + " > out 2> said";
  const int status = std::system(command.c_str());
  std::ifstream in(fs::path(folder) / "said");
  said.assign(std::istreambuf_iterator<char>(in), {});
  fs::remove_all(folder);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
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
  EXPECT_EQ(exit_code("check", {{"scene.yaml", out_of_reach}}, said), 4);
  EXPECT_TRUE(holds(said, "the run fails") && holds(said, "t = 0.1 s")) << said;
  EXPECT_EQ(exit_code("check --json", {{"scene.yaml", out_of_reach}}, said), 4);
  EXPECT_EQ(exit_code("check", {{"scene.yaml", std::string(four_bar)}}, said), 0);
  EXPECT_EQ(said, "");
}

TEST(ExitCodes, ASweepOfWhichNoCaseRanIsFour) {
  const std::string study = "scene: scene.yaml\nmeasure: {turned: energy lost}\nsweep: {grid: {run.tolerance: [1e-6, 1e-7]}}\n";
  std::string said;
  EXPECT_EQ(exit_code("sweep -q", {{"study.yaml", study}, {"scene.yaml", out_of_reach}}, said), 4);
  EXPECT_TRUE(holds(said, "none of 2 cases ran") && holds(said, "failed")) << said;
  EXPECT_EQ(exit_code("sweep -q", {{"study.yaml", study}, {"scene.yaml", std::string(four_bar)}}, said), 0);
}

}  // namespace
