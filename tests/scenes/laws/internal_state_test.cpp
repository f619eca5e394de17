// A spring and a damper in series, whose damper's length is an internal state, by every analysis: against exponentials.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "framework/integration/integrator.h"
#include "tests/contracts/scheme_cases.h"
#include "tests/scenes/mechanisms.h"

namespace pintle::internal_state_test {
namespace {

using pintle_scenes::body;
using pintle_scenes::joint;
using pintle_scenes::law;
using pintle_scenes::ref;
using pintle_scenes::spring;
using pintle_scenes::start_at;
using pintle_scenes::Whole;

constexpr double m = 2, k0 = 80, k = 300, c = 12, free_length = 1, x0 = 1.3;

SceneLoad maxwell(const std::string& a, const std::string& b, double stiffness = k, double damping = c) {
  return {"mount", SceneMaxwell{ref(a), ref(b), stiffness, damping}, {}};
}

// A cart on a rubber mount: a spring with a Maxwell element beside it.
Scene cart(double stiffness = k, double damping = c) {
  Scene s;
  s.gravity = {0, 0};
  s.bodies = {body("cart", m, 0.1, {})};
  s.joints = {joint("rail", JointKind::prismatic, "ground", "cart")};
  s.loads = {spring("soft", "ground", "cart", k0, 0, free_length), maxwell("ground", "cart", stiffness, damping)};
  s.start_bodies = {start_at("cart", x0, 0, 0, 0, 0, 0)};
  s.run.until = 2;
  s.run.tolerance = 1e-10;
  s.output.every = 0.1;
  return s;
}

// d/dt [x − free length, v, damper's length − x0]
Eigen::Matrix3d of_cart(double stiffness = k, double damping = c) {
  Eigen::Matrix3d A;
  A << 0, 1, 0, -(k0 + stiffness) / m, 0, stiffness / m, stiffness / damping, 0, -stiffness / damping;
  return A;
}
Eigen::Vector3d motion(double t, double stiffness = k, double damping = c) {
  const Eigen::EigenSolver<Eigen::Matrix3d> pairs(of_cart(stiffness, damping));
  const Eigen::Matrix3cd V = pairs.eigenvectors();
  const Eigen::Vector3cd parts =
      V.partialPivLu().solve(Eigen::Vector3d(x0 - free_length, 0, x0 - free_length).cast<std::complex<double>>());
  return (V * (pairs.eigenvalues() * t).array().exp().matrix().cwiseProduct(parts)).real() + Eigen::Vector3d(free_length, 0, free_length);
}

class Mount : public testing::TestWithParam<const char*> {};

TEST_P(Mount, MovesAsExponentialsSay) {
  Scene s = cart();
  s.run.method = GetParam();
  const bool implicit = s.run.method == "generalized-alpha";
  if (implicit) s.run.tolerance = 1e-8;
  const Whole w = pintle_scenes::run(s);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const double near = implicit ? 2e-5 : 1e-8;  // the tolerance to ⅔; a hundred times the tolerance
  const auto t = w.column("t [s]"), x = w.column("cart.x [m]"), d = w.column("mount.damper length [m]"),
             f = w.column("mount.fx on cart [N]");
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Eigen::Vector3d exact = motion(t[i]);
    EXPECT_NEAR(x[i], exact[0], near);
    EXPECT_NEAR(d[i], exact[2], near);
    EXPECT_NEAR(f[i], -k * (exact[0] - exact[2]), 2 * k * near);
  }
  const Eigen::Vector3d end = motion(2);
  const auto energy = [](const Eigen::Vector3d& y) {
    return (m * y[1] * y[1] + k0 * std::pow(y[0] - free_length, 2) + k * std::pow(y[0] - y[2], 2)) / 2;
  };
  EXPECT_NEAR(w.ledger("mount.lost to damper [J]"), energy(motion(0)) - energy(end), 100 * near);
}
INSTANTIATE_TEST_SUITE_P(Each, Mount, testing::Values("dopri5", "rkf45", "verner87", "generalized-alpha"),
                         [](const auto& p) { return std::string(p.param).substr(0, p.param[0] == 'g' ? 11 : std::string::npos); });

// So stiff a spring is none: a damper alone. Explicit pairs would need 1e7 steps a second.
TEST(Mount, OfAStiffSpringIsADamperInFewSteps) {
  constexpr double stiff = 1e8;
  Scene s = cart(stiff, c);
  s.run.tolerance = 1e-7;
  const Whole w = pintle_scenes::run(s);
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_EQ(name(w.model.scheme), "generalized-alpha");
  EXPECT_LT(w.run.counts.steps, 5000);
  s.loads = {spring("soft", "ground", "cart", k0, c, free_length)};
  s.run.method = "verner87", s.run.tolerance = 1e-10;
  const Whole damper = pintle_scenes::run(s);
  EXPECT_LT(pintle_scenes::relative_difference(w.column("cart.x [m]"), damper.column("cart.x [m]")), 1e-4);  // the tolerance to ⅔
}

TEST(Mount, CarriesNothingAtRest) {
  Scene s = cart();
  s.loads.push_back(pintle_scenes::force("push", "cart", law(4), law(0)));
  const Model model = build(s);
  const Equilibrium rest = find_equilibrium(s, model, assemble(s, model));
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.state.y[0], free_length + 4 / k0, 1e-12);
  EXPECT_NEAR(rest.state.y[model.system.x_begin()], rest.state.y[0], 1e-12);
  EXPECT_EQ(rest.stability.unstable, 0);
}

