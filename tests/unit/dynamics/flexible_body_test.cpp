// One free flexible body beside a rigid one: what the equations of motion hold of it, against its
// kinetic and potential energy and against the motion of its points alone.

#include "framework/dynamics/model/flexible.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include "framework/build/build.h"
#include "framework/dynamics/equations/energy.h"
#include "framework/scene/yaml/reader.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::flexible_body_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Tolerances, relative to the size of the terms.
// A few dozen operations on numbers of one size.
constexpr double rounding = 1e-12;
// Differences of fourth order over `step` s, m or rad: in two steps a body moves by up to a
// hundredth of its size, (1e-2)⁴/30 cut off; energies, of which forces of velocity change a
// hundredth, lose 1e-14/step.
constexpr double difference = 1e-8;
constexpr double step = 5e-5;
constexpr int draws = 20;

template <class F>
auto slope_of(F f) {
  const decltype(f(0.0)) near = f(step) - f(-step), far = f(2 * step) - f(-2 * step);
  return decltype(f(0.0))((8 * near - far) / (12 * step));
}

// ---- the bodies: of rubber, so that elastic forces do not bury those of inertia ----------------

struct Shape {
  const char* name;
  std::vector<const char*> points;
  const char* text;
};
const Shape shapes[] = {
    // Two legs with a lump in the corner.
    {"CorneredBeam",
     {"A", "C", "B"},
     "    beam: {through: [A, C, B], section: {rectangle: [20 mm, 10 mm]}, elements: 12,\n"
     "           young: 1 MPa, poisson: 0.4, density: 1100 kg/m^3}\n"
     "    points: {A: [0, 0], C: [0.3, 0.05], B: [0.4, 0.25]}\n"
     "    lumps: {C: {mass: 50 g, inertia: 1e-5 kg m^2}}\n"
     "    modes: {count: 5, frame: "},
    {"EyeBar",
     {"A", "B"},
     "    plate: {thickness: 10 mm, young: 1 MPa, poisson: 0.4, density: 1100 kg/m^3, size: 15 "
     "mm,\n"
     "            link: {eye bar: {length: 0.2, width: 0.03,\n"
     "                             eyes: [{bore: 0.03, outer: 0.06}, {bore: 0.02, outer: "
     "0.04}]}}}\n"
     "    points: {A: {hole: eye 1}, B: {hole: eye 2, coupling: average}}\n"
     "    modes: {craig-bampton: {count: 2}, frame: "},
};
struct Tie {
  const char *name, *text;
};
const Tie ties[] = {{"MeanAxes", "mean axes"}, {"Tangent", "{tangent: A}"}, {"Chord", "{chord: [A, B]}"}};

using Case = std::tuple<Shape, Tie, const char*>;
std::string case_name(const Case& c) {
  std::string stiffening = std::get<2>(c);
  stiffening[0] = static_cast<char>(stiffening[0] - 'a' + 'A');
  return std::string(std::get<0>(c).name) + std::get<1>(c).name + stiffening;
}

constexpr int part = 1;  // its index; body 0 is rigid

// Forces of nothing make markers of its points.
System make_system(const Case& c) {
  const auto& [shape, conditions, stiffening] = c;
  std::string text = "gravity: [1.5, -9.8]\nbodies:\n  rigid: {rigid: {mass: 2, inertia: 0.3}}\n  part:\n";
  text +=
      std::string(shape.text) + conditions.text + "}\n    stiffening: " + stiffening + "\n    damping: {ratios: [0.02, 0.1, 0]}\nforces:\n";
  for (const char* point : shape.points)
    text += "  at " + std::string(point) + ": {force: [0, 0], at: part." + point + ", follows: true}\n";
  System s = build(read_scene_text(text, "test.yaml")).system;
  s.forces.clear();
  s.force_names.clear();
  std::erase_if(s.markers, [](const Marker& m) { return m.body != part; });
  number(s);
  return s;
}

class FlexibleBody : public testing::TestWithParam<Case> {
 protected:
  const System& system = made_once();
  const Body& body = system.bodies[part];
  const int n = body.modes(), n_q = system.n();
  Equations eq{system};
  Draw draw{23};

