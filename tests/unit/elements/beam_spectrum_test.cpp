// Frequencies and buckling loads of beams and bars, against closed forms and published spectra.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "elements/section.h"
#include "tests/unit/elements/beam_chain.h"

namespace pintle::beam_spectrum_test {
namespace {

// A slope between two meshes whose error is still three or more digits above rounding.
constexpr double order = 0.1;
// Published with five or six digits.
constexpr double printed = 1e-5;

/// The limit that values of second order on n and 2n elements tend to, to fourth order.
double limit(double coarse, double fine) { return fine + (fine - coarse) / 3; }

const BeamEuler euler{.EA = 3e6, .EI = 200, .rhoA = 0.8};
const BeamTimoshenko timoshenko{.EA = 3e6, .EI = 200, .kGA = 1e4, .rhoA = 0.8, .rhoI = 0.01};

// ---- spectra ----

/// βL of the mode near `guess`: cos βL cosh βL = `sign` (−1 clamped–free, 1 free–free).
double beta_root(double guess, double sign) {
  for (int i = 0; i < 20; ++i) {
    const double c = std::cos(guess), s = std::sin(guess), C = std::cosh(guess), S = std::sinh(guess);
    guess -= (c * C - sign) / (c * S - s * C);
  }
  return guess;
}
struct Spectrum {
  std::vector<int> held;
  std::vector<double> beta;  ///< published
  std::function<double(double)> refined;
  int rigid;
};
const Spectrum spectra[] = {
    {{0, 1, 2}, {1.875104, 4.694091, 7.854757}, [](double b) { return beta_root(b, -1); }, 0},
    {{0, 1, -2}, {M_PI, 2 * M_PI, 3 * M_PI}, [](double b) { return b; }, 0},
    {{0}, {4.730041, 7.853205, 10.995608}, [](double b) { return beta_root(b, 1); }, 2},
};
/// Angular frequencies in bending, unit length.
template <class E>
VectorXd spectrum(const E& e, int n, const std::vector<int>& held, bool lumped = false) {
  const Chain<E> c = chain(e, n, 1.0);
  const Dofs free = bending(c.dofs(), held);
  const MatrixXd M = kept(lumped ? c.lumped() : c.M(), free);
  // Free bodies: shifted by a frequency of the size of the lowest.
  const double shift = 100 * e.EI / e.rhoA;
  const VectorXd w = frequencies(kept(c.K(), free) + shift * M, M);
  return (w.array().square() - shift).cwiseMax(0).sqrt();
}

TEST(Beam, FrequenciesConvergeToTheClassicalSpectraAtFourthOrder) {
  for (const Spectrum& s : spectra) {
    const VectorXd coarse = spectrum(euler, 16, s.held), fine = spectrum(euler, 32, s.held);
    for (int k = 0; k < 3; ++k) {
      const double published = s.beta[static_cast<std::size_t>(k)], beta = s.refined(published);
      EXPECT_NEAR(beta, published, 1e-6);
      const double exact = beta * beta * std::sqrt(euler.EI / euler.rhoA);
      const double e16 = coarse[k + s.rigid] / exact - 1, e32 = fine[k + s.rigid] / exact - 1;
      EXPECT_GT(e32, 0) << "a consistent mass bounds from above";
      EXPECT_NEAR(std::log2(e16 / e32), 4, order) << "mode " << k;
    }
  }
}

TEST(Beam, LumpedMassKeepsFourthOrderInAPinnedBeam) {
  const double exact = M_PI * M_PI * std::sqrt(euler.EI / euler.rhoA);
  const double e6 = spectrum(euler, 6, {0, 1, -2}, true)[0] / exact - 1;
  const double e12 = spectrum(euler, 12, {0, 1, -2}, true)[0] / exact - 1;
  EXPECT_LT(std::abs(e12), 1e-5);
  EXPECT_NEAR(std::log2(e6 / e12), 4, order);
}

/// Lower root of the quadratic that half waves of a pinned Timoshenko beam satisfy.
double pinned_timoshenko(const BeamTimoshenko& e, double L, int waves) {
  const double k = waves * M_PI / L, kk = k * k;
  const double a = e.rhoA * e.rhoI / e.kGA, c = e.EI * kk * kk;
  const double b = e.rhoA + e.rhoI * kk + e.rhoA * e.EI * kk / e.kGA;
  return std::sqrt(2 * c / (b + std::sqrt(b * b - 4 * a * c)));
}
BeamTimoshenko deep_beam(ShearFactor factor) {
  const double young = 200e9, nu = 0.3, rho = 8000;
  const Section s = section(RectangleSection{2, 2}, factor, nu);
  return {young * s.A, young * s.I, s.kappa * young / (2 * (1 + nu)) * s.A, rho * s.A, rho * s.I};
}
/// Flexural frequencies of NAFEMS FV5 [Hz].
VectorXd deep_beam_frequencies(const BeamTimoshenko& e, int n) {
  const Chain<BeamTimoshenko> c = chain(e, n, 10.0);
  const Dofs free = bending(c.dofs(), {1, -2});
  return frequencies(kept(c.K(), free), kept(c.M(), free)) / (2 * M_PI);
}
TEST(Beam, DeepBeamOfNafemsHasItsPublishedFrequencies) {
  struct Case {
    ShearFactor factor;
    double f[3];
  };
  for (const Case& k :
       {Case{ShearFactor::cowper, {42.6449, 148.149, 283.468}}, Case{ShearFactor::five_sixths, {42.609, 147.786, 282.363}}}) {
    const VectorXd coarse = deep_beam_frequencies(deep_beam(k.factor), 40);
    const VectorXd fine = deep_beam_frequencies(deep_beam(k.factor), 80);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(fine[i] / k.f[i], 1, 3e-4) << "a fifth of (kh)²/12 = 1.2e-3 in mode 3";
      EXPECT_NEAR(limit(coarse[i], fine[i]) / k.f[i], 1, printed) << "mode " << i + 1;
    }
  }
  const Chain<BeamTimoshenko> c = chain(deep_beam(ShearFactor::cowper), 80, 10.0);
  Dofs axial;
  for (int i = 3; i < c.dofs(); i += 3) axial.push_back(i);
  // A linear rod overshoots by (kh)²/24: 1.6e-5 of the quarter wave on 80 elements.
  EXPECT_NEAR(frequencies(kept(c.K(), axial), kept(c.M(), axial))[0] / (2 * M_PI) / 125, 1, 2e-5);
}

// Shear is constant along an element: second order where elements are shorter than the beam is
// deep, fourth where the beam is slender enough for shear not to count.
TEST(Beam, TimoshenkoFrequenciesConvergeAtSecondOrderDeepAndFourthSlender) {
  const auto slope = [](const BeamTimoshenko& e, int n, int mode) {
    const double exact = pinned_timoshenko(e, 10, mode + 1) / (2 * M_PI);
    const double coarse = deep_beam_frequencies(e, n)[mode];
    return std::log2((coarse / exact - 1) / (deep_beam_frequencies(e, 2 * n)[mode] / exact - 1));
  };
  const BeamTimoshenko deep = deep_beam(ShearFactor::cowper);
  BeamTimoshenko slender = deep;
  slender.EI *= 1e-6;
  slender.rhoI *= 1e-6;
  for (int mode : {0, 1, 2}) {
    EXPECT_NEAR(slope(deep, 12, mode), 2, order) << mode;
    EXPECT_NEAR(slope(slender, 12, mode), 4, order) << mode;
  }
}

// ---- under load ----

/// Lowest pull −P at which K + K_g is singular.
template <class E>
double buckling_load(const E& e, int n) {
  const Chain<E> c = chain(e, n, 1.0);
  const Dofs free = bending(c.dofs(), {1, -2});
  const double w = frequencies(kept(c.K(), free), kept(c.K_g([](double) { return 1; }), free))[0];
  return w * w;
}
// Euler π²EI/L²; with shear, for the work ½N w′², Engesser's P/(1 + P/κGA), of second order.
TEST(Beam, PinnedColumnBucklesUnderEulersAndEngessersLoad) {
  const double P = M_PI * M_PI * euler.EI, with_shear = P / (1 + P / timoshenko.kGA);
  const double e4 = buckling_load(euler, 4) / P - 1, e8 = buckling_load(euler, 8) / P - 1;
  EXPECT_NEAR(std::log2(e4 / e8), 4, order);
  const double t4 = buckling_load(timoshenko, 4) / with_shear - 1;
  const double t8 = buckling_load(timoshenko, 8) / with_shear - 1;
  EXPECT_NEAR(std::log2(t4 / t8), 2, order);
}

// Hinged bars under tension are a string: f = √(N/ρA)/2L, of second order.
TEST(Bar, ChainUnderTensionIsAString) {
  const Bar bar{.EA = 3e6, .rhoA = 0.8};
  const auto error = [&](int n) {
    const Chain<Bar> c = chain(bar, n, 1.0);
    Dofs free;
    for (int i = 3; i < c.dofs() - 2; i += 2) free.push_back(i);
    const MatrixXd K_g = kept(c.K_g([](double) { return 50; }), free);
    return frequencies(K_g, kept(c.M(), free))[0] / (M_PI * std::sqrt(50 / 0.8)) - 1;
  };
  EXPECT_NEAR(std::log2(error(8) / error(16)), 2, order);
}

// REFERENCES.md §4: flapwise η = 2, 6, 10 of a cantilever that spins about its root.
TEST(Beam, SpinningCantileverHasItsPublishedFlapwiseFrequencies) {
  const BeamEuler e{.EA = 1, .EI = 1, .rhoA = 1};
  struct Case {
    double eta, first, second;
  };
  for (const Case& k : {Case{2, 4.1373, 22.6149}, Case{6, 7.3604, 26.8091}, Case{10, 11.2023, 33.6404}}) {
    const auto pull = [&](double s) { return k.eta * k.eta * (1 - s * s) / 2; };
    const auto on = [&](int n) {  // the pull's parabola becomes n chords: second order
      const Chain<BeamEuler> c = chain(e, n, 1.0);
      const Dofs free = bending(c.dofs(), {1, 2});
      return frequencies(kept(c.K() + c.K_g(pull), free), kept(c.M(), free));
    };
    const VectorXd coarse = on(20), fine = on(40);
    EXPECT_NEAR(limit(coarse[0], fine[0]), k.first, 1e-4) << "printed with four decimals";
    EXPECT_NEAR(limit(coarse[1], fine[1]), k.second, 1e-4);
  }
}

}  // namespace
}  // namespace pintle::beam_spectrum_test
