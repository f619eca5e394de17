// Who may include whom: docs name the layers, this table keeps them. Leaves know mathematics, the
// framework knows mechanics, the app knows files.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;
using Paths = std::vector<std::string_view>;

/// A folder and whose headers it may include beside its own; paths are prefixes. A folder inside another one stands before it.
struct Layer {
  std::string_view folder;
  Paths may;
};
/// Each layer comes after those that it may include: so there are no cycles, see ALayerIncludesOnlyThoseBeforeIt.
const std::vector<Layer> layers{
    {"files/", {}},
    {"elements/", {}},
    {"contact/", {}},
    {"meshes/", {"files/"}},

    {"framework/common/", {}},
    {"framework/scene/units/",
     {"framework/common/", "framework/scene/scene.h", "framework/scene/error.h", "framework/scene/joint_words.h",
      "framework/scene/text_file.h"}},
    {"framework/scene/yaml/", {"files/", "framework/common/", "framework/scene/"}},
    {"framework/scene/", {"files/", "elements/material.h", "elements/section.h", "meshes/link.h", "framework/common/"}},

    {"framework/component/eigen/", {"framework/common/"}},
    {"framework/component/fe/",
     {"elements/", "contact/complementarity.h", "contact/plane.h", "meshes/", "framework/common/", "framework/component/eigen/"}},
    {"framework/component/reduction/", {"meshes/", "framework/common/", "framework/component/eigen/", "framework/component/fe/"}},

    {"framework/dynamics/model/", {"contact/", "framework/common/", "framework/component/reduction/inertia.h"}},
    {"framework/dynamics/solvers/", {"framework/common/", "framework/dynamics/model/"}},
    {"framework/dynamics/equations/", {"contact/", "framework/common/", "framework/dynamics/model/", "framework/dynamics/solvers/"}},
    {"framework/dynamics/newton/", {"framework/common/", "framework/dynamics/solvers/", "framework/dynamics/equations/"}},
    {"framework/integration/explicit/",
     {"framework/common/", "framework/dynamics/", "framework/integration/constraint_treatment.h", "framework/integration/dense_output.h",
      "framework/integration/step.h", "framework/integration/stepper.h"}},
    {"framework/integration/implicit/",
     {"framework/common/", "framework/dynamics/", "framework/integration/dense_output.h", "framework/integration/step.h",
      "framework/integration/stepper.h"}},
    {"framework/integration/events/",
     {"framework/common/", "framework/dynamics/", "framework/integration/scheme.h", "framework/integration/step.h",
      "framework/integration/stepper.h"}},
    {"framework/integration/time_stepping/",
     {"framework/common/", "framework/dynamics/", "framework/integration/events/", "framework/integration/stepper.h"}},
    {"framework/integration/", {"framework/common/", "framework/dynamics/", "framework/integration/"}},

    {"framework/bodies/", {"files/", "meshes/", "framework/common/", "framework/scene/", "framework/component/", "framework/dynamics/"}},
    {"framework/drawing/", {"elements/", "meshes/", "framework/common/", "framework/component/", "framework/bodies/"}},
    {"framework/mechanism/",
     {"elements/", "framework/common/", "framework/scene/colour.h", "framework/dynamics/", "framework/integration/", "framework/bodies/",
      "framework/drawing/"}},
    {"framework/configuration/",
     {"framework/common/", "framework/scene/", "framework/dynamics/", "framework/integration/", "framework/bodies/",
      "framework/mechanism/"}},
    {"framework/build/",
     {"contact/", "framework/common/", "framework/scene/", "framework/component/", "framework/dynamics/model/", "framework/integration/",
      "framework/bodies/", "framework/mechanism/", "framework/configuration/"}},

    {"framework/analysis/simulate/",
     {"files/", "framework/common/", "framework/scene/", "framework/dynamics/", "framework/integration/", "framework/bodies/",
      "framework/mechanism/", "framework/configuration/", "framework/build/"}},
    {"framework/analysis/kinematics/",
     {"framework/common/", "framework/scene/", "framework/dynamics/", "framework/configuration/", "framework/analysis/simulate/"}},
    {"framework/analysis/linearize/",
     {"framework/common/", "framework/scene/", "framework/component/eigen/", "framework/dynamics/", "framework/integration/",
      "framework/bodies/", "framework/mechanism/", "framework/configuration/", "framework/analysis/kinematics/"}},
    {"framework/analysis/natural_modes/",
     {"framework/common/", "framework/scene/", "framework/component/", "framework/bodies/", "framework/build/"}},
    {"framework/analysis/static_case/",
     {"framework/common/", "framework/scene/", "framework/component/", "framework/bodies/", "framework/drawing/"}},
    {"framework/analysis/cost/",
     {"framework/common/", "framework/dynamics/equations/internal.h", "framework/integration/", "framework/mechanism/",
      "framework/configuration/", "framework/build/", "framework/analysis/simulate/explain_failure.h"}},
    {"framework/output/",
     {"framework/common/", "framework/scene/", "framework/integration/", "framework/mechanism/", "framework/configuration/",
      "framework/build/", "framework/analysis/"}},

    {"framework/study/measures/",
     {"framework/common/", "framework/scene/", "framework/bodies/", "framework/analysis/simulate/", "framework/analysis/linearize/",
      "framework/analysis/natural_modes/"}},
    {"framework/study/sweep/",
     {"files/", "framework/common/", "framework/scene/", "framework/bodies/", "framework/analysis/simulate/", "framework/study/case.h",
      "framework/study/share_out.h", "framework/study/study.h"}},
    {"framework/study/fit/",
     {"framework/common/", "framework/scene/", "framework/bodies/", "framework/study/changed_scene.h", "framework/study/share_out.h",
      "framework/study/study.h", "framework/study/sweep/"}},
    {"framework/study/sensitivity/", {"framework/common/", "framework/scene/", "framework/study/sweep/"}},
    {"framework/study/nonlinear/",
     {"framework/common/", "framework/scene/", "framework/integration/", "framework/bodies/", "framework/mechanism/",
      "framework/configuration/", "framework/build/", "framework/analysis/simulate/", "framework/study/case.h",
      "framework/study/share_out.h", "framework/study/study.h", "framework/study/sweep/"}},
    {"framework/study/tradeoff/",
     {"framework/common/", "framework/scene/", "framework/build/", "framework/analysis/simulate/", "framework/study/changed_scene.h",
      "framework/study/study.h"}},
    {"framework/study/",
     {"meshes/limits.h", "framework/common/", "framework/scene/", "framework/bodies/", "framework/configuration/", "framework/build/",
      "framework/analysis/", "framework/study/measures/"}},
    {"framework/plots/", {"framework/common/", "framework/study/tradeoff/"}},
    {"framework/report/",
     {"framework/common/", "framework/scene/", "framework/bodies/", "framework/drawing/", "framework/mechanism/", "framework/build/"}},

    {"fmi/", {"files/", "framework/"}},
    {"app/view/", {"files/noted.h", "framework/", "app/failure.h", "app/mistyped.h", "app/options.h", "app/progress.h"}},
    {"app/fmu/",
     {"files/", "fmi/contents.h", "meshes/module.h", "framework/", "app/failure.h", "app/mistyped.h", "app/options.h", "app/progress.h"}},
    {"app/hdf5/", {"framework/", "app/failure.h", "app/mistyped.h", "app/options.h", "app/progress.h"}},
    {"app/", {"files/", "elements/", "contact/", "meshes/", "framework/"}},
    {"examples/", {"elements/", "contact/", "meshes/", "framework/"}},
    {"tests/oracles/", {}},
    {"tests/fmi/importer", {}},  // of what it judges it knows nothing
    {"tests/", {"files/", "elements/", "contact/", "meshes/", "framework/", "app/", "tests/"}},
    {"benchmarks/",
     {"elements/", "contact/", "meshes/", "framework/", "tests/oracles/", "tests/paper/plot.h", "tests/scenes/mechanisms.h"}},
};

