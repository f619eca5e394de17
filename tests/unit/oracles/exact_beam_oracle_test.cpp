// The oracle of large beam motion at rest and in small vibration, against closed forms and printed
// elastica.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "framework/build/build.h"
#include "tests/oracles/exact_beam.h"
#include "tests/oracles/exact_beam_mesh.h"
#include "tests/oracles/runge_kutta.h"
#include "tests/unit/oracles/exact_beam_samples.h"

namespace pintle_oracle::exact_beam_oracle_test {
namespace {

using Eigen::Vector3d;

// Half a unit of the fifth printed decimal.
constexpr double printed = 0.5e-5;

ExactBeam cantilever(ExactBeam beam, const Place& load) {
  beam.a.hold = Hold::clamp;
  beam.b.load = load;
  return beam;
}

// ---- equations ----

TEST(ExactBeam, TangentIsTheDerivativeOfItsForce) {
  const double difference = 1e-7;  // central differences in double
  for (ExactBeam beam = soft(); beam.degree >= 1; --beam.degree) {
    beam.elements = 2;
    const BeamMesh mesh = build(beam, flat());  // free: z = u
    BeamVector u = initial(mesh, flat()).z, along(u.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      u[i] += 0.3 * std::sin(1.0 + 2.0 * double(i));
      along[i] = std::cos(3.0 * double(i));
    }
    const Internal at = internal(mesh, u, true);
    BeamVector slope = BeamVector::Zero(u.size());
    for (std::size_t e = 0; e < at.tangents.size(); ++e) {
      const ElementMatrix& K = at.tangents[e];
      slope.segment(mesh.first[e], K.rows()) += K * along.segment(mesh.first[e], K.cols());
    }
    const double h = 1e-5;
    const Internal up = internal(mesh, u + h * along, false), down = internal(mesh, u - h * along, false);
    EXPECT_LT((slope - (up.force - down.force) / (2 * h)).norm(), difference * slope.norm());
    EXPECT_NEAR(at.force.dot(along), (up.energy - down.energy) / (2 * h), difference * at.force.norm() * along.norm());
  }
}

// ---- statics ----

TEST(ExactBeam, EndCoupleRollsItIntoACircle) {
  ExactBeam beam{.length = 2, .EA = 1e8, .EI = 3, .GA = 1e8, .rhoA = 1, .rhoI = 1};
  for (beam.degree = 1; beam.degree <= 3; ++beam.degree) {
    const Place end = tip(static_shape(cantilever(beam, {0, 0, 2 * pi * beam.EI / beam.length}), flat()));
    EXPECT_NEAR(end[0], 0, rounding * beam.length) << beam.degree;
    EXPECT_NEAR(end[1], 0, rounding * beam.length) << beam.degree;
    EXPECT_NEAR(end[2], 2 * pi, rounding) << beam.degree;
  }
}

// Mattiasson (1981), from elliptic integrals; 1/EA = 1e-8 is below the print.
TEST(ExactBeam, MeetsPrintedElastica) {
  ExactBeam beam{.length = 1, .EA = 1e8, .EI = 1, .GA = 1e8, .rhoA = 1, .rhoI = 1};
  beam.elements = 16;
  const double table[][3] = {{1, 0.05643, 0.30172}, {10, 0.55500, 0.81061}};
  for (const auto& [load, shortening, deflection] : table) {
    const Place end = tip(static_shape(cantilever(beam, {0, load, 0}), flat()));
    EXPECT_NEAR(1 - end[0], shortening, printed) << load;
    EXPECT_NEAR(end[1], deflection, printed) << load;
  }
}

/// A cantilever's place at a station by shooting for the couple at its clamp. The internal force is
/// the load P all along, m′ = −r′ × P. The load grows in steps, which keeps to the branch of the
/// straight beam.
Place shoot(const ExactBeam& beam, double station) {
  const auto at = [&beam](double part, double couple, double length) {
    const Place load = part * beam.b.load;
    const auto rhs = [&beam, &load](const Vec<4>& y, Vec<4>& dy) {
      const double c = std::cos(y[2]), s = std::sin(y[2]);
      const double stretch = 1 + (c * load[0] + s * load[1]) / beam.EA;
      const double shear = (-s * load[0] + c * load[1]) / beam.GA;
      dy = {c * stretch - s * shear, s * stretch + c * shear, y[3] / beam.EI, 0};
      dy[3] = dy[1] * load[0] - dy[0] * load[1];
    };
    return integrate_tightly<4>(rhs, {0, 0, 0, couple}, length, 1e-13, {1, 1, 1, 1});
  };
  double m = 0;
  for (const double part : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    const auto rest = [&](double couple) { return at(part, couple, beam.length)[3] - part * beam.b.load[2]; };
    double before = m - 0.1, rest_before = rest(before), now = rest(m);
    for (int i = 0; i < 30 && now != rest_before && std::abs(now) > 1e-14; ++i) {
      const double next = m - now * (m - before) / (now - rest_before);
      before = m;
      rest_before = now;
      m = next;
      now = rest(m);
    }
  }
  const Vec<4> y = at(1, m, station);
  return {y[0], y[1], y[2]};
}

TEST(ExactBeam, MeetsTheElasticaThatStretchesAndShears) {
  for (const Place& load : {Place(0, 3, 0), Place(-1, 4, 0.5), Place(6, -2, 1)}) {
    ExactBeam beam = cantilever(soft(), load);
    beam.elements = 64;
    const Place want = shoot(beam, beam.length), got = tip(static_shape(beam, flat()));
    EXPECT_LT((got - want).norm(), rounding * 10) << load.transpose();  // the shooting's tolerance
  }
}

TEST(ExactBeam, ElementEndsConvergeWithTwiceTheDegree) {
  ExactBeam beam = cantilever(soft(), {0, 4, 0});
  const Place want = shoot(beam, beam.length);
  for (beam.degree = 1; beam.degree <= 3; ++beam.degree) {
    const auto error = [&](int n) {
      beam.elements = n;
      return (tip(static_shape(beam, flat())) - want).norm();
    };
    EXPECT_GT(slope(error(8), error(16)), 2 * beam.degree - order) << beam.degree;
  }
}

TEST(ExactBeam, PlacesWithinElementsConvergeWithTheDegreeAndOne) {
  ExactBeam beam = cantilever(soft(), {0, 4, 0});
  const double s = beam.length / 3;  // two thirds into an element of 8, 32, 128
  const Place want = shoot(beam, s);
  for (beam.degree = 1; beam.degree <= 3; ++beam.degree) {
    const auto error = [&](int n) {
      beam.elements = n;
      return (place_at(beam, static_shape(beam, flat()), s) - want).norm();
    };
    EXPECT_GT(slope(error(8), error(32)) / 2, beam.degree + 1 - order) << beam.degree;
  }
}

TEST(ExactBeam, SmallLoadDeflectsAsTimoshenkoSays) {
  const double small = 1e-5;  // the next term is of its square
  ExactBeam beam = cantilever(soft(), {0, small, 0});
  beam.gravity = {0, -2 * small};
  beam.b.mass = 0.75;
  const double L = beam.length, q = beam.rhoA * beam.gravity[1];
  const double P = small + beam.b.mass * beam.gravity[1];
  const double want = P * (L * L * L / (3 * beam.EI) + L / beam.GA) + q * (L * L * L * L / (8 * beam.EI) + L * L / (2 * beam.GA));
  EXPECT_NEAR(tip(static_shape(beam, flat(), 1))[1], want, 1e-8 * std::abs(want));
}

// ---- frequencies ----

struct Mode {
  double k, w, turn;  ///< deflection sin ks, section's turn `turn`·cos ks
};
// (GA k² − ρA ω²)(EI k² + GA − ρI ω²) = GA² k²,  k = nπ/L
Mode pinned_mode(const ExactBeam& beam, int n) {
  const double k = n * pi / beam.length, shear = beam.GA * k * k, bend = beam.EI * k * k;
  const double a = beam.rhoA * beam.rhoI, b = shear * beam.rhoI + beam.rhoA * (bend + beam.GA);
  const double w2 = 2 * shear * bend / (b + std::sqrt(b * b - 4 * a * shear * bend));
  return {k, std::sqrt(w2), (shear - beam.rhoA * w2) / (beam.GA * k)};
}
/// Of the beam thrown into the mode, from its second return through zero [s].
double measured_period(ExactBeam beam, int n) {
  beam.a.hold = Hold::hinge;
  beam.b.hold = Hold::slide;
  const Mode mode = pinned_mode(beam, n);
  const BeamStart start = [&mode](double s) {
    const double speed = 1e-5;  // the frequency follows its square
    return SectionMotion{.place = {s, 0, 0}, .rate = {0, speed * std::sin(mode.k * s), speed * mode.turn * std::cos(mode.k * s)}};
  };
  const double T = 2 * pi / mode.w, before = 1.999 * T, after = 2.001 * T;
  const auto frames = simulate(beam, start, {before, after}, T / 50);
  const double s = 0.5 * beam.length / n;
  const double y0 = place_at(beam, frames[0].place, s)[1], y1 = place_at(beam, frames[1].place, s)[1];
  return (before * y1 - after * y0) / (y1 - y0) / 2;
}

// At 16 elements and 50 steps a period the third mode is 5e-7 off, the others less.
TEST(ExactBeam, PinnedBeamVibratesAsTimoshenkoSays) {
  ExactBeam beam = soft();
  beam.elements = 16;
  for (const int n : {1, 2, 3}) EXPECT_NEAR(measured_period(beam, n) * pinned_mode(beam, n).w / (2 * pi), 1, 1e-6) << n;
}

TEST(ExactBeam, FrequenciesConvergeWithTwiceTheDegree) {
  ExactBeam beam = soft();
  for (beam.degree = 1; beam.degree <= 3; ++beam.degree) {
    const auto error = [&beam](int elements) {
      beam.elements = elements;
      return measured_period(beam, 1) * pinned_mode(beam, 1).w / (2 * pi) - 1;
    };
    const int coarse = beam.degree == 3 ? 4 : 8;
    EXPECT_NEAR(slope(error(coarse), error(2 * coarse)), 2 * beam.degree, order) << beam.degree;
  }
}

// x tan x = ρA L/m, x = ωL √(ρA/EA)
TEST(ExactBeam, PointMassAtItsEndSlowsItsAxialVibration) {
  ExactBeam beam = soft();
  beam.a.hold = Hold::hinge;
  beam.b.mass = 0.7;
  double x = 1;
  for (int i = 0; i < 60; ++i) x = std::atan(beam.rhoA * beam.length / beam.b.mass / x);
  const double w = x / beam.length * std::sqrt(beam.EA / beam.rhoA), T = 2 * pi / w;
  const BeamStart start = [&](double s) {
    SectionMotion at{.place = {s, 0, 0}};
    at.rate[0] = 1e-5 * std::sin(x * s / beam.length);
    return at;
  };
  const auto frames = simulate(beam, start, {0.25 * T, 0.5 * T}, T / 200);
  const double swing = 1e-5 * std::sin(x) / w;
  EXPECT_NEAR(tip(frames[0].place)[0] - beam.length, swing, 1e-6 * swing);
  EXPECT_NEAR(tip(frames[1].place)[0] - beam.length, 0, 1e-6 * swing);
}

// ---- refusals ----

TEST(ExactBeam, RefusesWhatCannotBe) {
  const std::vector<std::function<void(ExactBeam&)>> wrongs{
      [](ExactBeam& b) { b.EI = 0; },
      [](ExactBeam& b) { b.degree = 4; },
      [](ExactBeam& b) { b.elements = 0; },
      [](ExactBeam& b) { b.b.mass = -1; },
      [](ExactBeam& b) {
        b.b = {.hold = Hold::slide, .line = {0, 0}};
      },
      [](ExactBeam& b) {
        b.a.law = crank_pin({0, 0}, 1, [](double) { return Vector3d::Zero(); });
      },
  };
  for (std::size_t i = 0; i < wrongs.size(); ++i) {
    ExactBeam beam = soft();
    wrongs[i](beam);
    EXPECT_THROW(simulate(beam, flat(), {0}, 0.1), std::invalid_argument) << i;
  }
}

TEST(ExactBeam, RefusesAStartOffItsSupports) {
  ExactBeam beam = soft();
  beam.a.hold = Hold::hinge;
  beam.b.hold = Hold::slide;
  const auto refuses = [&beam](const BeamStart& start) { EXPECT_THROW(simulate(beam, start, {0}, 0.1), std::invalid_argument); };
  refuses(rigid_start({0, 0, 0}, {1e-3, 0, 0}));  // A moves off its hinge
  refuses(rigid_start({0, 0, 0}, {0, 0, 1e-3}));  // B moves off its line
  beam.a.law = crank_pin({1, 0}, 0.5, [](double) { return Vector3d::Zero(); });
  refuses(flat());  // the pin is elsewhere
  EXPECT_NO_THROW(simulate(beam, rigid_start({1.5, 0, 0}), {0}, 0.1));
}

TEST(ExactBeam, SaysWhereNoEquilibriumIsFound) {
  ExactBeam loose = soft();
  loose.b.load = {0, 1, 0};
  EXPECT_THROW(static_shape(loose, flat()), std::runtime_error);
}

}  // namespace
}  // namespace pintle_oracle::exact_beam_oracle_test
