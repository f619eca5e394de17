// The mesher's process: what it may do, what becomes of a drawing that makes it fail, and that its meshes are those that
// Gmsh makes in this process, to the bit.

#include "meshes/mesher.h"

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "files/noted.h"
#include "files/trust.h"
#include "meshes/gmsh_mesher.h"
#include "meshes/limits.h"
#include "meshes/wire.h"
#include "tests/refusal.h"

namespace pintle::mesher_test {
namespace {

namespace fs = std::filesystem;
const fs::path data = fs::path(PINTLE_SOURCE_DIR) / "tests/data/meshes";

const std::string square =
    "Point(1)={0,0,0}; Point(2)={1,0,0}; Point(3)={1,1,0}; Point(4)={0,1,0};\n"
    "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4};\n";
const std::string face = "Plane Surface(1)={1};\n";

/// A folder of its own, gone at the end; limits and trust are then as before.
struct Mesher : testing::Test {
  Mesher() {
    std::string pattern = (fs::temp_directory_path() / "pintle_mesher_XXXXXX").string();
    folder = fs::canonical(mkdtemp(pattern.data()));
    fs::create_directory(folder / "scene");
  }
  ~Mesher() override {
    fs::remove_all(folder);
    set_trust({});
    set_mesher_limits({});
    unsetenv("PINTLE_NO_CONFINEMENT");
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / "scene" / name) << text;
    return folder / "scene" / name;
  }
  std::string said(const fs::path& path) const {
    return pintle_test::refusal_by<std::exception>([&] { read_geometry(path, {}); });
  }
  /// A script that leaves a file behind if its command runs.
  std::string command() const { return "SystemCall \"touch " + (folder / "ran").string() + "\";\n"; }
  /// Gmsh does not wait for its commands, so this waits for one.
  bool ran(std::chrono::milliseconds most = std::chrono::milliseconds(200)) const {
    const auto until = std::chrono::steady_clock::now() + most;
    while (!fs::exists(folder / "ran") && std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return fs::exists(folder / "ran");
  }
  fs::path folder;
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Mesher, AMshFileThatIsAScriptRunsNothing) {
  EXPECT_TRUE(has(said(write("a.msh", command())), "$MeshFormat"));
  EXPECT_TRUE(has(said(write("b.msh", "\n" + command())), "$MeshFormat"));
  std::ifstream in(data / "rocker_41.msh");
  const std::string mesh{std::istreambuf_iterator<char>(in), {}};
  said(write("c.msh", mesh + command()));
  said(write("d.msh", "$MeshFormat\n" + command()));
  EXPECT_FALSE(ran());
}

TEST_F(Mesher, AScriptUnderTheNameOfAnotherKindRunsNothing) {
  for (const char* name : {"a.step", "a.stp", "a.brep", "a.STEP", "a.msh.gz", "a.geo_unrolled", "a.opt", "a"})
    EXPECT_NE(said(write(name, command() + square + face)), "") << name;
  said(write("b.step", "ISO-10303-21;\n" + command()));
  said(write("b.brep", "CASCADE Topology V1, (c) Matra-Datavision\n" + command()));
  EXPECT_FALSE(ran());
}

TEST_F(Mesher, AnOptionFileBesideAMeshIsRefused) {
  fs::copy_file(data / "rocker_41.msh", folder / "scene/a.msh");
  write("a.msh.opt", command());
  EXPECT_TRUE(has(said(folder / "scene/a.msh"), "a.msh.opt"));
  EXPECT_FALSE(ran());
}

TEST_F(Mesher, ADrawingRunsNoCommandUnlessTheUserTrustsIt) {
  const fs::path drawing = write("a.geo", command() + square + face);
  const std::string words = said(drawing);
  EXPECT_TRUE(has(words, "a.geo") && has(words, "--trust-geo")) << words;
  EXPECT_FALSE(ran());
  set_trust({{}, true});
  EXPECT_EQ(said(drawing), "accepted");
  EXPECT_TRUE(ran(std::chrono::seconds(10)));
}

TEST_F(Mesher, ADrawingWritesNothing) {
  for (const std::string& order :
       {"Save \"" + (folder / "scene/out.msh").string() + "\";", "Print \"" + (folder / "ran").string() + "\";",
        "Printf(\"x\") > \"" + (folder / "ran").string() + "\";", "CreateDir \"" + (folder / "ran").string() + "\";"})
    said(write("a.geo", square + face + "Mesh 2;\n" + order + "\n"));
  EXPECT_FALSE(ran());
  EXPECT_FALSE(fs::exists(folder / "scene/out.msh"));
}

TEST_F(Mesher, ADrawingReadsWhatLiesBelowTheSceneAndNoMore) {
  fs::create_directory(folder / "scene/parts");
  write("parts/inner.geo", square);
  EXPECT_EQ(said(write("a.geo", "Include \"parts/inner.geo\";\n" + face)), "accepted");
  std::ofstream(folder / "secret.geo") << square;
  const fs::path out = write("b.geo", "Include \"../secret.geo\";\n" + face);
  EXPECT_NE(said(out), "");
  fs::create_symlink(folder / "secret.geo", folder / "scene/link.geo");
  EXPECT_NE(said(write("c.geo", "Include \"link.geo\";\n" + face)), "");
  set_trust({{folder}, false});
  EXPECT_EQ(said(out), "accepted");
}

TEST_F(Mesher, TheFilesThatADrawingNamesAreNoted) {
  fs::create_directory(folder / "scene/parts");
  write("parts/deep.geo", square);
  write("parts/inner.geo", "Include \"deep.geo\";\n");
  write("other.geo", square);
  const FilesNoted noted;
  EXPECT_EQ(said(write("a.geo", "// not \"none.geo\"\nMerge \"parts/inner.geo\";\n" + face)), "accepted");
  std::vector<fs::path> names;
  for (const fs::path& path : noted.paths()) names.push_back(path.lexically_relative(folder / "scene"));
  EXPECT_EQ(names, (std::vector<fs::path>{"a.geo", "parts/inner.geo", "parts/deep.geo"}));
}

TEST_F(Mesher, ADrawingThatIncludesItselfIsRefused) {
  EXPECT_NE(said(write("a.geo", "Include \"a.geo\";\n")), "");
  EXPECT_EQ(said(write("b.geo", square + face)), "accepted") << "the next drawing is meshed";
}

TEST_F(Mesher, WithoutConfinementOnlyTrustedScriptsAreRun) {
  setenv("PINTLE_NO_CONFINEMENT", "1", 1);
  const fs::path drawing = write("a.geo", square + face);
  // Meshers that are idle have been told otherwise at their start: these are as many as have ever worked at once, one.
  MesherLimits short_of_time;
  short_of_time.seconds = 0;
  set_mesher_limits(short_of_time);
  said(write("endless.geo", "For i In {1:1e9}\nx = i;\nEndFor\n"));
  set_mesher_limits({});
  EXPECT_TRUE(has(said(drawing), "--trust-geo"));
  EXPECT_EQ(said(data / "rocker_41.msh"), "accepted");
  EXPECT_EQ(said(data / "plate_mm.step"), "accepted");
  set_trust({{}, true});
  EXPECT_EQ(said(drawing), "accepted");
  unsetenv("PINTLE_NO_CONFINEMENT");
  set_mesher_limits(short_of_time);
  said(folder / "scene/endless.geo");
}

TEST_F(Mesher, AnEndlessDrawingIsRefusedAtTheTimeLimit) {
  MesherLimits limits;
  limits.seconds = 0.3;
  set_mesher_limits(limits);
  const auto begin = std::chrono::steady_clock::now();
  const std::string words = said(write("a.geo", "For i In {1:1e9}\nx = i;\nEndFor\n" + square + face));
  EXPECT_TRUE(has(words, "0.3 s") && has(words, "--mesh-time") && has(words, "a.geo")) << words;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(Mesher, ADrawingThatNeedsTooMuchMemoryIsRefused) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer reserves terabytes";
#endif
  MesherLimits limits;
  limits.bytes = std::size_t{550} << 20;
  set_mesher_limits(limits);
  const std::string words = said(write("a.geo", "l() = {0:1e8};\n" + square + face));
  EXPECT_TRUE(has(words, "--mesh-memory")) << words;
}

TEST_F(Mesher, ADrawingThatLeavesIsRefused) { EXPECT_TRUE(has(said(write("a.geo", "Exit;\n")), "without a mesh")); }

/// Processes whose parent is this one, the threads' too.
std::vector<pid_t> children() {
  std::vector<pid_t> out;
  for (const auto& task : fs::directory_iterator("/proc/self/task")) {
    std::ifstream in(task.path() / "children");
    for (pid_t p; in >> p;) out.push_back(p);
  }
  return out;
}

TEST_F(Mesher, KilledInTheMiddleItIsARefusedBodyAndTheNextIsMeshed) {
  const fs::path drawing = write("a.geo", "For i In {1:1e9}\nx = i;\nEndFor\n");
  const fs::path plain = write("b.geo", square + face);
  EXPECT_EQ(said(plain), "accepted");
  std::string words;
  std::thread waiting([&] { words = said(drawing); });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  for (const pid_t p : children()) kill(p, SIGSEGV);
  waiting.join();
  EXPECT_TRUE(has(words, "a.geo") && has(words, "crashes")) << words;
  EXPECT_EQ(said(plain), "accepted");
}

TEST_F(Mesher, AnIdleMesherThatIsKilledIsReplaced) {
  const fs::path plain = write("b.geo", square + face);
  EXPECT_EQ(said(plain), "accepted");
  for (const pid_t p : children()) kill(p, SIGKILL);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(said(plain), "accepted");
}

bool stop_now() { return true; }

TEST_F(Mesher, StoppedItIsNoErrorOfTheBody) {
  const fs::path drawing = write("a.geo", "For i In {1:1e9}\nx = i;\nEndFor\n");
  MesherLimits limits;
  limits.stop = stop_now;
  set_mesher_limits(limits);
  EXPECT_THROW(read_geometry(drawing, {}), MeshingStopped);
}

TEST_F(Mesher, LeavesNoZombie) {
  said(write("a.geo", "Exit;\n"));
  for (const pid_t p : children()) {
    std::ifstream in("/proc/" + std::to_string(p) + "/stat");
    std::string number, name, state;
    in >> number >> name >> state;
    EXPECT_NE(state, "Z") << name;
  }
}

TEST_F(Mesher, EndsWithTheProgramThatStartedIt) {
  int line[2];
  ASSERT_EQ(pipe(line), 0);
  const fs::path drawing = write("a.geo", "For i In {1:1e9}\nx = i;\nEndFor\n");
  const pid_t program = fork();
  if (program == 0) {
    std::thread([&] { said(drawing); }).detach();
    std::vector<pid_t> found;
    for (int k = 0; k < 200 && found.empty(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10)), found = children();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const pid_t mesher = found.empty() ? 0 : found[0];
    if (::write(line[1], &mesher, sizeof mesher) > 0) kill(getpid(), SIGKILL);
    _exit(1);
  }
  pid_t mesher = 0;
  ASSERT_EQ(read(line[0], &mesher, sizeof mesher), static_cast<ssize_t>(sizeof mesher));
  waitpid(program, nullptr, 0);
  ASSERT_GT(mesher, 0);
  bool gone = false;
  for (int k = 0; k < 200 && !gone; ++k) {
    std::ifstream in("/proc/" + std::to_string(mesher) + "/stat");
    std::string number, name, state;
    in >> number >> name >> state;
    gone = !in || state == "Z";
    if (!gone) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(gone);
  close(line[0]), close(line[1]);
}

std::string bits(const Mesh& mesh) { return packed(mesh); }

TEST_F(Mesher, GivesTheMeshesOfThisProcessToTheBit) {
  MeshOptions options;
  const Link bar = EyeBar{0.3, 0.03, {0.03, 0.06}, {0.02, 0.04}};
  for (const CellShape shape : {CellShape::triangle6, CellShape::quadrilateral8}) {
    options.shape = shape;
    EXPECT_EQ(bits(mesh_link(bar, options)), bits(gmsh_link(bar, options)));
    for (const char* name : {"rocker.geo", "plate_mm.step", "rocker_41.msh"})
      EXPECT_EQ(bits(read_geometry(data / name, options)), bits(gmsh_geometry(data / name, options, 1))) << name;
  }
}

TEST_F(Mesher, ThreadsGetTheSameMeshes) {
  const std::string alone = bits(read_geometry(data / "rocker.geo", {}));
  std::vector<std::string> got(3);
  std::vector<std::thread> threads;
  for (std::string& g : got) threads.emplace_back([&g] { g = bits(read_geometry(data / "rocker.geo", {})); });
  for (std::thread& t : threads) t.join();
  for (const std::string& g : got) EXPECT_EQ(g, alone);
}

TEST_F(Mesher, AMshFileMayNumberItsNodesFarApart) {
  const fs::path file = write("far.msh",
                              "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2000000000 1 0 0\n2100000000 0 1 0\n$EndNodes\n"
                              "$Elements\n1\n7 2 2 1 1 1 2000000000 2100000000\n$EndElements\n");
  MesherLimits limits;
  limits.bytes = std::size_t{2} << 30;
  set_mesher_limits(limits);
  const Mesh mesh = read_geometry(file, {});
  EXPECT_EQ(mesh.node_numbers, (std::vector<long>{1, 2'000'000'000, 2'100'000'000}));
  EXPECT_EQ(mesh.cell_count(), 1u);
}

TEST(Wire, ADamagedAnswerIsRefused) {
  Mesh mesh;
  mesh.x.resize(2, 3);
  mesh.x << 0, 1, 0, 0, 0, 1;
  mesh.node_numbers = {1, 2, 3};
  mesh.cells.push_back({CellShape::triangle3, {0, 1, 2}, {1}});
  mesh.groups.push_back({"a", {0, 2}, {}});
  const std::string whole = packed(mesh);
  EXPECT_EQ(packed(unpacked_mesh(whole)), whole);
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_THROW(unpacked_mesh(std::string_view(whole).substr(0, n)), std::runtime_error) << n;
  mesh.cells[0].nodes[1] = 3;
  EXPECT_THROW(unpacked_mesh(packed(mesh)), std::runtime_error);
  mesh.cells[0].nodes = {0, 1};
  EXPECT_THROW(unpacked_mesh(packed(mesh)), std::runtime_error);
}

}  // namespace
}  // namespace pintle::mesher_test
