// The three models of a clearance joint: the massless link and the spring and damper against models written by hand, and what
// changing one word does to a scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "framework/analysis/kinematics/kinematics.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/analysis/simulate/saved_state.h"
#include "framework/build/build.h"
#include "framework/configuration/equilibrium.h"
#include "framework/scene/error.h"
#include "tests/oracles/slider_crank_link.h"
#include "tests/scenes/mechanisms.h"

namespace pintle_scenes::clearance_models_test {
namespace {

namespace po = pintle_oracle;
using pintle::ClearanceModel;
using pintle::Scene;
using pintle::Status;

Scene with_model(ClearanceModel model, const SliderCrank& o) {
  Scene s = scene(o);
  s.joints[2].clearance->model = model;
  return s;
}

double first(const Whole& w, const std::string& name) { return w.column(name).front(); }

// --- massless link ---

struct LinkCase {
  double clearance, angle;
  const char* method;
  double accuracy;  // of the largest value: tolerance 1e-11 over some hundred swings of the link; ⅔ of it for the implicit scheme
};
void PrintTo(const LinkCase& c, std::ostream* out) { *out << c.method << ", " << 1e3 * c.clearance << " mm, " << c.angle; }

struct MasslessLink : testing::TestWithParam<LinkCase> {};

TEST_P(MasslessLink, MovesAndPullsAsInMinimalCoordinates) {
  const LinkCase& k = GetParam();
  SliderCrank o{.clearance = k.clearance, .angle = k.angle, .until = 4e-3, .tolerance = 1e-11, .method = k.method};
  const po::Params p = oracle(o);
  // Laid as the ideal joint presses: against the force on the coupler.
  const po::Ideal ideal = po::evaluate_ideal(p, k.angle, o.speed);
  const double psi = std::atan2(-ideal.pin_force[1], -ideal.pin_force[0]);
  const std::array<double, 4> initial{k.angle, psi, o.speed, 0}, y = po::link_after(p, initial, o.until);
  const po::LinkMotion m = po::link_motion(p, y), at_start = po::link_motion(p, initial);

  const Whole w = run(with_model(ClearanceModel::massless_link, o));
  ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
  const double far = k.accuracy;
  EXPECT_NEAR(w.last("crank.angle [rad]"), m.theta, far);
  EXPECT_NEAR(w.last("coupler.angle [rad]"), m.phi, far);
  EXPECT_NEAR(w.last("slider.x [m]"), m.x, far * 0.17);
  EXPECT_NEAR(w.last("crank.speed [rad/s]"), y[2], far * o.speed * 10);
  EXPECT_NEAR(w.last("slider.vx [m/s]"), m.x_rate, far * 7.5 * 10);
  EXPECT_NEAR(w.last("gudgeon pin.ex [m]"), k.clearance * std::cos(y[1]), 100 * far * k.clearance);
  EXPECT_NEAR(w.last("gudgeon pin.ey [m]"), k.clearance * std::sin(y[1]), 100 * far * k.clearance);
  EXPECT_NEAR(w.last("gudgeon pin.normal [N]"), m.tension, 1000 * far * 300);
  EXPECT_NEAR(first(w, "gudgeon pin.normal [N]"), at_start.tension, 1e-8 * 300);
  EXPECT_NEAR(first(w, "gudgeon pin.fx on slider [N]"), at_start.tension * std::cos(psi), 1e-8 * 300);
}
INSTANTIATE_TEST_SUITE_P(Cases, MasslessLink,
                         testing::Values(LinkCase{5e-4, 0, "dopri5", 1e-8}, LinkCase{5e-4, 0.7, "verner87", 1e-8},
                                         LinkCase{1e-5, 0.7, "dopri5", 1e-8}, LinkCase{1e-5, 2.2, "verner87", 1e-8},
                                         LinkCase{5e-4, 0.7, "generalized-alpha", 2e-6}));

TEST(MasslessLinkModel, IsADistanceJointOfTheClearance) {
  const SliderCrank o{.clearance = 1e-4, .angle = 0.4, .until = 0.01, .tolerance = 1e-10};
  const Scene linked = with_model(ClearanceModel::massless_link, o);
  const Whole link = run(linked);
  Scene s = scene(o);
  s.joints[2].clearance.reset();
  s.joints[2].kind = pintle::JointKind::distance;
  s.joints[2].length = o.clearance;
  s.start_journals.clear();
  const pintle::Model model = build(s);
  pintle::Assembly assembly;
  const pintle::Assembly same = assemble(linked, link.model);
  assembly.start = same.start;
  assembly.start.y.setZero(model.system.n_y());
  assembly.start.y.head(2 * model.system.n()) = same.start.y.head(2 * model.system.n());
  assembly.start.impact_rate.clear();
  assembly.shared.assign(static_cast<std::size_t>(model.system.n_rows()), false);
  const pintle::Run rod = simulate(s, model, assembly);
  ASSERT_EQ(rod.status, Status::finished) << rod.reason;
  for (const char* name : {"crank.angle [rad]", "coupler.angle [rad]", "slider.x [m]"})
    EXPECT_NEAR(link.last(name), rod.trajectory.column(name).back(), 1e-7) << name;
}

TEST(MasslessLinkModel, HoldsTheJournalAtTheWallAndLosesNothing) {
  for (const char* constraints : {"projection", "partitioning"}) {
    const SliderCrank o{.clearance = 1e-4, .until = 0.03, .tolerance = 1e-9, .constraints = constraints};
    const Whole w = run(with_model(ClearanceModel::massless_link, o));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    for (const double depth : w.column("gudgeon pin.depth [m]")) EXPECT_NEAR(depth, 0, 1e-12);
    EXPECT_EQ(w.run.last.lost, 0);
    EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-8 * w.run.energy_in_play);
    EXPECT_TRUE(w.run.impacts.empty());
    EXPECT_EQ(w.model.system.n_rows(), 7);  // one less than with an ideal pin
  }
}

TEST(MasslessLinkModel, SaysInHowManyOutputsItPushed) {
  // Laid across the gap from where the joint presses: unstable, it swings over.
  const SliderCrank o{.clearance = 5e-4, .eccentricity = {5e-4, 1e-5}, .until = 0.01, .tolerance = 1e-9, .outputs = 500};
  const Whole w = run(with_model(ClearanceModel::massless_link, o));
  const auto normal = w.column("gudgeon pin.normal [N]");
  const auto pushed = std::count_if(normal.begin(), normal.end(), [](double N) { return N < 0; });
  ASSERT_GT(pushed, 0);
  const auto says = [&](const std::string& text) {
    return text.find("in " + std::to_string(pushed) + " of 501 outputs") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(w.run.warnings, says), 1);
}

TEST(MasslessLinkModel, TakesItsDirectionFromTheStartIfThatGivesOne) {
  SliderCrank o{.clearance = 1e-4, .eccentricity = {0, 3e-5}, .until = 1e-4};
  Scene s = with_model(ClearanceModel::massless_link, o);
  s.start_journals[0].speed = {0.2, 0.7};  // along the link nothing can move
  const Whole w = run(s);
  EXPECT_NEAR(first(w, "gudgeon pin.ex [m]"), 0, 1e-13);
  EXPECT_NEAR(first(w, "gudgeon pin.ey [m]"), 1e-4, 1e-13);
  EXPECT_NEAR(first(w, "gudgeon pin.rate [m/s]"), 0, 1e-10);
  EXPECT_NEAR(first(w, "gudgeon pin.sliding [m/s]") - first(w, "coupler.speed [rad/s]") * (0.01 - 1e-4), -0.2, 1e-9);
}

TEST(MasslessLinkModel, TendsToTheIdealJointAsTheClearanceVanishes) {
  const SliderCrank ideal{.clearance = 0, .until = 5e-3, .tolerance = 1e-9};
  const Whole to = run(scene(ideal));
  double before = 1;
  for (const double c : {1e-4, 1e-5, 1e-6}) {
    SliderCrank o = ideal;
    o.clearance = c;
    const Whole w = run(with_model(ClearanceModel::massless_link, o));
    const double away = std::abs(w.last("slider.x [m]") - to.last("slider.x [m]"));
    EXPECT_LT(away, 2 * c);
    EXPECT_LT(away, 0.3 * before);
    before = away;
  }
}

TEST(MasslessLinkModel, RestsHangingOnTheWall) {
  // A body hung by a worn pin: its mass centre under the pin, the journal at the lowest point of its bearing.
  Scene s;
  s.gravity = {0, -10};
  s.bodies = {body("bob", 2, 0.1, {point("P", 0, 0.3)})};
  s.joints = {joint("pin", pintle::JointKind::revolute, "ground", "bob.P")};
  s.joints[0].clearance = clearance("ground", 1e-3, 0.8);
  s.joints[0].clearance->model = ClearanceModel::massless_link;
  s.start_bodies = {start_angle("bob", 0.4, 0)};
  const pintle::Model model = build(s);
  const pintle::Equilibrium rest = find_equilibrium(s, model, assemble(s, model), 0);
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.table.column("pin.ey [m]").back(), -1e-3, 1e-9);
  EXPECT_NEAR(rest.table.column("pin.normal [N]").back(), 20, 1e-9);
  EXPECT_EQ(rest.stability.unstable, 0);
}

