// The tangent of the equations of motion against differences of their residual, for every joint, force and
// contact on bodies of every kind. A new joint or force joins by one line in `kinds`.

#include "framework/dynamics/equations/internal.h"
#include "framework/dynamics/equations/tangent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "contact/profile.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::tangent_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Differences of fourth order over `step` lose rounding/step, 1e-12 of the residual, and step⁴/30 of fifth
// derivatives up to 1e6. A contact changes over its depth of 1e-3: its step is smaller, and its depth,
// known to 1e-16 m, costs 1e-13 of a force whose slope is 1e3 forces a metre: 1e-10 of it.
constexpr double step = 1e-4, contact_step = 2e-6;
constexpr double difference = 1e-8;
constexpr double rounding = 1e-13;
constexpr int draws = 12;

constexpr double clearance = 0.01, depth = 1e-3;

struct Kind {
  const char* name;
  std::vector<Joint> joints = {};
  std::vector<Force> forces = {};
  std::vector<ContactPair> contacts = {};
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
// Friction that grows with the sliding speeds drawn here.
ContactPair contact(double chi, std::optional<FrictionLaw> friction = {}, Sliding sliding = Sliding::material) {
  return {0, 1, JournalBearing{0.1 - clearance, 0.1}, ImpactLaw{1e6, 1.5, chi}, friction, sliding};
}
ContactPair spring_damper(std::optional<Ambrosio> friction = {}) {
  ContactPair pair = contact(0, friction);
  pair.normal = ImpactLaw{1e5, 1, 0, 20};
  return pair;
}
// Pieces of profiles, away from the points that carry them.
const Piece disc{.radius = 0.07, .centre = {0.02, -0.03}}, hollow{.radius = -0.3, .centre = {-0.04, 0.05}},
    corner{.radius = 0, .centre = {0.03, 0.02}, .normal = 0.3, .half = 0.8},
    flat{.centre = {-0.02, 0.06}, .normal = -0.7, .half = 0.5, .straight = true};
// Of an egg, or the hole of its shape: a span that bends far more than one pressing it moves along.
Piece span(bool inside, std::size_t which) {
  std::vector<Vector2d> rim;
  for (int i = 0; i < 12; ++i) {
    const double angle = (inside ? 2 : -2) * M_PI * i / 12, r = 0.3 + 0.02 * std::cos(angle);
    rim.emplace_back(0.03 + r * std::cos(angle), -0.02 + r * std::sin(angle));
  }
  return profile_through(rim, true).pieces[which];
}
const Piece egg = span(true, 1), other_egg = span(true, 4), egg_hole = span(false, 2);
ContactPair profiles(const Piece& a, const Piece& b) {
  ContactPair pair = contact(2, Ambrosio{0.3, 0, 50});
  pair.gap = {a, b};
  pair.profiles = pair.follows = true;
  return pair;
}
ContactPair dry(ContactPair pair) {
  pair.friction = Coulomb{0.2, 0.3, 5};
  return pair;
}
const std::vector<Kind> kinds{
    {"Nothing"},
    {"Revolute", {Revolute{0, 1}}},
    {"Slot", {Slot{0, 1}}},
    {"Prismatic", {Prismatic{0, 1, -0.4}}},
    {"Weld", {Weld{0, 1, -0.4}}},
    {"Distance", {Distance{0, 1, 0.8}}},
    {"Differential", {Differential{0, 1, 2, -0.6, 0.3}}},
    {"AngleDriver", {AngleDriver{0, 1, sine}}},
    {"DistanceDriver", {DistanceDriver{0, 1, sine}}},
    {"PointForce", {}, {PointForce{0, 1, sine, steady, false}}},
    {"FollowerForce", {}, {PointForce{0, 1, sine, steady, true}}},
    {"Torque", {}, {Torque{0, 1, sine}}},
    {"Spring", {}, {Spring{0, 1, 40, 0, 0.5}}},
    {"DampedSpring", {}, {Spring{0, 1, 40, 3, 0.5}}},
    {"TorsionSpring", {}, {TorsionSpring{0, 1, 25, 0, -0.8}}},
    {"DampedTorsionSpring", {}, {TorsionSpring{0, 1, 25, 2, -0.8}}},
    {"Maxwell", {}, {Maxwell{0, 1, 40, 3}}},
    {"Contact", {}, {}, {contact(0)}},
    {"LossyContact", {}, {}, {contact(2)}},
    {"SpringDamperContact", {}, {}, {spring_damper()}},
    {"SpringDamperContactWithFriction", {}, {}, {spring_damper(Ambrosio{0.3, 0, 50})}},
    {"ContactWithFriction", {}, {}, {contact(2, Ambrosio{0.3, 0, 50})}},
    {"ContactInFullSliding", {}, {}, {contact(0.6, Ambrosio{0.3, 1e-6, 2e-6})}},
    {"ContactOfGeometricSliding", {}, {}, {contact(0.6, Ambrosio{0.3, 0, 50}, Sliding::geometric)}},
    {"ContactOfDryFriction", {}, {}, {contact(2, Coulomb{0.2, 0.3, 5})}},
    {"DiscOnLineOfDryFriction", {}, {}, {dry(profiles(disc, flat))}},
    {"DiscOnDisc", {}, {}, {profiles(disc, disc)}},
    {"DiscInHollow", {}, {}, {profiles(disc, hollow)}},
    {"HollowRoundDisc", {}, {}, {profiles(hollow, disc)}},
    {"DiscOnLine", {}, {}, {profiles(disc, flat)}},
    {"LineOnDisc", {}, {}, {profiles(flat, disc)}},
    {"CornerOnLine", {}, {}, {profiles(corner, flat)}},
    {"LineOnCorner", {}, {}, {profiles(flat, corner)}},
    {"CornerOnDisc", {}, {}, {profiles(corner, disc)}},
    {"CurveOnDisc", {}, {}, {profiles(egg, disc)}},
    {"DiscOnCurve", {}, {}, {profiles(disc, egg)}},
    {"DiscInHollowCurve", {}, {}, {profiles(disc, egg_hole)}},
    {"CurveOnCurve", {}, {}, {profiles(egg, other_egg)}},
    {"CurveOnLine", {}, {}, {profiles(egg, flat)}},
    {"LineOnCurve", {}, {}, {profiles(flat, egg)}},
    {"Several",
     {Slot{0, 1}, Revolute{1, 0}},
     {Spring{1, 0, 40, 3, 0.5}, Maxwell{1, 0, 60, 5}, TorsionSpring{0, 1, 25, 2, -0.8}, PointForce{1, 0, sine, steady, true}}},
};

System make_system(const Kind& kind, const Carriers& carriers) {
  System s = kind.joints.empty() ? two_bodies(carriers) : bodies_for(kind.joints.front(), carriers);
  s.gravity = {0.6, -9.8};
  s.joints = kind.joints;
  s.forces = kind.forces;
  s.contacts = kind.contacts;
  s.joint_names.assign(s.joints.size(), kind.name);
  s.force_names.assign(s.forces.size(), kind.name);
  s.contact_names.assign(s.contacts.size(), kind.name);
  number(s);
  return s;
}

// A curve is touched within its ends or so, not where it is straight beyond them.
bool off_a_curve(const System& system, const Equations& eq) {
  if (system.contacts.empty() || !system.contacts[0].gap.curved()) return false;
  const Gap gap = evaluate(system.contacts[0].gap, moving_point(eq.motion[0]), moving_point(eq.motion[1]));
  return std::abs(gap.on_a.at) > 1.5 || std::abs(gap.on_b.at) > 1.5;
}

// A state in which a contact, if there is one, is pressed.
State make_state(const System& system, Draw& draw, Equations& eq) {
  State s = random_state(system, draw, eq);
  while (off_a_curve(system, eq)) s = random_state(system, draw, eq);
  if (system.contacts.empty()) return s;
  s.impact_rate = {draw.within(0.5, 4)};
  if (dry_states(system) > 0) s.friction = {{std::floor(draw.within(-1, 2)), draw.within(-90, 90)}};  // slides either way, or sticks
  const double angle = draw.within(-M_PI, M_PI);
  const Vector2d wanted = (clearance + depth) * Vector2d(std::cos(angle), std::sin(angle));
  Vector2d shift = wanted - (eq.motion[0].r - eq.motion[1].r);
  if (const ContactPair& pair = system.contacts[0]; pair.profiles) {
    const Gap gap = evaluate(pair.gap, moving_point(eq.motion[0]), moving_point(eq.motion[1]));
    shift = (depth - gap.depth) * gap.n;
  }
  if (system.markers[0].body != ground)
    s.y.head<2>() += shift;
  else
    s.y.segment<2>(3) -= shift;
  return s;
}

void prepare(const System& system, const State& s, Equations& eq) {
  pose(system, s.t, s.y, eq);
  update_mass(system, s.y, eq);
  speed(system, s.t, s.y, eq);
  apply_forces(system, s, eq);
}

/// A state of a system with accelerations and multipliers, at random.
struct Sample {
  Sample(const System& of, Draw& draw, Equations& eq)
      : system(of), state(make_state(of, draw, eq)), a(draw.matrix(of.n(), 1, 5)), lambda(draw.matrix(of.n_rows(), 1, 5)) {}
  const System& system;
  State state;
  VectorXd a, lambda;
  const VectorXd* base = nullptr;  // internal states follow the motion from these …
  double weight = 0;               // … at this weight

