// Tables for pages: what is kept of a file, and what is said of a damaged one.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/report/drawn_mesh.h"
#include "framework/report/sheets.h"
#include "tests/refusal.h"
#include "tests/report/page_reading.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using pintle_report_test::Folder;
using pintle_test::expect_refused;

/// Two waves of different lengths, with a peak of one row each.
std::string waves(int rows) {
  std::ostringstream out;
  out.precision(17);
  out << "t [s],slow [m],fast [N],gap [m]\n";
  for (int i = 0; i < rows; ++i) {
    const double t = 1e-3 * i;
    out << t << ',' << std::sin(t) + (i == rows / 3 ? 7 : 0) << ',' << std::cos(40 * t) - (i == rows / 2 ? 9 : 0) << ',';
    if (i % 2 == 0) out << t;
    out << '\n';
  }
  return out.str();
}

TEST(Sheets, AShortTableIsKeptWhole) {
  const Folder folder;
  const fs::path file = folder.write("t.csv", "t [s],\"pin, worn.x [m]\",b.y [m^2]\n0,1,2\n0.5,,-3e-7\n");
  const ReducedTable table = reduced_by_column(file, {}, {});
  ASSERT_TRUE(table.whole);
  EXPECT_EQ(table.rows, 2U);
  const Sheet& sheet = table.sheets.at(0);
  EXPECT_EQ(sheet.columns.at(0).name, "pin, worn.x");
  EXPECT_EQ(sheet.columns.at(1).unit, "m^2");
  EXPECT_EQ(sheet.t, (std::vector<double>{0, 0.5}));
  EXPECT_EQ(sheet.values.at(1), (std::vector<double>{2, -3e-7}));
  EXPECT_TRUE(std::isnan(sheet.values.at(0).at(1)));
}

/// Every pair of time and value in a reduced column is one of the file, and every stretch of rows keeps its extremes.
TEST(Sheets, ALongTableKeepsExtremesOfEveryStretch) {
  const Folder folder;
  constexpr int rows = 20'000;
  const fs::path file = folder.write("t.csv", waves(rows));
  const auto full = pintle_report_test::plain_table(file);
  constexpr std::size_t values = 4000;
  const ReducedTable table = reduced_by_column(file, {values, 300}, {"slow"});
  ASSERT_FALSE(table.whole);
  EXPECT_EQ(table.rows, static_cast<std::size_t>(rows));
  ASSERT_EQ(table.sheets.size(), 3U);
  for (std::size_t c = 0; c < 2; ++c) {
    const Sheet& sheet = table.sheets[c];
    EXPECT_LE(2 * sheet.t.size(), values / 4 + 8) << "more than its share";
    std::map<double, double> there;
    for (const auto& row : full.rows) there[row[0]] = row[c + 1];
    for (std::size_t i = 0; i < sheet.t.size(); ++i) EXPECT_EQ(sheet.values[0][i], there.at(sheet.t[i]));
    EXPECT_TRUE(std::ranges::is_sorted(sheet.t));
    EXPECT_EQ(sheet.t.front(), full.rows.front()[0]);
    EXPECT_EQ(sheet.t.back(), full.rows.back()[0]);
    // Whatever window of two stretches one looks at, the least and greatest value kept in it bound all its rows within it.
    constexpr int stretch = rows / (values / 4 / 2 / 2), steps = rows / stretch;
    for (int k = 0; k + 2 < steps; ++k) {
      double least = INFINITY, most = -INFINITY, kept_least = INFINITY, kept_most = -INFINITY;
      for (int i = (k + 1) * stretch; i < (k + 2) * stretch; ++i) {
        least = std::min(least, full.rows[static_cast<std::size_t>(i)][c + 1]);
        most = std::max(most, full.rows[static_cast<std::size_t>(i)][c + 1]);
      }
      for (std::size_t i = 0; i < sheet.t.size(); ++i)
        if (sheet.t[i] >= 1e-3 * (k * stretch) - 1e-9 && sheet.t[i] <= 1e-3 * ((k + 3) * stretch) + 1e-9)
          kept_least = std::min(kept_least, sheet.values[0][i]), kept_most = std::max(kept_most, sheet.values[0][i]);
      EXPECT_LE(kept_least, least);
      EXPECT_GE(kept_most, most);
    }
  }
  EXPECT_EQ(*std::ranges::max_element(table.sheets[0].values[0]), full.rows[rows / 3][1]);
  EXPECT_EQ(*std::ranges::min_element(table.sheets[1].values[0]), full.rows[rows / 2][2]);
  EXPECT_LE(2 * table.sheets[2].t.size(), 3 * values / 4 + 8) << "of a column with a gap in every other row";
}

