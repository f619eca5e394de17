// Which rows are redundant and which joint forces unique, judged by hand and by dense decompositions.

#include "framework/configuration/redundancy.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <string>

#include "framework/build/build.h"
#include "framework/configuration/assemble.h"
#include "framework/dynamics/equations/jacobian.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::redundancy_test {
namespace {

using namespace pintle;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SceneBody link(const std::string& name, double x, double y, double angle) {
  SceneBody b = body(name, 1, 1.0 / 12, {point("A", -0.5), point("B", 0.5)});
  b.at = {x + 0.5 * std::cos(angle), y + 0.5 * std::sin(angle)}, b.angle = angle;
  return b;
}
std::string numbered(const char* name, int i) { return name + std::to_string(i); }

// Links on a square grid of pins, horizontal and vertical ones: triangles are missing, rows are redundant in many ways
// once `held` pins are fixed to the ground as well.
Scene grid(int columns, int rows, int held) {
  Scene s;
  int pins = 0;
  std::vector<std::string> last(static_cast<std::size_t>((columns + 1) * (rows + 1)));
  const auto meet = [&](int i, int j, const std::string& end) {
    std::string& before = last[static_cast<std::size_t>(j * (columns + 1) + i)];
    if (!before.empty()) s.joints.push_back(joint(numbered("pin", pins++), JointKind::revolute, before, end));
    if (before.empty()) before = end;
  };
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::string name = numbered("h", j * 100 + i);
      s.bodies.push_back(link(name, i, j, 0));
      meet(i, j, name + ".A"), meet(i + 1, j, name + ".B");
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const std::string name = numbered("v", j * 100 + i);
      s.bodies.push_back(link(name, i, j, M_PI / 2));
      meet(i, j, name + ".A"), meet(i, j + 1, name + ".B");
    }
  for (int k = 0; k < held; ++k) {
    const int i = k % (columns + 1), j = k / (columns + 1);
    s.ground.push_back(point(numbered("G", k), i, j));
    s.joints.push_back(
        joint(numbered("base", k), JointKind::revolute, numbered("ground.G", k), last[static_cast<std::size_t>(j * (columns + 1) + i)]));
  }
  return s;
}

struct Judged {
  Model model;
  Assembly assembly;
};
Judged judge(const Scene& s) {
  Judged j{build(s), {}};
  j.assembly = assemble(s, j.model);
  return j;
}

