// examples/vacuum_breaker.yaml against an integration of its two masses from event to event.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/scenes/hand_models.h"
#include "tests/scenes/text_runs.h"

namespace pintle::vacuum_breaker_test {
namespace {

using pintle_scenes::expect_sound, pintle_scenes::run, pintle_scenes::Whole;

constexpr double g = 9.81, over = 4e-3, nut = 60e-3, gap = 12e-3, rod = 120e-3, closed = -rod - nut + over, open = closed - over - gap;
constexpr double m_contact = 1.5, m_yoke = 4, k_contact = 120e3, k_opening = 60e3, restitution = 0.3;

struct Bounce {
  double t, approach;
};

// Heights and speeds of contact and yoke. Three things may hold: the latch the yoke, the fixed contact the contact, the nut both together.
struct Breaker {
  using State = std::array<double, 4>;  // contact's height, yoke's, and their speeds
  State x{0, closed, 0, 0};
  double t = 0;
  bool latched = true, touching = true, tight = false, pressed = false, magnet = false;  // pressed: the buffer
  double parted = 0, blow = 0, latching = 0;  // when the contacts part; energy lost by the nut and by the latch
  std::vector<Bounce> bounces = {};

  static double apart(const State& s) { return s[0] - rod - s[1]; }  // of the contact's rod and the yoke
  static double contact_push(const State& s) { return k_contact * (nut + 12.5e-3 - apart(s)); }
  double on_contact(const State& s) const { return contact_push(s) - m_contact * g; }
  static double depth(const State& s) { return open - s[1]; }
  static double buffer(const State& s) { return 2e6 * depth(s) - 4e3 * s[3]; }
  double on_yoke(const State& s) const {
    const double opening = k_opening * (s[1] - closed + 100e-3 - 60e-3);
    return -contact_push(s) - opening - m_yoke * g + (pressed ? buffer(s) : 0) + (magnet ? 1800 + 150e3 * (s[1] - open) : 0);
  }
  State rate(const State& s) const {
    double contact = touching ? 0 : on_contact(s) / m_contact, yoke = latched ? 0 : on_yoke(s) / m_yoke;
    if (tight) contact = yoke = (on_contact(s) + on_yoke(s)) / (m_contact + m_yoke);
    return {s[2], s[3], contact, yoke};
  }
  double pull_of_nut(const State& s) const { return on_contact(s) - m_contact * rate(s)[2]; }
  State after(double h) const {
    return pintle_hand::runge_kutta(x, t, h, [this](double, const State& s) { return rate(s); });
  }

