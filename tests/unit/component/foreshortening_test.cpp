// What bending adds to displacement at second order, by its matrices alone: against published
// rotating and buckling beams, exact integrals of slopes and direct eigenvalue problems.

#include "framework/component/reduction/foreshortening.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "tests/contracts/reduction_bodies.h"
#include "tests/unit/elements/beam_chain.h"

namespace pintle::foreshortening_test {
namespace {

using Eigen::Vector2d;
constexpr double pi = std::numbers::pi;

// Tolerances, relative to the largest entry or to the value.
// Loads pass through K⁻¹ and back through stress: 1e-16 times EA/EI, 1e6 here, and some sums.
constexpr double through_statics = 1e-9;
// Beams of n elements whose pull varies: it is constant in an element, which is of order 2, and the
// error of a frequency no more than 1/(2n²) even at the fastest spin here.
double mesh(int n) { return 0.5 / (n * n); }
// The last of the published figures: 5e-5 of 4.1 and 5e-5 of 22.
constexpr double published = 1.3e-5;

// EI = ρA = L = 1. Stretch is a thousand times faster than bending, so that the lowest eight shapes
// are bending alone.
const BeamEuler unit_beam{.EA = 1e6, .EI = 1, .rhoA = 1};
const ReferenceConditions tangent{ReferenceConditions::tangent, 0}, chord{ReferenceConditions::chord, 0, 1};
const ReferenceConditions mean_axes{ReferenceConditions::mean_axes};

/// A body with its matrices and shapes.
struct Reduced {
  Reduced(FeModel made, ReferenceConditions with, const Keep& keep = {.count = 8})
      : model(std::move(made)), conditions(with), modes(normal_modes(c, conditions, keep)) {}
  Reduced(const Reduced&) = delete;  // c refers to the model
  FeModel model;
  Component c = component(model);
  Sparse M = Assembler(model).mass();
  ReferenceConditions conditions;
  ModalModel modes;