/// A dependency, by how its headers begin, and the only files that may know it.
struct Foreign {
  std::string_view header;
  Paths may;
};
const std::vector<Foreign> foreign{
    {"vtk",
     {"framework/drawing/vtk_encoder.cpp", "app/picture.cpp", "app/frames.cpp", "tests/unit/drawing/frame_files.h",
      "tests/unit/drawing/vtk_test.cpp", "tests/unit/drawing/flexible_frame_test.cpp"}},
    {"cairo", {"app/canvas.cpp", "app/cairo_pen.cpp"}},
    {"httplib", {"app/view/server.cpp"}},
    {"hdf5", {"app/hdf5/hdf5_file.cpp"}},
    {"libxml/", {"app/fmu/model_description.cpp", "tests/fmi/importer.cpp"}},
    {"minizip/", {"app/fmu/archive.cpp", "tests/fmi/importer.cpp"}},
    {"yaml.h", {"framework/scene/yaml/yaml_tree.cpp"}},
    {"cholmod", {"framework/common/solver_libraries.cpp", "framework/dynamics/solvers/sparse_ldl.cpp", "framework/component/"}},
    {"SuiteSparse_config", {"framework/common/suitesparse_memory.cpp"}},
    {"Eigen/CholmodSupport", {}},
    {"amd.h", {"framework/dynamics/solvers/sparse_ldl.cpp"}},
    {"ldl.h", {"framework/dynamics/solvers/sparse_ldl.cpp"}},
    {"klu", {"framework/dynamics/solvers/sparse_lu.cpp"}},
    {"umfpack", {}},
    {"SuiteSparseQR", {"framework/common/solver_libraries.cpp", "framework/configuration/row_qr_spqr.cpp"}},
    {"gmsh.h", {"meshes/gmsh_"}},
    {"nlopt.h", {"framework/study/fit/optimiser.cpp"}},
    {"Spectra/", {"tests/", "benchmarks/"}},
    {"mpi.h", {"app/mpi_communicator.cpp"}},
    {"CLI/", {"app/"}},
    {"nlohmann/",
     {"framework/scene/", "framework/analysis/", "framework/output/", "framework/study/", "framework/report/", "fmi/", "app/", "tests/",
      "benchmarks/"}},
    {"valijson/", {"tests/"}},
    {"gtest/", {"tests/"}},
    {"benchmark/", {"benchmarks/"}},
};

