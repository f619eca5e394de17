// Numbering, assembly and couplings of a body of elements. Judged by sums written out here, by
// rigid motion, and by least squares; elements themselves are judged elsewhere.

#include "framework/component/fe/fe_model.h"

#include "framework/component/fe/assembly.h"
#include "tests/unit/component/fe_bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace pintle::fe_model_test {
namespace {

using Eigen::Matrix2Xd;
using Eigen::MatrixX3d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Sums of some hundred terms, relative to the largest term.
constexpr double rounding = 1e-12;

const BeamEuler beam{2e8, 1500, 8, 1e-3};
const Bar bar{1e8, 4};

double largest(const MatrixXd& A) { return A.cwiseAbs().maxCoeff(); }

/// A triangle of two beams and a bar; the third node of the chain hangs on bars alone.
FeModel frame(std::vector<Lump> lumps = {}) {
  Matrix2Xd x(2, 4);
  x << 0, 1.1, 0.4, 2.0, 0, 0.2, 0.9, 0.7;
  return fe_model(x, {Block<BeamEuler>{{beam}, {0, 1, 1, 2}, {0, 1}}, Block<Bar>{{bar}, {2, 0, 1, 3, 2, 3}, {2, 3, 4}}}, std::move(lumps));
}

FeModel body(const std::string& name) {
  const PlaneProperties p = steel(PlaneState::strain);
  if (name == "frame") return frame({{1, {3, 0.2}}, {3, {5, 0}}});
  if (name == "triangle6") return model_of(plate(3, 2, CellShape::triangle6, bent_rectangle(2, 1)), p);
  if (name == "quadrilateral4") return model_of(plate(4, 3, CellShape::quadrilateral4, bent_rectangle(2, 1)), p);
  return model_of(plate(12, 2, CellShape::quadrilateral8, ring(0.1, 0.3, 1, 2 * M_PI), true), p);
}
const char* const bodies[] = {"frame", "triangle6", "quadrilateral4", "quadrilateral8"};

/// Dense sum over elements as the textbook writes it: A += Lₑᵀ a Lₑ.
template <class Of>
MatrixXd written_out(const FeModel& m, const Of& of) {
  MatrixXd A = MatrixXd::Zero(m.N(), m.N());
  for (const AnyBlock& any : m.blocks)
    std::visit(
        [&]<class E>(const Block<E>& block) {
          for (int e = 0; e < block.size(); ++e) {
            MatrixXd gather = MatrixXd::Zero(E::dofs, m.N());
            for (int k = 0; k < E::nodes; ++k)
              for (int d = 0; d < E::dofs_per_node; ++d)
                gather(k * E::dofs_per_node + d,
                       m.begin[static_cast<std::size_t>(block.nodes[static_cast<std::size_t>(e * E::nodes + k)])] + d) = 1;
            A += gather.transpose() * MatrixXd(of(block.element(e), block.coords(e, m.x), gather)) * gather;
          }
        },
        any);
  return A;
}

TEST(FeModel, ANodeTurnsOnlyWhereABeamMeetsIt) { EXPECT_EQ(frame().begin, (std::vector<int>{0, 3, 6, 9, 11})); }

TEST(FeModel, ANodeThatNoElementUsesIsRefusedByNumberAndPlace) {
  Matrix2Xd x(2, 3);
  x << 0, 1, 4, 0, 0, 5;
  const std::string words = refusal([&] { fe_model(x, {Block<Bar>{{bar}, {0, 1}, {0}}}); });
  EXPECT_TRUE(says(words, "node 2 at (4, 5)")) << words;
}

TEST(FeModel, InertiaOnANodeWithoutRotationIsRefused) {
  const std::string words = refusal([] { frame({{3, {1, 0.5}}}); });
  EXPECT_TRUE(says(words, "node 3") && says(words, "no rotation")) << words;
}

TEST(FeModel, WrongCountsAndNumbersAreRefused) {
  Matrix2Xd x(2, 2);
  x << 0, 1, 0, 0;
  EXPECT_TRUE(says(refusal([&] { fe_model(x, {Block<Bar>{{bar}, {0, 2}, {0}}}); }), "node 2"));
  EXPECT_TRUE(says(refusal([&] { fe_model(x, {Block<Bar>{{bar}, {0, 1, 0}, {0}}}); }), "multiple"));
  EXPECT_TRUE(says(refusal([&] { fe_model(x, {Block<Bar>{{bar, bar}, {0, 1}, {0}}}); }), "2 properties for 1"));
  EXPECT_TRUE(says(refusal([&] { fe_model(x, {Block<Bar>{{bar}, {0, 1}, {0}}}, {{1, {-1, 0}}}); }), "negative"));
}

class Bodies : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, Bodies, testing::ValuesIn(bodies), [](const auto& at) { return std::string(at.param); });

