// Frames of lines and forces, and the list of all frames of a run.
#include "tests/unit/frame_files.h"

namespace pintle_test {
namespace {

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
}  // namespace pintle_test
