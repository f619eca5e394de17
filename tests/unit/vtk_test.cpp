#include "framework/drawing/vtk.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

namespace pintle {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, gone when the test is.
struct Folder {
  fs::path path;
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path = fs::temp_directory_path() / ("pintle_vtk_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
};

/// A triangle of the crank, a bar of the coupler, a lone point, an empty line and a force.
Drawing drawing(double t) {
  Drawing d;
  d.t = t;
  d.exaggeration = 25;
  d.owners = {"crank", "coupler", "gudgeon pin"};
  d.lines = {{Part::link, 0, true, {{0, 0}, {1, 0}, {0, 1}}},
             {Part::link, 1, false, {{1, 0}, {3, 0.125}}},
             {Part::joint, 2, true, {{3, 0.125}}},
             {Part::trace, 2, false, {}}};
  d.forces = {{{3, 0.125}, {-40, 1e3}, 2, Giver::contact, -3}};
  return d;
}

vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// A square of a triangle pair and a quadrilateral, deformed and with fields.
DrawnBody body(const std::string& name) {
  DrawnBody b;
  b.name = name;
  b.points.resize(2, 6);
  b.points << 0, 1, 1, 0, 2, 2.1, 0, 0, 1, 1, 0, 1.0 / 3;
  b.cells = {{CellShape::triangle3, {0, 1, 2, 0, 2, 3}, {1, 2}}, {CellShape::quadrilateral4, {1, 4, 5, 2}, {3}}};
  Eigen::RowVectorXd mises(6);
  mises << 0, 1e6, 2e6, 3e6, 4e6, 5e6;
  b.fields = {{"displacement [m]", b.points / 8}, {"von Mises [Pa]", mises}};
  return b;
}

Drawing flexible(double t, const std::vector<std::string>& bodies) {
  Drawing d = drawing(t);
  d.deformation = 40;
  for (const std::string& name : bodies) d.bodies.push_back(body(name));
  return d;
}

vtkSmartPointer<vtkUnstructuredGrid> written(const Drawing& d) {
  const Folder folder;
  FrameWriter(folder.path).add(d);
  return read(folder.path / "frames/00000.vtu");
}

std::vector<double> cell_field(vtkUnstructuredGrid* grid, const char* name) {
  std::vector<double> values;
  vtkDataArray* array = grid->GetCellData()->GetArray(name);
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i) {
    values.push_back(array->GetTuple1(i));
  }
  return values;
}

std::vector<std::string> names(vtkUnstructuredGrid* grid, const char* name) {
  std::vector<std::string> values;
  const auto* array = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray(name));
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i) {
    values.push_back(const_cast<vtkStringArray*>(array)->GetValue(i));
  }
  return values;
}

/// What a collection lists: time, part, file.
struct Listed {
  double t;
  int part;
  std::string file;
  bool operator==(const Listed&) const = default;
};
void PrintTo(const Listed& l, std::ostream* out) { *out << l.t << " part " << l.part << " " << l.file; }
std::vector<Listed> listed(const fs::path& pvd) {
  std::vector<Listed> all;
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(pvd.c_str()));
  vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  for (int i = 0; list && i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = list->GetNestedElement(i);
    all.push_back({std::stod(entry->GetAttribute("timestep")), std::stoi(entry->GetAttribute("part")), entry->GetAttribute("file")});
  }
  return all;
}

std::string failure(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no failure";
}

TEST(Frame, HasACellForEachLineAndForceAndAPointForEachCorner) {
  const auto grid = written(drawing(0));
  EXPECT_EQ(grid->GetNumberOfPoints(), 3 + 2 + 1 + 1);
  ASSERT_EQ(grid->GetNumberOfCells(), 4);
  EXPECT_EQ(grid->GetCellType(0), VTK_POLYGON);  // a link, which ParaView fills
  EXPECT_EQ(grid->GetCellType(1), VTK_POLY_LINE);
  EXPECT_EQ(grid->GetCellType(2), VTK_VERTEX);
  EXPECT_EQ(grid->GetCellType(3), VTK_VERTEX);
  EXPECT_EQ(grid->GetPoint(4)[1], 0.125);
}