TEST_P(Bodies, MatricesAreTheSumsOfTheirElements) {
  const FeModel m = body(GetParam());
  const Assembler assembler(m);
  const VectorXd u = 1e-3 * random_vector(m.N(), 7);
  MatrixXd lumps = MatrixXd::Zero(m.N(), m.N()), skew_lumps = lumps;
  for (const Lump& lump : m.lumps) {
    const int at = m.begin[static_cast<std::size_t>(lump.node)];
    lumps(at, at) += lump.mass.m;
    lumps(at + 1, at + 1) += lump.mass.m;
    if (lump.mass.J > 0) lumps(at + 2, at + 2) += lump.mass.J;
    skew_lumps(at, at + 1) += lump.mass.m;  // Zᵀ m
    skew_lumps(at + 1, at) -= lump.mass.m;
  }
  const auto agree = [](const Sparse& ours, const MatrixXd& written) {
    EXPECT_LT(largest(MatrixXd(ours) - written), rounding * largest(written));
  };
  agree(assembler.stiffness(), written_out(m, [](const auto& e, const auto& x, const MatrixXd&) { return stiffness(e, x); }));
  agree(assembler.mass(), lumps + written_out(m, [](const auto& e, const auto& x, const MatrixXd&) { return mass(e, x); }));
  agree(assembler.mass(MassKind::lumped),
        lumps + written_out(m, [](const auto& e, const auto& x, const MatrixXd&) { return MatrixXd(lumped_mass(e, x).asDiagonal()); }));
  agree(assembler.skew_mass(), skew_lumps + written_out(m, [](const auto& e, const auto& x, const MatrixXd&) { return skew_mass(e, x); }));
  agree(assembler.geometric_stiffness(u), written_out(m, [&]<class E>(const E& e, const Coords<E>& x, const MatrixXd& gather) {
          return geometric_stiffness(e, x, stress(e, x, NodalVector<E>(gather * u)));
        }));
}

TEST_P(Bodies, RigidMotionsCostNoEnergyAndCarryTheMass) {
  const FeModel m = body(GetParam());
  const Assembler assembler(m);
  const Sparse K = assembler.stiffness(), M = assembler.mass();
  const RigidFields f = rigid_fields(m);
  MatrixX3d motions(m.N(), 3);
  motions << f.T, f.R;
  EXPECT_LT(largest(K * motions), rounding * largest(MatrixXd(K)) * largest(motions));
  // Mass and centre as areas and lengths have them.
  double mass = 0;
  const std::string name = GetParam();
  if (name == "frame") {
    mass = beam.rhoA * ((m.x.col(1) - m.x.col(0)).norm() + (m.x.col(2) - m.x.col(1)).norm()) +
           bar.rhoA * ((m.x.col(2) - m.x.col(0)).norm() + (m.x.col(3) - m.x.col(1)).norm() + (m.x.col(3) - m.x.col(2)).norm()) + 8;
  } else if (name != "quadrilateral8") {
    mass = 7800 * 0.01 * 2;  // the bump moves no boundary
  } else {
    // Sides are parabolas through the circle: area between polygon and 2/3 of each circular
    // sagitta.
    for (const double r : {0.1, 0.3}) {
      const double half = M_PI / 12, chord = 2 * r * std::sin(half), sagitta = r * (1 - std::cos(half));
      const double area = 12 * (r * r * std::sin(half) * std::cos(half) + 2.0 / 3 * chord * sagitta);
      mass += (r == 0.1 ? -1 : 1) * area * 7800 * 0.01;
    }
  }
  EXPECT_NEAR(f.T.col(0).dot(M * f.T.col(0)), mass, 1e-10 * mass);
  EXPECT_NEAR(f.T.col(1).dot(M * f.T.col(1)), mass, 1e-10 * mass);
  EXPECT_NEAR(f.T.col(0).dot(M * f.T.col(1)), 0, 1e-10 * mass);
}

