// What is wrong in a .geo script is said with its line and a remedy.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "meshes/gmsh.h"

namespace pintle::geo_words_test {
namespace {

namespace fs = std::filesystem;

TEST(GeoFile, WhatIsWrongIsSaidWithItsLineAndARemedy) {
  std::string pattern = (fs::temp_directory_path() / "pintle_words_XXXXXX").string();
  const fs::path folder = fs::canonical(mkdtemp(pattern.data())), inner = folder / "inner";
  fs::create_directory(inner);
  std::ofstream(folder / "outside.geo") << "Point(9)={0,0,0};\n";
  struct Case {
    std::string script, line;
    std::vector<std::string> said;
  };
  for (const Case& c :
       std::vector<Case>{{"SystemCall \"true\";", ":3: ", {"--trust-geo"}},
                         {"Include \"../outside.geo\";", ":3: ", {"--allow-path " + folder.string(), "outside.geo"}},
                         {"Merge \"" + (folder / "outside.geo").string() + "\";", ":3: ", {"--allow-path " + folder.string()}},
                         {"Include \"none.geo\";", ":3: ", {"none.geo", "no such file"}},
                         {"Printf(\"a\") > \"" + (folder / "made").string() + "\";", ":3: ", {"must not write files", "--trust-geo"}},
                         {"Point(2)={1,0,0;", ":3: ", {"syntax error"}},
                         {"x = nothing + 1;", ":3: ", {"Unknown variable"}}}) {
    const fs::path file = inner / "drawing.geo";
    std::ofstream(file) << "// a drawing\nPoint(1)={0,0,0};\n" + c.script + "\n";
    std::string said = "read";
    try {
      read_geometry(file, {});
    } catch (const std::exception& e) {
      said = e.what();
    }
    EXPECT_NE(said.find("drawing.geo" + c.line), std::string::npos) << c.script << ": " << said;
    for (const std::string& part : c.said) EXPECT_NE(said.find(part), std::string::npos) << c.script << ": " << said;
  }
  EXPECT_FALSE(fs::exists(folder / "made"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace pintle::geo_words_test
