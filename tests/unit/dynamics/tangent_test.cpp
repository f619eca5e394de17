// The tangent of the equations of motion against differences of their residual, for every joint, force and
// contact of tangent_kinds.h on bodies of every kind.

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

#include "tests/contracts/moving_bodies.h"
#include "tests/unit/dynamics/tangent_kinds.h"

namespace pintle::tangent_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Differences of fourth order over `step` lose rounding/step, 1e-12 of the residual, and step⁴/30 of fifth
// derivatives up to 1e6. A contact changes over its depth of 1e-3: its step is smaller, and its depth,
// known to 1e-16 m, costs 1e-13 of a force whose slope is 1e3 forces a metre: 1e-10 of it.
constexpr double step = 1e-4, contact_step = 2e-6;
constexpr double difference = 1e-8;
constexpr double rounding = 1e-13;
constexpr int draws = 12;

System make_system(const Kind& kind, const Carriers& carriers) {
  System s = kind.joints.empty() ? two_bodies(carriers) : bodies_for(kind.joints.front(), carriers);
  s.gravity = {0.6, -9.8};
  s.joints = kind.joints;
  s.forces = kind.forces;
  s.contacts = kind.contacts;
  s.signals = kind.signals;
  s.laws = kind.laws;
  s.states = kind.states;
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
  if (system.contacts[0].flank) return s;
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

  // @returns the state with internal states that have followed
  State move_to(State s, Equations& eq) const {
    prepare(system, s, eq);
    if (!base) return s;
    follow_internal_states(system, eq, s, weight, base->data(), s.y.data() + system.x_begin());
    apply_forces(system, s, eq);
    return s;
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
    const State here = move_to(state, eq);
    Tangent tangent(system);
    std::vector<double> values(tangent.places().size(), 7.0);
    tangent.evaluate(system, here, eq, a, lambda, w, values);
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
    const double h = system_.contacts.empty() ? step : contact_step;
    const auto slope = [&](int k) {
      State forth = sample.state, back = sample.state;
      forth.y[k] += h, back.y[k] -= h;
      return VectorXd((rates(forth) - rates(back)) / (2 * h));
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
  // follow a body or are sized by signals have no potential and are left out.
  void coordinates_is_symmetric_at_rest() {
    Kind kind = kind_;
    std::erase_if(kind.forces, [](const Force& f) { return turns_with_b(f) || std::holds_alternative<SizedForce>(f); });
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
