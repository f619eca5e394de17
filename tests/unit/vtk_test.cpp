#include "framework/run/vtk.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>
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
    path = fs::temp_directory_path() /
           ("pintle_vtk_" + std::string(test->name()) + "_" + std::to_string(getpid()));
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
  d.forces = {{{3, 0.125}, {-40, 1e3}, 2}};
  return d;
}

vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
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
  EXPECT_EQ(grid->GetCellType(0), VTK_POLY_LINE);
  EXPECT_EQ(grid->GetCellType(1), VTK_POLY_LINE);
  EXPECT_EQ(grid->GetCellType(2), VTK_VERTEX);
  EXPECT_EQ(grid->GetCellType(3), VTK_VERTEX);
  EXPECT_EQ(grid->GetPoint(4)[1], 0.125);
}

TEST(Frame, ClosedLineEndsWhereItBegan) {
  const auto grid = written(drawing(0));
  vtkCell* triangle = grid->GetCell(0);
  ASSERT_EQ(triangle->GetNumberOfPoints(), 4);
  EXPECT_EQ(triangle->GetPointId(3), triangle->GetPointId(0));
  EXPECT_EQ(grid->GetCell(1)->GetNumberOfPoints(), 2);
}

TEST(Frame, CarriesPartsAndOwnersWithTheirNames) {
  const auto grid = written(drawing(0));
  EXPECT_EQ(cell_field(grid, "part"), (std::vector<double>{0, 0, 1, 7}));
  EXPECT_EQ(cell_field(grid, "owner"), (std::vector<double>{0, 1, 2, 2}));
  EXPECT_EQ(names(grid, "owners"), drawing(0).owners);
  EXPECT_EQ(names(grid, "parts"), (std::vector<std::string>{"link", "joint", "journal", "bearing",
                                                            "spring", "guide", "trace", "force"}));
}

TEST(Frame, CarriesForcesAsVectorsAndZeroElsewhere) {
  const auto grid = written(drawing(0));
  vtkDataArray* force = grid->GetPointData()->GetArray("force [N]");
  ASSERT_TRUE(force);
  ASSERT_EQ(force->GetNumberOfComponents(), 3);
  EXPECT_EQ(force->GetComponent(6, 0), -40);
  EXPECT_EQ(force->GetComponent(6, 1), 1e3);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(force->GetComponent(i, 1), 0);
}

TEST(Frame, CarriesItsTimeAndTheExaggerationOfTheClearance) {
  const auto grid = written(drawing(0.1));
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.1);
  EXPECT_EQ(grid->GetFieldData()->GetArray("clearance exaggeration")->GetTuple1(0), 25);
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

  const auto file = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromFile((folder.path / "mechanism.pvd").c_str()));
  ASSERT_TRUE(file);
  vtkXMLDataElement* list = file->FindNestedElementWithName("Collection");
  ASSERT_TRUE(list);
  ASSERT_EQ(list->GetNumberOfNestedElements(), 3);
  for (int i = 0; i < 3; ++i) {
    vtkXMLDataElement* frame = list->GetNestedElement(i);
    EXPECT_EQ(std::stod(frame->GetAttribute("timestep")), times[i]);
    const auto grid = read(folder.path / frame->GetAttribute("file"));
    EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), times[i]);
  }
}

TEST(FrameWriter, LeavesNothingHalfWritten) {
  const Folder folder;
  FrameWriter writer(folder.path);
  writer.add(drawing(0));
  writer.finish();
  for (const auto& entry : fs::recursive_directory_iterator(folder.path)) {
    if (entry.is_directory()) continue;
    const auto kind = entry.path().extension();
    EXPECT_TRUE(kind == ".vtu" || kind == ".pvd") << entry.path();
  }
}

TEST(FrameWriter, NamesTheDirectoryThatCannotBeMade) {
  const Folder folder;
  std::ofstream(folder.path / "taken") << "a file stands here";
  const fs::path under = folder.path / "taken" / "run";
  EXPECT_NE(failure([&] { FrameWriter{under}; }).find((under / "frames").string()),
            std::string::npos);
}

TEST(FrameWriter, NamesTheFileThatCannotBeWritten) {
  const Folder folder;
  FrameWriter writer(folder.path);
  fs::create_directories(folder.path / "mechanism.pvd");
  EXPECT_NE(failure([&] { writer.finish(); }).find((folder.path / "mechanism.pvd").string()),
            std::string::npos);
  fs::remove_all(folder.path / "frames");
  const auto message = failure([&] { writer.add(drawing(0)); });
  EXPECT_NE(message.find((folder.path / "frames/00000.vtu").string()), std::string::npos);
}

}  // namespace
}  // namespace pintle
