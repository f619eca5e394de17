// A pair of surfaces in contact: where its power goes, and that its forces are opposite.

#include "framework/dynamics/model/contact_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "tests/contracts/moving_bodies.h"

namespace pintle::contact_pair_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double rounding = 1e-12;

struct Touching {
  ContactPair pair;
  Vector3d journal, bearing, journal_rate, bearing_rate;  // poses and their rates
  double impact_rate;
};

// Overlaps over decades, sinking in, leaving, and leaving fast enough for the force to be clamped.
std::vector<Touching> overlaps(std::optional<Ambrosio> friction) {
  std::vector<Touching> out;
  Draw draw(17);
  for (double depth : {1e-8, 1e-6, 1e-4})
    for (const ImpactLaw& law : {ImpactLaw{1e9, 1.5, 0}, ImpactLaw{1e9, 1.5, 0.6}, ImpactLaw{1e6, 1, 0, 30}})
      for (double clearance : {1e-5, 1e-3})
        for (int n = 0; n < 12; ++n) {
          Touching c;
          c.pair = {0, 1, JournalBearing{0.02 - clearance, 0.02}, law, friction};
          c.bearing << 0, 0, draw.within(-12, 12);  // far from the origin, depth loses its digits
          c.journal = draw.pose();
          const double angle = draw.within(-M_PI, M_PI);
          c.journal.head<2>() = c.bearing.head<2>() + (clearance + depth) * Vector2d(std::cos(angle), std::sin(angle));
          c.bearing_rate = draw.rates();
          c.journal_rate = c.bearing_rate + 0.3 * draw.rates();
          c.impact_rate = draw.within(0.05, 0.6);
          out.push_back(c);
        }
  return out;
}
// The same, of bodies whose boundary is massless, up to some ten times as flexible as the contact.
std::vector<Touching> seated_overlaps(std::optional<Ambrosio> friction) {
  std::vector<Touching> out;
  Draw draw(23);
  for (Touching& c : overlaps(friction)) {
    if (std::get_if<ImpactLaw>(&c.pair.normal)->d > 0) continue;
    const auto compliance = [&] {
      const Eigen::Matrix2d root = 1e-3 * draw.matrix(2, 2, 1);
      return Eigen::Matrix2d(root * root.transpose());
    };
    c.pair.massless = ResidualFlexibility{compliance(), compliance()};
    out.push_back(c);
  }
  return out;
}
std::vector<Touching> all_overlaps(std::optional<Ambrosio> friction) {
  std::vector<Touching> out = overlaps(friction);
  for (const Touching& c : seated_overlaps(friction)) out.push_back(c);
  return out;
}
ContactEffect effect_after(const Touching& c, double t) {
  return evaluate(c.pair, moving(c.journal + t * c.journal_rate, c.journal_rate), moving(c.bearing + t * c.bearing_rate, c.bearing_rate),
                  c.impact_rate);
}

TEST(ContactPair, PowerGoesToStorageHysteresisAndFriction) {
  for (const bool rough : {false, true})
    for (const Touching& c : all_overlaps(rough ? std::optional<Ambrosio>({0.3, 1e-3, 1e-2}) : std::nullopt)) {
      const ContactEffect e = effect_after(c, 0);
      ASSERT_GT(e.gap.depth, 0);
      const double power = e.on_a.dot(c.journal_rate) + e.on_b.dot(c.bearing_rate);
      const double h = 1e-4 * e.gap.depth;  // rates below 1 m/s: 1e-8 cut-off
      const double rate = (effect_after(c, h).normal.stored - effect_after(c, -h).normal.stored) / (2 * h);
      const double terms = std::abs(rate) + e.normal.dissipation + std::abs(e.friction_loss) + e.normal.force * std::abs(e.gap.rate);
      const double digits = 1e-17 * e.normal.stored / (e.gap.depth * h);  // a depth is a difference of lengths to 1e-3 m [W]
      EXPECT_NEAR(power, -rate - e.normal.dissipation - e.friction_loss, terms * 2e-6 + digits);
    }
}