/// Rows 0 to 9, 1001 and 8000 to 12999 are empty, stretches have 80 rows.
TEST(Sheets, ALongTableKeepsAnEmptyPointOfEachGap) {
  const Folder folder;
  std::string text = "t [s],x [m]\n";
  for (int i = 0; i < 20'000; ++i) {
    const bool empty = i < 10 || i == 1001 || (i >= 8000 && i < 13'000);
    text += std::to_string(i) + "," + (empty ? "" : std::to_string(i % 7)) + "\n";
  }
  const Sheet sheet = reduced_by_column(folder.write("t.csv", text), {2000, 300}, {}).sheets.at(0);
  EXPECT_TRUE(std::ranges::is_sorted(sheet.t));
  std::vector<double> empty;
  for (std::size_t i = 0; i < sheet.t.size(); ++i)
    if (std::isnan(sheet.values[0][i])) empty.push_back(sheet.t[i]);
  EXPECT_EQ(empty, (std::vector<double>{0, 1001, 8000}));
  EXPECT_EQ(sheet.t[1], 10);
  EXPECT_EQ(sheet.t.back(), 19'999);
}

TEST(Sheets, PosesAreEvenlySpacedRowsWithTheFirstAndLast) {
  const Folder folder;
  const fs::path file = folder.write("t.csv", waves(20'000));
  const Sheet poses = reduced_by_column(file, {4000, 300}, {"slow", "there is none"}).poses;
  ASSERT_EQ(poses.columns.size(), 1U);
  EXPECT_EQ(poses.columns[0].name, "slow");
  EXPECT_GE(poses.t.size(), 140U);
  EXPECT_LE(poses.t.size(), 153U);
  EXPECT_EQ(poses.t.front(), 0);
  EXPECT_NEAR(poses.t.back(), 19.999, 1e-12);
  for (std::size_t i = 3; i + 1 < poses.t.size(); ++i) EXPECT_NEAR(poses.t[i] - poses.t[i - 1], poses.t[2] - poses.t[1], 1e-9);
}

TEST(Sheets, RowsWithAnExtremeAreKeptWhole) {
  const Folder folder;
  const fs::path file = folder.write("t.csv", waves(20'000));
  const auto full = pintle_report_test::plain_table(file);
  const ReducedTable table = reduced_by_row(file, 3000);
  ASSERT_EQ(table.sheets.size(), 1U);
  const Sheet& sheet = table.sheets[0];
  EXPECT_LE(4 * sheet.t.size(), 3000U + 64U);
  EXPECT_EQ(*std::ranges::max_element(sheet.values[0]), full.rows[20'000 / 3][1]);
  EXPECT_EQ(*std::ranges::min_element(sheet.values[1]), full.rows[20'000 / 2][2]);
  std::map<double, std::vector<double>> there;
  for (const auto& row : full.rows) there[row[0]] = row;
  for (std::size_t i = 0; i < sheet.t.size(); ++i)
    for (std::size_t c = 0; c < 2; ++c) EXPECT_EQ(sheet.values[c][i], there.at(sheet.t[i])[c + 1]);
}

TEST(Sheets, ADamagedTableIsRefusedByFileAndLine) {
  const Folder folder;
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    const fs::path file = folder.write("bad.csv", text);
    expect_refused<ResultsError>([&] { reduced_by_column(file, {}, {}); }, parts);
  };
  refused("t [s],x [m]\n0,1\n1,2,3\n", {"bad.csv:3: has 3 fields", "the header has 2"});
  refused("t [s],x [m]\n0,1\n1,two\n", {"bad.csv:3: \"two\" in column 2 is not a number"});
  refused("t [s],x [m]\n0,1\n1,2", {"bad.csv:3: the line is cut off"});
  refused("t [s],\"x [m]\n0,1\n", {"bad.csv:1: a quotation mark is not closed"});
  refused("", {"bad.csv: cannot be read: it is empty"});
  expect_refused<ResultsError>([&] { reduced_by_row(folder.path() / "none.csv", 10); }, {"none.csv: cannot be read (No such file"});
}

/// A plate of squares, side n + 1 nodes of them, drawn by what FlexibleDrawing gives of it.
TEST(DrawnMesh, TrianglesCoverThePlateAndAFineOneIsMadeCoarse) {
  const Scene scene = with_pieces(read_scene_text(R"(
bodies:
  plate:
    plate:
      {thickness: 10 mm, young: 70 GPa, poisson: 0.3, density: 2700 kg/m^3,
       grid: {corners: [[0, 0], [0.2, 0], [0.2, 0.1], [0, 0.1]], cells: [40, 20]}}
    modes: {frame: mean axes, count: 2}
run: {until: 1 ms}
output: {frames: 2}
)",
                                                  "plate.yaml"));
  const Model model = build(scene);
  ASSERT_EQ(model.drawings.size(), 1U);
  const FlexibleDrawing& body = model.drawings[0];
  const auto area = [&](const DrawnMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
      const auto corner = [&](std::size_t k) -> Eigen::Vector2d { return body.points().col(mesh.points[static_cast<std::size_t>(t[k])]); };
      const Eigen::Vector2d u = corner(1) - corner(0), v = corner(2) - corner(0);
      sum += std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
    }
    return sum;
  };
  const DrawnMesh fine = drawn_mesh(body.points(), body.cells(), body.size(), 1'000'000);
  EXPECT_NEAR(area(fine), 0.02, 1e-9);
  const DrawnMesh coarse = drawn_mesh(body.points(), body.cells(), body.size(), 60);
  EXPECT_LE(coarse.points.size(), 60U);
  EXPECT_NEAR(area(coarse), 0.02, 0.009);  // at two sides a square of 0.03 at most is lost
  double rim = 0;
  for (const auto& [a, b] : fine.rim)
    rim +=
        (body.points().col(fine.points[static_cast<std::size_t>(a)]) - body.points().col(fine.points[static_cast<std::size_t>(b)])).norm();
  EXPECT_NEAR(rim, 0.6, 1e-9);
}

}  // namespace

}  // namespace pintle