TEST(RowSpace, HasTheRankAndTheNullVectorsOfADenseDecomposition) {
  for (const int held : {2, 5, 8, 12}) {
    const Scene s = grid(3, 2, held);
    const Judged j = judge(s);
    const System& system = j.model.system;
    Equations eq(system);
    pose(system, 0, j.assembly.start.y, eq);
    MatrixXd Cq = system.row_scale.asDiagonal() * dense_jacobian(system, eq) * system.scale.asDiagonal();
    Eigen::JacobiSVD<MatrixXd> svd(Cq.transpose(), Eigen::ComputeFullV);
    svd.setThreshold(1e-9);
    const auto rank = svd.rank();
    const RowSpace space = row_space(system, eq);
    ASSERT_EQ(space.rank, rank) << held;
    ASSERT_EQ(static_cast<Eigen::Index>(space.dependences.size()), Cq.rows() - rank);
    MatrixXd N = MatrixXd::Zero(Cq.rows(), Cq.rows() - rank);
    for (Eigen::Index k = 0; k < N.cols(); ++k)
      for (const auto& [row, weight] : space.dependences[static_cast<std::size_t>(k)].N) N(row, k) = weight;
    EXPECT_LT((N.transpose() * Cq).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_EQ(Eigen::FullPivLU<MatrixXd>(N).rank(), N.cols());
    // A force is unique if no null vector touches its row.
    const MatrixXd kernel = svd.matrixV().rightCols(Cq.rows() - rank);
    ASSERT_EQ(static_cast<Eigen::Index>(j.assembly.shared.size()), Cq.rows());
    for (Eigen::Index row = 0; row < Cq.rows(); ++row)
      EXPECT_EQ(j.assembly.shared[static_cast<std::size_t>(row)], kernel.cols() > 0 && kernel.row(row).norm() > 1e-8)
          << held << " row " << row;
  }
}

// Between two walls only the push along the bar is shared; across, the lever decides.
TEST(Redundancy, OfABarBetweenTwoWallsIsAlongItAlone) {
  Scene s;
  s.ground = {point("L", 0), point("R", 1)};
  s.bodies = {link("bar", 0, 0, 0)};
  s.joints = {joint("left", JointKind::revolute, "ground.L", "bar.A"), joint("right", JointKind::revolute, "ground.R", "bar.B")};
  const Judged j = judge(s);
  ASSERT_EQ(j.assembly.redundant.size(), 1u);
  EXPECT_EQ(row_text(j.model.system, j.assembly.redundant[0].joint, j.assembly.redundant[0].row), "\"right\" (x)");
  EXPECT_TRUE(j.assembly.redundant[0].permanent);
  EXPECT_EQ(rows_text(j.model.system, j.assembly.shared), "\"left\" x; \"right\" x");
  EXPECT_EQ(rows_text(j.model.system, j.assembly.shared, false), "\"left\" y; \"right\" y");
}

TEST(Redundancy, OfAFlatParallelogramIsOfThisPoseOnly) {
  for (const double angle : {0.0, 0.5}) {
    Scene s;
    s.ground = {point("L", 0), point("R", 1)};
    s.bodies = {link("a", 0, 0, angle), link("b", 1, 0, angle), link("bar", std::cos(angle), std::sin(angle), 0)};
    s.joints = {joint("1", JointKind::revolute, "ground.L", "a.A"), joint("2", JointKind::revolute, "ground.R", "b.A"),
                joint("3", JointKind::revolute, "a.B", "bar.A"), joint("4", JointKind::revolute, "b.B", "bar.B")};
    const Judged j = judge(s);
    ASSERT_EQ(j.assembly.redundant.size(), angle == 0 ? 1u : 0u);
    if (angle != 0) continue;
    EXPECT_FALSE(j.assembly.redundant[0].permanent);
    ASSERT_EQ(warnings_of(j.model, j.assembly).size(), 1u);
    EXPECT_NE(warnings_of(j.model, j.assembly)[0].find("singular configuration"), std::string::npos);
  }
}

TEST(Redundancy, OfManyParallelCranksIsCountedToTheLast) {
  Scene s;
  constexpr int n = 120;
  SceneBody bar = body("bar", 1, 1, {});
  bar.at = {std::cos(0.7), std::sin(0.7)};
  for (int i = 0; i < n; ++i) {
    s.ground.push_back(point(numbered("G", i), 0.1 * i));
    bar.points.push_back(point(numbered("P", i), 0.1 * i));
    s.bodies.push_back(link(numbered("crank", i), 0.1 * i, 0, 0.7));
    s.joints.push_back(joint(numbered("base", i), JointKind::revolute, numbered("ground.G", i), numbered("crank", i) + ".A"));
    s.joints.push_back(joint(numbered("top", i), JointKind::revolute, numbered("crank", i) + ".B", numbered("bar.P", i)));
  }
  s.bodies.push_back(bar);
  const Judged j = judge(s);
  EXPECT_EQ(j.assembly.rank, 3 * (n + 1) - 1);
  EXPECT_EQ(static_cast<int>(j.assembly.redundant.size()), n - 2);
  for (const Redundancy& r : j.assembly.redundant) EXPECT_TRUE(r.permanent);
}

// Given the speed of one crank of a flat parallelogram the other one turns alike, or against it: s on a branch.
TEST(Assembly, InAFlatPoseTakesSpeedsOfABranch) {
  Scene s;
  s.ground = {point("L", 0), point("R", 1)};
  s.bodies = {link("a", 0, 0, 0), link("b", 1, 0, 0), link("bar", 1, 0, 0)};
  s.joints = {joint("1", JointKind::revolute, "ground.L", "a.A"), joint("2", JointKind::revolute, "ground.R", "b.A"),
              joint("3", JointKind::revolute, "a.B", "bar.A"), joint("4", JointKind::revolute, "b.B", "bar.B")};
  s.start_bodies = {start_angle("a", 0, 2)};
  const Judged j = judge(s);
  const double b = j.assembly.start.y[j.model.system.n() + 5];
  // (β − α)((β + α) − (β − α)) = 0 with links of 1 m: β = α, as α ≠ 0
  EXPECT_NEAR(b, 2, 1e-8);
}

}  // namespace
}  // namespace pintle_scenes::redundancy_test
