// The exam every frame tie sits, with every way of reduction, on bodies of beams and of plane
// elements. A new tie, way or body joins by one line below.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "tests/contracts/reduction_bodies.h"

namespace pintle::frame_tie_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Tolerances.
// Of ΦᵀMΦ and ΦᵀKΦ, relative to the largest: what the theory note promises. Rounding of sums over
// some hundred dofs is 1e-13; the eigensolver's residual enters squared.
constexpr double orthogonality = 1e-10;
// Displacement at a tied port over the largest of its shape.
constexpr double on_tie = 1e-12;
// Energies go through K⁻¹: rounding times its condition, 1e6 to 1e8 on these bodies.
constexpr double through_inverse = 1e-8;
// Smallest over largest singular value of unit vectors [T R Φ]: dependent ones give 1e-16, shapes
// near to rigid motions (a tied body's lowest modes) no less than 1e-3.
constexpr double independence = 1e-4;

struct NamedBody {
  const char* name;
  SampleBody (*make)();
};
const NamedBody bodies[] = {
    {"EulerBeam", [] { return euler_beam(); }},
    {"TimoshenkoBracket", timoshenko_bracket},
    {"PlateOnRigidEdges", [] { return plate_on_edges(Coupling::rigid); }},
    {"PlateOnAveragedEdges", [] { return plate_on_edges(Coupling::average); }},
    {"PlateOnNodes", plate_on_nodes},
};

struct NamedTie {
  const char* name;
  ReferenceConditions conditions;
};
const NamedTie ties[] = {
    {"Tangent", {ReferenceConditions::tangent, 0, -1}},
    {"TangentAtB", {ReferenceConditions::tangent, 1, -1}},
    {"Chord", {ReferenceConditions::chord, 0, 1}},
    {"MeanAxes", {ReferenceConditions::mean_axes}},
};

enum class Promise { true_modes, static_at_ports };
struct Way {
  const char* name;
  ModalModel (*reduce)(const Component&, const ReferenceConditions&);
  Promise promise;
};
const std::vector<int> both{0, 1};
const Way ways[] = {
    {"NormalModes", [](const Component& c, const ReferenceConditions& t) { return normal_modes(c, t, {.count = 7}); }, Promise::true_modes},
    {"AllModes", [](const Component& c, const ReferenceConditions& t) { return normal_modes(c, t, {.all = true}); }, Promise::true_modes},
    {"CraigBampton", [](const Component& c, const ReferenceConditions& t) { return craig_bampton(c, both, t, {.count = 5}); },
     Promise::static_at_ports},
    {"StaticShapesAlone", [](const Component& c, const ReferenceConditions& t) { return craig_bampton(c, both, t, {.count = 0}); },
     Promise::static_at_ports},
    {"FreeModes", [](const Component& c, const ReferenceConditions& t) { return free_modes(c, both, t, {.count = 5}); },
     Promise::static_at_ports},
    {"AttachmentShapesAlone", [](const Component& c, const ReferenceConditions& t) { return free_modes(c, both, t, {.count = 0}); },
     Promise::static_at_ports},
};

struct Case {
  NamedBody body;
  NamedTie conditions;
  Way way;
  bool possible() const { return conditions.conditions.kind != ReferenceConditions::tangent || body.make().turns(); }
};
void PrintTo(const Case& at, std::ostream* out) { *out << at.body.name << at.conditions.name << at.way.name; }
std::string case_name(const testing::TestParamInfo<Case>& info) { return testing::PrintToString(info.param); }
/// Of ways that promise this; tangent ties only where ports can turn (else they are refused: tested
/// below).
std::vector<Case> cases(std::vector<Promise> promises) {
  std::vector<Case> all;
  for (const NamedBody& body : bodies)
    for (const NamedTie& conditions : ties)
      for (const Way& way : ways)
        if (Case at{body, conditions, way}; std::ranges::count(promises, way.promise) && at.possible()) all.push_back(at);
  return all;
}

class FrameTieExam : public testing::TestWithParam<Case> {
 protected:
  const SampleBody body = GetParam().body.make();
  const ReferenceConditions conditions = GetParam().conditions.conditions;
  const Way way = GetParam().way;
  const Component c = component(body.model);

  ModalModel reduced() const { return way.reduce(c, conditions); }
};
class TrueModes : public FrameTieExam {};
class StaticAtPorts : public FrameTieExam {};

INSTANTIATE_TEST_SUITE_P(Every, FrameTieExam, testing::ValuesIn(cases({Promise::true_modes, Promise::static_at_ports})), case_name);
INSTANTIATE_TEST_SUITE_P(Every, TrueModes, testing::ValuesIn(cases({Promise::true_modes})), case_name);
INSTANTIATE_TEST_SUITE_P(Every, StaticAtPorts, testing::ValuesIn(cases({Promise::static_at_ports})), case_name);

