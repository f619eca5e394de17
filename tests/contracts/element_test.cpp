// The exam every element sits. A new element joins by one line in `kinds`.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "framework/component/fe/fe_model.h"
#include "tests/contracts/element_samples.h"

namespace pintle::element_test {
namespace {

// A few hundred operations on numbers of one size, relative to the largest term. Elements lie up to
// three times their size from the origin, which costs a digit.
constexpr double rounding = 1e-12;
// Of eigenvalues, relative to the largest: rounding leaves 1e-15 of a zero one, while the softest
// sample, a beam 0.005 of its length high, keeps 2e-6.
constexpr double zero_eigenvalue = 1e-9;

struct Kind {
  const char* name;
  std::vector<Sample> (*samples)(Sides);
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
const Kind kinds[] = {
    {"Bar", samples<Bar>},
    {"BeamEuler", samples<BeamEuler>},
    {"BeamTimoshenko", samples<BeamTimoshenko>},
    {"Triangle3", samples<Triangle3>},
    {"Triangle6", samples<Triangle6>},
    {"Quadrilateral4", samples<Quadrilateral4>},
    {"Quadrilateral4Plain", samples<Quadrilateral4Plain>},
    {"Quadrilateral8", samples<Quadrilateral8>},
    {"Quadrilateral8Reduced", samples<Quadrilateral8Reduced>},
    {"Quadrilateral9", samples<Quadrilateral9>},
};
static_assert(std::size(kinds) == std::variant_size_v<AnyBlock>, "an element has not joined");

class ElementContract : public testing::TestWithParam<Kind> {
 protected:
  std::vector<Sample> straight() const { return GetParam().samples(Sides::straight); }
  std::vector<Sample> curved() const { return GetParam().samples(Sides::curved); }
  Draw draw_{11};
};
INSTANTIATE_TEST_SUITE_P(Each, ElementContract, testing::ValuesIn(kinds), [](const auto& p) { return std::string(p.param.name); });

// ---- nodal fields and what is compared ----

VectorXd nodal(const Traits& is, const Matrix2Xd& displacement, double rotation) {
  MatrixXd u = MatrixXd::Constant(is.dofs_per_node, is.nodes, rotation);
  u.topRows(2) = displacement;
  return u.reshaped();
}
MatrixXd translations(const Traits& is) {
  MatrixXd T(is.dofs(), 2);
  for (int k = 0; k < 2; ++k) T.col(k) = nodal(is, Vector2d::Unit(k).replicate(1, is.nodes), 0);
  return T;
}
VectorXd position(const Sample& s) { return nodal(s.is, s.here.x, 0); }
VectorXd rotation_field(const Sample& s) { return nodal(s.is, Z * s.here.x, 1); }
/// Forces [N, N m] or displacements [m, rad], either turned; rotations and moments as they are.
MatrixXd turned(const Traits& is, double angle) {
  MatrixXd Q = MatrixXd::Identity(is.dofs(), is.dofs());
  for (int i = 0; i < is.dofs(); i += is.dofs_per_node) Q.block(i, i, 2, 2) = turn_by(angle);
  return Q;
}
/// Lengths that rotations are divided by and moments too, so that entries have one unit.
VectorXd units(const Sample& s) { return nodal(s.is, Matrix2Xd::Ones(2, s.is.nodes), 1 / s.size); }
MatrixXd scaled(const Sample& s, const MatrixXd& A) { return units(s).asDiagonal() * A * units(s).asDiagonal(); }
double largest(const MatrixXd& A) { return A.cwiseAbs().maxCoeff(); }
/// Largest difference of two matrices of an element, relative to the largest entry of the first.
double apart(const Sample& s, const MatrixXd& A, const MatrixXd& B) { return largest(scaled(s, A - B)) / largest(scaled(s, A)); }
VectorXd random_dofs(Draw& draw, const Sample& s) { return s.size * units(s).cwiseProduct(draw.matrix(s.is.dofs(), 1)); }

// ---- stiffness ----

TEST_P(ElementContract, StiffnessIsSymmetric) {
  for (const Sample& s : curved()) EXPECT_LT(apart(s, s.here.stiffness, s.here.stiffness.transpose()), rounding);
}

// Three motions, and the modes that an element owns up to.
TEST_P(ElementContract, OnlyRigidMotionsCostNothingAndNothingGivesEnergy) {
  for (const Sample& s : curved()) {
    const MatrixXd K = scaled(s, s.here.stiffness);
    const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(K).eigenvalues();
    const double zero = zero_eigenvalue * values.maxCoeff();
    EXPECT_GT(values.minCoeff(), -zero);
    EXPECT_EQ((values.array() < zero).count(), 3 + s.is.spurious_modes);
  }
}

TEST_P(ElementContract, StiffnessDoesNotFeelARigidMotion) {
  for (const Sample& s : curved()) {
    MatrixXd rigid(s.is.dofs(), 3);
    rigid << s.size * translations(s.is), rotation_field(s);
    const MatrixXd force = units(s).asDiagonal() * s.here.stiffness * rigid;
    EXPECT_LT(largest(force), 10 * rounding * largest(scaled(s, s.here.stiffness)) * s.size);
  }
}

// ---- field and mass ----

/// The map of a cell with parallel sides, known without the element.
Vector2d place(const Sample& s, const Vector2d& xi) {
  const Matrix2Xd& x = s.here.x;
  if (s.is.line()) return (1 - xi.x()) * x.col(0) + xi.x() * x.col(1);
  const Vector2d a = x.col(1) - x.col(0), b = x.col(s.is.corners() - 1) - x.col(0);
  if (s.is.cell == Cell::triangle) return x.col(0) + a * xi.x() + b * xi.y();
  return x.col(0) + a * (1 + xi.x()) / 2 + b * (1 + xi.y()) / 2;
}

TEST_P(ElementContract, FieldHoldsTranslationPositionAndRotation) {
  for (const Sample& s : GetParam().samples(Sides::parallel)) {
    const Rule rule = fine_rule(s.is);
    for (int p = 0; p < rule.weight.size(); ++p) {
      const Vector2d xi = rule.xi.col(p), r = place(s, xi);
      const MatrixXd N = s.here.shape(xi);
      EXPECT_LT(largest(N * translations(s.is) - Matrix2d::Identity()), rounding);
      EXPECT_LT(largest(N * position(s) - r), rounding * s.size);
      EXPECT_LT(largest(N * rotation_field(s) - Z * r), rounding * s.size);
      if (!s.is.turns()) continue;
      EXPECT_NEAR(s.here.rotation(xi.x()).dot(rotation_field(s)), 1, rounding);
    }
  }
}

TEST_P(ElementContract, MassAndSkewMassAreTheIntegralsOfItsShapes) {
  for (const Sample& s : curved()) {
    MatrixXd M = MatrixXd::Zero(s.is.dofs(), s.is.dofs()), G = M;
    for (const Point& p : points_of(s, fine_rule(s.is))) {
      M += s.stuff.density * p.measure * p.N.transpose() * p.N;
      G += s.stuff.density * p.measure * p.N.transpose() * Z.transpose() * p.N;
      if (!s.is.turns()) continue;
      const RowVectorXd turn = s.here.rotation(p.xi.x());
      M += s.stuff.rotary_density * p.measure * turn.transpose() * turn;
    }
    EXPECT_LT(apart(s, M, s.here.mass), rounding);
    EXPECT_LT(apart(s, G, s.here.skew_mass), rounding);
  }
}

TEST_P(ElementContract, MassIsSymmetricAndPositiveAndSkewMassSkew) {
  for (const Sample& s : curved()) {
    EXPECT_LT(apart(s, s.here.mass, s.here.mass.transpose()), rounding);
    EXPECT_EQ(scaled(s, s.here.mass).llt().info(), Eigen::Success);
    EXPECT_LT(apart(s, s.here.skew_mass, -s.here.skew_mass.transpose()), rounding);
  }
}

struct Moments {
  double mass = 0;
  Vector2d first = Vector2d::Zero();
  double second = 0;  ///< ∫ ρ x·x, a beam's sections as points
};
/// Of a segment, or of a polygon as the triangles between its sides and the origin.
Moments moments(const Sample& s) {
  Moments all;
  const double more = s.is.line() ? 0 : 1;
  const int sides = s.is.line() ? 1 : s.is.corners();
  for (int i = 0; i < sides; ++i) {
    const Vector2d a = s.here.x.col(i), b = s.here.x.col((i + 1) % s.is.corners());
    const double area = (a.x() * b.y() - a.y() * b.x()) / 2 * s.stuff.thickness;
    const double m = s.stuff.density * (s.is.line() ? (b - a).norm() : area);
    all.mass += m;
    all.first += m * (a + b) / (2 + more);
    all.second += m * (a.dot(a) + a.dot(b) + b.dot(b)) / (3 + 3 * more);
  }
  return all;
}

TEST_P(ElementContract, MassAndSkewMassKnowTheMomentsOfTheBody) {
  for (const Sample& s : straight()) {
    const MatrixXd &M = s.here.mass, &G = s.here.skew_mass, T = translations(s.is);
    const VectorXd x = position(s), R = rotation_field(s);
    const Moments b = moments(s);
    const double sections = s.stuff.rotary_density * (s.here.x.col(1) - s.here.x.col(0)).norm();
    const double first = b.mass * s.size, second = first * s.size;  // 4 and 16 of them a term
    EXPECT_LT(largest(T.transpose() * M * T - b.mass * Matrix2d::Identity()), 4 * rounding * b.mass);
    EXPECT_LT(largest(T.transpose() * M * x - b.first), 4 * rounding * first);
    EXPECT_LT(largest(T.transpose() * M * R - Z * b.first), 4 * rounding * first);
    EXPECT_NEAR(x.dot(M * x), b.second, 16 * rounding * second);
    EXPECT_NEAR(R.dot(M * R), b.second + sections, 16 * rounding * second);
    EXPECT_NEAR(R.dot(M * x), 0, 16 * rounding * second);
    EXPECT_LT(largest(T.transpose() * G * T - b.mass * Z.transpose()), 4 * rounding * b.mass);
    EXPECT_NEAR(x.dot(G * R), b.second, 16 * rounding * second);
  }
}

TEST_P(ElementContract, LumpedMassIsNowhereNegativeAndKeepsTheMass) {
  for (const Sample& s : straight()) {
    const double mass = moments(s).mass;
    EXPECT_GE(s.here.lumped_mass.minCoeff(), 0);
    const MatrixXd T = translations(s.is);
    const Matrix2d total = T.transpose() * s.here.lumped_mass.asDiagonal() * T;
    EXPECT_LT(largest(total - mass * Matrix2d::Identity()), 4 * rounding * mass);
  }
}

// ---- stress ----

// A line is stretched along itself alone: sideways the same would turn it.
TEST_P(ElementContract, ConstantStrainGivesItsStress) {
  for (const Sample& s : curved()) {
    Matrix2d slope = draw_.matrix(2, 2);
    VectorXd right(s.is.stress_rows);
    double terms = s.stuff.EA;
    if (s.is.line()) {
      const Vector2d t = (s.here.x.col(1) - s.here.x.col(0)).normalized();
      slope = slope(0, 0) * t * t.transpose();
      right << s.stuff.EA * t.dot(slope * t), 0, 0;
    } else {
      const PlaneMaterial& m = s.stuff.material;
      const Eigen::Vector3d strain(slope(0, 0), slope(1, 1), slope(0, 1) + slope(1, 0));
      right << m.D * strain, m.Dz * strain;
      terms = largest(m.D);
    }
    MatrixXd told = s.here.stress(nodal(s.is, slope * s.here.x, 0));
    if (s.is.line()) told.row(2) /= s.size;
    EXPECT_LT(largest(told.colwise() - right), 10 * rounding * terms);
  }
}

/// N²/2EA + V²/2κGA + M²/2EI along a line, ½ σᵀD⁻¹σ over a plane.
double energy_of(const Sample& s, const MatrixXd& f) {
  if (s.is.line()) {
    double twice = f(0, 0) * f(0, 0) / s.stuff.EA;
    if (s.is.turns()) twice += (f(2, 0) * f(2, 0) + f(2, 0) * f(2, 1) + f(2, 1) * f(2, 1)) / (3 * s.stuff.EI);
    if (s.stuff.kGA > 0) twice += f(1, 0) * f(1, 0) / s.stuff.kGA;
    return twice / 2 * (s.here.x.col(1) - s.here.x.col(0)).norm();
  }
  const Eigen::Matrix3d compliance = s.stuff.material.D.inverse();
  const std::vector<Point> points = points_of(s, own_rule(s));
  double energy = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Eigen::Vector3d sigma = f.col(static_cast<Eigen::Index>(p)).head(3);
    energy += points[p].measure * sigma.dot(compliance * sigma) / 2;
  }
  return energy;
}

TEST_P(ElementContract, StrainEnergyIsThatOfTheStress) {
  for (const Sample& s : curved()) {
    const VectorXd u = random_dofs(draw_, s);
    const double terms = largest(scaled(s, s.here.stiffness)) * s.size * s.size;
    EXPECT_NEAR(u.dot(s.here.stiffness * u) / 2, energy_of(s, s.here.stress(u)), 10 * rounding * terms);
  }
}

// ---- geometric stiffness ----

/// Any stress, of the size that strains of 1 cause.
MatrixXd random_stress(Draw& draw, const Sample& s) {
  MatrixXd f = draw.matrix(s.is.stress_rows, s.is.points);
  if (!s.is.line()) return largest(s.stuff.material.D) * f;
  f.row(2) *= s.size;
  if (!s.is.turns()) f.bottomRows(2).setZero();
  return s.stuff.EA * f;
}

/// What a stress does on the quadratic part of strain at one point, as the headers say it: Biot's
/// strain in a plane, ½N w′² − V u′θ along a line, N and V linear between its ends.
double second_order_work(const Sample& s, const Point& at, const MatrixXd& f, Eigen::Index point, const VectorXd& u) {
  if (!s.is.line()) {
    Matrix2d slope, sigma;
    slope << at.slope[0] * u, at.slope[1] * u;
    sigma << f(0, point), f(2, point), f(2, point), f(1, point);
    const Matrix2d strain = (slope + slope.transpose()) / 2;
    return sigma.cwiseProduct(slope.transpose() * slope - strain * strain).sum() / 2;
  }
  const double xi = at.xi.x();
  const Vector2d t = (s.here.x.col(1) - s.here.x.col(0)).normalized(), slope = at.slope[0] * u;
  const double N = (1 - xi) * f(0, 0) + xi * f(0, 1), V = (1 - xi) * f(1, 0) + xi * f(1, 1);
  const double theta = s.is.turns() ? s.here.rotation(xi).dot(u) : 0;
  const double across = t.x() * slope.y() - t.y() * slope.x();
  return N * across * across / 2 - V * t.dot(slope) * theta;
}

// The work is quadratic in u, so W(u + v) − W(u) − W(v) is its second derivative without error.
TEST_P(ElementContract, GeometricStiffnessIsTheSecondDifferenceOfWork) {
  for (const Sample& s : curved()) {
    const MatrixXd f = random_stress(draw_, s);
    const auto points = points_of(s, s.is.line() ? fine_rule(s.is) : own_rule(s));
    const auto W = [&](const VectorXd& u) {
      double work = 0;
      for (std::size_t p = 0; p < points.size(); ++p)
        work += points[p].measure * second_order_work(s, points[p], f, static_cast<Eigen::Index>(p), u);
      return work;
    };
    const MatrixXd I = MatrixXd::Identity(s.is.dofs(), s.is.dofs());
    MatrixXd second = I;
    for (int i = 0; i < I.cols(); ++i)
      for (int j = 0; j < I.cols(); ++j) second(i, j) = W(I.col(i) + I.col(j)) - W(I.col(i)) - W(I.col(j));
    EXPECT_LT(apart(s, second, s.here.geometric_stiffness(f)), rounding);
  }
}

TEST_P(ElementContract, GeometricStiffnessIsSymmetricAndLinearInStress) {
  for (const Sample& s : curved()) {
    const MatrixXd f = random_stress(draw_, s), g = random_stress(draw_, s);
    const MatrixXd F = s.here.geometric_stiffness(f), H = s.here.geometric_stiffness(g);
    EXPECT_LT(apart(s, F, F.transpose()), rounding);
    EXPECT_LT(apart(s, 2 * F - 3 * H, s.here.geometric_stiffness(2 * f - 3 * g)), 10 * rounding);
  }
}

// A straight bar that is stretched comes no shorter, whatever stress it is under: its length is what its
// displacement says. So it is with every homogeneous strain without rotation.
TEST_P(ElementContract, StretchWithoutRotationHasNothingOfSecondOrder) {
  for (const Sample& s : curved()) {
    const MatrixXd f = random_stress(draw_, s), K_g = s.here.geometric_stiffness(f);
    Matrix2d strain;
    const Vector2d t = (s.here.x.col(1) - s.here.x.col(0)).normalized();
    strain << 0.7, 0.3, 0.3, -0.4;
    if (s.is.line()) strain = t * t.transpose();
    VectorXd u = VectorXd::Zero(s.is.dofs());
    for (int i = 0; i < s.is.nodes; ++i) u.segment<2>(i * s.is.dofs_per_node) = strain * (s.here.x.col(i) - s.here.x.col(0));
    EXPECT_LT(std::abs(u.dot(K_g * u)), 10 * rounding * largest(scaled(s, K_g)) * s.size * s.size);
  }
}

// Forces turn with a stressed element, moments do not change. It is what makes a string of a bar
// under tension, and of any body in balance one that rests wherever it is turned.
TEST_P(ElementContract, ARigidRotationTurnsTheForcesOfAStressedElement) {
  for (const Sample& s : curved()) {
    const VectorXd u = random_dofs(draw_, s);
    const MatrixXd K_g = s.here.geometric_stiffness(s.here.stress(u));
    VectorXd turning = turned(s.is, M_PI / 2) * s.here.stiffness * u;
    if (s.is.turns()) turning[2] = turning[5] = 0;
    const VectorXd error = units(s).cwiseProduct(K_g * rotation_field(s) - turning);
    EXPECT_LT(largest(error), 10 * rounding * largest(scaled(s, K_g)) * s.size);
  }
}

// ---- axes ----

MatrixXd turned_stress(const Sample& s, MatrixXd f) {
  if (s.is.line()) return f;
  const Matrix2d A = turn_by(s.angle);
  for (int p = 0; p < f.cols(); ++p) {
    Matrix2d sigma;
    sigma << f(0, p), f(2, p), f(2, p), f(1, p);
    sigma = A * sigma * A.transpose();
    f.col(p).head(3) << sigma(0, 0), sigma(1, 1), sigma(0, 1);
  }
  return f;
}

TEST_P(ElementContract, ItsAnswersTurnWithItAndDoNotSeeTheOrigin) {
  for (const Sample& s : curved()) {
    const Subject &a = s.here, &b = s.elsewhere;
    const MatrixXd Q = turned(s.is, s.angle);
    const auto same = [&](const MatrixXd& before, const MatrixXd& after) {
      EXPECT_LT(apart(s, Q * before * Q.transpose(), after), 4 * rounding);
    };
    same(a.stiffness, b.stiffness);
    same(a.mass, b.mass);
    same(a.skew_mass, b.skew_mass);
    same(a.lumped_mass.asDiagonal(), b.lumped_mass.asDiagonal());
    const MatrixXd f = random_stress(draw_, s);
    same(a.geometric_stiffness(f), b.geometric_stiffness(turned_stress(s, f)));

    const VectorXd u = random_dofs(draw_, s);
    MatrixXd before = turned_stress(s, a.stress(u)), after = b.stress(Q * u);
    if (s.is.line()) before.row(2) /= s.size, after.row(2) /= s.size;
    EXPECT_LT(largest(before - after), 40 * rounding * largest(before));
  }
}

}  // namespace
}  // namespace pintle::element_test
