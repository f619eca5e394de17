// Reading CalculiX and Abaqus decks. What the files in tests/data/meshes hold is drawn in their
// comments and computed here by hand.

#include "meshes/inp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "meshes/quality.h"
#include "tests/unit/meshes/mesh_sides.h"
#include "tests/refusal.h"

namespace pintle::inp_test {
namespace {

namespace fs = std::filesystem;

const fs::path data = fs::path(PINTLE_SOURCE_DIR) / "tests/data/meshes";

/// A deck of its own, removed at the end.
class Deck {
 public:
  explicit Deck(const std::string& text, const std::string& name = "deck.inp") {
    std::string pattern = (fs::temp_directory_path() / "pintle_inp_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    write(name, text);
    path_ = folder_ / name;
  }
  ~Deck() { fs::remove_all(folder_); }
  Deck(const Deck&) = delete;
  Deck& operator=(const Deck&) = delete;
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  const fs::path& path() const { return path_; }

 private:
  fs::path folder_, path_;
};

std::vector<long> numbers_of(const Mesh& mesh, const std::string& group) {
  std::vector<long> numbers;
  if (const Group* g = mesh.group(group))
    for (const int node : g->nodes) numbers.push_back(mesh.node_numbers[static_cast<std::size_t>(node)]);
  return numbers;
}
std::size_t sides_of(const Mesh& mesh, const std::string& group) {
  const Group* g = mesh.group(group);
  return g ? count(g->sides) : 0;
}
using Numbers = std::vector<long>;

TEST(InpCalculix, CellsComeWithTheNumbersOfTheFile) {
  const Mesh mesh = read_inp(data / "bracket_ccx.inp");
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells[0].shape, CellShape::quadrilateral8);
  EXPECT_EQ(mesh.cells[0].numbers, (Numbers{10, 20}));
  EXPECT_EQ(mesh.x.cols(), 13);  // node 99 belongs to no cell
  EXPECT_EQ(mesh.x.col(12), Eigen::Vector2d(3, 2)) << "2.0D+00 is two";
  EXPECT_EQ(quality(mesh).least_jacobian, 1);
}

TEST(InpCalculix, NodeSetsMayGenerateNameOtherSetsAndElementSets) {
  const Mesh mesh = read_inp(data / "bracket_ccx.inp");
  EXPECT_EQ(numbers_of(mesh, "LEFT"), (Numbers{1, 4, 9}));
  EXPECT_EQ(numbers_of(mesh, "odd"), (Numbers{1, 3, 5, 7, 9, 11, 13}));
  EXPECT_EQ(numbers_of(mesh, "both"), (Numbers{1, 3, 4, 9}));
  EXPECT_EQ(numbers_of(mesh, "of_right_half"), (Numbers{2, 3, 5, 6, 8, 10, 11, 13}));
  EXPECT_EQ(numbers_of(mesh, "right_half"), (Numbers{2, 3, 5, 6, 8, 10, 11, 13}));
  EXPECT_EQ(mesh.group("ref"), nullptr) << "a reference node is no part of the mesh";
}

TEST(InpCalculix, SurfacesAreTheLabelledSides) {
  const Mesh mesh = read_inp(data / "bracket_ccx.inp");
  EXPECT_EQ(numbers_of(mesh, "Top"), (Numbers{4, 5, 6, 12, 13}));
  EXPECT_EQ(sides_of(mesh, "Top"), 2u);
  EXPECT_EQ(numbers_of(mesh, "ends"), (Numbers{1, 3, 4, 6, 9, 11}));
  EXPECT_EQ(sides_of(mesh, "all_round"), 6u) << "no side between the two cells";
  ASSERT_NE(mesh.group("all_round"), nullptr);
  EXPECT_DOUBLE_EQ(area_left_of(mesh, mesh.group("all_round")->sides), 8) << "4 by 2, the body on the left";
}

TEST(InpCalculix, ScaleMultipliesLengths) {
  const Mesh mesh = read_inp(data / "bracket_ccx.inp", 0.001);
  EXPECT_DOUBLE_EQ(mesh.x.row(0).maxCoeff(), 0.004);
}

TEST(InpAbaqus, PartAndAssemblyAreOneBody) {
  const Mesh mesh = read_inp(data / "strip_abaqus.inp");
  EXPECT_EQ(mesh.cell_count(), 3u);
  EXPECT_EQ(mesh.cells.size(), 2u);
  EXPECT_EQ(numbers_of(mesh, "left end"), (Numbers{1, 4}));
  EXPECT_EQ(numbers_of(mesh, "Set-1").size(), 7u) << "node set and element set of one name are one group";
}

TEST(InpAbaqus, ClockwiseCellIsTurnedAndItsEdgesKeepTheBodyOnTheirLeft) {
  const Mesh mesh = read_inp(data / "strip_abaqus.inp");
  EXPECT_EQ(quality(mesh).inverted.size(), 0u);
  const Group* bottom = mesh.group("Bottom");
  ASSERT_NE(bottom, nullptr);
  EXPECT_EQ(numbers_of(mesh, "Bottom"), (Numbers{1, 2, 3}));
  for (const Cells& sides : bottom->sides)
    for (std::size_t s = 0; s < sides.size(); ++s)
      EXPECT_LT(mesh.x(0, sides.nodes[2 * s]), mesh.x(0, sides.nodes[2 * s + 1])) << "left to right";
}

TEST(InpGmsh, CurvesWrittenAsTrussesAreEdges) {
  const Mesh mesh = read_inp(data / "rocker_gmsh.inp");
  EXPECT_TRUE(mesh.plane());
  ASSERT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.cells[0].shape, CellShape::triangle6);
  const Group* hole = mesh.group("pin_hole");
  ASSERT_NE(hole, nullptr);
  // n parabolas through three points each of a circle of radius 0.01; the body is outside.
  const double n = static_cast<double>(sides_of(mesh, "pin_hole")), b = M_PI / n;
  const double parabolas = n * (std::sin(2 * b) / 2 + 4 * std::sin(b) * (1 - std::cos(b)) / 3) * 1e-4;
  EXPECT_NEAR(area_left_of(mesh, hole->sides), -parabolas, 1e-12 * parabolas);
  EXPECT_NE(mesh.group("hole 1"), nullptr) << "the hole without a name gets one";
  EXPECT_EQ(mesh.group("hole 2"), nullptr);
}

TEST(InpBeams, TheMiddleNodeIsFoundWhereItLies) {
  const std::string nodes = "*NODE\n1,0\n2,1\n3,2\n";
  const Mesh abaqus = read_inp(Deck(nodes + "*ELEMENT,TYPE=B32\n1,1,2,3\n").path());
  const Mesh gmsh = read_inp(Deck(nodes + "*ELEMENT,TYPE=T3D3\n1,1,3,2\n").path());
  for (const Mesh& mesh : {abaqus, gmsh}) {
    ASSERT_EQ(mesh.cells.size(), 1u);
    EXPECT_EQ(mesh.cells[0].shape, CellShape::line3);
    EXPECT_EQ(mesh.cells[0].nodes, (std::vector<int>{0, 2, 1}));
    EXPECT_FALSE(mesh.plane());
  }
}

TEST(InpInclude, FilesStandBesideTheOneThatNamesThem) {
  Deck deck("*INCLUDE, INPUT=part/nodes.inc\n*ELEMENT,TYPE=CPS3\n1,1,2,3\n");
  fs::create_directory(deck.path().parent_path() / "part");
  deck.write("part/nodes.inc", "*NODE\n1,0,0\n2,1,0\n*INCLUDE,INPUT=third.inc\n");
  deck.write("part/third.inc", "3,0,1\n");
  EXPECT_EQ(read_inp(deck.path()).x.cols(), 3);
}

struct Bad {
  const char* what;
  const char* text;
  const char* line;   // of the complaint
  const char* words;  // in it
};
const std::string square = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n*ELEMENT,TYPE=CPS4,ELSET=E\n1,1,2,3,4\n";

class InpRefuses : public testing::TestWithParam<Bad> {};

TEST_P(InpRefuses, WithFileAndLine) {
  const Deck deck(square + GetParam().text);
  pintle_test::expect_refused<std::invalid_argument>([&] { read_inp(deck.path()); },
                                                     {"deck.inp:" + std::string(GetParam().line) + ":", GetParam().words});
}

INSTANTIATE_TEST_SUITE_P(Each, InpRefuses,
                         testing::Values(Bad{"NodeDefinedTwice", "*NODE\n3,5,5\n", "9", "node 3 is defined again, first on line 4"},
                                         Bad{"ElementDefinedTwice", "*ELEMENT,TYPE=CPS3\n1,1,2,3\n", "9", "element 1 is defined again"},
                                         Bad{"UndefinedNode", "*ELEMENT,TYPE=CPS3\n2,1,2,8\n", "9", "node 8, which no *NODE defines"},
                                         Bad{"CollapsedElement", "*ELEMENT,TYPE=CPS4\n2,1,2,3,3\n", "9", "twice"},
                                         Bad{"TooFewNodes", "*ELEMENT,TYPE=CPS4\n2,1,2,3\n*NSET,NSET=A\n1\n", "9",
                                             "has 3 nodes, must have 4"},
                                         Bad{"TooManyNodes", "*ELEMENT,TYPE=CPS3\n2,1,2,3,4\n", "9", "more than its 3 nodes"},
                                         Bad{"Axisymmetric", "*ELEMENT,TYPE=CAX4\n2,1,2,3,4\n", "8", "axisymmetric"},
                                         Bad{"Solid", "*ELEMENT,TYPE=C3D8\n2,1,2,3,4,1,2,3,4\n", "8", "solid"},
                                         Bad{"GeneralisedPlaneStrain", "*ELEMENT,TYPE=CPEG4\n", "8", "generalised plane strain"},
                                         Bad{"UnknownElement", "*ELEMENT,TYPE=SPRINGA\n2,1,2\n", "8", "is not known"},
                                         Bad{"ElementWithoutType", "*ELEMENT\n2,1,2\n", "8", "without TYPE="},
                                         Bad{"UnknownNodeInSet", "*NSET,NSET=A\n1,77\n", "9", "names node 77, which is not defined"},
                                         Bad{"UnknownSetInSet", "*NSET,NSET=A\n1,elsewhere\n", "9", "there is no node set \"elsewhere\""},
                                         Bad{"UnknownElementInSurface", "*SURFACE,NAME=A\n5,S1\n", "9", "names element 5"},
                                         Bad{"UnknownSetInSurface", "*SURFACE,NAME=A\nF,S1\n", "9", "there is no element set \"F\""},
                                         Bad{"SideThatIsNone", "*SURFACE,NAME=A\nE,S5\n", "9", "\"S5\" is no side"},
                                         Bad{"SetThatHoldsItself", "*NSET,NSET=A\nB\n*NSET,NSET=B\nA\n", "8", "contains itself"},
                                         Bad{"SetWithoutName", "*NSET\n1\n", "8", "without NSET="},
                                         Bad{"WordForANumber", "*NODE\nfive,0,0\n", "9", "\"five\" is no node number"},
                                         Bad{"WordForACoordinate", "*NODE\n5,0,here\n", "9", "\"here\" is no coordinate"},
                                         Bad{"NotFinite", "*NODE\n5,0,nan\n", "9", "\"nan\" is no coordinate"},
                                         Bad{"OutOfThePlane", "*NODE\n5,0,0,0.5\n", "9", "z = 0.5"},
                                         Bad{"CylindricalNodes", "*NODE,SYSTEM=C\n5,1,90\n", "8", "SYSTEM=C"},
                                         Bad{"GeneratedNodes", "*NGEN\n1,4,1\n", "8", "*NGEN is not read"},
                                         Bad{"RangeBackwards", "*NSET,NSET=A,GENERATE\n5,1\n", "9", "GENERATE needs"},
                                         Bad{"SecondPart", "*PART,NAME=A\n*END PART\n*PART,NAME=B\n", "10", "a second *PART"},
                                         Bad{"MovedInstance", "*INSTANCE,NAME=A,PART=P\n1.,0.,0.\n", "9", "moved or turned"},
                                         Bad{"MissingInclude", "*INCLUDE,INPUT=nowhere.inc\n", "8", "there is no file"},
                                         Bad{"IncludeOfItself", "*INCLUDE,INPUT=deck.inp\n", "8", "includes this file itself"}),
                         [](const testing::TestParamInfo<Bad>& param) { return std::string(param.param.what); });

TEST(InpRefusesWhole, NoElementNoFileNoScale) {
  EXPECT_THROW(read_inp(Deck("*NODE\n1,0,0\n").path()), std::invalid_argument);
  EXPECT_THROW(read_inp(data / "no_such_file.inp"), std::runtime_error);
  EXPECT_THROW(read_inp(data / "bracket_ccx.inp", 0), std::invalid_argument);
  EXPECT_THROW(read_inp(data / "bracket_ccx.inp", -1), std::invalid_argument);
}

TEST(InpNumbers, MayHaveGapsAndComeInAnyOrder) {
  const Mesh mesh = read_inp(Deck("*NODE\n900000000,1,1\n7,0,0\n42,1,0\n8,0,1\n"
                                  "*ELEMENT,TYPE=CPE4,ELSET=e\n5000000,7,42,900000000,8\n*NSET,NSET=right\n900000000,42\n")
                                 .path());
  EXPECT_EQ(quality(mesh).least_jacobian, 1);
  EXPECT_EQ(mesh.cells[0].numbers, (Numbers{5000000}));
  ASSERT_NE(mesh.group("right"), nullptr);
  for (const int node : mesh.group("right")->nodes) EXPECT_EQ(mesh.x(0, node), 1);
}

const std::string one_triangle = "*NODE\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT,TYPE=CPS3\n7,1,2,3\n";
constexpr const char* greatest = "9223372036854775807";

TEST(InpNumbers, ARangeUpToTheGreatestNumberEnds) {
  for (const std::string& range : {std::string("1,") + greatest + ",9223372036854775806", std::string("2,") + greatest,
                                   std::string(greatest) + "," + greatest + "," + greatest}) {
    const Mesh mesh =
        read_inp(Deck(one_triangle + "*NSET,NSET=a,GENERATE\n" + range + "\n*ELSET,ELSET=e,GENERATE\n1," + greatest + "\n").path());
    EXPECT_EQ(numbers_of(mesh, "e"), (Numbers{1, 2, 3})) << range;
  }
  EXPECT_EQ(numbers_of(read_inp(Deck(one_triangle + "*NSET,NSET=a,GENERATE\n1," + greatest + ",2\n").path()), "a"), (Numbers{1, 3}));
}

TEST(InpNumbers, NodesMayHaveTheGreatestNumber) {
  const std::string n = greatest;
  const Mesh mesh = read_inp(Deck("*NODE,NSET=all\n1,0,0\n2,1,0\n" + n + ",0,1\n*ELEMENT,TYPE=CPS3\n" + n + ",1,2," + n + "\n").path());
  EXPECT_EQ(numbers_of(mesh, "all").back(), std::stol(n));
}

TEST(InpNumbers, OnesTooGreatAreRefusedByLine) {
  for (const char* number : {"9223372036854775808", "-1", "0", "1e3", "99999999999999999999999"})
    for (const std::string& text :
         {"*NODE\n" + std::string(number) + ",0,0\n", one_triangle + "*ELEMENT,TYPE=CPS3\n" + number + ",1,2,3\n",
          one_triangle + "*ELEMENT,TYPE=CPS3\n8,1,2," + number + "\n", one_triangle + "*NSET,NSET=a,GENERATE\n1," + number + "\n",
          one_triangle + "*NSET,NSET=a\n" + number + "\n"})
      EXPECT_THROW(read_inp(Deck(text).path()), std::invalid_argument) << text;
}

TEST(InpSets, ThatNameOthersTwiceEachAreGatheredOnce) {
  std::string text = one_triangle + "*NSET,NSET=s0\n1,2\n";
  for (int k = 1; k < 60; ++k) {
    const std::string before = "s" + std::to_string(k - 1);
    text += "*NSET,NSET=s" + std::to_string(k) + "\n" + before + "," + before + "\n";
  }
  EXPECT_EQ(numbers_of(read_inp(Deck(text).path()), "s59"), (Numbers{1, 2}));
}

TEST(InpSets, NestedWithoutEndAreRefused) {
  std::string text = one_triangle;
  for (int k = 0; k < 200'000; ++k) text += "*NSET,NSET=s" + std::to_string(k) + "\ns" + std::to_string(k + 1) + "\n";
  EXPECT_THROW(read_inp(Deck(text).path()), std::invalid_argument);
}

}  // namespace
}  // namespace pintle::inp_test