TEST(ContactPair, OnlyLoses) {
  for (const Touching& c : all_overlaps(Ambrosio{0.3, 1e-3, 1e-2})) {
    const ContactEffect e = effect_after(c, 0);
    EXPECT_GE(e.normal.dissipation, 0);
    EXPECT_GE(e.friction_loss, 0);
    EXPECT_GE(e.normal.force, 0);
  }
}

// The two surface points are `depth` apart, so friction T leaves the couple depth·T and no more.
TEST(ContactPair, ForcesAreOppositeAndMomentsUpToTheOverlap) {
  for (const Touching& c : overlaps(Ambrosio{0.3, 1e-3, 1e-2})) {
    const ContactEffect e = effect_after(c, 0);
    EXPECT_EQ((e.on_a + e.on_b).head<2>().norm(), 0);
    const double couple = moment(c.journal, e.on_a) + moment(c.bearing, e.on_b);
    EXPECT_NEAR(couple, e.gap.depth * e.friction, 10 * rounding * (1 + e.normal.force));
  }
}

// The force F on both displaced centres: their distance is c + δ with F = k δⁿ, and the displacements are A F and B F in body axes.
TEST(ContactPair, AMasslessBoundaryIsInEquilibrium) {
  for (const Touching& c : seated_overlaps(std::nullopt)) {
    const auto& law = *std::get_if<ImpactLaw>(&c.pair.normal);
    Touching still = c;
    still.journal_rate.setZero(), still.bearing_rate.setZero();
    const Vector2d f = -effect_after(still, 0).on_a.head<2>();
    const auto displaced = [&](const Eigen::Matrix2d& G, double angle) {
      const Eigen::Matrix2d R = (Eigen::Matrix2d() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
      return Vector2d(R * G * R.transpose() * f);
    };
    const Vector2d q = c.journal.head<2>() - c.bearing.head<2>() - displaced(c.pair.massless->a, c.journal[2]) -
                       displaced(c.pair.massless->b, c.bearing[2]);
    const double depth = q.norm() - c.pair.gap.clearance(), digits = 1e-14 * (c.journal - c.bearing).head<2>().norm();
    EXPECT_NEAR(std::pow(f.norm() / law.k, 1 / law.n), depth, digits);
    EXPECT_NEAR(cross(q, f), 0, digits * f.norm());
  }
}

// Turned about the origin, the forces turn with the bodies; and they have no moment, as the potential does not change.
TEST(ContactPair, AMasslessBoundaryHasNoPreferredDirection) {
  constexpr double turn = 0.7;
  const Eigen::Matrix3d R =
      (Eigen::Matrix3d() << std::cos(turn), -std::sin(turn), 0, std::sin(turn), std::cos(turn), 0, 0, 0, 1).finished();
  for (const Touching& c : seated_overlaps(std::nullopt)) {
    Touching turned = c;
    for (Vector3d* p : {&turned.journal, &turned.bearing, &turned.journal_rate, &turned.bearing_rate}) *p = R * *p;
    turned.journal[2] += turn, turned.bearing[2] += turn;
    const ContactEffect e = effect_after(c, 0), f = effect_after(turned, 0);
    const double digits = 1e-14 * (e.normal.d_depth + e.normal.d_rate + e.normal.force / c.pair.gap.clearance());
    EXPECT_LE((f.on_a - R * e.on_a).norm() + (f.on_b - R * e.on_b).norm(), digits);
    EXPECT_NEAR(moment(c.journal, e.on_a) + moment(c.bearing, e.on_b), 0, digits);
  }
}

TEST(ContactPair, ActsOnlyOnceLatchedAndOverlapping) {
  Touching c = overlaps(std::nullopt).front();
  c.impact_rate = 0;
  EXPECT_EQ(effect_after(c, 0).on_a.norm(), 0);
  c.impact_rate = 0.1;
  c.journal.head<2>() = c.bearing.head<2>();
  const ContactEffect e = effect_after(c, 0);
  EXPECT_EQ(e.on_a.norm() + e.on_b.norm() + e.normal.stored, 0);
  EXPECT_DOUBLE_EQ(e.gap.depth, -c.pair.gap.clearance());
}

}  // namespace
}  // namespace pintle::contact_pair_test