  void move_to(State s, Equations& eq) const {
    prepare(system, s, eq);
    if (!base) return;
    follow_internal_states(system, eq, s.t, weight, base->data(), s.y.data() + system.x_begin());
    apply_forces(system, s, eq);
  }
  VectorXd residual(const State& s, Equations& eq) const {
    move_to(s, eq);
    VectorXd r = -eq.f;
    add_mass_times(system, eq, a, r);
    add_reaction(eq, lambda, r);
    return r;
  }
  // ∂r/∂y_k
  VectorXd slope(int k, Equations& eq) const {
    const double h = system.contacts.empty() ? step : contact_step;
    const auto change = [&](double by) -> VectorXd {
      State forth = state, back = state;
      forth.y[k] += by;
      back.y[k] -= by;
      return residual(forth, eq) - residual(back, eq);
    };
    return (8 * change(h) - change(2 * h)) / (12 * h);
  }
  MatrixXd ours(const Tangent::Weights& w, Equations& eq) const {
    move_to(state, eq);
    Tangent tangent(system);
    std::vector<double> values(tangent.places().size(), 7.0);
    tangent.evaluate(system, state, eq, a, lambda, w, values);
    return dense(system, tangent, values);
  }
};

double largest(const MatrixXd& A) { return A.size() == 0 ? 0 : A.lpNorm<Eigen::Infinity>(); }

/// A kind between two carriers.
struct Held {
  Kind kind_;
  Carriers carriers_;
  System system_ = make_system(kind_, carriers_);
  Equations eq_{system_};
  Draw draw_{29};
  const int n_ = system_.n();