TEST_P(FrameTieExam, ShapesAreMassNormalisedAndDiagonaliseTheStiffness) {
  const ModalModel m = reduced();
  const NodalMatrices a = nodal_matrices(body.model);
  const Eigen::Index k = m.omega.size();
  ASSERT_EQ(m.shapes.cols(), k);
  ASSERT_EQ(m.shapes.rows(), body.model.N());
  EXPECT_LT((m.shapes.transpose() * a.M * m.shapes - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff(), orthogonality);
  const MatrixXd squares = m.omega.cwiseAbs2().asDiagonal();
  const MatrixXd off = m.shapes.transpose() * a.K * m.shapes - squares;
  EXPECT_LT(off.cwiseAbs().maxCoeff(), orthogonality * squares.maxCoeff());
}

TEST_P(FrameTieExam, FrequenciesArePositiveAndAscend) {
  const ModalModel m = reduced();
  ASSERT_GT(m.omega.size(), 0);
  EXPECT_GT(m.omega[0], 0);
  EXPECT_TRUE(std::is_sorted(m.omega.begin(), m.omega.end()));
}

TEST_P(FrameTieExam, EveryShapeMeetsTheTie) {
  const ModalModel m = reduced();
  const NodalMatrices a = nodal_matrices(body.model);
  const MatrixXd rigid = rigid_nodal(body.model);
  for (Eigen::Index k = 0; k < m.omega.size(); ++k) {
    const VectorXd phi = m.shapes.col(k);
    VectorXd violation;
    if (conditions.kind == ReferenceConditions::tangent) {
      violation = port_motion(body, conditions.a, phi);
    } else if (conditions.kind == ReferenceConditions::chord) {
      const Eigen::Vector2d along = body.model.ports[1].x - body.model.ports[0].x;
      const Eigen::Vector2d across = Eigen::Vector2d(-along.y(), along.x()).normalized();
      violation.resize(3);
      violation << port_motion(body, 0, phi).head<2>(), across.dot(port_motion(body, 1, phi).head<2>());
    } else {
      // Momentum over what the moving masses carry at most.
      violation = (rigid.transpose() * a.M * phi).cwiseQuotient((rigid.transpose() * a.M * rigid).diagonal().cwiseSqrt());
      EXPECT_LT(violation.cwiseAbs().maxCoeff(), on_tie) << "shape " << k;
      continue;
    }
    EXPECT_LT(violation.cwiseAbs().maxCoeff(), on_tie * phi.cwiseAbs().maxCoeff()) << "shape " << k;
  }
}

TEST_P(FrameTieExam, TieRowsVanishOnEveryShapeAndOnNoRigidMotion) {
  const MatrixXd B = reference_condition_rows(c, conditions);
  ASSERT_EQ(B.rows(), 3);
  ASSERT_EQ(B.cols(), body.model.n());
  const MatrixXd rigid = rigid_motions(body.model);
  Eigen::Matrix3d on_rigid = B * rigid;
  on_rigid = (on_rigid.rowwise().norm().cwiseInverse().asDiagonal() * on_rigid).eval();
  EXPECT_GT(on_rigid.jacobiSvd().singularValues()[2], 1e-3);
  const ModalModel m = reduced();
  // Independent dofs out of nodal ones, by least squares.
  const MatrixXd L = nodal(body.model, MatrixXd::Identity(body.model.n(), body.model.n()));
  const MatrixXd phi = L.colPivHouseholderQr().solve(m.shapes);
  for (int r = 0; r < 3; ++r)
    for (Eigen::Index k = 0; k < phi.cols(); ++k) EXPECT_LT(std::abs(B.row(r) * phi.col(k)), on_tie * B.row(r).norm() * phi.col(k).norm());
}

TEST_P(FrameTieExam, RigidMotionsAndShapesAreIndependent) {
  const ModalModel m = reduced();
  MatrixXd all(body.model.N(), 3 + m.omega.size());
  all << rigid_nodal(body.model), m.shapes;
  const MatrixXd M = nodal_matrices(body.model).M;
  // Lengths in the metric of mass, where rotations and displacements compare.
  const MatrixXd metric = M.llt().matrixU();
  MatrixXd unit = metric * all;
  unit.col(2) -= unit.leftCols(2) * unit.leftCols(2).colPivHouseholderQr().solve(unit.col(2));
  unit.colwise().normalize();
  const VectorXd s = unit.jacobiSvd().singularValues();
  EXPECT_GT(s[s.size() - 1], independence * s[0]);
}

TEST_P(FrameTieExam, TheSameComesOutTwice) {
  const ModalModel m = reduced(), again = reduced();
  EXPECT_EQ(m.shapes, again.shapes);
  EXPECT_EQ(m.omega, again.omega);
}

TEST_P(FrameTieExam, SignsFollowTheFirstLargeComponent) {
  const ModalModel m = reduced();
  for (Eigen::Index k = 0; k < m.omega.size(); ++k) {
    const VectorXd phi = m.shapes.col(k);
    const double half = phi.cwiseAbs().maxCoeff() / 2;
    const auto first = std::find_if(phi.begin(), phi.end(), [&](double v) { return std::abs(v) >= half; });
    EXPECT_GT(*first, 0) << "shape " << k;
  }
}

TEST_P(TrueModes, LeaveNoResidualButTheReactionsOfTheTie) {
  const ModalModel m = reduced();
  // Rounding of Kφ over what is left of it in a smooth shape.
  EXPECT_LT(m.residual.maxCoeff(), 1e-6);
}

/// Flexibility at the ports under loads in equilibrium: A = FᵀK⁻F over independent dofs, with K
/// made regular by a stiffness against rigid motions, which such loads do not feel.
struct PortLoads {
  MatrixXd load;      // n × (b − 3), in equilibrium, on port dofs only
  MatrixXd response;  // their displacements
};
PortLoads balanced_loads(const Component& c) {
  std::vector<int> dofs;
  for (const Port& p : c.model.ports)
    for (const int f : p.dof)
      if (f >= 0) dofs.push_back(f);
  MatrixXd rigid = rigid_motions(c.model);
  const MatrixXd at_ports = rigid(dofs, Eigen::all);
  const auto b = static_cast<Eigen::Index>(dofs.size());
  const MatrixXd balanced = at_ports.jacobiSvd(Eigen::ComputeFullU).matrixU().rightCols(b - 3);
  PortLoads loads{MatrixXd::Zero(c.model.n(), b - 3), {}};
  loads.load(dofs, Eigen::all) = balanced;
  rigid = rigid.householderQr().householderQ() * MatrixXd::Identity(rigid.rows(), 3);
  const MatrixXd K = c.K;
  const MatrixXd regular = K + K.diagonal().mean() * rigid * rigid.transpose();
  loads.response = regular.ldlt().solve(loads.load);
  return loads;
}

TEST_P(StaticAtPorts, ResponseToLoadsInEquilibriumIsThatOfTheWholeBody) {
  const ModalModel m = reduced();
  const PortLoads loads = balanced_loads(c);
  const MatrixXd L = nodal(body.model, MatrixXd::Identity(body.model.n(), body.model.n()));
  const MatrixXd phi = L.colPivHouseholderQr().solve(m.shapes);
  const MatrixXd modal = phi.transpose() * loads.load;
  const MatrixXd reduced_flexibility = modal.transpose() * m.omega.cwiseAbs2().cwiseInverse().asDiagonal() * modal;
  const MatrixXd full = loads.load.transpose() * loads.response;
  EXPECT_LT((reduced_flexibility - full).norm(), through_inverse * full.norm());
}

// ---- across ties --------------------------------------------------------------------------------

// Normal modes under different ties are those of differently held bodies: only complete sets agree.
class Gauge : public testing::TestWithParam<std::tuple<NamedBody, Way>> {};
std::string gauge_name(const testing::TestParamInfo<Gauge::ParamType>& info) {
  return std::string(std::get<0>(info.param).name) + std::get<1>(info.param).name;
}
INSTANTIATE_TEST_SUITE_P(Every, Gauge, testing::Combine(testing::ValuesIn(bodies), testing::ValuesIn(ways + 1, ways + std::size(ways))),
                         gauge_name);

TEST_P(Gauge, EveryTieSpansTheSameMotionsUpToRigidOnes) {
  const Way way = std::get<1>(GetParam());
  const SampleBody body = std::get<0>(GetParam()).make();
  const Component c = component(body.model);
  const MatrixXd metric = nodal_matrices(body.model).M.llt().matrixU();
  const auto span = [&](const ReferenceConditions& conditions) {
    const ModalModel m = way.reduce(c, conditions);
    MatrixXd all(body.model.N(), 3 + m.omega.size());
    all << rigid_nodal(body.model), m.shapes;
    return MatrixXd(metric * all);
  };
  const MatrixXd reference = span({ReferenceConditions::mean_axes});
  const Eigen::HouseholderQR<MatrixXd> qr(reference);
  const MatrixXd Q = qr.householderQ() * MatrixXd::Identity(reference.rows(), reference.cols());
  for (const auto& [name, conditions] : ties) {
    if (conditions.kind == ReferenceConditions::tangent && !body.turns()) continue;
    const MatrixXd other = span(conditions);
    ASSERT_EQ(other.cols(), reference.cols()) << name;
    const MatrixXd outside = other - Q * (Q.transpose() * other);
    EXPECT_LT((outside.colwise().norm().cwiseQuotient(other.colwise().norm())).maxCoeff(), 1e-7) << name;
  }
}

TEST(TangentTie, IsRefusedWhereThePortCannotTurn) {
  const SampleBody body = plate_on_nodes();
  const Component c = component(body.model);
  try {
    reference_condition_rows(c, {ReferenceConditions::tangent, 0, -1});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("\"A\" cannot turn"), std::string::npos) << e.what();
  }
}

