// Frames of flexible bodies.
#include "tests/unit/drawing/frame_files.h"

namespace pintle_test {
namespace {

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

}  // namespace
}  // namespace pintle_test