// --- spring and damper ---

struct Bounce {
  double separation, lost, deepest;
  bool parted;
};
/// A disc of 0.2 kg flies at 0.4 m/s against the wall of a hole in the ground.
Bounce bounce(double stiffness, double damping, const std::string& method = "verner87", double tolerance = 1e-11) {
  Scene s;
  s.bodies = {body("disc", 0.2, 1e-4, {point("P", 0)})};
  s.joints = {joint("hole", pintle::JointKind::revolute, "ground", "disc.P")};
  auto& c = s.joints[0].clearance.emplace(clearance("ground", 1e-3, 0.8));
  c.model = ClearanceModel::spring_damper;
  c.stiffness = stiffness, c.damping = damping;
  s.start_journals = {{"hole", {0, 0}, {0.4, 0}, {}}};
  s.run.until = 5e-3, s.run.tolerance = tolerance, s.run.method = method;
  const Whole w = run(s);
  EXPECT_EQ(w.run.status, Status::finished) << w.run.reason;
  EXPECT_LT(std::abs(w.run.worst_unexplained), (tolerance < 1e-9 ? 1e-8 : 1e-4) * w.run.energy_in_play);
  const pintle::Impact& hit = w.run.impacts.at(0);
  return {hit.separation, hit.lost, hit.deepest, std::isfinite(hit.end)};
}