// ---- classical spectra --------------------------------------------------------------------------
// Roots βL of Euler–Bernoulli beams; ω = (βL)² √(EI/ρA)/L².

struct Spectrum {
  ReferenceConditions conditions;
  double root[3];
};
const Spectrum spectra[] = {
    {{ReferenceConditions::tangent, 0, -1}, {1.8751040687, 4.6940911330, 7.8547574382}},
    {{ReferenceConditions::chord, 0, 1}, {M_PI, 2 * M_PI, 3 * M_PI}},
    {{ReferenceConditions::mean_axes}, {4.7300407449, 7.8532046241, 10.9956078380}},
};

TEST(ClassicalSpectrum, OfABeamComesOutUnderEachTie) {
  const int elements = 20;
  const SampleBody body = euler_beam(elements);
  const Component c = component(body.model);
  const BeamEuler strip = euler_strip();
  const double length = 0.5;
  for (const Spectrum& s : spectra) {
    const ModalModel m = normal_modes(c, s.conditions, {.count = 3});
    for (int k = 0; k < 3; ++k) {
      const double exact = std::pow(s.root[k] / length, 2) * std::sqrt(strip.EI / strip.rhoA);
      // A cubic beam's frequency is too high by (βh)⁴/1440 to first order.
      const double bound = std::pow(s.root[k] / elements, 4) / 1440;
      EXPECT_NEAR(m.omega[k] / exact - 1, bound, 0.1 * bound + 1e-9) << s.conditions.kind << " mode " << k;
    }
  }
}