bool starts_with_any(std::string_view path, const Paths& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](std::string_view p) { return path.starts_with(p); });
}

/// @param file    path from the root   @param header  as written   @param quoted  "…" rather than
/// <…>
bool allowed(std::string_view file, std::string_view header, bool quoted) {
  if (!quoted) {
    for (const auto& f : foreign) {
      if (header.starts_with(f.header) && !starts_with_any(file, f.may)) return false;
    }
    return true;
  }
  if (header.find('/') == std::string_view::npos) return true;  // a neighbour
  const auto layer = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return file.starts_with(l.folder); });
  if (layer == layers.end()) return false;
  const auto folder_of = [](std::string_view path) { return path.substr(0, path.rfind('/') + 1); };
  return folder_of(header) == folder_of(file) || starts_with_any(header, layer->may);
}

TEST(Layering, EveryIncludeIsAnEdgeOfTheTable) {
  const fs::path root = PINTLE_SOURCE_DIR;
  const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  int seen = 0;
  for (const auto* folder : {"elements", "contact", "files", "meshes", "framework", "fmi", "app", "examples", "benchmarks", "tests"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const auto kind = entry.path().extension();
      const std::string file = entry.path().lexically_relative(root).generic_string();
      if ((kind != ".h" && kind != ".cpp") || file.starts_with("tests/consumer/")) continue;
      std::ifstream in(entry.path());
      int number = 1;
      for (std::string line; std::getline(in, line); ++number) {
        std::smatch match;
        if (!std::regex_search(line, match, include)) continue;
        ++seen;
        EXPECT_TRUE(allowed(file, match.str(2), match.str(1) == "\"")) << file << ":" << number << ": may not include " << match.str(2);
      }
    }
  }
  EXPECT_GT(seen, 100) << "the scan has missed the sources";
}

