#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>
#include <vector>

#include "slider_crank_clearance.h"

/// A slider-crank whose coupler is one Euler–Bernoulli beam element, hand-derived, with an ideal or
/// a clearance joint between coupler and slider.
///
///   q = (θ, φ, s, α_A, α_B, x): angles of the crank and of the coupler's chord AB from +x [rad],
///   growth of the chord [m], rotations of the coupler's end sections against the chord [rad],
///   position of the slider [m].
///   The crank turns about O on the ground, its pin A is ideal, the slider stays on the x axis and
///   does not turn. Gravity along −y, its energy 0 at y = 0.
///
///   Coupler at 0 ≤ ξ ≤ 1 from A to B, L its length, R(φ) the turn by φ:
///     r = A + R(φ) u,   u = [(L + s) ξ,  L (N₂ α_A + N₄ α_B)],   N₂ = ξ(1 − ξ)²,  N₄ = ξ³ − ξ².
///     T = ∫ ½ρA ṙ·ṙ,   ṙ = J q̇,   M = ∫ρA JᵀJ,   velocity terms ∫ρA Jᵀ(J̇ q̇),
///   by Gauss quadrature exact for these polynomials; sections have no rotary inertia of their own.
///     strain energy ½ EA s²/L + 2 EI (α_A² + α_A α_B + α_B²)/L.
///   Rayleigh damping C = αM_e + βK acts on (ṡ, α̇_A, α̇_B) alone: its part αM_e is that of the
///   frame which rides the chord, and is not the same for another frame.
///
///   Contact as for the rigid coupler (slider_crank_clearance.h), between the coupler's end, centre
///   r(1), which turns at φ̇ + α̇_B, and the slider. Forces act on either body's own surface point.
///
///   Small strain: that bending shortens the chord, by L/30 (2α_A² − α_A α_B + 2α_B²), is left out,
///   and stiffening with it. The slider is ahead of the crank pin, the crank shorter than the
///   coupler.
namespace pintle_oracle::flexible {

/// Defaults are the paper's. One that is computed follows what is given for the fields above it
/// when a Params is made; the paper's damped cases have both ratios 0.04.
struct Params {
  double crank = 0.05, coupler = 0.12;                               ///< lengths [m]
  double crank_mass = 0.3, coupler_mass = 0.21, slider_mass = 0.14;  ///< [kg]
  double crank_inertia = 1e-4;                                       ///< about its mass centre, at mid-length [kg m²]
  double gravity = 9.81;                                             ///< along −y [m/s²]
  double young = 207e9, poisson = 0.3, diameter = 0.01;              ///< [Pa], –, of the coupler [m]
  double rho_a = coupler_mass / coupler;                             ///< ρA [kg/m]
  double ea = young * std::numbers::pi * diameter * diameter / 4;    ///< [N]
  double ei = ea * diameter * diameter / 16;                         ///< [N m²]
  double zeta[2] = {0, 0};                                           ///< ratios at the beam's two lowest frequencies, –
  double clearance = 1e-5;                                           ///< 0: an ideal pin, and nothing of what follows is used [m]
  double bearing_radius = 0.01;                                      ///< [m]
  double stiffness =                                                 ///< K [N/m^1.5]
      hertz_stiffness(bearing_radius - clearance, bearing_radius, young, poisson, true);
  double chi = lankarani_nikravesh(0.9);  ///< –
  double mu = 0, v0 = 1e-3, v1 = 1e-2;    ///< –, [m/s], [m/s]
  Slip slip = Slip::material;
  bool bearing_on_slider = true;
  double speed = 150;          ///< of the crank at the start [rad/s]
  double start_angle = 0;      ///< of the crank [rad]
  double start_e[2] = {0, 0};  ///< journal less bearing centre at the start; at rest there [m]
};

/// Matrices of the coupler for (s, α_A, α_B), chord held.
struct Beam {
  Eigen::Matrix3d mass, stiffness, damping;
  Eigen::Vector3d omega;  ///< natural frequencies, ascending [rad/s]
  double alpha, beta;     ///< [1/s], [s]
};
Beam beam(const Params&);

/// y = (q, q̇, losses by hysteresis, friction, Rayleigh damping [J]).
constexpr int dofs = 6, dynamic = 12, size = 15;
using Y = std::array<double, size>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// M q̈ + velocity = weight + …, all three bodies.
struct Inertia {
  Matrix6 mass;
  Vector6 velocity, weight;
};
Inertia inertia(const Params&, const Y&);

/// Params with what is computed of them once; functions of a Model take Params as well.
struct Model {
  Model(const Params&);
  Params p;
  Beam coupler;
  bool ideal;
  double side, lever;  ///< e = side (B − slider); of the coupler's surface about B [m]
};

/// Journal less bearing centre.
struct Gap {
  Eigen::Vector2d e, e_rate;  ///< [m], [m/s]
  double depth, rate;         ///< |e| − clearance and its rate
};
Gap gap(const Model&, const Y&);
/// Sets φ, x and their rates such that B = slider + offset, at rest against it.
void close_loop(const Params&, Y&, const Eigen::Vector2d& offset = Eigen::Vector2d::Zero());

constexpr double latch_floor = 1e-6;  ///< [m/s]

struct State {
  double t = 0;
  Y y{};
  bool touching = false;
  double latch = latch_floor;  ///< δ̇₀ [m/s]
};

/// Everything seen at one instant.
struct Sample {
  State state;
  Vector6 acceleration;
  Eigen::Vector2d pin_force;                 ///< on the coupler at B, of either joint [N]
  Eigen::Vector2d e;                         ///< journal less bearing centre [m]
  double depth, rate;                        ///< |e| − clearance [m], [m/s]
  double normal, friction, slip;             ///< friction on the journal along Zn [N], [N], [m/s]
  double kinetic, gravity, strain, contact;  ///< energies [J]
  double ledger;                             ///< their sum and the losses [J]: constant
};

struct Impact {
  double begin = 0, end = 0;            ///< [s]
  double approach = 0, separation = 0;  ///< [m/s], both positive; separation 0 if unfinished
  double deepest = 0;                   ///< [m]
  double loss = 0, friction_loss = 0;   ///< in this contact, hysteresis and friction [J]
  bool finished = false;                ///< false: still touching at the end of the run
};

struct Options {
  /// Max-norm of local error over tolerance × scale. With c the clearance (crank length if ideal),
  /// v = ω √(c L₁) and E = m_slider v²: c/L₁, c/L₂, c for θ, φ, x; v/L₁, v/L₂, v for all speeds; E
  /// for losses; for s, α_A, α_B what gives the strain energy E.
  double tolerance = 1e-10;
  double first_step = 1e-7;  ///< [s]
  long max_evaluations = 2'000'000'000;
};

/// Of a run.
struct Result {
  std::vector<Sample> samples;  ///< one for each time asked for
  std::vector<Impact> impacts;
  State end;
  long steps = 0, rejected = 0, evaluations = 0;
  bool completed = false;  ///< false: max_evaluations ran out
};

/// The straight coupler at rest in its chord's axes.
State start(const Params&);
Sample evaluate(const Model&, const State&);
/// dy/dt; of an ideal pin, φ, x and their rates are first set from the rest.
void rhs(const Model&, const State&, Y& dy);

/// From `from` to the last of `times` (ascending) by Dormand–Prince. Steps end at each time, and at
/// the instants at which contact begins and ends, solved for with steps of the method itself to
/// rounding; contact forces act between these only. May be continued from Result::end: a contact
/// under way is then in both lists.
Result simulate(const Model&, const Options&, const State& from, const std::vector<double>& times);

}  // namespace pintle_oracle::flexible