TEST(Mount, StartsWithoutForceWhereverItStarts) {
  const Scene s = cart();
  const Model model = build(s);
  const Assembly assembly = assemble(s, model);
  EXPECT_NEAR(assembly.start.y[model.system.x_begin()], x0, 1e-15);
}

TEST(Mount, LinearizesToTheRootsOfItsThirdOrder) {
  Scene s = cart();
  s.start_bodies = {start_at("cart", free_length, 0, 0, 0, 0, 0)};
  const Model model = build(s);
  const Linearization lin = linearize(s, model, assemble(s, model).start);
  const auto of = [](const Eigen::MatrixXd& A) {
    const Eigen::VectorXcd found = A.eigenvalues();
    std::vector<std::complex<double>> out(found.begin(), found.end());
    std::ranges::sort(out, {}, [](const auto& r) { return std::pair(r.real(), r.imag()); });
    return out;
  };
  const auto exact = of(of_cart()), found = of(lin.space.A);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(std::abs(found[i] - exact[i]), 1e-10 * std::abs(exact[2]));
  EXPECT_EQ(lin.space.states.back(), "mount.damper length [m]");
  ASSERT_EQ(lin.modes.size(), 2u);  // a pair and one that decays
  for (const LinearMode& mode : lin.modes) {
    double nearest = 1e300;
    for (const auto& r : exact) nearest = std::min(nearest, std::abs(mode.root - r));
    EXPECT_LT(nearest, 1e-9);
    EXPECT_LT(mode.uncertainty, 1e-9);
  }
  // The output "pull" is k (x − d).
  const auto row = std::ranges::find(lin.space.outputs, "mount.pull [N]") - lin.space.outputs.begin();
  ASSERT_LT(row, static_cast<std::ptrdiff_t>(lin.space.outputs.size()));
  EXPECT_LT((lin.space.C.row(row) - Eigen::RowVector3d(k, 0, -k)).norm(), 1e-9 * k);
}

// Driven in x = 1 + 0.1 sin ωt, the driver meets the mount's force, which a lag of its own delays.
TEST(Mount, OfADrivenCartNeedsTheThrustOfItsTransferFunction) {
  constexpr double w = 15, amplitude = 0.1, kappa = k / c;
  Scene s = cart();
  s.loads = {maxwell("ground", "cart")};
  s.start_bodies.clear();
  s.bodies[0].at = {1, 0};
  s.drivers = {{"jack", DriverKind::distance, ref("ground"), ref("cart"), pintle_scenes::wave(1, amplitude, w), {}}};
  const Model model = build(s);
  const Inverse out = inverse(s, model, assemble(s, model), {});
  const auto t = out.run.trajectory.column("t [s]"), f = out.run.trajectory.column("mount.fx on cart [N]");
  // ḟ = k ẋ − κ f, f(0) = 0: with ẋ = a ω cos ωt.
  const double scale = k * amplitude * w / (kappa * kappa + w * w);
  ASSERT_GT(t.size(), 10u);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double pull = scale * (kappa * std::cos(w * t[i]) + w * std::sin(w * t[i]) - kappa * std::exp(-kappa * t[i]));
    EXPECT_NEAR(f[i], -pull, 1e-6 * scale * kappa);
  }
}