TEST(Frame, ClosedLineThatIsNoLinkEndsWhereItBegan) {
  Drawing d = drawing(0);
  d.lines[0].part = Part::bearing;
  const auto grid = written(d);
  vtkCell* triangle = grid->GetCell(0);
  ASSERT_EQ(triangle->GetNumberOfPoints(), 4);
  EXPECT_EQ(triangle->GetPointId(3), triangle->GetPointId(0));
  EXPECT_EQ(grid->GetCell(1)->GetNumberOfPoints(), 2);
}

TEST(Frame, CarriesPartsAndOwnersWithTheirNames) {
  const auto grid = written(drawing(0));
  EXPECT_EQ(cell_field(grid, "part"), (std::vector<double>{0, 0, 1, 10}));
  EXPECT_EQ(cell_field(grid, "owner"), (std::vector<double>{0, 1, 2, 2}));
  EXPECT_EQ(names(grid, "owners"), drawing(0).owners);
  EXPECT_EQ(names(grid, "parts"), (std::vector<std::string>{"link", "joint", "journal", "bearing", "spring", "guide", "trace", "cylinder",
                                                            "hatch", "reaction", "contact force", "spring force", "load"}));
  auto* name = vtkStringArray::SafeDownCast(grid->GetCellData()->GetAbstractArray("name"));
  ASSERT_TRUE(name);
  EXPECT_EQ(name->GetValue(1), "coupler");
  EXPECT_EQ(name->GetValue(3), "gudgeon pin");
}

TEST(Frame, CarriesForcesAsVectorsAndZeroElsewhere) {
  const auto grid = written(drawing(0));
  vtkDataArray* force = grid->GetPointData()->GetArray("force [N]");
  ASSERT_TRUE(force);
  ASSERT_EQ(force->GetNumberOfComponents(), 3);
  EXPECT_EQ(force->GetComponent(6, 0), -40);
  EXPECT_EQ(force->GetComponent(6, 1), 1e3);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(force->GetComponent(i, 1), 0);
  EXPECT_EQ(grid->GetPointData()->GetArray("couple [N m]")->GetTuple1(6), -3);
}

TEST(Frame, CarriesItsTimeAndTheExaggerationOfTheClearance) {
  const auto grid = written(drawing(0.1));
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.1);
  EXPECT_EQ(grid->GetFieldData()->GetArray("clearance exaggeration")->GetTuple1(0), 25);
}

TEST(Frame, KeepsNumbersInTheTypesThatItsReadersKnow) {
  Drawing d = drawing(0);
  d.colours = {Rgb{255, 0, 128}, std::nullopt};
  const auto grid = written(d);
  EXPECT_EQ(grid->GetPoints()->GetDataType(), VTK_DOUBLE);
  for (const char* name : {"force [N]", "couple [N m]"}) EXPECT_EQ(grid->GetPointData()->GetArray(name)->GetDataType(), VTK_DOUBLE) << name;
  for (const char* name : {"part", "owner"}) EXPECT_EQ(grid->GetCellData()->GetArray(name)->GetDataType(), VTK_INT) << name;
  vtkDataArray* colour = grid->GetCellData()->GetArray("colour");
  ASSERT_TRUE(colour);
  EXPECT_EQ(colour->GetDataType(), VTK_UNSIGNED_CHAR);
  ASSERT_EQ(colour->GetNumberOfComponents(), 3);
  EXPECT_EQ(colour->GetComponent(0, 2), 128);
  EXPECT_EQ(colour->GetComponent(1, 0), 96);  // grey, where the scene gives none
  EXPECT_EQ(names(grid, "colours"), (std::vector<std::string>{"#ff0080", ""}));
}

TEST(Frame, OfNothingIsAnEmptyGrid) {
  const auto grid = written(Drawing{});
  EXPECT_EQ(grid->GetNumberOfCells(), 0);
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0);
}