  static const System& made_once() {
    static std::map<std::string, System> known;
    const auto [at, is_new] = known.try_emplace(case_name(GetParam()));
    if (is_new) at->second = make_system(GetParam());
    return at->second;
  }
  // Shapes are bent alike in energy, the lowest by a few centimetres at a few decimetres a second.
  VectorXd random_y() {
    VectorXd y = VectorXd::Zero(system.n_y());
    const VectorXd reach = std::sqrt(body.m) * body.flex->omega[0] * body.flex->omega.cwiseInverse();
    y.head<6>() << draw.pose(), draw.pose();
    y.segment(6, n) = draw.matrix(n, 1, 0.01).cwiseProduct(reach);
    y.segment<6>(n_q) << draw.rates(), draw.rates();
    y.segment(n_q + 6, n) = draw.matrix(n, 1, 0.2).cwiseProduct(reach);
    return y;
  }
  // Speeds and coordinates of the part: [x y θ] and η are not side by side in q.
  std::vector<int> own() const {
    std::vector<int> at{3, 4, 5};
    for (int i = 0; i < n; ++i) at.push_back(6 + i);
    return at;
  }
  // What a unit of each is worth in √J: m for a displacement, J for an angle, 1 for η.
  VectorXd root_mass() const {
    VectorXd w = VectorXd::Ones(3 + n);
    w.head<3>() << std::sqrt(body.m), std::sqrt(body.m), std::sqrt(body.J);
    return w;
  }
  VectorXd taken(const VectorXd& v) const {
    VectorXd out(3 + n);
    const std::vector<int> at = own();
    for (int i = 0; i < 3 + n; ++i) out[i] = v[at[static_cast<std::size_t>(i)]];
    return out;
  }
  MatrixXd mass_matrix(const VectorXd& y) {
    FlexibleInertia& e = eq.flexible[0];
    evaluate_inertia(system, y, std::cos(y[5]), std::sin(y[5]), e);
    return pintle::mass_matrix(e);
  }
  // ∂T/∂s of the part: T is quadratic in s, so a difference over any step is exact but for
  // rounding.
  VectorXd momentum(const VectorXd& y) const {
    const VectorXd w = root_mass();
    VectorXd p(3 + n);
    for (int i = 0; i < 3 + n; ++i) {
      VectorXd up = y, down = y;
      const double by = 1 / w[i];
      up[n_q + own()[static_cast<std::size_t>(i)]] += by;
      down[n_q + own()[static_cast<std::size_t>(i)]] -= by;
      p[i] = (kinetic_energy(system, up, part) - kinetic_energy(system, down, part)) / (2 * by);
    }
    return p;
  }
  // ∂F/∂q of the part for a function of y; an η of √m displaces by a metre or a few.
  template <class F>
  VectorXd gradient(const VectorXd& y, F energy) const {
    VectorXd g(3 + n);
    for (int i = 0; i < 3 + n; ++i) {
      const double unit = i < 3 ? 1 : std::sqrt(body.m);
      g[i] = slope_of([&](double by) {
               VectorXd moved = y;
               moved[own()[static_cast<std::size_t>(i)]] += by * unit;
               return energy(moved);
             }) /
             unit;
    }
    return g;
  }
  // The part's forces in `s`, whose gravity or elasticity a test has taken away.
  VectorXd forces(const System& s, const VectorXd& y) {
    mass_matrix(y);
    VectorXd f = VectorXd::Zero(n_q);
    add_forces(s, y, eq.flexible[0], f);
    return taken(f);
  }
  void expect_close(const VectorXd& ours, const VectorXd& other, double tolerance) const {
    const VectorXd w = root_mass();
    const VectorXd size = other.cwiseQuotient(w);
    EXPECT_LT((ours - other).cwiseQuotient(w).norm(), tolerance * size.norm())
        << "ours " << ours.transpose() << "\nother " << other.transpose();
  }
};

System without_gravity(System s) {
  s.gravity.setZero();
  return s;
}
System without_elasticity(System s) {
  s.bodies[part].flex->omega.setZero();
  return s;
}