  void expect_differences(const Tangent::Weights& w, int first) {
    for (int k = 0; k < draws; ++k) {
      const Sample sample(system_, draw_, eq_);
      const MatrixXd ours = sample.ours(w, eq_);
      MatrixXd theirs(n_, n_);
      for (int j = 0; j < n_; ++j) theirs.col(j) = sample.slope(first + j, eq_);
      const double terms = 1 + largest(theirs) + largest(sample.residual(sample.state, eq_));
      EXPECT_LT(largest(ours - theirs), terms * difference) << "draw " << k << "\nours\n" << ours << "\ndifferences\n" << theirs;
    }
  }

  void coordinates_is_differences_of_the_residual() { expect_differences({1, 0, 0}, 0); }

  void speeds_is_differences_of_the_residual() { expect_differences({0, 1, 0}, n_); }

  // x = base + weight ẋ is solved for in each state; a weight without end is rest.
  void internal_states_that_follow_are_differences() {
    if (system_.n_x() == 0) return;
    for (const double weight : {0.03, 2.0, internal_at_rest})
      for (const bool of_speed : {false, true}) {
        Sample sample(system_, draw_, eq_);
        const VectorXd base = sample.state.y.segment(system_.x_begin(), system_.n_x());
        sample.base = &base, sample.weight = weight;
        const MatrixXd ours = sample.ours({of_speed ? 0.0 : 1.0, of_speed ? 1.0 : 0.0, 0, weight}, eq_);
        MatrixXd theirs(n_, n_);
        for (int j = 0; j < n_; ++j) theirs.col(j) = sample.slope(j + (of_speed ? n_ : 0), eq_);
        const double terms = 1 + largest(theirs) + largest(sample.residual(sample.state, eq_));
        EXPECT_LT(largest(ours - theirs), terms * difference) << weight << "\nours\n" << ours << "\ndifferences\n" << theirs;
      }
  }