TEST(Mount, GoesOnBitForBitFromAnyStep) {
  const scheme_cases::Case k_ = scheme_cases::series::make();
  for (const char* method : {"dopri5", "rkf45", "verner87", ""}) {
    const Scheme scheme{.tableau = find_tableau(method), .tolerance = 1e-7};
    Integrator run(k_.system, scheme, k_.start);
    std::vector<std::string> saved;
    for (int i = 0; i < 30; ++i) {
      saved.push_back(run.save());
      ASSERT_TRUE(run.advance(5)) << run.failure();
    }
    for (std::size_t i = 0; i < saved.size(); ++i) {
      Integrator next(k_.system, scheme, k_.start);
      next.load(saved[i]);
      EXPECT_EQ(next.save(), saved[i]);
      for (std::size_t j = i; j < saved.size(); ++j) ASSERT_TRUE(next.advance(5));
      EXPECT_EQ(next.state().y, run.state().y) << method << " " << i;
    }
  }
}

// Between the nodes of a step the damper's length follows the points: by itself it would be off by what the interpolation errs, which
// 1e10 N/m make a force of. There the spring is none, and the pull is the damper's, c times the rate of the distance.
TEST(Mount, OfAStiffSpringPullsLikeItsDamperInEveryRow) {
  for (const double stiffness : {1e9, 1e10, 1e11}) {
    Scene s;
    s.gravity = {0, -9.81};
    s.ground = {pintle_scenes::point("G", 0.3, 0.2)};
    s.bodies = {body("bob", 2, 0.03, {pintle_scenes::point("O", -0.25), pintle_scenes::point("P", 0.15, 0.05)})};
    s.joints = {joint("hinge", JointKind::revolute, "ground", "bob.O")};
    s.loads = {{"sp", SceneSpring{ref("ground.G"), ref("bob.P"), 60, 0, 0.3}, {}}, maxwell("ground.G", "bob.P", stiffness, 30)};
    s.start_bodies = {pintle_scenes::start_angle("bob", -0.17, 2)};
    s.run.until = 1, s.run.tolerance = 1e-6, s.run.method = "generalized-alpha";
    s.output.every = 1e-3, s.output.points = {ref("bob.P")};
    const Whole w = pintle_scenes::run(s);
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    const auto x = w.column("bob.P.x [m]"), y = w.column("bob.P.y [m]"), vx = w.column("bob.P.vx [m/s]"), vy = w.column("bob.P.vy [m/s]"),
               fx = w.column("mount.fx on bob [N]"), fy = w.column("mount.fy on bob [N]");
    for (std::size_t i = 1; i < x.size(); ++i) {  // at the start it does not pull yet
      const Eigen::Vector2d d(x[i] - 0.3, y[i] - 0.2), along = d.normalized();
      const double pull = 30 * along.dot(Eigen::Vector2d(vx[i], vy[i]));
      EXPECT_NEAR(-along.dot(Eigen::Vector2d(fx[i], fy[i])), pull, 0.05 + 1e-15 * stiffness) << stiffness << " at row " << i;
    }
  }
}

TEST(Mount, WithoutLengthIsSaidToAddNothing) {
  Scene s = cart();
  s.start_bodies = {start_at("cart", 0, 0, 0, 0, 0, 0)};
  s.loads.erase(s.loads.begin());
  const Model model = build(s);
  const Linearization lin = linearize(s, model, assemble(s, model).start);
  EXPECT_TRUE(std::ranges::any_of(lin.notes, [](const std::string& n) { return n.find("\"mount\" has no length") != std::string::npos; }));
}

// What it writes does not change its motion.
TEST(Mount, MovesTheSameWhateverIsWritten) {
  for (const char* method : {"dopri5", "verner87", "generalized-alpha"}) {
    Scene s = cart();
    s.run.method = method, s.run.tolerance = 1e-6;
    Whole few = (s.output.every = 2, pintle_scenes::run(s)), many = (s.output.every = 0.013, pintle_scenes::run(s));
    EXPECT_EQ(few.run.counts.steps, many.run.counts.steps) << method;
    EXPECT_EQ(few.run.integrals, many.run.integrals) << method;
  }
}

}  // namespace
}  // namespace pintle::internal_state_test