TEST(FrameWriter, ListsEachFrameWithItsExactTime) {
  const Folder folder;
  const std::vector<double> times{0, 1e-5, 1.0 / 3};
  FrameWriter writer(folder.path);
  for (const double t : times) writer.add(drawing(t));
  writer.finish();

  const std::vector<Listed> frames = listed(folder.path / "mechanism.pvd");
  ASSERT_EQ(frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(frames[i].t, times[i]);
    const auto grid = read(folder.path / frames[i].file);
    EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), times[i]);
  }
}

TEST(FlexibleFrame, KeepsPlacesExactlyAndCellsOfEachShape) {
  const Folder folder;
  FrameWriter(folder.path).add(flexible(0.1, {"plate"}));
  const auto grid = read(folder.path / "frames/plate_00000.vtu");
  const DrawnBody b = body("plate");
  ASSERT_EQ(grid->GetNumberOfPoints(), 6);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(grid->GetPoint(i)[0], b.points(0, i));
    EXPECT_EQ(grid->GetPoint(i)[1], b.points(1, i));
    EXPECT_EQ(grid->GetPoint(i)[2], 0);
  }
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  const std::vector<std::pair<int, std::vector<int>>> cells{{VTK_TRIANGLE, {0, 1, 2}}, {VTK_TRIANGLE, {0, 2, 3}}, {VTK_QUAD, {1, 4, 5, 2}}};
  for (int c = 0; c < 3; ++c) {
    const auto& [type, nodes] = cells[static_cast<std::size_t>(c)];
    EXPECT_EQ(grid->GetCellType(c), type);
    ASSERT_EQ(grid->GetCell(c)->GetNumberOfPoints(), static_cast<vtkIdType>(nodes.size()));
    for (std::size_t k = 0; k < nodes.size(); ++k) EXPECT_EQ(grid->GetCell(c)->GetPointId(static_cast<int>(k)), nodes[k]);
  }
}

TEST(FlexibleFrame, CarriesItsFieldsInSinglePrecisionAndWhoAndWhenItIs) {
  const Folder folder;
  FrameWriter(folder.path).add(flexible(0.1, {"plate"}));
  const auto grid = read(folder.path / "frames/plate_00000.vtu");
  const DrawnBody b = body("plate");
  vtkDataArray* u = grid->GetPointData()->GetArray("displacement [m]");
  vtkDataArray* mises = grid->GetPointData()->GetArray("von Mises [Pa]");
  ASSERT_TRUE(u && mises);
  EXPECT_EQ(u->GetDataType(), VTK_FLOAT);
  ASSERT_EQ(u->GetNumberOfComponents(), 3);
  ASSERT_EQ(mises->GetNumberOfComponents(), 1);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(u->GetComponent(i, 0), static_cast<float>(b.points(0, i) / 8));
    EXPECT_EQ(u->GetComponent(i, 1), static_cast<float>(b.points(1, i) / 8));
    EXPECT_EQ(u->GetComponent(i, 2), 0);
    EXPECT_EQ(mises->GetTuple1(i), 1e6 * i);
  }
  EXPECT_EQ(names(grid, "body"), std::vector<std::string>{"plate"});
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.1);
  EXPECT_EQ(grid->GetFieldData()->GetArray("deformation exaggeration")->GetTuple1(0), 40);
}

/// Values with runs of zeros of every length, here and there a negative zero, which is none.
Eigen::MatrixXd spotted(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  Eigen::MatrixXd out(rows, columns);
  unsigned left = 0, state = seed;
  bool zero = false;
  for (double* x = out.data(); x != out.data() + out.size(); ++x) {
    if (left == 0) {
      state = state * 1664525U + 1013904223U;
      left = 1 + (state >> 24) % (zero ? 7 : 40);
      zero = !zero;
    }
    *x = zero ? 0 : left % 5 == 0 ? -0.0 : 1.0 / 3 * left;
    --left;
  }
  return out;
}

