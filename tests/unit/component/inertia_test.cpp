// What the online side keeps of a body, against the motion of its material: kinetic energy by
// quadrature over elements and section fibres, with shape functions alone.

#include "framework/component/reduction/inertia.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <ostream>
#include <random>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "tests/contracts/reduction_bodies.h"

#include "framework/bodies/modal_basis.h"

namespace pintle::inertia_test {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Tolerances, relative to the size of the terms.
// Sums over a few thousand points.
constexpr double rounding = 1e-12;
// Central differences over 1e-4 of a turn: cut-off 1e-8 of third derivatives, rounding 1e-12.
constexpr double difference = 1e-6;

/// A bit of material: dm, where it lies, and its displacement for each nodal dof.
struct Particle {
  double m;
  Vector2d x;
  Eigen::Matrix2Xd shape;  // 2 × k, after multiplication by the modal shapes
};

// Exact for degree 9 in each direction: products of two biquadratic fields on distorted cells.
const double gauss_at[] = {-0.906179845938663993, -0.538469310105683091, 0, 0.538469310105683091, 0.906179845938663993};
const double gauss_weight[] = {0.236926885056189088, 0.478628670499366468, 0.568888888888888889, 0.478628670499366468,
                               0.236926885056189088};

template <class E>
MatrixXd element_shapes(const FeModel& model, const Block<E>& block, int i, const MatrixXd& phi) {
  MatrixXd u(E::dofs, phi.cols());
  for (int k = 0; k < E::nodes; ++k) {
    const auto node = static_cast<std::size_t>(block.nodes[static_cast<std::size_t>(i * E::nodes + k)]);
    u.middleRows(k * E::dofs_per_node, E::dofs_per_node) = phi.middleRows(model.begin[node], E::dofs_per_node);
  }
  return u;
}

/// A section with rotary inertia ρI per length is two fibres at ±√(I/A) that turn with it.
template <class E>
void add_line(std::vector<Particle>& all, const FeModel& model, const Block<E>& block, const MatrixXd& phi) {
  for (int i = 0; i < block.size(); ++i) {
    const E& e = block.element(i);
    const Coords<E> x = block.coords(i, model.x);
    const MatrixXd u = element_shapes(model, block, i, phi);
    const Vector2d axis = x.col(1) - x.col(0), along = axis.normalized(), across(-along.y(), along.x());
    const double fibre = std::sqrt(e.rhoI / e.rhoA);
    for (int g = 0; g < 5; ++g) {
      const double xi = (1 + gauss_at[g]) / 2;
      for (const double side : {-fibre, fibre}) {
        Particle p{e.rhoA * axis.norm() * gauss_weight[g] / 4, x.col(0) + xi * axis + side * across, {}};
        p.shape = (shape(e, x, {xi, 0}) - side * along * rotation(e, x, xi)) * u;
        all.push_back(p);
      }
    }
  }
}

/// Triangles are folded squares: (s, t) → (s, t(1 − s)), with the Jacobian 1 − s.
template <class E>
void add_plane(std::vector<Particle>& all, const FeModel& model, const Block<E>& block, const MatrixXd& phi) {
  const bool triangle = E::nodes == 3 || E::nodes == 6;
  for (int i = 0; i < block.size(); ++i) {
    const E& e = block.element(i);
    const Coords<E> x = block.coords(i, model.x);
    const MatrixXd u = element_shapes(model, block, i, phi);
    NodalVector<E> position;
    for (int k = 0; k < E::nodes; ++k) position.template segment<2>(2 * k) = x.col(k);
    const auto at = [&](const Vector2d& xi) -> Vector2d { return shape(e, x, xi) * position; };
    for (int g = 0; g < 25; ++g) {
      Vector2d xi(gauss_at[g % 5], gauss_at[g / 5]);
      double weight = gauss_weight[g % 5] * gauss_weight[g / 5];
      if (triangle) {
        xi = (xi.array() + 1) / 2;
        weight *= (1 - xi.x()) / 4;
        xi.y() *= 1 - xi.x();
      }
      // Of second degree at most in each direction: differences over a half are exact.
      const Vector2d a = at(xi + Vector2d(0.25, 0)) - at(xi - Vector2d(0.25, 0));
      const Vector2d b = at(xi + Vector2d(0, 0.25)) - at(xi - Vector2d(0, 0.25));
      const double area = 4 * (a.x() * b.y() - a.y() * b.x());
      all.push_back({e.p.density * e.p.thickness * area * weight, at(xi), shape(e, x, xi) * u});
    }
  }
}

/// A lump with inertia is two halves that turn about its node, far enough apart to have it.
void add_lump(std::vector<Particle>& all, const FeModel& model, const Lump& lump, const MatrixXd& phi) {
  const int f = model.begin[static_cast<std::size_t>(lump.node)];
  const double arm = std::sqrt(lump.mass.J / lump.mass.m);
  for (const double side : {-arm, arm}) {
    Particle p{lump.mass.m / 2, model.x.col(lump.node) + Vector2d(0, side), phi.middleRows(f, 2)};
    if (arm > 0) p.shape.row(0) -= side * phi.row(f + 2);
    all.push_back(p);
  }
}

/// Lumped elements are a mass at each of their nodes.
template <class E>
void add_lumped(std::vector<Particle>& all, const FeModel& model, const Block<E>& block, const MatrixXd& phi) {
  for (int i = 0; i < block.size(); ++i) {
    const NodalVector<E> m = lumped_mass(block.element(i), block.coords(i, model.x));
    for (int k = 0; k < E::nodes; ++k) {
      const int f = k * E::dofs_per_node;
      const int node = block.nodes[static_cast<std::size_t>(i * E::nodes + k)];
      add_lump(all, model, {node, {m[f], E::dofs_per_node == 3 ? m[f + 2] : 0}}, phi);
    }
  }
}

std::vector<Particle> particles(const FeModel& model, const MatrixXd& phi, MassKind kind) {
  std::vector<Particle> all;
  for (const AnyBlock& any : model.blocks)
    std::visit(
        [&]<class E>(const Block<E>& block) {
          if (kind == MassKind::lumped)
            add_lumped(all, model, block, phi);
          else if constexpr (std::is_same_v<E, BeamEuler> || std::is_same_v<E, BeamTimoshenko>)
            add_line(all, model, block, phi);
          else if constexpr (!std::is_same_v<E, Bar>)
            add_plane(all, model, block, phi);
        },
        any);
  for (const Lump& lump : model.lumps) add_lump(all, model, lump, phi);
  return all;
}

Matrix2d turn(double angle) {
  Matrix2d A;
  A << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return A;
}
const Matrix2d Z = (Matrix2d() << 0, -1, 1, 0).finished();

/// q = [x y θ η], s = q̇: each particle is where its body carries it, and moves as that changes.
double kinetic_energy(const std::vector<Particle>& all, const VectorXd& q, const VectorXd& s) {
  const Matrix2d A = turn(q[2]);
  const auto n = q.size() - 3;
  double sum = 0;
  for (const Particle& p : all) {
    const Vector2d y = p.x + p.shape * q.tail(n);
    const Vector2d v = s.head<2>() + s[2] * (A * (Z * y)) + A * (p.shape * s.tail(n));
    sum += p.m * v.squaredNorm() / 2;
  }
  return sum;
}

/// Block mass matrix of [x y θ η].
MatrixXd mass_matrix(const RigidInertia& r, const FlexInertia& f, const VectorXd& q) {
  const auto n = f.omega.size();
  const VectorXd eta = q.tail(n);
  const Matrix2d A = turn(q[2]);
  MatrixXd M = MatrixXd::Identity(3 + n, 3 + n);
  M.topLeftCorner<2, 2>() *= r.m;
  M.block<2, 1>(0, 2) = A * Z * (r.c + f.S * eta);
  M.topRightCorner(2, n) = A * f.S;
  M(2, 2) = r.J + 2 * f.j.dot(eta) + eta.squaredNorm();
  M.block(2, 3, 1, n) = f.h + eta.transpose() * f.G;
  return M.selfadjointView<Eigen::Upper>();
}

/// Docs' inertia terms on the right-hand side, elastic and damping ones left out.
VectorXd inertia_force(const RigidInertia& r, const FlexInertia& f, const VectorXd& q, const VectorXd& s) {
  const auto n = f.omega.size();
  const VectorXd eta = q.tail(n), rate = s.tail(n);
  const Matrix2d A = turn(q[2]);
  const double w = s[2];
  VectorXd force(3 + n);
  force.head<2>() = w * w * (A * (r.c + f.S * eta)) - 2 * w * (A * Z * (f.S * rate));
  force[2] = -2 * w * (f.j.dot(rate) + eta.dot(rate));
  force.tail(n) = w * w * (f.j.transpose() + eta) + 2 * w * (f.G * rate);
  return force;
}

SampleBody plate_of(CellShape cells, const char* element = "") {
  const Plate p = plate(4, 2, cells, bent_rectangle(0.2, 0.05));
  return on_nodes(model_of(p, steel(PlaneState::stress), element), p.nodes.at("left")[1], p.nodes.at("right")[0]);
}

struct Subject {
  const char* name;
  SampleBody (*make)();
  ReferenceConditions conditions;
  MassKind kind = MassKind::consistent;
};
void PrintTo(const Subject& s, std::ostream* out) { *out << s.name; }
constexpr ReferenceConditions chord{ReferenceConditions::chord, 0, 1}, tangent{ReferenceConditions::tangent, 0, -1}, mean{};
using enum CellShape;
const Subject subjects[] = {
    {"EulerBeamTangent", [] { return euler_beam(6); }, tangent},
    {"TimoshenkoBracketChord", timoshenko_bracket, chord},
    {"TimoshenkoBracketMeanAxes", timoshenko_bracket, mean},
    {"TimoshenkoBracketLumped", timoshenko_bracket, tangent, MassKind::lumped},
    {"PlateOnRigidEdgesTangent", [] { return plate_on_edges(Coupling::rigid); }, {ReferenceConditions::tangent, 1, -1}},
    {"PlateOnAveragedEdgesMeanAxes", [] { return plate_on_edges(Coupling::average); }, mean},
    {"PlateOnEdgesLumped", [] { return plate_on_edges(Coupling::rigid); }, chord, MassKind::lumped},
    {"PlateOnNodesChord", plate_on_nodes, chord},
    {"Triangle3", [] { return plate_of(triangle3); }, mean},
    {"Triangle6", [] { return plate_of(triangle6); }, mean},
    {"Quadrilateral4", [] { return plate_of(quadrilateral4); }, mean},
    {"Quadrilateral4Plain", [] { return plate_of(quadrilateral4, "quadrilateral4-plain"); }, chord},
    {"Quadrilateral8", [] { return plate_of(quadrilateral8); }, chord},
    {"Quadrilateral8Reduced", [] { return plate_of(quadrilateral8, "quadrilateral8-reduced"); }, mean},
    {"Quadrilateral9", [] { return plate_of(quadrilateral9); }, mean},
    {"Quadrilateral9Lumped", [] { return plate_of(quadrilateral9); }, mean, MassKind::lumped},
};

/// As a mechanism has it.
Sparse skew_mass(const FeModel& model, const Sparse& M, MassKind kind) {
  SceneBody scene;
  scene.elastic.emplace().lumped = kind == MassKind::lumped;
  ElasticBody e;
  e.scene = &scene, e.model = model, e.M = M;
  return skew_mass_of(e);
}

class Inertia : public testing::TestWithParam<Subject> {
 protected:
  const SampleBody body = [] {
    SampleBody b = GetParam().make();
    for (AnyBlock& any : b.model.blocks)  // an Euler beam whose sections have inertia
      if (auto* beams = std::get_if<Block<BeamEuler>>(&any))
        for (BeamEuler& e : beams->properties) e = euler_strip(1);
    return b;
  }();
  const MassKind kind = GetParam().kind;
  const Sparse M = Assembler(body.model).mass(kind), G = skew_mass(body.model, M, kind);
  const ModalModel modes = craig_bampton(component(body.model, kind == MassKind::lumped), {0, 1}, GetParam().conditions, {.count = 3});
  const RigidInertia rigid = rigid_inertia(body.model, M);
  const FlexInertia flex = flex_inertia(body.model, M, G, modes);
  const std::vector<Particle> material = particles(body.model, modes.shapes, kind);
  std::mt19937 random{7};

