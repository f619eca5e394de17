// What a scene may read: ordinary files in its folder and below, and where the user allows it.

#include "files/files.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "files/trust.h"
#include "framework/scene/yaml/reader.h"
#include "meshes/inp.h"
#include "tests/refusal.h"

namespace pintle::files_test {
namespace {

namespace fs = std::filesystem;

const std::string numbers = "0 1\n0.5 2\n1 3\n";
const std::string secret = "open sesame\n";

/// A folder with a scene's folder in it, gone at the end.
struct Contained : testing::Test {
  Contained() {
    std::string pattern = (fs::temp_directory_path() / "pintle_files_XXXXXX").string();
    folder = fs::canonical(mkdtemp(pattern.data()));
    fs::create_directories(scene() / "sub");
    write(folder / "outside.csv", numbers);
    write(scene() / "inside.csv", numbers);
  }
  ~Contained() override {
    fs::remove_all(folder);
    set_trust({});
  }
  fs::path scene() const { return folder / "scene"; }
  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }

  std::string said_of_table(const std::string& name) const {
    return said(
        "{title: t, bodies: {a: {rigid: {mass: 1 kg, inertia: 1}}}, joints: {j: {revolute: [ground, a]}}, "
        "forces: {f: {torque: {table: \"" +
        name + "\"}, on: a}}, run: {until: 1 s}}");
  }
  std::string said_of_mesh(const std::string& name) const {
    return said("{bodies: {a: {plate: {file: \"" + name + "\", thickness: 1 mm, young: 1 GPa, poisson: 0.3, density: 1}}}}");
  }
  template <class Read>
  std::string said(const std::string& name, const std::string& text, Read read) const {
    write(scene() / name, text);
    return pintle_test::refusal_by<std::exception>([&] { read(scene() / name); });
  }
  std::string said(const std::string& text) const {
    return said("scene.yaml", text, [](const fs::path& path) { read_scene(path); });
  }
  std::string said_of_inp(const std::string& text) const {
    return said("deck.inp", text, [](const fs::path& path) { read_inp(path); });
  }
  fs::path folder;
};

void says(const std::string& said, const std::string& part) {
  EXPECT_NE(said.find(part), std::string::npos) << "\"" << said << "\" lacks \"" << part << "\"";
}
void hides(const std::string& said, const std::string& part) { EXPECT_EQ(said.find(part), std::string::npos) << "\"" << said << "\""; }

TEST_F(Contained, TablesLieInTheScenesFolderOrBelow) {
  EXPECT_EQ(said_of_table("inside.csv"), "accepted");
  EXPECT_EQ(said_of_table("sub/../inside.csv"), "accepted");
  EXPECT_EQ(said_of_table((scene() / "inside.csv").string()), "accepted");
  fs::create_symlink("../inside.csv", scene() / "sub/link.csv");
  EXPECT_EQ(said_of_table("sub/link.csv"), "accepted");
  for (const std::string& name : {std::string("../outside.csv"), (folder / "outside.csv").string(), std::string("sub/../../outside.csv"),
                                  std::string("/proc/self/environ"), std::string("../nothing.csv")}) {
    says(said_of_table(name), "forces.f.torque.table");
    says(said_of_table(name), "--allow-path");
  }
}

TEST_F(Contained, ASymbolicLinkLeadsNowhereElse) {
  fs::create_symlink(folder / "outside.csv", scene() / "file.csv");
  fs::create_directory_symlink(folder, scene() / "up");
  says(said_of_table("file.csv"), "--allow-path");
  says(said_of_table("up/outside.csv"), "--allow-path");
}

TEST_F(Contained, ANeighbourWhoseNameBeginsAlikeIsOutside) {
  fs::create_directory(folder / "scene2");
  write(folder / "scene2/a.csv", numbers);
  says(said_of_table("../scene2/a.csv"), "--allow-path");
}

TEST_F(Contained, TheUserMayAllowAFolder) {
  set_trust({{folder}, false});
  EXPECT_EQ(said_of_table("../outside.csv"), "accepted");
  set_trust({{scene() / "sub"}, false});
  says(said_of_table("../outside.csv"), "--allow-path");
}

TEST_F(Contained, DrawingsAndMeshesLieThereToo) {
  for (const char* kind : {"inp", "msh", "geo", "step", "brep"}) {
    write(folder / ("m." + std::string(kind)), "x\n");
    says(said_of_mesh("../m." + std::string(kind)), "--allow-path");
  }
}

TEST_F(Contained, WhatIsIncludedLiesThereToo) {
  write(folder / "nodes.inp", "*NODE\n1,0,0\n");
  says(said_of_inp("*INCLUDE, INPUT=../nodes.inp\n"), "deck.inp:1: *INCLUDE of \"../nodes.inp\" lies outside");
  says(said_of_inp("*INCLUDE, INPUT=/etc/passwd\n"), "lies outside");
  write(scene() / "sub/nodes.inp", "*NODE\n1,0,0\n*INCLUDE, INPUT=../more.inp\n");
  write(scene() / "more.inp", "2,1,0\n3,0,1\n");
  EXPECT_EQ(said_of_inp("*INCLUDE, INPUT=sub/nodes.inp\n*ELEMENT, TYPE=CPS3\n1,1,2,3\n"), "accepted");
}

TEST_F(Contained, PipesDevicesAndFoldersAreRefusedAtOnce) {
  ASSERT_EQ(mkfifo((scene() / "pipe.csv").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo((scene() / "pipe.inp").c_str(), 0600), 0);
  says(said_of_table("pipe.csv"), "ordinary file");
  says(said_of_table("sub"), "directory");
  set_trust({{"/dev"}, false});
  says(said_of_table("/dev/zero"), "ordinary file");
  EXPECT_THROW(read_inp(scene() / "pipe.inp"), std::runtime_error);
  EXPECT_THROW(read_inp(scene() / "sub"), std::runtime_error);
  EXPECT_THROW(read_inp("/dev/zero"), std::runtime_error);
  says(said_of_inp("*INCLUDE, INPUT=pipe.inp\n"), "ordinary file");
}

TEST_F(Contained, WhatIsNoTableOrInputFileIsNotShown) {
  for (const char* name : {"inside.csv", "secret.inp"}) write(scene() / name, secret + secret);
  says(said_of_table("inside.csv"), "inside.csv:2");
  for (const std::string& said : {said_of_table("inside.csv"), said_of_inp("*INCLUDE, INPUT=secret.inp\n"), said_of_inp(secret)}) {
    hides(said, "open");
    hides(said, "sesame");
  }
  says(said_of_inp("*NODE\n*INCLUDE, INPUT=secret.inp\n"), "secret.inp:1");
}

TEST_F(Contained, FilesThatIncludeThemselvesOrEachOtherAreRefused) {
  says(said_of_inp("*INCLUDE, INPUT=deck.inp\n"), "includes this file itself");
  fs::create_symlink("deck.inp", scene() / "alias.inp");
  says(said_of_inp("*INCLUDE, INPUT=alias.inp\n"), "includes this file itself");
  write(scene() / "a.inp", "*INCLUDE, INPUT=b.inp\n");
  write(scene() / "b.inp", "*INCLUDE, INPUT=sub/../a.inp\n");
  says(said_of_inp("*INCLUDE, INPUT=a.inp\n"), "b.inp:1");
}

TEST_F(Contained, FilesThatIncludeTwoEachAreBounded) {
  for (int k = 0; k < 40; ++k) {
    const std::string next = "*INCLUDE, INPUT=f" + std::to_string(k + 1) + ".inp\n";
    write(scene() / ("f" + std::to_string(k) + ".inp"), next + next);
  }
  write(scene() / "f40.inp", "*NODE\n1,0,0\n");
  says(said_of_inp("*INCLUDE, INPUT=f0.inp\n"), "1000 files");
}

}  // namespace
}  // namespace pintle::files_test