  void coupling_to_internal_states_is_differences() {
    if (system_.n_x() == 0) return;
    const Sample sample(system_, draw_, eq_);
    prepare(system_, sample.state, eq_);
    Tangent tangent(system_);
    const Tangent::Internal ours = tangent.internal(system_, sample.state, eq_);
    const auto rates = [&](const State& s) {
      prepare(system_, s, eq_);
      VectorXd dy(system_.n_y());
      fill_derivative(system_, s.y, eq_, dy);
      return VectorXd(dy.segment(system_.x_begin(), system_.n_x()));
    };
    const auto slope = [&](int k) {
      State forth = sample.state, back = sample.state;
      forth.y[k] += step, back.y[k] -= step;
      return VectorXd((rates(forth) - rates(back)) / (2 * step));
    };
    constexpr double central = 1e-6;  // step² of third derivatives up to 1e2
    for (int j = 0; j < system_.n_x(); ++j) {
      EXPECT_LT((sample.slope(system_.x_begin() + j, eq_) + ours.f_x.col(j)).norm(), (1 + ours.f_x.norm()) * difference);
      EXPECT_LT((slope(system_.x_begin() + j) - ours.g_x.col(j)).norm(), (1 + ours.g_x.norm()) * central);
    }
    for (int j = 0; j < n_; ++j) {
      EXPECT_LT((slope(j) - ours.g_q.col(j)).norm(), (1 + ours.g_q.norm()) * central);
      EXPECT_LT((slope(n_ + j) - ours.g_s.col(j)).norm(), (1 + ours.g_s.norm()) * central);
    }
  }

  // r is linear in a: a difference over a whole unit is exact but for rounding.
  void accelerations_is_the_mass_matrix() {
    for (int k = 0; k < draws; ++k) {
      Sample sample(system_, draw_, eq_);
      const MatrixXd ours = sample.ours({0, 0, 1}, eq_);
      const VectorXd a = sample.a, before = sample.residual(sample.state, eq_);
      const double terms = 1 + largest(before);
      for (int j = 0; j < n_; ++j) {
        sample.a = a + VectorXd::Unit(n_, j);
        EXPECT_LT(largest(ours.col(j) - (sample.residual(sample.state, eq_) - before)), 100 * terms * rounding);
      }
      for (const FlexibleInertia& body : eq_.flexible) {
        const MatrixXd M = mass_matrix(body);
        EXPECT_LT(largest(ours.block(3 * body.body, 3 * body.body, 3, 3) - M.topLeftCorner(3, 3)), rounding * largest(M));
        EXPECT_LT(largest(ours.block(body.begin, body.begin, body.n, body.n) - M.bottomRightCorner(body.n, body.n)),
                  100 * rounding * largest(M));
      }
    }
  }

  void a_weighted_sum_is_the_sum_of_its_parts() {
    const Sample sample(system_, draw_, eq_);
    const Tangent::Weights w{0.7, -3.1, 11};
    const MatrixXd sum = w.q * sample.ours({1, 0, 0}, eq_) + w.s * sample.ours({0, 1, 0}, eq_) + w.a * sample.ours({0, 0, 1}, eq_);
    EXPECT_LT(largest(sample.ours(w, eq_) - sum), (1 + largest(sum)) * rounding);
  }