/// A folder that the table has as one, before or after.
TEST(Layering, ALayerIncludesOnlyThoseBeforeIt) {
  for (std::size_t i = 0; i < layers.size(); ++i)
    for (const std::string_view may : layers[i].may)
      for (std::size_t k = i + 1; k < layers.size(); ++k)
        EXPECT_FALSE(may.starts_with(layers[k].folder) && !layers[i].folder.starts_with(layers[k].folder))
            << layers[i].folder << " may include " << may << ", which stands after it";
}

// Two types of one name are one to the linker, which keeps the functions of either.
TEST(Layering, NoTwoTypesShareAName) {
  const fs::path root = PINTLE_SOURCE_DIR;
  const std::regex type(R"(^(?:struct|class|enum|enum class) (\w+)(?: final)?(?: \{| : |$))");
  std::map<std::string, std::string> known;
  for (const auto* folder : {"elements", "contact", "files", "meshes", "framework", "fmi", "app"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string file = entry.path().lexically_relative(root).generic_string();
      std::ifstream in(entry.path());
      bool local = false;
      for (std::string line; std::getline(in, line);) {
        if (line == "namespace {") local = true;
        if (line == "}  // namespace") local = false;
        std::smatch match;
        if (local || !std::regex_search(line, match, type)) continue;
        const auto [first, is_new] = known.try_emplace(match.str(1), file);
        EXPECT_TRUE(is_new) << match.str(1) << " stands in " << first->second << " and in " << file;
      }
    }
  EXPECT_GT(known.size(), 200u) << "the scan has missed the types";
}

TEST(Layering, HeadersThatUseEigenCheckItsLayout) {
  const fs::path root = PINTLE_SOURCE_DIR;
  int seen = 0;
  for (const auto* folder : {"elements", "contact", "meshes", "framework"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h") continue;
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      if (text.find("#include <Eigen/") == std::string::npos) continue;
      ++seen;
      EXPECT_NE(text.find("#include \"eigen_layout.h\""), std::string::npos) << entry.path() << ": must include eigen_layout.h";
    }
  EXPECT_GT(seen, 20) << "the scan has missed the headers";
}

TEST(Layering, TheTableForbidsWhatItShould) {
  EXPECT_FALSE(allowed("contact/gap.h", "framework/dynamics/model/marker.h", true));
  EXPECT_FALSE(allowed("framework/dynamics/model/joints.cpp", "framework/component/fe/fe_model.h", true));
  EXPECT_FALSE(allowed("framework/integration/integrator.cpp", "framework/scene/scene.h", true));
  EXPECT_FALSE(allowed("framework/integration/explicit/stages.cpp", "framework/integration/events/events.h", true));
  EXPECT_FALSE(allowed("framework/integration/implicit/alpha.cpp", "framework/integration/explicit/stages.h", true));
  EXPECT_FALSE(allowed("framework/integration/events/events.cpp", "framework/integration/integrator.h", true));
  EXPECT_FALSE(allowed("tests/oracles/pendulum.h", "contact/gap.h", true));
  EXPECT_FALSE(allowed("framework/analysis/simulate/simulate.cpp", "vtkPoints.h", false));
  EXPECT_FALSE(allowed("framework/build/build.cpp", "yaml.h", false));
  EXPECT_TRUE(allowed("framework/build/build.cpp", "framework/dynamics/model/system.h", true));
}

}  // namespace