// L/h = 100: shear and rotary inertia lower ω by ½(βr/L)²(1 + E/κG) of itself where ends are
// pinned, by a few times that at most where they are free or clamped.
TEST(ClassicalSpectrum, OfASlenderMeshedBarComesOutUnderEachTie) {
  const double length = 1, height = 0.01, poisson = 0;
  const Plate p = plate(40, 1, CellShape::quadrilateral8, rectangle(length, height));
  FeModel model = model_of(p, steel(PlaneState::stress, poisson));
  add_ports(model, {}, {edge_port(p, "A", "left", Coupling::rigid), edge_port(p, "B", "right", Coupling::rigid)});
  const Component c = component(model);
  const double wave = std::sqrt(2e11 / 7800 / 12) * height;
  for (const Spectrum& s : spectra) {
    const ModalModel m = normal_modes(c, s.conditions, {.count = 3});
    for (int k = 0; k < 3; ++k) {
      const double exact = std::pow(s.root[k] / length, 2) * wave;
      const double shear = std::pow(s.root[k] * height / length, 2) / 24 * 3.4;
      EXPECT_LT(std::abs(m.omega[k] / exact - 1), 3 * shear + 2e-5) << s.conditions.kind << " mode " << k;
      EXPECT_LT(m.omega[k], exact * (1 + 2e-5)) << s.conditions.kind << " mode " << k;
    }
  }
}

// Six static and eight normal shapes of twenty beams: what restricting them to a tie costs.
TEST(ClassicalSpectrum, OfABeamComesOutOfCraigBamptonAtEachTie) {
  const SampleBody body = euler_beam(20);
  const Component c = component(body.model);
  const BeamEuler strip = euler_strip();
  const double quoted[] = {4e-7, 5e-7, 3e-5};  // DESIGN.md §12, to one digit
  for (int i = 0; i < 3; ++i) {
    const ModalModel m = craig_bampton(c, both, spectra[i].conditions, {.count = 8});
    ASSERT_EQ(m.omega.size(), 11);
    const double exact = std::pow(spectra[i].root[0] / 0.5, 2) * std::sqrt(strip.EI / strip.rhoA);
    EXPECT_LT(std::abs(m.omega[0] / exact - 1), 1.15 * quoted[i]) << spectra[i].conditions.kind;
    EXPECT_GT(m.omega[0], exact) << "a Rayleigh–Ritz value lies above the true one";
  }
}

}  // namespace
}  // namespace pintle::frame_tie_test
