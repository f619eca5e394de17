// Frames of lines and forces, and the list of all frames of a run.
#include <algorithm>
#include <array>
#include <iterator>
#include <regex>

#include "framework/drawing/palette.h"
#include "tests/unit/drawing/frame_files.h"

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
  EXPECT_EQ(colour->GetComponent(1, 0), body_palette[1][0]);  // where the scene gives none
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

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}
/// The first groups of all matches.
std::vector<std::string> found(const std::string& text, const std::string& pattern) {
  const std::regex words(pattern);
  std::vector<std::string> out;
  for (auto match = std::sregex_iterator(text.begin(), text.end(), words); match != std::sregex_iterator(); ++match)
    out.push_back((*match)[1]);
  return out;
}

// What mechanism.py asks for is in the files that it reads.
TEST(ParaviewMacro, NamesArraysAndPartsThatFramesHold) {
  const Folder folder;
  FrameWriter writer(folder.path);
  for (const double t : {0.0, 1.0}) {
    Drawing d = flexible(t, {"rod"});
    d.colours = {Rgb{255, 0, 128}, std::nullopt};
    d.touching = {{"hit", {0, 0}}};
    writer.add(d);
  }
  writer.finish({{0, 0.5, 0.5, 800}});
  std::string files;
  for (const auto& entry : fs::directory_iterator(folder.path / "frames")) files += text_of(entry.path());
  const std::string macro = text_of(folder.path / "mechanism.py");

  const std::string opened = R"x((?:"CELLS", |"POINTS", |Data\[|GetArray\(|names_of\(lines, |cell_values\(\w+, )"([^"]+)")x";
  const std::vector<std::string> arrays = found(macro, opened);
  EXPECT_GT(arrays.size(), 10U);
  for (const std::string& name : arrays)
    EXPECT_TRUE(name.starts_with("No ") || name == "arrow" || files.find("Name=\"" + name + "\"") != std::string::npos) << name;

  const std::vector<std::string> known = names(read(folder.path / "frames/00000.vtu"), "parts");
  std::vector<std::string> parts = found(macro, R"x(": \["([^"]+)"\])x");
  for (const std::string& list : found(macro, R"x(parts_of\(lines, "[^"]+"((?:, "[^"]+")+)\))x"))
    for (const std::string& part : found(list, "\"([^\"]+)\"")) parts.push_back(part);
  EXPECT_GT(parts.size(), 10U);
  for (const std::string& part : parts) EXPECT_TRUE(std::ranges::count(known, part)) << part;
}

TEST(ParaviewMacro, HasThePalette) {
  const Folder folder;
  FrameWriter writer(folder.path);
  writer.add(drawing(0));
  writer.finish();
  const std::string macro = text_of(folder.path / "mechanism.py");
  EXPECT_EQ(found(macro, "(\\(\\d\\.\\d{3}, \\d\\.\\d{3}, \\d\\.\\d{3}\\))").size(), body_palette.size() + arrow_palette.size());
  EXPECT_EQ(macro.find("PALETTE"), std::string::npos);
}

/// Lightness and hue of CIELAB, from sRGB.
std::array<double, 3> lab(const Rgb& rgb) {
  std::array<double, 3> linear{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = rgb[i] / 255.0;
    linear[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  const auto [r, g, b] = linear;
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505), y = f(0.2126 * r + 0.7152 * g + 0.0722 * b),
               z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
// The least difference that can be seen is 2.3.
TEST(Palette, HasTwelveColoursTenTimesAsFarApartAsCanBeSeen) {
  EXPECT_GE(body_palette.size(), 12U);
  for (std::size_t i = 0; i < body_palette.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = lab(body_palette[i]), b = lab(body_palette[j]);
      EXPECT_GT(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 10 * 2.3) << i << " and " << j;
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
