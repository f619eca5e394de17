// The exam every gap sits: a geometry that turns two moving points into a depth and its rates.
// A new gap joins by a line in `Gaps`, its sizes in `over_decades` and its `surfaces`.

#include "contact/gap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace pintle::gap_test {
namespace {

using Eigen::Vector2d;

// Tolerances, relative to the terms summed.
// A handful of operations on numbers of one size.
constexpr double rounding = 1e-12;
// Central difference: 1e-10 cut-off, 1e-11 rounding, and room for the angles at which they meet.
constexpr double difference = 1e-7;
// Its step, relative to the shortest length or time at hand.
constexpr double relative_step = 1e-5;

Vector2d perp(const Vector2d& v) { return {-v.y(), v.x()}; }
Vector2d turned(double angle, const Vector2d& v) { return Eigen::Rotation2Dd(angle) * v; }

struct Case {
  MovingPoint journal, bearing;
  double relative_speed() const { return (journal.v - bearing.v).norm(); }
};

template <class G>
std::vector<G> over_decades();
template <>
std::vector<JournalBearing> over_decades<JournalBearing>() {
  std::vector<JournalBearing> gaps;
  for (double bearing : {1e-3, 1e-2, 0.5})
    for (double part : {1e-4, 1e-2, 0.3})  // clearance over radius
      gaps.push_back({.journal = bearing * (1 - part), .bearing = bearing});
  return gaps;
}

// Where the two surfaces lie along n from the two centres, and the eccentricity of first touch [m].
struct Surfaces {
  double journal, bearing, touch;
};
Surfaces surfaces(const JournalBearing& gap) { return {gap.journal, gap.bearing, gap.bearing - gap.journal}; }

// Eccentricities from deep inside the clearance to well into the wall, all directions, at random
// speeds and spins (fixed seed).
template <class G, class F>
void for_cases(const G& gap, F exam) {
  const Surfaces size = surfaces(gap);
  std::mt19937 generator(20);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double scale) {
    const double x = unit(generator), y = unit(generator);
    return Vector2d(scale * x, scale * y);
  };
  for (double ratio : {0.01, 0.5, 0.999999, 1.0, 1.000001, 1.5})
    for (double angle = -std::numbers::pi; angle <= std::numbers::pi; angle += std::numbers::pi / 8) {
      const Vector2d e = ratio * size.touch * Vector2d(std::cos(angle), std::sin(angle));
      const MovingPoint bearing{vector(size.bearing), vector(2.0), 150 * unit(generator)};
      const MovingPoint journal{bearing.r + e, bearing.v + vector(1.0), 150 * unit(generator)};
      exam(Case{journal, bearing});
    }
}

template <class G>
Gap at(const G& gap, const Case& c) {
  return evaluate(gap, c.journal, c.bearing);
}

// The centres' positions after time t at constant speeds.
Case later(const Case& c, double t) {
  Case out = c;
  out.journal.r += t * c.journal.v;
  out.bearing.r += t * c.bearing.v;
  return out;
}

// A step in time over which nothing moves more than `relative_step` of the eccentricity.
double short_time(const Case& c) {
  const double spin = std::abs(c.journal.w) + std::abs(c.bearing.w);
  return relative_step / (spin + c.relative_speed() / (c.journal.r - c.bearing.r).norm());
}

// Terms whose rounding a difference of positions carries: the positions, over the step.
double speed_scale(const Case& c, double length, double t) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double spin = std::abs(c.journal.w) + std::abs(c.bearing.w);
  return difference * (c.relative_speed() + spin * length) + 4 * epsilon * (c.journal.r.norm() + length) / t;
}

template <class G>
struct GapContract : testing::Test {
  template <class F>
  void everywhere(F exam) {
    for (const G& gap : over_decades<G>()) for_cases(gap, [&](const Case& c) { exam(gap, c); });
  }
};
using Gaps = testing::Types<JournalBearing>;  // a new gap joins here
TYPED_TEST_SUITE(GapContract, Gaps);