  // At rest, without accelerations, r is the gradient of λ·C and of energies. Friction needs speed, or to have been decided; forces that
  // follow a body have no potential and are left out.
  void coordinates_is_symmetric_at_rest() {
    Kind kind = kind_;
    std::erase_if(kind.forces, [](const Force& f) { return std::holds_alternative<PointForce>(f) && std::get<PointForce>(f).follows; });
    const System system = make_system(kind, carriers_);
    Equations eq(system);
    for (int k = 0; k < draws; ++k) {
      Sample sample(system, draw_, eq);
      sample.state.y.tail(system.n_y() - n_).setZero();
      sample.state.friction.clear();
      sample.a.setZero();
      const MatrixXd K = sample.ours({1, 0, 0}, eq);
      EXPECT_LT(largest(K - K.transpose()), (1 + largest(K)) * rounding) << K;
    }
  }
};

class TangentOf : public testing::TestWithParam<Kind> {
 protected:
  template <class Exam>
  void each_carrier(Exam exam) {
    for (const Carriers& carriers : all_carriers()) {
      SCOPED_TRACE(name_of(carriers));
      Held held{GetParam(), carriers};
      exam(held);
    }
  }
};

TEST_P(TangentOf, CoordinatesIsDifferencesOfTheResidual) {
  each_carrier([](Held& held) { held.coordinates_is_differences_of_the_residual(); });
}
TEST_P(TangentOf, SpeedsIsDifferencesOfTheResidual) {
  each_carrier([](Held& held) { held.speeds_is_differences_of_the_residual(); });
}
TEST_P(TangentOf, InternalStatesThatFollowAreDifferences) {
  each_carrier([](Held& held) { held.internal_states_that_follow_are_differences(); });
}
TEST_P(TangentOf, CouplingToInternalStatesIsDifferences) {
  each_carrier([](Held& held) { held.coupling_to_internal_states_is_differences(); });
}
TEST_P(TangentOf, AccelerationsIsTheMassMatrix) {
  each_carrier([](Held& held) { held.accelerations_is_the_mass_matrix(); });
}
TEST_P(TangentOf, AWeightedSumIsTheSumOfItsParts) {
  each_carrier([](Held& held) { held.a_weighted_sum_is_the_sum_of_its_parts(); });
}
TEST_P(TangentOf, CoordinatesIsSymmetricAtRest) {
  each_carrier([](Held& held) { held.coordinates_is_symmetric_at_rest(); });
}

INSTANTIATE_TEST_SUITE_P(Each, TangentOf, testing::ValuesIn(kinds), [](const auto& one) { return one.param.name; });

TEST(TangentContract, EveryKindSitsTheExam) {
  std::set<std::size_t> joints, forces;
  for (const Kind& kind : kinds) {
    for (const Joint& j : kind.joints) joints.insert(j.index());
    for (const Force& f : kind.forces) forces.insert(f.index());
  }
  EXPECT_EQ(joints.size(), std::variant_size_v<Joint>);
  EXPECT_EQ(forces.size(), std::variant_size_v<Force>);
}

// ---- the exam itself ----------------------------------------------------------------------------

// Draws meet what the laws distinguish: sinking in, leaving and leaving so fast that nothing is left of the
// force.
TEST(TangentContract, ContactsAreMetPressedAndClamped) {
  const System system = make_system({"LossyContact", {}, {}, {contact(2)}}, {Carrier::rigid, Carrier::rigid});
  Equations eq(system);
  Draw draw(29);  // as TangentOf
  int in = 0, out = 0, clamped = 0;
  for (int k = 0; k < draws; ++k) {
    const Sample sample(system, draw, eq);
    prepare(system, sample.state, eq);
    ASSERT_NEAR(eq.contact[0].gap.depth, depth, 1e-12);
    ++(eq.contact[0].normal.force == 0 ? clamped : eq.contact[0].gap.rate > 0 ? in : out);
  }
  EXPECT_GT(in, 0);
  EXPECT_GT(out, 0);
  EXPECT_GT(clamped, 0);
}

// ---- one body by itself -------------------------------------------------------------------------

// A spring between two points of one body, and a slot: four blocks in one place.
TEST(Tangent, OfWhatHoldsABodyToItselfIsDifferencesOfTheResidual) {
  for (const Carrier carrier : {Carrier::rigid, Carrier::flexible, Carrier::stiffening}) {
    System system = two_bodies({carrier, Carrier::rigid});
    Marker other = system.markers[0];
    other.x_BP = {-0.6, 0.5};
    if (other.shape.size() > 0) other.shape *= -0.7;
    system.markers.push_back(other);
    system.joints = {Slot{0, 2}};
    system.forces = {Spring{2, 0, 40, 3, 0.5}};
    system.joint_names = system.force_names = {"own"};
    number(system);
    Equations eq(system);
    Draw draw(31);
    const Sample sample(system, draw, eq);
    for (const bool of_speed : {false, true}) {
      const MatrixXd ours = sample.ours({of_speed ? 0.0 : 1.0, of_speed ? 1.0 : 0.0, 0}, eq);
      MatrixXd theirs(system.n(), system.n());
      for (int j = 0; j < system.n(); ++j) theirs.col(j) = sample.slope(j + (of_speed ? system.n() : 0), eq);
      EXPECT_LT(largest(ours - theirs), (1 + largest(theirs) + largest(sample.residual(sample.state, eq))) * difference);
    }
  }
}

}  // namespace
}  // namespace pintle::tangent_test
