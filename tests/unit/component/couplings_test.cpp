// Rims tied to ports: judged by rigid motion, by LᵀAL written out and by least squares.

#include "framework/component/fe/assembly.h"
#include "framework/component/fe/fe_model.h"
#include "framework/component/fe/from_mesh.h"
#include "tests/unit/component/fe_bodies.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace pintle::couplings_test {
namespace {

using Eigen::Matrix2Xd;
using Eigen::MatrixX3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Sums of some hundred terms, relative to the largest term.
constexpr double rounding = 1e-12;

const BeamEuler beam{2e8, 1500, 8, 1e-3};
const Bar bar{1e8, 4};

double largest(const MatrixXd& A) { return A.cwiseAbs().maxCoeff(); }

/// A ring about (0.4, −0.2) whose hole has a port in its middle.
struct Ring {
  Plate plate;
  RimPort rim;
  FeModel model;
};
Ring ported_ring(Coupling coupling, CellShape shape = CellShape::quadrilateral8, const Vector2d& off = Vector2d::Zero()) {
  const Vector2d center(0.4, -0.2);
  Plate p = pintle::plate(10, 2, shape, ring(0.1, 0.3, 0.3, 2 * M_PI, center), true);
  Group group{"hole", p.nodes["bottom"], p.edge["bottom"]};
  std::sort(group.nodes.begin(), group.nodes.end());
  RimPort rim{"eye", center + off, group.nodes, rim_weights(p.mesh, group), coupling};
  FeModel model = model_of(p, steel(PlaneState::stress));
  add_ports(model, {{"rim of the plate", p.nodes["top"][3]}}, {rim});
  return {std::move(p), std::move(rim), std::move(model)};
}

class Couplings : public testing::TestWithParam<Coupling> {};
INSTANTIATE_TEST_SUITE_P(Both, Couplings, testing::Values(Coupling::rigid, Coupling::average),
                         [](const auto& at) { return at.param == Coupling::rigid ? "rigid" : "average"; });

TEST_P(Couplings, RigidMotionOfTheBodyStaysRigidAndFree) {
  for (const Vector2d& off : {Vector2d(0, 0), Vector2d(0.03, -0.02)}) {
    const FeModel m = ported_ring(GetParam(), CellShape::quadrilateral8, off).model;
    const MatrixX3d motions = rigid_motions(m);
    const RigidFields f = rigid_fields(m);
    MatrixX3d expected(m.N(), 3);
    expected << f.T, f.R;
    EXPECT_LT(largest(nodal(m, motions) - expected), rounding);
    const Assembler assembler(m);
    const Sparse K = independent(m, assembler.stiffness()), M = assembler.mass();
    EXPECT_LT(largest(K * motions), rounding * largest(MatrixXd(K)));
    const Eigen::Matrix3d inertia = expected.transpose() * (M * expected);
    const Eigen::Matrix3d ours = motions.transpose() * (independent(m, M) * motions);
    EXPECT_LT(largest(ours - inertia), rounding * largest(inertia));
  }
}

TEST_P(Couplings, TheCoupledMatrixIsLtALAndKeepsOnePattern) {
  const FeModel m = ported_ring(GetParam()).model;
  const Assembler assembler(m);
  const MatrixXd L(m.L);
  const Sparse K = independent(m, assembler.stiffness());
  for (const Sparse& A : {assembler.stiffness(), assembler.mass(), assembler.skew_mass()}) {
    const Sparse ours = independent(m, A);
    const MatrixXd written = L.transpose() * MatrixXd(A) * L;
    EXPECT_LT(largest(MatrixXd(ours) - written), rounding * largest(written));
    ASSERT_EQ(ours.nonZeros(), K.nonZeros());
    EXPECT_TRUE(std::equal(K.innerIndexPtr(), K.innerIndexPtr() + K.nonZeros(), ours.innerIndexPtr()));
  }
}

TEST_P(Couplings, IndependentDegreesOfFreedomAreTheNodalOnesThatStayThenThePorts) {
  const Ring r = ported_ring(GetParam());
  const FeModel& m = r.model;
  const auto gone = GetParam() == Coupling::rigid ? 2 * static_cast<int>(r.rim.nodes.size()) : 3;
  EXPECT_EQ(m.n(), m.N() - gone + 3);
  int next = 0;
  for (int i = 0; i < m.N(); ++i)
    if (m.independent_of(i) >= 0) {
      EXPECT_EQ(m.independent_of(i), next++);
    }
  const Port* eye = m.port("eye");
  ASSERT_NE(eye, nullptr);
  for (int d = 0; d < 3; ++d) EXPECT_EQ(eye->dof[d], next + d);
  const Port* node = m.port("rim of the plate");
  ASSERT_NE(node, nullptr);
  EXPECT_EQ(node->dof[2], -1);
  EXPECT_EQ(m.port("ear"), nullptr);
  // A dof that stays is itself in u = L ũ.
  const VectorXd free = random_vector(m.n(), 5), u = nodal(m, free);
  for (int i = 0; i < m.N(); ++i)
    if (const int k = m.independent_of(i); k >= 0) {
      EXPECT_EQ(u[i], free[k]);
    }
}

TEST(RigidCoupling, TheRimMovesAsARingAboutItsPort) {
  const Ring r = ported_ring(Coupling::rigid, CellShape::quadrilateral8, {0.03, -0.02});
  const VectorXd free = random_vector(r.model.n(), 11), u = nodal(r.model, free);
  const int* f = r.model.port("eye")->dof;
  for (const int node : r.rim.nodes) {
    const Vector2d arm = r.model.x.col(node) - r.rim.x;
    const Vector2d expected = Vector2d(free[f[0]], free[f[1]]) + free[f[2]] * Vector2d(-arm.y(), arm.x());
    EXPECT_LT((u.segment<2>(2 * node) - expected).norm(), rounding);
  }
}

TEST(RigidCoupling, BeamsOnARimTurnWithIt) {
  FeModel m = chain(beam, 4, {0, 0}, {1, 0});
  add_ports(m, {}, {{"clamp", {0.1, 0.05}, {0, 1}, {1, 1}, Coupling::rigid}});
  const VectorXd u = nodal(m, VectorXd::Unit(m.n(), m.port("clamp")->dof[2]));
  EXPECT_EQ(u[2], 1);
  EXPECT_EQ(u[5], 1);
  EXPECT_NEAR(u[4], 0.15, rounding);  // node 1 at (0.25, 0): φ · (0.25 − 0.1)
}

// The rigid motion of the rim, as weighted least squares by QR of the stacked equations finds it.
TEST(AverageCoupling, ThePortMovesAsTheRimDoesInWeightedLeastSquares) {
  for (const CellShape shape : {CellShape::quadrilateral8, CellShape::triangle3}) {
    const Ring r = ported_ring(Coupling::average, shape, {0.03, -0.02});
    const VectorXd free = random_vector(r.model.n(), 13), u = nodal(r.model, free);
    const auto k = static_cast<Eigen::Index>(r.rim.nodes.size());
    MatrixXd B(2 * k, 3);
    VectorXd b(2 * k);
    for (Eigen::Index i = 0; i < k; ++i) {
      const int node = r.rim.nodes[static_cast<std::size_t>(i)];
      const double w = std::sqrt(r.rim.weights[static_cast<std::size_t>(i)]);
      const Vector2d arm = r.model.x.col(node) - r.rim.x;
      B.row(2 * i) << w, 0, -w * arm.y();
      B.row(2 * i + 1) << 0, w, w * arm.x();
      b.segment<2>(2 * i) = w * u.segment<2>(2 * node);
    }
    const Vector3d motion = B.householderQr().solve(b);
    const int* f = r.model.port("eye")->dof;
    // The given dofs are differences of k others: k times rounding, over the radius for
    // turning.
    for (int d = 0; d < 3; ++d) EXPECT_NEAR(motion[d], free[f[d]], 1e-11);
  }
}

TEST(AverageCoupling, TwoNodesAreRimEnough) {
  FeModel m = model_of(plate(1, 1, CellShape::quadrilateral4, rectangle(1, 1)), steel(PlaneState::stress));
  add_ports(m, {}, {{"pair", {0.5, 0}, {0, 1}, {1, 1}, Coupling::average}});
  const VectorXd free = random_vector(m.n(), 17), u = nodal(m, free);
  const int* f = m.port("pair")->dof;
  EXPECT_NEAR((u[0] + u[2]) / 2, free[f[0]], rounding);
  EXPECT_NEAR((u[1] + u[3]) / 2, free[f[1]], rounding);
  EXPECT_NEAR(u[3] - u[1], free[f[2]], rounding);
}

TEST(Ports, WrongRimsAndNamesAreRefused) {
  const Plate p = plate(4, 4, CellShape::quadrilateral4, rectangle(1, 1));
  const auto words = [&](const std::vector<NodePort>& nodes, const std::vector<RimPort>& rims) {
    return refusal([&] {
      FeModel m = model_of(p, steel(PlaneState::stress));
      add_ports(m, nodes, rims);
    });
  };
  const Vector2d o(0, 0);
  const RimPort a{"A", o, {0, 1, 2}, {1, 1, 1}, Coupling::rigid};
  RimPort b{"B", o, {2, 3}, {1, 1}, Coupling::average};
  EXPECT_TRUE(says(words({}, {a, b}), "\"B\" at (0, 0): its rim shares node 2 with that of port \"A\""));
  b.nodes = {3};
  b.weights = {1};
  EXPECT_TRUE(says(words({}, {b}), "at least two"));
  b.nodes = {3, 4};
  EXPECT_TRUE(says(words({}, {b}), "1 weights for 2 nodes"));
  b.weights = {1, 0};
  EXPECT_TRUE(says(words({}, {b}), "must be > 0"));
  b.weights = {1, std::nan("")};
  EXPECT_TRUE(says(words({}, {b}), "must be > 0"));
  b = {"B", o, {3, 3}, {1, 1}, Coupling::average};
  EXPECT_TRUE(says(words({}, {b}), "twice"));
  b.nodes = {3, 99};
  EXPECT_TRUE(says(words({}, {b}), "node 99 does not exist"));
  EXPECT_TRUE(says(words({{"P", 1}}, {a}), "on the rim of port \"A\""));
  EXPECT_TRUE(says(words({{"A", 7}}, {a}), "two ports have this name"));
  EXPECT_TRUE(says(words({{"P", -1}}, {}), "node -1 does not exist"));
}

TEST(Ports, ARimWhoseNodesCoincideIsRefused) {
  Matrix2Xd x(2, 3);
  x << 0, 1, 1, 0, 0, 0;
  FeModel m = fe_model(x, {Block<Bar>{{bar}, {0, 1, 0, 2}, {0, 1}}});
  EXPECT_TRUE(says(refusal([&] { add_ports(m, {}, {{"A", {1, 0}, {1, 2}, {1, 1}, Coupling::rigid}}); }), "coincide"));
}

TEST(Ports, AddingThemTwiceIsRefused) {
  FeModel m = chain(beam, 3, {0, 0}, {1, 0});
  add_ports(m, {{"A", 0}}, {});
  EXPECT_TRUE(says(refusal([&] { add_ports(m, {{"B", 1}}, {}); }), "all of them at once"));
}

TEST(Ports, NodesAloneLeaveEveryFreedomItsOwn) {
  FeModel m = chain(beam, 3, {0, 0}, {1, 0});
  add_ports(m, {{"A", 2}}, {});
  EXPECT_EQ(m.L.size(), 0);
  EXPECT_EQ(m.n(), m.N());
  EXPECT_EQ(m.port("A")->dof[2], 8);
  const Sparse K = Assembler(m).stiffness();
  EXPECT_EQ(largest(MatrixXd(independent(m, K) - K)), 0);
}

TEST(PlaneBlocks, CellsBecomeTheElementOfTheirShapeOrTheOneNamed) {
  Mesh mesh = plate(3, 2, CellShape::quadrilateral4, rectangle(1, 1)).mesh;
  const PlaneProperties p = steel(PlaneState::stress);
  EXPECT_TRUE(std::holds_alternative<Block<Quadrilateral4>>(plane_blocks(mesh, p, "")[0]));
  EXPECT_TRUE(std::holds_alternative<Block<Quadrilateral4Plain>>(plane_blocks(mesh, p, "quadrilateral4-plain")[0]));
  EXPECT_TRUE(says(refusal([&] { plane_blocks(mesh, p, "triangle6"); }), "the mesh has quadrilateral4 cells"));
  EXPECT_TRUE(says(refusal([&] { plane_blocks(mesh, p, "quad4"); }), "the elements are triangle3"));
  // A quadrilateral cut in two stands among the others, under their name too, and counts on.
  Cells& cells = mesh.cells[0];
  const std::vector<int> last(cells.nodes.end() - 4, cells.nodes.end());
  cells.nodes.resize(cells.nodes.size() - 4);
  cells.numbers.pop_back();
  mesh.cells.push_back({CellShape::triangle3, {last[0], last[1], last[2], last[0], last[2], last[3]}, {6, 7}});
  for (const char* name : {"", "quadrilateral4-plain"}) {
    const std::vector<AnyBlock> blocks = plane_blocks(mesh, p, name);
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_EQ(std::get<Block<Triangle3>>(blocks[1]).cells, (std::vector<int>{5, 6}));
  }
  EXPECT_TRUE(says(refusal([&] { plane_blocks(mesh, p, "triangle3"); }), "quadrilateral4 cells"));
  mesh.cells[0].shape = CellShape::line2;
  EXPECT_TRUE(says(refusal([&] { plane_blocks(mesh, p, ""); }), "line2"));
  mesh.cells.clear();
  EXPECT_TRUE(says(refusal([&] { plane_blocks(mesh, p, ""); }), "empty"));
}

TEST(PlaneBlocks, NegativeDensityAndThicknessAreRefused) {
  const Mesh mesh = plate(1, 1, CellShape::quadrilateral4, rectangle(1, 1)).mesh;
  PlaneProperties p = steel(PlaneState::stress);
  p.density = -7800;
  EXPECT_TRUE(says(refusal([&] { plane_blocks(mesh, p, ""); }), "density -7800"));
  p = steel(PlaneState::stress);
  p.thickness = 0;
  EXPECT_TRUE(says(refusal([&] { plane_blocks(mesh, p, ""); }), "thickness 0"));
}

TEST(PlaneBlocks, EveryNamedElementMakesABlock) {
  for (const std::string& name : element_names()) {
    const std::string shape = name.substr(0, name.find('-'));
    for (const CellShape s :
         {CellShape::triangle3, CellShape::triangle6, CellShape::quadrilateral4, CellShape::quadrilateral8, CellShape::quadrilateral9})
      if (shape == name_of(s)) {
        const Mesh mesh = plate(1, 1, s, rectangle(1, 1)).mesh;
        EXPECT_EQ(plane_blocks(mesh, steel(PlaneState::stress), name).size(), 1u) << name;
      }
  }
  EXPECT_EQ(element_names().size(), 7u);
}

// ∫ N_i ds: of a straight side of three nodes 1/6, 4/6, 1/6 of its length; of a circle, its length:
// a polygon's exactly, a parabola's with a relative error of order (half angle)⁴.
TEST(RimWeights, AreLengthsOfTheRimThatBelongToEachNode) {
  for (const CellShape shape : {CellShape::quadrilateral4, CellShape::quadrilateral8}) {
    Plate p = plate(12, 1, shape, ring(0.1, 0.3, 0.3, 2 * M_PI), true);
    Group group{"hole", p.nodes["bottom"], p.edge["bottom"]};
    std::sort(group.nodes.begin(), group.nodes.end());
    const std::vector<double> w = rim_weights(p.mesh, group);
    const double sum = std::accumulate(w.begin(), w.end(), 0.0), half = M_PI / 12;
    if (shape == CellShape::quadrilateral4)
      EXPECT_NEAR(sum, 2 * 12 * 0.1 * std::sin(half), rounding);
    else
      EXPECT_NEAR(sum, 2 * M_PI * 0.1, std::pow(half, 4) * sum);
  }
  Plate straight = plate(1, 1, CellShape::quadrilateral8, rectangle(3, 1));
  Group group{"bottom", straight.nodes["bottom"], straight.edge["bottom"]};
  std::sort(group.nodes.begin(), group.nodes.end());
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = straight.mesh.x(0, group.nodes[i]);
    EXPECT_NEAR(rim_weights(straight.mesh, group)[i], x == 1.5 ? 2 : 0.5, rounding);
  }
}

TEST(RimWeights, ABareSetOfNodesIsNoRim) {
  const Plate p = plate(1, 1, CellShape::quadrilateral4, rectangle(1, 1));
  EXPECT_TRUE(says(refusal([&] { rim_weights(p.mesh, {"set", {0, 1}, {}}); }), "no sides"));
  EXPECT_TRUE(says(refusal([&] { rim_weights(p.mesh, {"edge", {0, 1, 3}, p.edge.at("bottom")}); }), "node 3"));
}

}  // namespace
}  // namespace pintle::couplings_test