TYPED_TEST(GapContract, NormalIsUnit) {
  this->everywhere([](const TypeParam& gap, const Case& c) { EXPECT_NEAR(at(gap, c).n.norm(), 1, rounding); });
}

TYPED_TEST(GapContract, NormalIsTheGradientOfDepth) {
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const double h = relative_step * at(gap, c).e.norm();
    const double noise = 4 * std::numeric_limits<double>::epsilon() * c.journal.r.norm() / h;
    Vector2d by_journal, by_bearing;
    for (int i : {0, 1}) {
      const auto depth = [&](double dj, double db) {
        Case moved = c;
        moved.journal.r[i] += dj;
        moved.bearing.r[i] += db;
        return at(gap, moved).depth;
      };
      by_journal[i] = (depth(h, 0) - depth(-h, 0)) / (2 * h);
      by_bearing[i] = (depth(0, h) - depth(0, -h)) / (2 * h);
    }
    EXPECT_LT((at(gap, c).n - by_journal).norm(), difference + noise);
    EXPECT_LT((at(gap, c).n + by_bearing).norm(), difference + noise);
  });
}

TYPED_TEST(GapContract, DepthIsContinuous) {
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const double depth = at(gap, c).depth;
    for (double size : {1e-3, 1e-6, 1e-9}) {
      Case moved = c;
      const Vector2d shift = size * at(gap, c).e.norm() * Vector2d(0.6, -0.8);
      moved.journal.r += shift;
      EXPECT_LE(std::abs(at(gap, moved).depth - depth), shift.norm() + rounding * (c.journal.r.norm() + surfaces(gap).bearing));
    }
  });
}

TYPED_TEST(GapContract, RateIsTheChangeOfDepth) {
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const double t = short_time(c);
    const double by_time = (at(gap, later(c, t)).depth - at(gap, later(c, -t)).depth) / (2 * t);
    EXPECT_NEAR(at(gap, c).rate, by_time, speed_scale(c, surfaces(gap).bearing, t));
  });
}

TYPED_TEST(GapContract, MaterialSlipIsThatOfTwoMarksOnTheSurfaces) {
  // A mark is painted on each surface where n meets it, and both are followed as their bodies move.
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const Vector2d n = at(gap, c).n;
    const Surfaces levers = surfaces(gap);
    const double t = short_time(c);
    const auto apart = [&](double dt) -> Vector2d {
      const Case moved = later(c, dt);
      return moved.journal.r + turned(c.journal.w * dt, levers.journal * n) - moved.bearing.r -
             turned(c.bearing.w * dt, levers.bearing * n);
    };
    const double by_time = (apart(t) - apart(-t)).dot(perp(n)) / (2 * t);
    EXPECT_NEAR(at(gap, c).material_slip, by_time, speed_scale(c, surfaces(gap).bearing, t));
  });
}

TYPED_TEST(GapContract, GeometricSlipIsThatOfTheContactPoints) {
  // The points where n meets the surfaces, r + R n, wander over both bodies as n turns.
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const Vector2d n = at(gap, c).n;
    const Surfaces levers = surfaces(gap);
    const double t = short_time(c);
    const auto apart = [&](double dt) -> Vector2d {
      const Case moved = later(c, dt);
      const Vector2d n_then = at(gap, moved).n;
      return moved.journal.r + levers.journal * n_then - moved.bearing.r - levers.bearing * n_then;
    };
    const double by_time = (apart(t) - apart(-t)).dot(perp(n)) / (2 * t);
    // n of a shallow eccentricity carries the positions' rounding over |e|, times the levers.
    const double n_noise = 4 * std::numeric_limits<double>::epsilon() * c.journal.r.norm() / at(gap, c).e.norm() * surfaces(gap).touch / t;
    EXPECT_NEAR(
        at(gap, c).geometric_slip, by_time,
        speed_scale(c, surfaces(gap).bearing, t) + difference * surfaces(gap).touch / at(gap, c).e.norm() * c.relative_speed() + n_noise);
  });
}