// Zeros are packed in words of eight bytes and blocks of 32768: 4096 of one, 1365 points and a third, 8192 floats.
TEST(FlexibleFrame, IsWhatItWasWhereverZerosStand) {
  const Folder folder;
  FrameWriter writer(folder.path);
  std::vector<DrawnBody> all;
  std::vector<int> sizes{1365, 1366, 4095, 4096, 4097, 8191, 8192, 8193, 20000};
  for (int n = 1; n < 24; ++n) sizes.push_back(n);
  for (const int n : sizes)
    for (unsigned seed = 0; seed < 3; ++seed) {
      DrawnBody b{"body " + std::to_string(all.size()), spotted(2, n, seed), {{CellShape::line2, {0, n - 1}, {1}}}, {}};
      b.fields = {{"spotted", spotted(1, n, seed + 5)}, {"nothing", Eigen::MatrixXd::Zero(3, n)}, {"<&\">", spotted(2, n, seed + 9)}};
      all.push_back(b);
    }
  Drawing d;
  d.bodies = all;
  writer.add(d);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto grid = read(folder.path / ("frames/body_" + std::to_string(k) + "_00000.vtu"));
    const Eigen::Index n = all[k].points.cols();
    ASSERT_EQ(grid->GetNumberOfPoints(), n);
    Eigen::Index wrong = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      for (int c = 0; c < 2; ++c)
        wrong += grid->GetPoint(i)[c] != all[k].points(c, i) || std::signbit(grid->GetPoint(i)[c]) != std::signbit(all[k].points(c, i));
    EXPECT_EQ(wrong, 0) << n;
    for (const Field& f : all[k].fields) {
      vtkDataArray* array = grid->GetPointData()->GetArray(f.name.c_str());
      ASSERT_TRUE(array) << f.name;
      ASSERT_EQ(array->GetNumberOfTuples(), n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index c = 0; c < f.values.rows(); ++c)
          wrong += array->GetComponent(i, static_cast<int>(c)) != static_cast<float>(f.values(c, i));
      EXPECT_EQ(wrong, 0) << f.name << ' ' << n;
    }
  }
}

TEST(FlexibleFrame, OfALaterTimeHasTheSameCellsAtItsOwnPlaces) {
  const Folder folder;
  FrameWriter writer(folder.path);
  for (int k = 0; k < 3; ++k) {
    Drawing d = flexible(k, {"plate"});
    d.bodies[0].points.array() += k;
    d.bodies[0].fields.resize(1);
    writer.add(d);
  }
  const auto first = read(folder.path / "frames/plate_00000.vtu");
  const auto last = read(folder.path / "frames/plate_00002.vtu");
  EXPECT_EQ(last->GetNumberOfCells(), 3);
  EXPECT_EQ(last->GetCell(2)->GetPointId(1), 4);
  EXPECT_EQ(first->GetPoint(5)[1], 1.0 / 3);
  EXPECT_EQ(last->GetPoint(5)[1], 1.0 / 3 + 2);
  EXPECT_EQ(last->GetPointData()->GetNumberOfArrays(), 1);
}

TEST(FlexibleFrame, OfEachBodyHasItsOwnCells) {
  const Folder folder;
  Drawing d = flexible(0, {"plate", "strip"});
  d.bodies[1].cells.pop_back();
  FrameWriter writer(folder.path);
  for (int k = 0; k < 2; ++k) writer.add(d);
  EXPECT_EQ(read(folder.path / "frames/plate_00001.vtu")->GetNumberOfCells(), 3);
  EXPECT_EQ(read(folder.path / "frames/strip_00001.vtu")->GetNumberOfCells(), 2);
}

TEST(FlexibleFrame, IsListedAsAPartBesideTheLines) {
  const Folder folder;
  FrameWriter writer(folder.path);
  writer.add(flexible(0, {"crank", "rod"}));
  writer.add(flexible(0.5, {"crank", "rod"}));
  writer.finish();
  const std::vector<Listed> expected{{0, 0, "frames/00000.vtu"},   {0, 1, "frames/crank_00000.vtu"},   {0, 2, "frames/rod_00000.vtu"},
                                     {0.5, 0, "frames/00001.vtu"}, {0.5, 1, "frames/crank_00001.vtu"}, {0.5, 2, "frames/rod_00001.vtu"}};
  EXPECT_EQ(listed(folder.path / "mechanism.pvd"), expected);
}

