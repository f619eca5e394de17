// Finished meshes (.msh) with faults: refused with their line, or harmless.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshes/gmsh.h"
#include "meshes/quality.h"
#include "meshes/soundness.h"

namespace pintle::msh_test {
namespace {

namespace fs = std::filesystem;
using Lines = std::vector<std::string>;

const Lines four_nodes{"1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0"}, two_cells{"1 1 2 3", "2 1 3 4"};
const std::string names = "$PhysicalNames\n2\n1 7 \"edge\"\n2 1 \"steel\"\n$EndPhysicalNames\n";

std::string joined(const Lines& lines, const std::string& before = "") {
  std::string out;
  for (const std::string& line : lines) out += before + line + "\n";
  return out;
}
/// A unit square of two triangles in the plane, number and three nodes of each.
std::string version_2(const Lines& nodes, const Lines& cells, const std::string& groups = "", std::optional<std::size_t> node_count = {},
                      std::optional<std::size_t> cell_count = {}) {
  std::string out = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + groups + "$Nodes\n" + std::to_string(node_count.value_or(nodes.size())) +
                    "\n" + joined(nodes) + "$EndNodes\n$Elements\n" + std::to_string(cell_count.value_or(cells.size())) + "\n";
  for (const std::string& cell : cells) {
    const std::size_t blank = cell.find(' ');
    out += cell.substr(0, blank) + " 2 2 1 1" + cell.substr(blank) + "\n";
  }
  return out + "$EndElements\n";
}
std::string version_4(const Lines& nodes, const Lines& cells, std::optional<std::size_t> node_count = {},
                      std::optional<std::size_t> cell_count = {}) {
  const auto block = [](std::optional<std::size_t> count, const Lines& of) {
    return " " + std::to_string(count.value_or(of.size())) + "\n";
  };
  std::string out = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 1 1 0 1 1 0\n$EndEntities\n$Nodes\n1 " +
                    std::to_string(nodes.size()) + " 1 9\n2 1 0" + block(node_count, nodes);
  for (const std::string& node : nodes) out += node.substr(0, node.find(' ')) + "\n";
  for (const std::string& node : nodes) out += node.substr(node.find(' ') + 1) + "\n";
  return out + "$EndNodes\n$Elements\n1 " + std::to_string(cells.size()) + " 1 9\n2 1 2" + block(cell_count, cells) + joined(cells) +
         "$EndElements\n";
}

struct Read {
  Mesh mesh;
  std::string said;
};
Read read(const std::string& text) {
  std::string folder = (fs::temp_directory_path() / "pintle_msh_XXXXXX").string();
  const fs::path path = fs::path(mkdtemp(folder.data())) / "m.msh";
  std::ofstream(path, std::ios::binary) << text;
  Read out;
  try {
    out.mesh = read_geometry(path, {});
  } catch (const std::exception& e) {
    out.said = e.what();
  }
  fs::remove_all(folder);
  return out;
}
void expect_square(const std::string& text) {
  const Read r = read(text);
  EXPECT_EQ(r.said, "") << text;
  EXPECT_EQ(r.mesh.x.cols(), 4) << text;
  EXPECT_EQ(r.mesh.cell_count(), 2U) << text;
}
void expect_refused(const std::string& text, const std::string& where, const std::string& what) {
  const std::string said = read(text).said;
  EXPECT_NE(said.find("m.msh" + where), std::string::npos) << said << "\n" << text;
  EXPECT_NE(said.find(what), std::string::npos) << said << "\n" << text;
}
Lines with(Lines lines, const std::string& more) {
  lines.push_back(more);
  return lines;
}
Lines with(Lines lines, std::size_t at, const std::string& other) {
  lines.at(at) = other;
  return lines;
}

TEST(MshFile, ANodeNumberAtTwoPlacesIsRefusedWithBothLines) {
  expect_refused(version_2(with(four_nodes, "3 5 5 0"), two_cells), ":10:", "line 8");
  expect_refused(version_4(with(four_nodes, "3 5 5 0"), two_cells), ":20:", "line 18");
}
TEST(MshFile, ANodeWrittenTwiceAtOnePlaceIsOne) {
  expect_square(version_2(with(four_nodes, four_nodes[2]), two_cells));
  expect_square(version_4(with(four_nodes, four_nodes[2]), two_cells));
}
TEST(MshFile, NodesThatNoCellUsesAreDropped) {
  expect_square(version_2(with(four_nodes, "9 5 5 0"), two_cells));
  expect_square(version_4(with(four_nodes, "9 5 5 0"), two_cells));
}
TEST(MshFile, APlaceThatIsNotFiniteIsRefusedWithItsLine) {
  for (const char* wrong : {"3 1 nan 0", "3 1 inf 0", "3 1 -infinity 0", "3 1 1 nan"}) {
    expect_refused(version_2(with(four_nodes, 2, wrong), two_cells), ":8:", "finite");
    expect_refused(version_4(with(four_nodes, 2, wrong), two_cells), ":17:", "finite");
  }
  expect_refused(version_2(with(four_nodes, 2, "3 1 1e999 0"), two_cells), ":8:", "three coordinates");
  expect_refused(version_2(with(four_nodes, 2, "3 1 x 0"), two_cells), ":8:", "three coordinates");
  expect_square(version_2(with(four_nodes, 0, "1 4.9e-324 -1e-330 0"), two_cells));
}
// Gmsh would pass over the rest, or take it for something else.
TEST(MshFile, ACountThatIsNotThatOfItsLinesIsRefused) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{3}}) {
    expect_refused(version_2(four_nodes, two_cells, "", count), ":", "more nodes");
    expect_refused(version_4(four_nodes, two_cells, count), ":", count == 0 ? "more nodes" : "node");
  }
  for (const std::size_t count : {std::size_t{5}, std::size_t{4'000'000'000'000}}) {
    expect_refused(version_2(four_nodes, two_cells, "", count), ":10:", "node 5");
    expect_refused(version_4(four_nodes, two_cells, count), ":", "node");
  }
  expect_refused(version_2(four_nodes, two_cells, "", {}, 1), ":14:", "more elements");
  expect_refused(version_4(four_nodes, two_cells, {}, 1), ":", "more elements");
  expect_refused(version_2(four_nodes, two_cells, "", {}, 3), ":15:", "element 3");
  expect_refused(version_4(four_nodes, two_cells, {}, 3), ":", "element 3");
}
TEST(MshFile, CutAnywhereItIsRefusedOrWhole) {
  for (const std::string& text : {version_2(four_nodes, two_cells, names), version_4(four_nodes, two_cells)}) {
    const std::size_t whole = text.rfind("$EndElements"), step = 7;
    for (std::size_t size = 0; size < whole; size += step) {
      const Read r = read(text.substr(0, size));
      EXPECT_TRUE(!r.said.empty() || r.mesh.cell_count() == 0) << text.substr(0, size);
    }
  }
}
TEST(MshFile, ACellOfANodeThatIsNotThereIsRefused) {
  for (const char* wrong : {"2 1 3 44", "2 1 3 0", "2 1 3 -4", "2 1 3 4000000000000"}) {
    EXPECT_NE(read(version_2(four_nodes, with(two_cells, 1, wrong))).said, "") << wrong;
    EXPECT_NE(read(version_4(four_nodes, with(two_cells, 1, wrong))).said, "") << wrong;
  }
}
TEST(MshFile, NumbersNeedNotBeDenseOrSmall) {
  expect_square(version_2(with(four_nodes, 3, "2000000000 0 1 0"), with(two_cells, 1, "7 1 3 2000000000")));
  expect_square(version_4(with(four_nodes, 3, "2000000000 0 1 0"), with(two_cells, 1, "7 1 3 2000000000")));
}
// Of two cells with one number Gmsh would leave one out: a hole in the body.
TEST(MshFile, ACellNumberOfTwoCellsIsRefusedWithBothLines) {
  expect_refused(version_2(four_nodes, with(two_cells, 1, "1 1 3 4")), ":14:", "line 13");
  expect_refused(version_4(four_nodes, with(two_cells, 1, "1 1 3 4")), ":24:", "line 23");
}
TEST(MshFile, CellsOnEachOtherAreUnsound) {
  for (const char* more : {"3 1 3 4", "2 1 2 4"}) {
    const Read r = read(version_2(four_nodes, with(two_cells, more)));
    EXPECT_TRUE(!r.said.empty() || !soundness(r.mesh).faults.empty()) << more;
  }
}
TEST(MshFile, AGroupWithoutCellsIsNone) {
  const Read r = read(version_2(four_nodes, two_cells, names));
  ASSERT_EQ(r.said, "");
  EXPECT_EQ(r.mesh.group("edge"), nullptr);
  ASSERT_NE(r.mesh.group("steel"), nullptr);
  EXPECT_EQ(r.mesh.group("steel")->nodes.size(), 4U);
}

}  // namespace
}  // namespace pintle::msh_test