  Foreshortening inertia() const { return inertia_foreshortening(c, M, conditions, modes); }
  std::array<MatrixXd, 2> at(int port) const { return port_foreshortening(c, conditions, modes)[static_cast<std::size_t>(port)]; }
  MatrixXd stiffness() const { return modes.omega.cwiseAbs2().asDiagonal(); }
};
Reduced beam(int elements, ReferenceConditions conditions, const Keep& keep = {.count = 8}, Vector2d to = {1, 0}) {
  FeModel model = chain(unit_beam, elements, {0, 0}, to);
  add_ports(model, {{"A", 0}, {"B", elements}, {"M", elements / 2}}, {});
  return {std::move(model), conditions, keep};
}

VectorXd eigenvalues(const MatrixXd& A) { return Eigen::SelfAdjointEigenSolver<MatrixXd>(A).eigenvalues(); }
double size_of(const MatrixXd& A) { return A.cwiseAbs().maxCoeff(); }
/// Least P > 0 at which K − P F is singular.
double buckling_load(const Reduced& body, const MatrixXd& F) {
  const VectorXd root = body.modes.omega.cwiseInverse();
  return 1 / eigenvalues(root.asDiagonal() * F * root.asDiagonal()).tail<1>()[0];
}

// ---- spin ----

struct Spin {
  double w, first, second;
};
const Spin spins[] = {{2, 4.1373, 22.6149}, {6, 7.3604, 26.8091}, {10, 11.2023, 33.6404}};

TEST(SpinningCantilever, HasThePublishedFrequenciesAcrossAndInThePlaneOfSpin) {
  const int elements = 80;
  const Reduced body = beam(elements, tangent, {.all = true});
  const MatrixXd j = body.inertia().j;
  const double tolerance = mesh(elements) + published;
  for (const Spin& s : spins) {
    const MatrixXd across = body.stiffness() - s.w * s.w * j;
    const VectorXd flap = eigenvalues(across);
    EXPECT_NEAR(std::sqrt(flap[0]), s.first, tolerance * s.first);
    EXPECT_NEAR(std::sqrt(flap[1]), s.second, tolerance * s.second);
    const MatrixXd one = MatrixXd::Identity(j.rows(), j.cols());
    const VectorXd in_plane = eigenvalues(body.stiffness() - s.w * s.w * (one + j));
    const double first = s.first * s.first - s.w * s.w;
    EXPECT_NEAR(in_plane[0], first, 2 * tolerance * s.first * s.first);
  }
}

TEST(SpinningCantilever, ConvergesWithOrderTwoInTheMesh) {
  const auto frequency = [](int elements) {
    const Reduced body = beam(elements, tangent);
    return std::sqrt(eigenvalues(body.stiffness() - 100 * body.inertia().j)[1]);
  };
  const double coarse = frequency(10), middle = frequency(20), fine = frequency(40);
  EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 2, 0.1);
}

/// Strip of length 1 and height 1/50 whose left edge follows a port in its middle, the origin, and
/// whose right edge follows one that stands `arm` ahead of it. EI = ρA = 1.
FeModel strip(double arm, Coupling right = Coupling::rigid, int cells = 40) {
  const double height = 0.02, thickness = 0.01;
  const Plate p = plate(cells, 2, CellShape::quadrilateral8, [=](double s, double t) { return Vector2d(s, height * (t - 0.5)); });
  const double density = 1 / (thickness * height);
  const double young = 12 / (thickness * std::pow(height, 3));
  const Material material{Isotropic{young, 0.3}, density};
  FeModel model = model_of(p, {plane_material(material, PlaneState::stress), density, thickness});
  RimPort a = edge_port(p, "A", "left", Coupling::rigid), b = edge_port(p, "B", "right", right);
  b.x.x() += arm;
  add_ports(model, {}, {a, b});
  return model;
}
// Plate against beam: rotary inertia and shear take (βh)²/6 of a frequency, 1.5e-3 of the second,
// and shear π²EI/(κGA) = 1e-3 of Euler's load; rigid edges give back less.
constexpr double slender = 3e-3;

TEST(SpinningCantilever, OfPlaneElementsIsTheBeam) {
  const Reduced body(strip(0), tangent);
  const MatrixXd j = body.inertia().j;
  for (const Spin& s : spins) {
    const VectorXd flap = eigenvalues(body.stiffness() - s.w * s.w * j);
    EXPECT_NEAR(std::sqrt(flap[0]), s.first, slender * s.first);
    EXPECT_NEAR(std::sqrt(flap[1]), s.second, slender * s.second);
  }
}

// ---- loads at ports ----

TEST(PulledBeam, PinnedAtItsEndsStiffensByEulersLoad) {
  const double a = 0.6, euler = pi * pi;
  const Vector2d along(std::cos(a), std::sin(a));
  const Reduced body = beam(40, chord, {.count = 8}, along);
  const auto [x, y] = body.at(1);
  const MatrixXd F = along.x() * x + along.y() * y;
  for (const double pull : {-0.9, -0.3, 0.5, 4.0}) {
    const VectorXd squares = eigenvalues(body.stiffness() - pull * euler * F);
    for (int k = 1; k <= 3; ++k) {
      const double free = std::pow(k * pi, 4);
      // Hermite cubics are of order 4: (kπ/n)⁴/720 of a frequency's square, 4e-6 at the third.
      EXPECT_NEAR(squares[k - 1], free * (1 + pull / (k * k)), 1e-5 * free) << pull << " " << k;
    }
  }
  EXPECT_NEAR(buckling_load(body, -F), euler, 1e-6 * euler);
}

TEST(PulledBeam, OfPlaneElementsBucklesUnderEulersLoad) {
  for (const Coupling coupling : {Coupling::rigid, Coupling::average}) {
    const Reduced body(strip(0, coupling), chord);
    EXPECT_NEAR(buckling_load(body, -body.at(1)[0]), pi * pi, slender * pi * pi);
  }
}

/// −∫ φ_i' φ_j' dx from the left end over so many elements of a chain along x; Hermite slopes,
/// exact.
MatrixXd slopes(const Reduced& body, int elements) {
  const double at[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  const double weight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const MatrixXd& phi = body.modes.shapes;
  MatrixXd sum = MatrixXd::Zero(phi.cols(), phi.cols());
  for (int e = 0; e < elements; ++e) {
    const double l = body.model.x(0, e + 1) - body.model.x(0, e);
    for (int g = 0; g < 3; ++g) {
      const double s = at[g];
      const Eigen::RowVector4d d(6 * s * (s - 1) / l, 1 + s * (3 * s - 4), 6 * s * (1 - s) / l, s * (3 * s - 2));
      MatrixXd w(4, phi.cols());
      w << phi.middleRows(3 * e + 1, 2), phi.middleRows(3 * e + 4, 2);
      const Eigen::RowVectorXd slope = d * w;
      sum -= weight[g] * l * slope.transpose() * slope;
    }
  }
  return sum;
}

TEST(ClampedBeam, ComesShorterByHalfTheSquareOfItsSlope) {
  const int elements = 20;
  const Reduced body = beam(elements, tangent);
  const MatrixXd tip = slopes(body, elements), middle = slopes(body, elements / 2);
  EXPECT_LT(size_of(body.at(1)[0] - tip), through_statics * size_of(tip));
  EXPECT_LT(size_of(body.at(2)[0] - middle), through_statics * size_of(tip));
}

TEST(ClampedBeam, DoesNotMoveAcrossAtSecondOrder) {
  const Reduced body = beam(20, tangent);
  EXPECT_LT(size_of(body.at(1)[1]), through_statics * size_of(body.at(1)[0]));
}

TEST(TiedPort, StaysWhereItIs) {
  for (const ReferenceConditions& conditions : {tangent, chord}) {
    const Reduced body = beam(20, conditions);
    const double size = size_of(body.at(1)[0]);
    for (const MatrixXd& F : body.at(0)) EXPECT_LT(size_of(F), through_statics * size);
  }
}

// A column with a rigid arm under a dead load at its end: ka·tan(kL) = 1, k² = P/EI.
TEST(RigidRim, ShortensAsTheRigidPieceThatItIs) {
  const double arm = 0.3;
  double low = 0, high = pi / 2;
  for (int i = 0; i < 60; ++i) {
    const double k = (low + high) / 2;
    (k * arm * std::tan(k) < 1 ? low : high) = k;
  }
  Reduced body(strip(arm), tangent);
  body.modes = craig_bampton(body.c, {0, 1}, tangent, {.count = 4});  // the arm bends the end
  EXPECT_NEAR(buckling_load(body, -body.at(1)[0]), low * low, slender * low * low);
}

// ---- mean axes ----

// Held by nothing, pulled at both ends by P in a fixed direction: the turn of the frame sees P L
// and what the ends move across. Beside it stands the eigenvalue problem of all nodal dofs.
TEST(FreeBeam, UnderOppositePullsIsThatOfNodalDegreesOfFreedom) {
  const int elements = 30;
  const double pull = 40;
  const Chain<BeamEuler> direct = chain(unit_beam, elements, 1.0);
  const Dofs bends = bending(direct.dofs(), {});
  const MatrixXd K = kept(direct.K() + direct.K_g([=](double) { return pull; }), bends);
  const VectorXd expected = Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(K, kept(direct.M(), bends)).eigenvalues();

  const Reduced body = beam(elements, mean_axes, {.all = true});
  const RigidInertia rigid = rigid_inertia(body.model, body.M);
  const double J = rigid.J - rigid.c.squaredNorm() / rigid.m;
  const auto k = body.modes.omega.size();
  MatrixXd A(1 + k, 1 + k);
  A(0, 0) = pull / J;
  A.bottomRightCorner(k, k) = body.stiffness() - pull * (body.at(1)[0] - body.at(0)[0]);
  A.block(0, 1, 1, k) = pull / std::sqrt(J) * (body.modes.ports.row(4) - body.modes.ports.row(1));
  const VectorXd ours = eigenvalues(A.selfadjointView<Eigen::Upper>());
  // Nodal dofs have one motion more, along y, which nothing resists.
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(ours[i], expected[i + 1], through_statics * expected[4]) << i;
}

// Pulled at one end it is accelerated, and the pull falls to nothing at the other.
TEST(FreeBeam, PulledAtOneEndIsStiffenedByWhatAcceleratesTheRest) {
  const int elements = 40;
  const Reduced body = beam(elements, mean_axes);
  const MatrixXd falling = chain(unit_beam, elements, 1.0).K_g([](double s) { return s; });
  const MatrixXd expected = -body.modes.shapes.transpose() * falling * body.modes.shapes;
  // h²/12 of the difference of the squares of the slopes at the ends, some eight times their mean.
  EXPECT_LT(size_of(body.at(1)[0] - expected), size_of(expected) / (elements * elements));
}

TEST(FreeBeam, KeepsItsMassCentre) {
  const Reduced body(timoshenko_bracket().model, mean_axes);
  const Foreshortening F = body.inertia();
  const RigidInertia rigid = rigid_inertia(body.model, body.M);
  const double reach = std::sqrt(rigid.J / rigid.m), size = size_of(F.j);
  for (const MatrixXd& S : F.S) EXPECT_LT(size_of(S), through_statics * size / reach);
  EXPECT_LT(size_of(F.h), through_statics * size);
  EXPECT_GT(size, 0);
}

// ---- any body ----

void for_any_body(const std::function<void(const SampleBody&, const Reduced&)>& claim) {
  for (const SampleBody& body :
       {timoshenko_bracket(), plate_on_edges(Coupling::rigid), plate_on_edges(Coupling::average), plate_on_nodes()})
    for (const ReferenceConditions& conditions : {tangent, chord, mean_axes})
      if (conditions.kind != ReferenceConditions::tangent || body.turns()) claim(body, {body.model, conditions});
}

TEST(Foreshortening, OfInertiaIsThatOfItsPointsOfMass) {
  const double m = 3;
  for_any_body([=](const SampleBody& body, const Reduced& reduced) {
    if (!body.rims.empty()) return;  // the middle of a hole has no mass
    const auto at = body.model.begin[static_cast<std::size_t>(body.port_nodes[1])];
    Sparse M(body.model.N(), body.model.N());
    M.insert(at, at) = M.insert(at + 1, at + 1) = m;
    const auto [x, y] = reduced.at(1);
    const Vector2d place = body.model.ports[1].x;
    const Foreshortening F = inertia_foreshortening(reduced.c, M, reduced.conditions, reduced.modes);
    const double size = through_statics * m * (size_of(x) + size_of(y));
    EXPECT_LT(size_of(F.S[0] - m * x), size);
    EXPECT_LT(size_of(F.S[1] - m * y), size);
    EXPECT_LT(size_of(F.j - m * (place.x() * x + place.y() * y)), size);
    EXPECT_LT(size_of(F.h - m * (place.x() * y - place.y() * x)), size);
  });
}

TEST(Foreshortening, IsLinearInTheLoadAndSymmetric) {
  std::mt19937 random(11);
  for_any_body([&](const SampleBody&, const Reduced& body) {
    MatrixXd loads(body.c.model.n(), 3);
    for (double& f : loads.reshaped()) f = static_cast<double>(random()) / 2147483648.0 - 1;
    loads.col(2) = 3 * loads.col(0) - 7 * loads.col(1);
    const std::vector<MatrixXd> F = foreshortening(body.c, body.conditions, body.modes, loads);
    EXPECT_LT(size_of(F[2] - (3 * F[0] - 7 * F[1])), through_statics * size_of(F[2]));
    for (const MatrixXd& f : F) EXPECT_EQ(f, f.transpose());
  });
}

/// What the nodes of a rigid rim move at second order when it turns by a and by b.
VectorXd rims_turned(const SampleBody& body, const VectorXd& a, const VectorXd& b) {
  VectorXd c = VectorXd::Zero(body.model.N());
  for (std::size_t k = 0; k < body.rims.size(); ++k) {
    const RimPort& rim = body.rims[k];
    if (rim.coupling != Coupling::rigid) continue;
    const int port = static_cast<int>(k);
    const double turns = port_motion(body, port, a)[2] * port_motion(body, port, b)[2];
    for (const int node : rim.nodes)
      c.segment<2>(body.model.begin[static_cast<std::size_t>(node)]) = -turns * (body.model.x.col(node) - rim.x);
  }
  return c;
}

// The displacement ψ by its definition: least energy, that is K ψ = −g with g·v = aᵀK_g(v)b for
// every v, the tie's rows as constraints. A load f must do the work fᵀψ on it.
TEST(Foreshortening, IsTheWorkOnTheDisplacementOfLeastEnergy) {
  for_any_body([](const SampleBody& body, const Reduced& reduced) {
    const int n = body.model.n();
    const Assembler assembler(body.model);
    const VectorXd a = reduced.modes.shapes.col(0), b = reduced.modes.shapes.col(1);
    VectorXd g = independent_load(body.model, assembler.stiffness() * rims_turned(body, a, b));
    for (int i = 0; i < n; ++i) {
      const VectorXd v = nodal(body.model, VectorXd::Unit(n, i));
      g[i] += a.dot(assembler.geometric_stiffness(v) * b);
    }
    const MatrixXd B = reference_condition_rows(reduced.c, reduced.conditions), K = reduced.c.K;
    const double scale = size_of(K) / size_of(B);
    MatrixXd A = MatrixXd::Zero(n + 3, n + 3);
    A << K, scale * B.transpose(), scale * B, MatrixXd::Zero(3, 3);
    VectorXd right = VectorXd::Zero(n + 3);
    right.head(n) = -g;
    const VectorXd psi = A.fullPivLu().solve(right).head(n);

    const MatrixXd loads = MatrixXd::Identity(n, n);
    const std::vector<MatrixXd> F = foreshortening(reduced.c, reduced.conditions, reduced.modes, loads);
    for (int i = 0; i < n; ++i) EXPECT_NEAR(F[static_cast<std::size_t>(i)](0, 1), psi[i], through_statics * size_of(psi));
  });
}

TEST(Foreshortening, OfABodyWithoutShapesIsEmpty) { EXPECT_EQ(beam(4, mean_axes, {.count = 0}).inertia().j.size(), 0); }

TEST(Foreshortening, SaysWhatItRefuses) {
  const Reduced body = beam(4, mean_axes);
  const auto rows = [&] { foreshortening(body.c, body.conditions, body.modes, MatrixXd::Zero(7, 1)); };
  EXPECT_TRUE(says(refusal(rows), "loads of 7 rows, must be 15"));
  const ReferenceConditions nowhere{ReferenceConditions::tangent, 9};
  const auto conditions = [&] { inertia_foreshortening(body.c, body.M, nowhere, body.modes); };
  EXPECT_TRUE(says(refusal(conditions), "name one of them"));

  Eigen::Matrix2Xd x(2, 4);
  x << 0, 1, 2, 3, 0, 0, 0, 0;
  const FeModel two = fe_model(x, {Block<BeamEuler>{{unit_beam}, {0, 1, 2, 3}, {0, 1}}});
  const auto apart = [&] {
    const ModalModel none{MatrixXd(two.N(), 0), {}, {}, {}, {}};
    foreshortening(component(two), mean_axes, none, MatrixXd::Zero(two.n(), 1));
  };
  EXPECT_TRUE(says(refusal<std::runtime_error>(apart), "not joined"));
}

}  // namespace
}  // namespace pintle::foreshortening_test