  /// A step; ends at the first thing that happens in it.
  void advance(double h) {
    const State next = after(h);
    const auto is_tight = [&](double by) { return apart(after(by)) - nut; };
    const auto is_touched = [&](double by) { return after(by)[0]; };
    const auto is_loose = [&](double by) { return -pull_of_nut(after(by)); };
    const auto is_pressed = [&](double by) { return std::min(depth(after(by)), buffer(after(by))); };
    const auto is_free = [&](double by) { return -buffer(after(by)); };
    const auto is_closed = [&](double by) { return after(by)[1] - closed; };
    double first = h;
    void (Breaker::*happens)() = nullptr;
    const auto consider = [&](bool may, const auto& guard, void (Breaker::*then)()) {
      if (!may || guard(h) <= 0) return;
      if (const double at = pintle_hand::crossing(h, guard); at < first || !happens) first = at, happens = then;
    };
    consider(!tight && apart(x) < nut, is_tight, &Breaker::nut_blow);
    consider(!touching && (x[0] < 0 || x[2] < 0), is_touched, &Breaker::bounce);
    consider(tight, is_loose, &Breaker::let_loose);
    consider(!pressed, is_pressed, &Breaker::press);
    consider(pressed, is_free, &Breaker::set_free);
    consider(magnet && !latched, is_closed, &Breaker::catch_yoke);
    x = happens ? after(first) : next;
    t += first;
    if (happens) (this->*happens)();
  }
  void nut_blow() {
    const double common = (m_contact * x[2] + m_yoke * x[3]) / (m_contact + m_yoke), jump = x[2] - x[3];
    blow += m_contact * m_yoke / (m_contact + m_yoke) * jump * jump / 2;
    if (touching) parted = t;
    touching = false, tight = true;
    x[2] = x[3] = common;
  }
  void let_loose() { tight = false; }
  void press() { pressed = true; }
  void set_free() { pressed = false; }
  void bounce() {
    bounces.push_back({t, x[2]});
    tight = false;
    x[0] = 0;
    x[2] *= -restitution;
    if (std::abs(x[2]) < 1e-6) touching = true, x[2] = 0;
  }
  void catch_yoke() {
    latching = m_yoke * x[3] * x[3] / 2;
    latched = true, magnet = false;
    x[3] = 0;
  }
};

TEST(VacuumBreaker, OpensClosesAndBounces) {
  Scene s = read_scene(PINTLE_SOURCE_DIR "/examples/vacuum_breaker.yaml");
  s.output.frames = 0;
  const Whole w = run(s);
  expect_sound(w);
  const auto t = w.column("t [s]"), contact = w.column("contact.y [m]"), yoke = w.column("yoke.y [m]");

  Breaker hand;
  const double every = 1e-4, near = 1e-6;  // of the run: a hundred times its tolerance
  std::size_t row = 0;
  for (int k = 1; k <= 1000; ++k) {
    if (k == 51) hand.latched = false;
    if (k == 601) hand.magnet = true;
    const double until = k * every;
    while (hand.t < until - 1e-15) hand.advance(std::min(5e-6, until - hand.t));
    while (row + 1 < t.size() && t[row] < until - 1e-9) ++row;
    ASSERT_NEAR(t[row], until, 1e-9);
    EXPECT_NEAR(contact[row], hand.x[0], near * gap) << until;
    EXPECT_NEAR(yoke[row], hand.x[1], near * gap) << until;
  }

  // The contacts part where the nut comes tight, in closed form.
  const double rate = std::sqrt((k_contact + k_opening) / m_yoke), start = (k_contact * (over + 12.5e-3) + k_opening * 40e-3) / m_yoke + g;
  const double parting = 5e-3 + std::acos(1 - over * rate * rate / start) / rate;
  EXPECT_NEAR(hand.parted, parting, 1e-9);
  EXPECT_NEAR(w.ledger("nut.lost to hysteresis [J]"), hand.blow, near * 50);
  EXPECT_NEAR(w.ledger("latch.lost to engaging [J]"), hand.latching, near * 50);

  // Bounces, by time and speed; the last row begins where ever lower ones end.
  std::vector<Bounce> seen;
  for (const Impact& i : w.run.impacts) {
    if (w.model.system.contact_names[static_cast<std::size_t>(i.contact)] != "contacts") continue;
    if (i.begin == 0) {
      EXPECT_NEAR(i.end, parting, 1e-9);
    } else {
      seen.push_back({i.begin, i.approach});
    }
  }
  ASSERT_GE(seen.size(), 8u);
  ASSERT_GE(hand.bounces.size(), seen.size());
  for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
    EXPECT_NEAR(seen[i].t, hand.bounces[i].t, 1e-8) << i;
    EXPECT_NEAR(seen[i].approach, hand.bounces[i].approach, 1e-5 * hand.bounces[i].approach) << i;
  }
  EXPECT_NEAR(seen.back().t, hand.bounces.back().t, 1e-8);
  EXPECT_TRUE(std::isnan(w.run.impacts.back().end)) << "the contacts stay closed";
}

// examples/breaker.yaml, the smaller one: an arm on a torsion spring, from 0 with its rest at 60 deg, to a bumper at 40 deg.
TEST(Breaker, ReachesItsBumperInClosedForm) {
  const Whole w = run(read_scene(PINTLE_SOURCE_DIR "/examples/breaker.yaml"));
  expect_sound(w);
  const double rate = std::sqrt(50 / 0.01), reached = 10e-3 + std::acos(1.0 / 3) / rate,
               speed = 1.0471975511965976 * rate * std::sqrt(8) / 3;
  ASSERT_EQ(w.run.happenings.size(), 4u);
  EXPECT_NEAR(w.run.happenings[1].t, reached, 1e-9);
  const auto t = w.column("t [s]"), arm = w.column("arm.speed [rad/s]"), angle = w.column("arm.angle [rad]");
  const auto row = static_cast<std::size_t>(std::find(t.begin(), t.end(), w.run.happenings[1].t) - t.begin());
  ASSERT_LT(row, t.size());
  EXPECT_NEAR(arm[row], speed, 1e-6 * speed);
  EXPECT_NEAR(arm.back(), 0, 1e-9) << "the catch holds it";
  EXPECT_GT(angle.back(), 40 * 3.141592653589793 / 180);
}

}  // namespace
}  // namespace pintle::vacuum_breaker_test