TEST(SpringDamper, BouncesAsTheLinearOscillatorThatDoesNotPull) {
  const double m = 0.2, v = 0.4, k = 3e6;
  for (const double zeta : {0.0, 0.01, 0.1, 0.5, 0.9}) {
    SCOPED_TRACE(zeta);
    const double a = std::asin(zeta), decay = std::exp(-(std::numbers::pi - 2 * a) * std::tan(a));
    const Bounce b = bounce(k, 2 * zeta * std::sqrt(k * m));
    ASSERT_TRUE(b.parted);
    EXPECT_NEAR(b.separation, v * decay, 1e-7 * v);
    EXPECT_NEAR(b.lost, m * v * v / 2 * (1 - decay * decay), 1e-7 * m * v * v);
    // Rate 0 at ωt = π/2 − a.
    EXPECT_NEAR(b.deepest, v * std::sqrt(m / k) * std::exp(-std::tan(a) * (std::numbers::pi / 2 - a)), 1e-8 * 1e-3);
  }
}

TEST(SpringDamper, BouncesAlikeUnderEveryScheme) {
  const double m = 0.2, v = 0.4, k = 3e6, a = std::asin(0.1), decay = std::exp(-(std::numbers::pi - 2 * a) * std::tan(a));
  for (const char* method : {"dopri5", "rkf45"})
    EXPECT_NEAR(bounce(k, 0.2 * std::sqrt(k * m), method, 1e-10).separation, v * decay, 1e-6 * v) << method;
  EXPECT_NEAR(bounce(k, 0.2 * std::sqrt(k * m), "generalized-alpha", 1e-8).separation, v * decay, 1e-4 * v);
}

TEST(SpringDamper, LeftToTheContactLawStoresAndLosesInATypicalImpactWhatThatDoes) {
  // A disc pressed by 50 N: the ideal joint carries just these, and they bring 50 N × 1 mm to the wall.
  Scene s;
  s.bodies = {body("disc", 0.2, 1e-4, {point("P", 0)})};
  s.joints = {joint("hole", pintle::JointKind::revolute, "ground", "disc.P")};
  auto& c = s.joints[0].clearance.emplace(clearance("ground", 1e-3, 0.6));
  s.loads = {force("press", "disc.P", law(50), law(0))};
  s.run.until = 8e-3, s.run.tolerance = 1e-11, s.run.method = "verner87";
  const Whole contact = run(s);
  c.model = ClearanceModel::spring_damper;
  const Whole spring = run(s);
  const pintle::ContactPair& pair = spring.model.system.contacts[0];
  ASSERT_FALSE(contact.run.impacts.empty());
  ASSERT_FALSE(spring.run.impacts.empty());
  const auto law = std::get<pintle::ImpactLaw>(contact.model.system.contacts[0].normal);
  const double deepest = std::pow(2.5 * 50 * 1e-3 / law.k, 0.4);  // ⅖ k δ^2.5 = F c
  EXPECT_NEAR(std::get<pintle::ImpactLaw>(pair.normal).k * deepest * deepest / 2, 50 * 1e-3, 1e-9);
  // A free impact loses 1 − e²; the 50 N go on while it lasts, which changes the ratio by little.
  const pintle::Impact &by_contact = contact.run.impacts[0], &by_spring = spring.run.impacts[0];
  EXPECT_NEAR(by_spring.approach, by_contact.approach, 1e-9);
  EXPECT_NEAR(by_spring.separation / by_contact.separation, 1, 0.02);
  EXPECT_NEAR(by_spring.lost / by_contact.lost, 1, 0.02);
}