TYPED_TEST(GapContract, ContactForcesWorkOnRateAndMaterialSlip) {
  // −N n + T Zn on the journal's surface point, its opposite on the bearing's: the power that the
  // two bodies receive is −N rate + T material_slip, which is what the ledger of energy rests on.
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const double normal = 7, friction = -3;  // [N]
    const Gap g = at(gap, c);
    const Surfaces levers = surfaces(gap);
    const Vector2d force = -normal * g.n + friction * perp(g.n);
    const auto power = [](const MovingPoint& p, const Vector2d& arm, const Vector2d& f) {
      return f.dot(p.v) + (arm.x() * f.y() - arm.y() * f.x()) * p.w;
    };
    const double received = power(c.journal, levers.journal * g.n, force) + power(c.bearing, levers.bearing * g.n, -force);
    const double size = (normal - friction) *
                        (c.journal.v.norm() + c.bearing.v.norm() + surfaces(gap).bearing * (std::abs(c.journal.w) + std::abs(c.bearing.w)));
    EXPECT_NEAR(received, -normal * g.rate + friction * g.material_slip, rounding * size);
  });
}

TYPED_TEST(GapContract, SwappingTheCentresMirrors) {
  // Spins stay where they are: journal and bearing differ in size.
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const Case swapped{{c.bearing.r, c.bearing.v, c.journal.w}, {c.journal.r, c.journal.v, c.bearing.w}};
    const Gap g = at(gap, c), m = at(gap, swapped);
    EXPECT_EQ(m.e, -g.e);
    EXPECT_EQ(m.n, -g.n);
    EXPECT_EQ(m.depth, g.depth);
    EXPECT_EQ(m.rate, g.rate);
    EXPECT_EQ(m.material_slip, g.material_slip);
    EXPECT_EQ(m.geometric_slip, g.geometric_slip);
  });
}

TYPED_TEST(GapContract, ReflectedWorldReversesSlipOnly) {
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const auto reflected = [](const MovingPoint& p) { return MovingPoint{{p.r.x(), -p.r.y()}, {p.v.x(), -p.v.y()}, -p.w}; };
    const Gap g = at(gap, c), m = at(gap, Case{reflected(c.journal), reflected(c.bearing)});
    EXPECT_EQ(m.depth, g.depth);
    EXPECT_EQ(m.rate, g.rate);
    EXPECT_EQ(m.material_slip, -g.material_slip);
    EXPECT_EQ(m.geometric_slip, -g.geometric_slip);
  });
}

TYPED_TEST(GapContract, TurningAndMovingTheWorldChangesNothing) {
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const double angle = 0.7;
    const Vector2d shift(0.3, -0.2), drift(1.1, 0.4);  // [m], [m/s]
    const auto moved = [&](const MovingPoint& p) { return MovingPoint{turned(angle, p.r) + shift, turned(angle, p.v) + drift, p.w}; };
    const Gap g = at(gap, c), m = at(gap, Case{moved(c.journal), moved(c.bearing)});
    const double lengths = c.journal.r.norm() + surfaces(gap).bearing + shift.norm();
    // e is a difference of positions: their rounding over |e| is the error of n's direction.
    const double direction = rounding * lengths / g.e.norm();
    const double speeds =
        c.journal.v.norm() + c.bearing.v.norm() + drift.norm() + surfaces(gap).bearing * (std::abs(c.journal.w) + std::abs(c.bearing.w));
    EXPECT_NEAR(m.depth, g.depth, rounding * lengths);
    EXPECT_NEAR(m.rate, g.rate, (rounding + direction) * speeds);
    EXPECT_NEAR(m.material_slip, g.material_slip, (rounding + direction) * speeds);
    EXPECT_NEAR(m.geometric_slip, g.geometric_slip, (rounding + direction) * speeds * (1 + std::abs(g.depth) / g.e.norm()));
  });
}