  double within(double reach) { return reach * (2 * (static_cast<double>(random()) / 4294967296.0) - 1); }
  /// Coordinates or speeds; deformation a tenth of the body's size.
  VectorXd draw() {
    VectorXd v(3 + modes.omega.size());
    v << within(1), within(1), within(3), VectorXd::Zero(modes.omega.size());
    for (Eigen::Index k = 0; k < modes.omega.size(); ++k) v[3 + k] = within(0.02) / modes.shapes.col(k).cwiseAbs().maxCoeff();
    return v;
  }
};
INSTANTIATE_TEST_SUITE_P(Every, Inertia, testing::ValuesIn(subjects), [](const auto& p) { return std::string(p.param.name); });

TEST_P(Inertia, OfTheUndeformedBodyIsThatOfItsMaterial) {
  RigidInertia sum;
  for (const Particle& p : material) {
    sum.m += p.m;
    sum.c += p.m * p.x;
    sum.J += p.m * p.x.squaredNorm();
  }
  EXPECT_NEAR(rigid.m, sum.m, rounding * sum.m);
  EXPECT_LT((rigid.c - sum.c).norm(), rounding * std::sqrt(sum.m * sum.J));
  EXPECT_NEAR(rigid.J, sum.J, rounding * sum.J);
}

// S, j, h and G by their definitions; ΦᵀMΦ = 1 besides.
TEST_P(Inertia, OfTheShapesIsThatOfItsMaterial) {
  const auto n = modes.omega.size();
  MatrixXd S = MatrixXd::Zero(2, n), j = MatrixXd::Zero(1, n), h = j, G_sum = MatrixXd::Zero(n, n), square = G_sum;
  for (const Particle& p : material) {
    const Eigen::Matrix2Xd turned = Z.transpose() * p.shape;
    S += p.m * p.shape;
    j += p.m * p.x.transpose() * p.shape;
    h += p.m * p.x.transpose() * turned;
    G_sum += p.m * p.shape.transpose() * turned;
    square += p.m * p.shape.transpose() * p.shape;
  }
  EXPECT_LT((flex.S - S).norm(), rounding * std::sqrt(rigid.m));
  EXPECT_LT((flex.j - j).norm(), rounding * std::sqrt(rigid.J));
  EXPECT_LT((flex.h - h).norm(), rounding * std::sqrt(rigid.J));
  EXPECT_LT((flex.G - G_sum).norm(), 10 * rounding);
  EXPECT_LT((square - MatrixXd::Identity(n, n)).norm(), 10 * rounding);
}

TEST_P(Inertia, MakesTheKineticEnergyOfAnyMotion) {
  for (int draw_ = 0; draw_ < 20; ++draw_) {
    const VectorXd q = draw(), s = draw();
    const double direct = kinetic_energy(material, q, s);
    EXPECT_NEAR(0.5 * s.dot(mass_matrix(rigid, flex, q) * s), direct, rounding * direct);
  }
}

// Lagrange: d/dt(∂T/∂s) − ∂T/∂q = M(q)a − (velocity terms); with a = 0 the left side is what
// remains.
TEST_P(Inertia, VelocityTermsAreThoseOfTheLagrangian) {
  const double step = 1e-4;
  for (int draw_ = 0; draw_ < 5; ++draw_) {
    const VectorXd q = draw(), s = draw();
    const auto size = q.size();
    // T is quadratic in s: differences over any step are exact but for rounding.
    const auto momentum = [&](const VectorXd& at) {
      VectorXd p(size);
      for (Eigen::Index k = 0; k < size; ++k) {
        VectorXd up = s, down = s;
        const double by = s.cwiseAbs().maxCoeff();
        up[k] += by;
        down[k] -= by;
        p[k] = (kinetic_energy(material, at, up) - kinetic_energy(material, at, down)) / (2 * by);
      }
      return p;
    };
    VectorXd expected = -(momentum(q + step * s) - momentum(q - step * s)) / (2 * step);
    for (Eigen::Index k = 0; k < size; ++k) {
      VectorXd up = q, down = q;
      up[k] += step;
      down[k] -= step;
      expected[k] += (kinetic_energy(material, up, s) - kinetic_energy(material, down, s)) / (2 * step);
    }
    const VectorXd ours = inertia_force(rigid, flex, q, s);
    EXPECT_LT((ours - expected).norm(), difference * expected.norm());
  }
}

TEST_P(Inertia, SkewInvariantIsSkewAndZetaIsZeroUntilChosen) {
  EXPECT_EQ(flex.G, -flex.G.transpose());
  EXPECT_EQ(flex.zeta, VectorXd::Zero(modes.omega.size()));
  EXPECT_EQ(flex.omega, modes.omega);
}

// Body axes moved by p and turned by A: x' = Aᵀ(x − p). The material is the same.
TEST_P(Inertia, InvariantsFollowWhenTheBodyAxesAreMoved) {
  const Vector2d p(0.3, -0.7);
  const Matrix2d A = turn(0.8);
  FeModel moved = body.model;
  moved.x = A.transpose() * (moved.x.colwise() - p);
  moved.ports.clear();
  // Shapes are carried along: displacements turn, rotations stay.
  ModalModel carried = modes;
  for (std::size_t k = 0; k + 1 < moved.begin.size(); ++k)
    carried.shapes.middleRows(moved.begin[k], 2) = (A.transpose() * modes.shapes.middleRows(moved.begin[k], 2)).eval();
  const Sparse M_moved = Assembler(moved).mass(kind);
  const RigidInertia r = rigid_inertia(moved, M_moved);
  const FlexInertia f = flex_inertia(moved, M_moved, skew_mass(moved, M_moved, kind), carried);

  const double size = std::sqrt(rigid.J / rigid.m) + p.norm(), root = std::sqrt(rigid.m);
  EXPECT_NEAR(r.m, rigid.m, rounding * rigid.m);
  EXPECT_LT((r.c - A.transpose() * (rigid.c - rigid.m * p)).norm(), rounding * rigid.m * size);
  EXPECT_NEAR(r.J, rigid.J - 2 * p.dot(rigid.c) + rigid.m * p.squaredNorm(), rounding * rigid.m * size * size);
  EXPECT_LT((f.S - A.transpose() * flex.S).norm(), rounding * root * 10);
  EXPECT_LT((f.j - (flex.j - p.transpose() * flex.S)).norm(), rounding * root * size * 10);
  EXPECT_LT((f.h - (flex.h - (Z * p).transpose() * flex.S)).norm(), rounding * root * size * 10);
  EXPECT_LT((f.G - flex.G).norm(), rounding * 10);
}

TEST(RigidInertia, CountsTheInertiaOfSections) {
  // A steel strip so short that its height matters: m(L² + h²)/12 about its middle.
  const double length = 0.05, height = 0.04, m = 2.0;
  const BeamEuler e{1e6, 1e3, m / length, m / length * height * height / 12};
  const FeModel model = chain(e, 3, {-length / 2, 0}, {length / 2, 0});
  const RigidInertia r = rigid_inertia(model, Assembler(model).mass());
  EXPECT_NEAR(r.J, m * (length * length + height * height) / 12, rounding * m * length * length);
}

}  // namespace
}  // namespace pintle::inertia_test
