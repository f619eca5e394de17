// The command that only makes the mesh names what is doubtful in it, on the screen and in mesh.json.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/program.h"

namespace {

using namespace pintle_test;

struct Doubted {
  const char *cells, *named;
};
void PrintTo(const Doubted& each, std::ostream* out) { *out << each.named; }

class MeshCommand : public testing::TestWithParam<Doubted> {};

TEST_P(MeshCommand, NamesWhatIsDoubtful) {
  const Folder folder;
  folder.write("plate.inp",
               "*NODE\n1,0,0\n2,10,0\n3,20,0\n4,0,10\n5,10,10\n6,20,10\n7,0,20\n8,10,20\n9,20,20\n10,10,0\n*ELEMENT, TYPE=CPS4\n" +
                   std::string(GetParam().cells));
  const auto scene = folder.write("plate.yaml",
                                  "bodies: {arm: {plate: {file: plate.inp, unit: mm, thickness: 5 mm, young: 207 GPa, poisson: 0.3, "
                                  "density: 7850}, points: {O: [0, 0]}}}\n");
  const auto out = folder.path() / "meshed";
  const Ended end = run(folder.path() / "log", {PINTLE_PROGRAM, "mesh", scene.string(), "--out", out.string()});
  EXPECT_EQ(end.code, 0) << end.complained;
  EXPECT_NE((end.said + end.complained).find("warning: "), std::string::npos) << end.said;
  for (const std::string& told : {end.said + end.complained, contents(out / "mesh.json")})
    EXPECT_NE(told.find(GetParam().named), std::string::npos) << told;
}

INSTANTIATE_TEST_SUITE_P(Each, MeshCommand,
                         testing::Values(Doubted{"1,1,2,5,4\n2,10,3,6,5\n3,4,5,8,7\n4,5,6,9,8\n", "slit"},
                                         Doubted{"1,1,2,5,4\n2,5,6,9,8\n", "hinge"}),
                         [](const auto& each) { return std::string(each.param.named); });

}  // namespace