TYPED_TEST(GapContract, SpinOfTheWholeWorldSlipsByDepthOnly) {
  // Both bodies turning as one rigid body do not change the depth; the two surface points lie
  // `depth` apart along n, so their speeds along Zn differ by just w · depth.
  this->everywhere([](const TypeParam& gap, const Case& c) {
    const double w = 40;  // [rad/s]
    const Case rigid{{c.journal.r, w * perp(c.journal.r), w}, {c.bearing.r, w * perp(c.bearing.r), w}};
    const Gap g = at(gap, rigid);
    const double size = w * (c.journal.r.norm() + surfaces(gap).bearing);
    EXPECT_NEAR(g.rate, 0, rounding * size);
    EXPECT_NEAR(g.material_slip, w * g.depth, rounding * size);
    EXPECT_NEAR(g.geometric_slip, w * g.depth, rounding * size * (1 + std::abs(g.depth) / g.e.norm()));
  });
}

TYPED_TEST(GapContract, IsFiniteWhereverTheCentresAre) {
  for (const TypeParam& gap : over_decades<TypeParam>())
    for (double size : {0.0, 5e-324, 1e-310, 1e-170, 1e-155, 1e-141, 1e-139, 1e-30, 1e3}) {
      const Case c{{{size, -size}, {0.3, 0.4}, 5}, {{0, 0}, {-0.1, 0.2}, -7}};
      const Gap g = at(gap, c);
      EXPECT_NEAR(g.n.norm(), 1, rounding) << size;
      for (double value : {g.depth, g.rate, g.material_slip, g.geometric_slip}) EXPECT_TRUE(std::isfinite(value)) << size;
    }
}

// ---- journal in a bearing: closed forms ------------------------------------------------------

const JournalBearing pin{.journal = 9.5e-3, .bearing = 10e-3};

TEST(JournalBearing, ConcentricPointsAlongXAndIsClearedAllRound) {
  const Gap g = evaluate(pin, {{1, 2}, {0.3, 0.4}, 5}, {{1, 2}, {0, 0}, 0});
  EXPECT_EQ(g.n, Vector2d(1, 0));
  EXPECT_EQ(g.depth, -pin.clearance());
  EXPECT_EQ(g.rate, 0.3);
  EXPECT_EQ(g.geometric_slip, 0);
}

TEST(JournalBearing, TouchesWhenTheEccentricityIsTheClearance) {
  const MovingPoint bearing{{0, 0}, {0, 0}, 0};
  const double c = pin.clearance();
  EXPECT_LT(evaluate(pin, {{0, 0.999 * c}, {0, 0}, 0}, bearing).depth, 0);
  EXPECT_GT(evaluate(pin, {{0, 1.001 * c}, {0, 0}, 0}, bearing).depth, 0);
  EXPECT_NEAR(evaluate(pin, {{0, c}, {0, 0}, 0}, bearing).depth, 0, rounding * c);
}

TEST(JournalBearing, SpinningJournalAgainstAStillWallSlipsByItsSurfaceSpeed) {
  const double w = 100, depth = 1e-6;  // [rad/s], [m]
  const Vector2d e(0, -(pin.clearance() + depth));
  const Gap g = evaluate(pin, {e, {0, 0}, w}, {{0, 0}, {0, 0}, 0});
  EXPECT_NEAR(g.material_slip, w * pin.journal, rounding * w * pin.journal);
  EXPECT_EQ(g.geometric_slip, 0) << "the geometric speed does not see spin";
}

TEST(JournalBearing, RollingJournalDoesNotSlip) {
  // The centre runs round at rate p; no slip in a still bearing where w R_i = −|e| p.
  const double p = 30, depth = 1e-6;  // [rad/s], [m]
  const double distance = pin.clearance() + depth;
  const Vector2d e(distance, 0);
  const Gap g = evaluate(pin, {e, p * perp(e), -distance * p / pin.journal}, {{0, 0}, {0, 0}, 0});
  EXPECT_NEAR(g.material_slip, 0, rounding * distance * p);
  EXPECT_NEAR(g.geometric_slip, depth * p, rounding * distance * p);
}

}  // namespace
}  // namespace pintle::gap_test