TEST(FlexibleFrame, HasAFileOfItsOwnWhateverItsBodyIsCalled) {
  const Folder folder;
  FrameWriter writer(folder.path);
  const std::vector<std::string> bodies{"piston rod", "piston/rod", "Piston_rod", "../../up", "<&\">", "Kurbel ü", "", "_2"};
  writer.add(flexible(0, bodies));
  writer.finish();
  const std::vector<Listed> files = listed(folder.path / "mechanism.pvd");
  ASSERT_EQ(files.size(), bodies.size() + 1);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::string& file = files[b + 1].file;
    EXPECT_EQ(file.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./"), std::string::npos) << file;
    EXPECT_EQ(fs::path(file).parent_path(), "frames");
    ASSERT_TRUE(fs::is_regular_file(folder.path / file)) << file;
    EXPECT_EQ(names(read(folder.path / file), "body"), std::vector<std::string>{bodies[b]});
  }
}

TEST(FrameWriter, ListsPathsAndImpactsOfTheWholeRunWithEveryFrame) {
  const Folder folder;
  FrameWriter writer(folder.path);
  for (int k = 0; k < 3; ++k) {
    Drawing d = flexible(k, {"plate"});
    d.followed = {{"coupler.M", {k, k * k}}};
    d.touching = {{"stop", {0, 0}}, {"gudgeon pin", {10 * k, 1}}};
    writer.add(d);
  }
  writer.finish({{1, 1.25, 0.5, 800}, {0, 2, 0.1, 3}});
  const std::vector<Listed> files = listed(folder.path / "mechanism.pvd");
  ASSERT_EQ(files.size(), 12U);
  EXPECT_EQ(files[6], (Listed{1, 2, "frames/paths.vtu"}));
  EXPECT_EQ(files[7], (Listed{1, 3, "frames/impacts.vtu"}));

  const auto paths = read(folder.path / "frames/paths.vtu");
  ASSERT_EQ(paths->GetNumberOfCells(), 1);
  ASSERT_EQ(paths->GetNumberOfPoints(), 3);
  EXPECT_EQ(paths->GetPoint(2)[1], 4);
  const auto impacts = read(folder.path / "frames/impacts.vtu");
  ASSERT_EQ(impacts->GetNumberOfPoints(), 2);
  EXPECT_EQ(impacts->GetPoint(0)[0], 12.5);  // a quarter of the way from frame 1 to frame 2
  EXPECT_EQ(impacts->GetPointData()->GetArray("peak force [N]")->GetTuple1(0), 800);
  EXPECT_EQ(impacts->GetPointData()->GetArray("time [s]")->GetTuple1(1), 2);
  EXPECT_EQ(vtkStringArray::SafeDownCast(impacts->GetCellData()->GetAbstractArray("name"))->GetValue(0), "gudgeon pin");
}

TEST(FrameWriter, LeavesNothingHalfWritten) {
  const Folder folder;
  FrameWriter writer(folder.path);
  writer.add(drawing(0));
  writer.finish();
  for (const auto& entry : fs::recursive_directory_iterator(folder.path)) {
    if (entry.is_directory()) continue;
    const auto kind = entry.path().extension();
    EXPECT_TRUE(kind == ".vtu" || kind == ".pvd" || kind == ".py") << entry.path();
  }
}

TEST(FrameWriter, NamesTheDirectoryThatCannotBeMade) {
  const Folder folder;
  std::ofstream(folder.path / "taken") << "a file stands here";
  const fs::path under = folder.path / "taken" / "run";
  EXPECT_NE(failure([&] { FrameWriter{under}; }).find((under / "frames").string()), std::string::npos);
}

TEST(FrameWriter, NamesTheFileThatCannotBeWritten) {
  const Folder folder;
  FrameWriter writer(folder.path);
  fs::create_directories(folder.path / "mechanism.pvd");
  EXPECT_NE(failure([&] { writer.finish(); }).find((folder.path / "mechanism.pvd").string()), std::string::npos);
  fs::remove_all(folder.path / "frames");
  const auto message = failure([&] { writer.add(drawing(0)); });
  EXPECT_NE(message.find((folder.path / "frames/00000.vtu").string()), std::string::npos);
}

}  // namespace
}  // namespace pintle