TEST_P(FlexibleBody, MassMatrixIsTheHessianOfKineticEnergy) {
  const VectorXd w = root_mass();
  for (int k = 0; k < draws; ++k) {
    VectorXd y = random_y();
    const MatrixXd M = mass_matrix(y);
    y.tail(system.n_y() - n_q).setZero();
    const auto T = [&](int i, int j) {  // of unit speeds along i and j together
      VectorXd at = y;
      at[n_q + own()[static_cast<std::size_t>(i)]] += 1 / w[i];
      if (j >= 0) at[n_q + own()[static_cast<std::size_t>(j)]] += 1 / w[j];
      return kinetic_energy(system, at, part);
    };
    for (int i = 0; i < 3 + n; ++i)
      for (int j = 0; j < 3 + n; ++j) EXPECT_NEAR(M(i, j) / (w[i] * w[j]), T(i, j) - T(i, -1) - T(j, -1), 10 * rounding) << i << ", " << j;
  }
}

// d/dt(∂T/∂s) − ∂T/∂q = M a − (velocity terms), at a = 0.
TEST_P(FlexibleBody, VelocityTermsAreThoseOfTheLagrangian) {
  const System bare = without_gravity(without_elasticity(system));
  for (int k = 0; k < draws; ++k) {
    const VectorXd y = random_y();
    const auto after = [&](double t) {
      VectorXd later = y;
      later.head(n_q) += t * y.segment(n_q, n_q);
      return later;
    };
    const VectorXd rate = slope_of([&](double t) { return momentum(after(t)); });
    const VectorXd by_place = gradient(y, [&](const VectorXd& at) { return kinetic_energy(system, at, part); });
    expect_close(forces(bare, y), by_place - rate, difference);
  }
}

TEST_P(FlexibleBody, GravityIsTheSlopeOfTheWeightOfItsMassCentre) {
  for (int k = 0; k < draws; ++k) {
    const VectorXd y = random_y();
    const VectorXd slopes = gradient(y, [&](const VectorXd& at) { return body.m * system.gravity.dot(mass_centre(system, at, part)); });
    expect_close(forces(system, y) - forces(without_gravity(system), y), slopes, difference);
  }
}

TEST_P(FlexibleBody, ElasticForceIsTheSlopeOfStrainEnergyAndDampingTakesItsLoss) {
  System undamped = system;
  undamped.bodies[part].flex->zeta.setZero();
  for (int k = 0; k < draws; ++k) {
    const VectorXd y = random_y();
    const VectorXd slopes = gradient(y, [&](const VectorXd& at) { return -strain_energy(system, at, part); });
    expect_close(forces(undamped, y) - forces(without_elasticity(undamped), y), slopes, difference);
    const VectorXd damping = forces(system, y) - forces(undamped, y);
    const double loss = damping_loss(system, y, part);
    EXPECT_NEAR(-damping.dot(taken(y.segment(n_q, n_q))), loss, rounding * (loss + forces(undamped, y).norm() * std::sqrt(body.m)));
  }
}

TEST_P(FlexibleBody, InverseMassUndoesTheMassMatrix) {
  for (int k = 0; k < draws; ++k) {
    const VectorXd y = random_y();
    const MatrixXd M = mass_matrix(y);
    ASSERT_TRUE(invert(eq.flexible[0]));
    VectorXd v = VectorXd::Zero(n_q);
    v.segment<3>(3) = Vector3d(draw.rates()).cwiseProduct(root_mass().head<3>());
    v.segment(6, n) = draw.matrix(n, 1, 2);
    const VectorXd before = taken(v);
    solve(eq.flexible[0], v.data());
    // What the shapes leave of the frame's inertia may be a ten-thousandth of it.
    expect_close(M * taken(v), before, 10 * rounding);
    EXPECT_EQ(v.head<3>().norm(), 0) << "the rigid body is none of its business";
  }
}

// ---- its points ---------------------------------------------------------------------------------