TEST(SpringDamper, RestsWhereItsSpringCarriesTheLoad) {
  Scene s;
  s.gravity = {0, -10};
  s.bodies = {body("disc", 2, 1e-4, {point("P", 0)})};
  s.joints = {joint("hole", pintle::JointKind::revolute, "ground", "disc.P")};
  auto& c = s.joints[0].clearance.emplace(clearance("ground", 1e-3, 0.6));
  c.model = ClearanceModel::spring_damper;
  c.stiffness = 1e6, c.damping = 100;
  s.start_journals = {{"hole", {0, -1.001e-3}, {0, 0}, {}}};
  const pintle::Model model = build(s);
  const pintle::Equilibrium rest = find_equilibrium(s, model, assemble(s, model), 0);
  ASSERT_TRUE(rest.found) << rest.reason;
  EXPECT_NEAR(rest.table.column("hole.depth [m]").back(), 20e-6, 1e-12);
  const pintle::Linearization small = linearize(s, model, rest.state, pintle::Laws::hold);
  EXPECT_NEAR(small.contacts.at(0).stiffness, 1e6, 1e-3);
  EXPECT_NEAR(small.contacts.at(0).damping, 100, 1e-9);
}

// --- one word ---

class EveryModel : public testing::TestWithParam<ClearanceModel> {};

TEST_P(EveryModel, RunsTheSceneOfAnotherWithAClosedLedgerAndTheSameColumns) {
  for (const char* method : {"dopri5", "verner87", "generalized-alpha", "auto"}) {
    SCOPED_TRACE(method);
    const SliderCrank o{.clearance = 1e-4, .friction = 0.05, .until = 0.01, .tolerance = 1e-9, .method = method};
    const Whole w = run(with_model(GetParam(), o)), contact = run(with_model(ClearanceModel::contact, o));
    ASSERT_EQ(w.run.status, Status::finished) << w.run.reason;
    EXPECT_LT(std::abs(w.run.worst_unexplained), 1e-5 * w.run.energy_in_play);
    EXPECT_EQ(w.run.trajectory.header, contact.run.trajectory.header);
    EXPECT_EQ(w.model.clearances.size(), 1u);
  }
}

TEST_P(EveryModel, GoesOnFromASavedStateBitForBit) {
  const SliderCrank o{.clearance = 1e-4, .until = 0.01, .tolerance = 1e-8};
  Scene s = with_model(GetParam(), o);
  s.output.states = 4e-3;
  const pintle::Model model = build(s);
  const pintle::Assembly start = assemble(s, model);
  std::vector<pintle::SavedState> saved;
  pintle::Listeners listeners;
  listeners.state = [&](const pintle::SavedState& state) { saved.push_back(state); };
  const pintle::Run whole = simulate(s, model, start, listeners);
  ASSERT_GT(saved.size(), 1u);
  const pintle::Run rest = simulate(s, model, start, {}, &saved.front());
  const auto all = whole.trajectory.data, part = rest.trajectory.data;
  ASSERT_LT(part.size(), all.size());
  ASSERT_GT(part.size(), 0u);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), all.end() - static_cast<std::ptrdiff_t>(part.size())));
}

TEST_P(EveryModel, LeavesAFreedomThatNoDriverMoves) {
  const Scene s = with_model(GetParam(), {.clearance = 1e-4, .driven = true});
  EXPECT_THROW(
      {
        const pintle::Model model = build(s);
        kinematics(s, model, assemble(s, model));
      },
      pintle::AssemblyError);
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel,
                         testing::Values(ClearanceModel::contact, ClearanceModel::massless_link, ClearanceModel::spring_damper),
                         [](const testing::TestParamInfo<ClearanceModel>& model) {
                           std::string name = model_name(model.param);
                           std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
                           return name;
                         });

TEST(OneWord, SaysWhatTheModelDoesNotUse) {
  Scene s = with_model(ClearanceModel::massless_link, {.clearance = 1e-4, .friction = 0.1});
  const pintle::Model link = build(s);
  EXPECT_NE(link.clearances[0].find("not used: normal, friction"), std::string::npos) << link.clearances[0];
  EXPECT_EQ(std::ranges::count_if(link.warnings, [](const std::string& w) { return w.find("friction is ignored") != std::string::npos; }),
            1);
  s.joints[2].clearance->model = ClearanceModel::contact;
  s.joints[2].clearance->damping = 1;
  EXPECT_NE(build(s).clearances[0].find("not used: damping"), std::string::npos);
}

}  // namespace
}  // namespace pintle_scenes::clearance_models_test
