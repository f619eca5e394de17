// What no scene can make the program do, by all of its commands: run something, read elsewhere. The program itself is started.

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace {

namespace fs = std::filesystem;
using std::string;

struct Bounds : testing::Test {
  Bounds() {
    string pattern = (fs::temp_directory_path() / "pintle_bounds_XXXXXX").string();
    folder = fs::canonical(mkdtemp(pattern.data()));
    fs::create_directory(folder / "s");
    write("outside.csv", "0 1\n0.5 1\n1 1\n");
    write("s/inside.csv", "0 1\n0.5 1\n1 1\n");
  }
  ~Bounds() override { fs::remove_all(folder); }
  void write(const string& name, const string& text) const { std::ofstream(folder / name) << text; }
  string ran_file() const { return (folder / "ran").string(); }
  bool ran() const {
    for (int k = 0; k < 20 && !fs::exists(ran_file()); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return fs::exists(ran_file());
  }

  void plate(const string& file) const {
    write("s/plate.yaml", "bodies: {arm: {plate: {file: " + file +
                              ", thickness: 5 mm, young: 207 GPa, poisson: 0.3, density: 7850},\n"
                              "  points: {O: [0, 0]}}}\njoints: {j: {revolute: [ground, arm.O]}}\nrun: {until: 1e-6}\n"
                              "output: {states: 5e-7}\n");
  }
  void pendulum(const string& table) const {
    write("s/rod.yaml",
          "gravity: [0, -9.81]\nbodies: {rod: {rigid: {mass: 1 kg, inertia: 1}, points: {O: [-1, 0]}, pose: {at: [1, 0]}}}\n"
          "joints: {pin: {revolute: [ground, rod.O]}}\nforces: {push: {torque: {table: " +
              table +
              "}, on: rod}}\n"
              "run: {until: 0.1 s}\noutput: {every: 10 ms, states: 0.05 s}\n");
  }
  /// What the program prints, and its exit code behind it.
  string pintle(const string& arguments) const {
    const string command = "cd " + (folder / "s").string() + " || exit 9\n" PINTLE_PROGRAM " " + arguments + " 2>&1";
    string out;
    FILE* pipe = popen(command.c_str(), "r");
    for (char part[4096]; pipe && fgets(part, sizeof part, pipe);) out += part;
    const int status = pipe ? pclose(pipe) : -1;
    return out + "exit " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
  }
  string contents(const string& name) const {
    std::ifstream in(folder / "s" / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder;
};

const string square =
    "Point(1)={0,0,0}; Point(2)={1,0,0}; Point(3)={1,1,0}; Point(4)={0,1,0};\n"
    "Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4};\nPlane Surface(1)={1};\n";

void says(const string& said, const string& part) {
  EXPECT_NE(said.find(part), string::npos) << "\"" << said << "\" lacks \"" << part << "\"";
}

TEST_F(Bounds, NoCommandRunsWhatADrawingOrAMeshAsksFor) {
  const string touch = "SystemCall \"touch " + ran_file() + "\";\n";
  write("s/a.msh", touch);
  write("s/a.geo", touch + square);
  for (const char* const file : {"a.msh", "a.geo"}) {
    plate(file);
    for (const char* const command : {"check", "run", "mesh", "modes", "linearize"}) {
      const string said = pintle(string(command) + " plate.yaml");
      says(said, "plate.yaml:1: bodies.arm.plate.file: ");
      says(said, file);
      says(said, "exit 2");
    }
  }
  EXPECT_FALSE(ran());
}

TEST_F(Bounds, TheCommandLineMayTrustADrawing) {
  write("s/a.geo", "SystemCall \"touch " + ran_file() + "\";\n" + square);
  plate("a.geo");
  says(pintle("mesh plate.yaml --trust-geo -q"), "exit 0");
  EXPECT_TRUE(ran());
}

TEST_F(Bounds, ASweepRefusesTheCaseAndGoesOn) {
  write("s/a.geo", "SystemCall \"touch " + ran_file() + "\";\n" + square);
  write("s/b.geo", square);
  write("s/endless.geo", "For i In {1:1e9}\nx = i;\nEndFor\n" + square);
  plate("b.geo");
  write("s/study.yaml",
        "scene: plate.yaml\nmeasure: {a: final angle of arm}\nset: {gravity: [0, 0]}\n"
        "sweep: {grid: {bodies.arm.plate.file: [b.geo, a.geo, ../c.geo, endless.geo]}}\n");
  says(pintle("sweep study.yaml -q -o out --threads 2 --mesh-time 1s"), "exit 0");
  EXPECT_FALSE(ran());
  const string table = contents("out/sweep.csv");
  says(table, "--trust-geo");
  says(table, "--allow-path");
  says(table, "--mesh-time");
  says(table, "finished");
}

TEST_F(Bounds, RunsAndRestartsReadNothingOutsideTheScenesFolder) {
  pendulum("../outside.csv");
  for (const char* const command : {"check", "run"}) {
    says(pintle(string(command) + " rod.yaml"), "rod.yaml:4: forces.push.torque.table: \"../outside.csv\" lies outside");
    says(pintle(string(command) + " rod.yaml"), "exit 2");
  }
  says(pintle("run rod.yaml -q -o allowed --allow-path .."), "exit 0");
  const string restart = "run rod.yaml -q --restart allowed/states/00001.state -o ";
  says(pintle(restart + "again"), "lies outside");
  says(pintle(restart + "again --allow-path .."), "exit 0");
}

// Of a saved run, the drawing needs the same trust again, and a mesh that has become a script is refused like any other.
TEST_F(Bounds, ARestartRunsNoCommandThatItsScenesFilesAskFor) {
  const string touch = "SystemCall \"touch " + ran_file() + "\";\n";
  const string restart = "run plate.yaml -q --restart saved/states/00001.state --set run.until=2e-6 -o again";
  write("s/a.geo", touch + square);
  plate("a.geo");
  says(pintle("run plate.yaml -q -o saved --trust-geo"), "exit 0");
  ASSERT_TRUE(ran());
  fs::remove(ran_file());
  const string untrusted = pintle(restart);
  says(untrusted, "--trust-geo");
  says(untrusted, "exit 2");
  EXPECT_FALSE(ran());
  says(pintle(restart + " --trust-geo"), "exit 0");

  fs::remove(ran_file());
  fs::remove_all(folder / "s/saved");
  write("s/a.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
        "$Elements\n1\n1 3 2 0 1 1 2 3 4\n$EndElements\n");
  plate("a.msh");
  says(pintle("run plate.yaml -q -o saved"), "exit 0");
  write("s/a.msh", touch);
  fs::remove_all(folder / "s/again");
  const string replaced = pintle(restart);
  says(replaced, "a.msh");
  says(replaced, "exit 2");
  EXPECT_FALSE(ran());
}

TEST_F(Bounds, AStudyNamesAScene) {
  pendulum("inside.csv");
  fs::create_directory(folder / "studies");
  const string rest = "measure: {a: final angle of rod}\nsweep: {grid: {run.tolerance: [1e-6]}}\n";
  write("studies/study.yaml", "scene: ../s/rod.yaml\n" + rest);
  says(pintle("sweep ../studies/study.yaml -q -o out"), "exit 0");
  write("studies/study.yaml", "scene: /etc/passwd\n" + rest);
  const string said = pintle("sweep ../studies/study.yaml -q -o out2");
  says(said, "study.yaml:1: scene: \"/etc/passwd\" is not a scene");
  EXPECT_EQ(said.find("root:"), string::npos);
}

TEST_F(Bounds, CtrlCEndsAMeshAtOnce) {
  write("s/endless.geo", "For i In {1:1e9}\nx = i;\nEndFor\n" + square);
  plate("b.geo");
  write("s/b.geo", square);
  write("s/study.yaml",
        "scene: plate.yaml\nmeasure: {a: final angle of arm}\nset: {gravity: [0, 0]}\n"
        "sweep: {list: [{bodies.arm.plate.file: b.geo}, {bodies.arm.plate.file: endless.geo}]}\n");
  const auto begin = std::chrono::steady_clock::now();
  const string said = pintle(
      "sweep study.yaml -q -o out --threads 1 & p=$!; until grep -q finished out/journal-0.txt 2>/dev/null; do sleep 0.1; done; sleep 0.5; "
      "kill -INT $p; wait $p; echo ended $? #");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  says(said, "ended 6");
  const string journal = contents("out/journal-0.txt");
  EXPECT_EQ(journal.find("refused"), string::npos) << "the case that was stopped is run again: " << journal;
}

}  // namespace