// Along q(t) = q₀ + s t + ½ a t².
TEST_P(FlexibleBody, MarkersMoveAsTheirPlaceChanges) {
  eq.directed.assign(system.markers.size(), true);
  for (int k = 0; k < draws; ++k) {
    const VectorXd y = random_y();
    const VectorXd a = random_y().segment(n_q, n_q) * 3;
    for (std::size_t m = 0; m < system.markers.size(); ++m) {
      const auto after = [&](double t) -> const MarkerMotion& {
        VectorXd later = y;
        later.head(n_q) += t * y.segment(n_q, n_q) + 0.5 * t * t * a;
        later.segment(n_q, n_q) += t * a;
        pose(system, t, later, eq);
        speed(system, t, later, eq);
        return eq.motion[m];
      };
      const auto place = [&](double t) {
        const MarkerMotion& p = after(t);
        return Vector3d(p.r.x(), p.r.y(), p.angle);
      };
      const auto rate = [&](double t) {
        const MarkerMotion& p = after(t);
        return Vector3d(p.v.x(), p.v.y(), p.w);
      };
      const Vector3d moved = slope_of(place), quickened = slope_of(rate), p_rate = rate(0);
      const MarkerMotion& now = eq.motion[m];
      Vector3d by_a(now.a0.x(), now.a0.y(), now.alpha0), by_s = Vector3d::Zero();
      visit_motion(system, eq, static_cast<int>(m), [&](int column, const Vector3d& J) {
        by_a += J * a[column];
        by_s += J * y[n_q + column];
      });
      EXPECT_LT((p_rate - moved).norm(), difference * (1 + moved.norm()));
      EXPECT_LT((by_s - p_rate).norm(), 10 * rounding * (1 + moved.norm()));
      EXPECT_LT((by_a - quickened).norm(), difference * (1 + quickened.norm()));
      EXPECT_LT((now.u - Vector2d(std::cos(now.angle), std::sin(now.angle))).norm(), rounding);

      const MovingPoint point = moving_point(system, static_cast<int>(m), y);
      EXPECT_LT((point.r - now.r).norm() + (point.v - now.v).norm(), 100 * rounding);
      EXPECT_NEAR(point.w, now.w, 100 * rounding);
    }
  }
}

TEST_P(FlexibleBody, MarkerJacobianIsDifferencesOverEachCoordinate) {
  for (int k = 0; k < draws; ++k) {
    const VectorXd y = random_y();
    for (int m = 0; m < static_cast<int>(system.markers.size()); ++m) {
      const auto place = [&](const VectorXd& at) {
        pose(system, 0, at, eq);
        const MarkerMotion& p = eq.motion[static_cast<std::size_t>(m)];
        return Vector3d(p.r.x(), p.r.y(), p.angle);
      };
      MatrixXd differences(3, n_q), J = MatrixXd::Zero(3, n_q);
      for (int i = 0; i < n_q; ++i)
        differences.col(i) = slope_of([&](double by) {
          VectorXd moved = y;
          moved[i] += by;
          return place(moved);
        });
      pose(system, 0, y, eq);
      visit_motion(system, eq, m, [&](int column, const Vector3d& c) { J.col(column) = c; });
      EXPECT_LT((J - differences).norm(), difference * J.norm()) << "marker " << m;
    }
  }
}

// ---- the books ----------------------------------------------------------------------------------

TEST_P(FlexibleBody, StoredEnergyFallsByWhatDampingTakes) {
  VectorXd dy(system.n_y());
  for (int k = 0; k < draws; ++k) {
    State s{0, random_y(), {}};
    ASSERT_TRUE(evaluate(system, s, eq, dy));
    const VectorXd a = eq.a;
    const double lost = dy[2 * n_q];
    ASSERT_EQ(system.n_z(), 1);
    EXPECT_DOUBLE_EQ(lost, damping_loss(system, s.y, part));
    EXPECT_GT(lost, 0);
    const auto stored = [&](double t) {
      State later = s;
      later.y.head(n_q) += t * s.y.segment(n_q, n_q) + 0.5 * t * t * a;
      later.y.segment(n_q, n_q) += t * a;
      return energies(system, later, eq).stored();
    };
    const double power = eq.f.cwiseAbs().dot(s.y.segment(n_q, n_q).cwiseAbs());
    EXPECT_NEAR(slope_of(stored), -lost, difference * power);
  }
}

INSTANTIATE_TEST_SUITE_P(Every, FlexibleBody,
                         testing::Combine(testing::ValuesIn(shapes), testing::ValuesIn(ties), testing::Values("none", "rotation", "axial")),
                         [](const auto& p) { return case_name(p.param); });

}  // namespace
}  // namespace pintle::flexible_body_test