TEST_P(Bodies, StiffnessMassSkewAndGeometricStiffnessHaveOnePattern) {
  const FeModel m = body(GetParam());
  const Assembler assembler(m);
  const Sparse K = assembler.stiffness();
  ASSERT_TRUE(K.isCompressed());
  for (Eigen::Index j = 0; j < K.cols(); ++j)
    for (int k = K.outerIndexPtr()[j]; k + 1 < K.outerIndexPtr()[j + 1]; ++k)
      ASSERT_LT(K.innerIndexPtr()[k], K.innerIndexPtr()[k + 1]) << "column " << j;
  for (const Sparse& other : {assembler.mass(), assembler.skew_mass(), assembler.geometric_stiffness(VectorXd::Ones(m.N()))}) {
    ASSERT_EQ(other.nonZeros(), K.nonZeros());
    EXPECT_TRUE(std::equal(K.innerIndexPtr(), K.innerIndexPtr() + K.nonZeros(), other.innerIndexPtr()));
    EXPECT_TRUE(std::equal(K.outerIndexPtr(), K.outerIndexPtr() + K.cols() + 1, other.outerIndexPtr()));
  }
}

TEST_P(Bodies, TheOrderOfElementsDoesNotMatter) {
  FeModel m = body(GetParam());
  const Sparse K = Assembler(m).stiffness();
  for (AnyBlock& any : m.blocks)
    std::visit(
        [&]<class E>(Block<E>& block) {
          Block<E> turned = block;
          for (int e = 0; e < block.size(); ++e)
            std::copy_n(block.nodes.begin() + e * E::nodes, E::nodes, turned.nodes.end() - (e + 1) * E::nodes);
          block = turned;
        },
        any);
  std::reverse(m.blocks.begin(), m.blocks.end());
  EXPECT_LT(largest(MatrixXd(Assembler(m).stiffness() - K)), rounding * largest(MatrixXd(K)));
}

TEST(Assembler, RenumberedNodesGiveTheSameMatrixRenumbered) {
  Plate p = plate(4, 3, CellShape::quadrilateral8, bent_rectangle(2, 1));
  const FeModel m = model_of(p, steel(PlaneState::stress));
  const auto count = static_cast<std::size_t>(m.x.cols());
  std::vector<int> to(count);
  std::iota(to.begin(), to.end(), 0);
  std::shuffle(to.begin(), to.end(), std::mt19937(3));
  Plate q = p;
  for (std::size_t i = 0; i < count; ++i) q.mesh.x.col(to[i]) = p.mesh.x.col(static_cast<Eigen::Index>(i));
  for (int& node : q.mesh.cells[0].nodes) node = to[static_cast<std::size_t>(node)];
  const MatrixXd K(Assembler(m).stiffness());
  const FeModel renumbered = model_of(q, steel(PlaneState::stress));
  const MatrixXd Kq(Assembler(renumbered).stiffness());
  double worst = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      worst = std::max(worst, largest(Kq.block<2, 2>(2 * to[i], 2 * to[j]) -
                                      K.block<2, 2>(static_cast<Eigen::Index>(2 * i), static_cast<Eigen::Index>(2 * j))));
  EXPECT_LT(worst, rounding * largest(K));
}

// Along a line of n cells 3n + 1 pairs of nodes share a cell; in a grid both ways at once.
TEST(Assembler, StoresTheNodesThatShareACellAndNoOthers) {
  const FeModel m = model_of(plate(7, 5, CellShape::quadrilateral4, rectangle(2, 1)), steel(PlaneState::stress));
  EXPECT_EQ(Assembler(m).stiffness().nonZeros(), 4 * (3 * 7 + 1) * (3 * 5 + 1));
}

TEST(Assembler, LumpedMassStoresItsDiagonalAlone) {
  const FeModel m = frame({{1, {3, 0.2}}});
  const Sparse M = Assembler(m).mass(MassKind::lumped);
  EXPECT_EQ(M.nonZeros(), m.N());
}

}  // namespace
}  // namespace pintle::fe_model_test
