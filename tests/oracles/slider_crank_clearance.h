#pragma once

#include <array>
#include <functional>

/// A slider-crank in minimal coordinates, hand-derived, with a clearance between coupler and
/// slider.
///
///   Coordinates q = (θ, φ, x): crank and coupler angle from +x [rad], slider position [m].
///   The crank turns about O on the ground, its pin A is ideal, the slider stays on the x axis and
///   does not turn. Mass centres of crank and coupler at mid-length, gravity along −y.
///   Journal and bearing centres: the coupler's end B and the slider's point S = (x, 0).
///
///   e = journal centre − bearing centre, n = e/|e|, t = Zn (quarter turn), depth = |e| − c.
///   N = max(0, K δ^1.5 (1 + χ δ̇/δ̇₀)), δ̇₀ latched when contact begins, not below 1e-6 m/s.
///   Friction μ c_d(slip) N on either body's own surface point, levers R_journal and R_bearing.
namespace pintle_oracle {

enum class Slip {
  material,   ///< of the two surface points in contact: ė·t + R_journal w_journal − R_bearing
              ///< w_bearing
  geometric,  ///< with R ṅ for the motion of the contact point: ė·t (1 − c/|e|)
};
enum class Method { rkf45, dopri54 };

struct Params {
  double crank = 0.05, coupler = 0.12;                               ///< lengths [m]
  double crank_mass = 0.3, coupler_mass = 0.21, slider_mass = 0.14;  ///< [kg]
  double crank_inertia = 1e-4, coupler_inertia = 2.5e-4;             ///< about mass centres [kg m²]
  double gravity = 9.81;                                             ///< along −y [m/s²]
  double clearance = 1e-5, bearing_radius = 0.01;                    ///< [m]
  double stiffness = 0;                                              ///< K [N/m^1.5]
  double chi = 0;                                                    ///< –
  double mu = 0, v0 = 1e-3, v1 = 1e-2;                               ///< –, [m/s], [m/s]
  Slip slip = Slip::material;
  bool bearing_on_slider = true;
  bool driven = false;         ///< crank held at its starting speed by a torque
  double speed = 150;          ///< of the crank at the start [rad/s]
  double start_angle = 0;      ///< of the crank [rad]
  double start_e[2] = {0, 0};  ///< e at the start; ė = 0 there [m]
};

/// K = 4/(3(h+h)) √R of like materials; internal: R = RᵢRⱼ/(Rⱼ − Rᵢ), else RᵢRⱼ/(Rᵢ + Rⱼ).
double hertz_stiffness(double journal_radius, double bearing_radius, double young, double nu, bool internal);
double lankarani_nikravesh(double e);  ///< χ = 3(1 − e²)/4

/// y = (θ, φ, x, rates of these, hysteresis loss, friction loss, the same as the slip in use shows
/// it, work of the drive) [J].
constexpr int size = 10, dynamic = 6;
using Y = std::array<double, size>;

struct State {
  double t = 0;
  Y y{};
  bool touching = false;
  double latch = 1;  ///< δ̇₀ [m/s]
};

/// Everything seen at one instant.
struct Sample {
  State state;
  double acceleration[3];
  double e[2], depth, rate;
  double normal, friction;      ///< forces [N]; friction on the journal along t
  double slip, geometric_slip;  ///< [m/s]
  double torque;                ///< of the drive [N m]
  double energy, stored;        ///< kinetic plus gravity (0 at y = 0); in the contact [J]
  double ledger;                ///< energy + stored + losses − drive work [J]: constant
};

struct Impact {
  double begin = 0, end = 0;
  double approach = 0, separation = 0;  ///< [m/s], both positive; separation 0 if unfinished
  double deepest = 0, peak_force = 0;   ///< [m], [N]
  double loss = 0, friction_loss = 0;   ///< in this contact [J]
  bool finished = false;                ///< false: still touching at the end of the run
};

struct Options {
  Method method = Method::dopri54;
  /// Max-norm of local error over tolerance × scale. Scales: c/L₁, c/L₂, c for positions; for
  /// speeds v/L₁, v/L₂, v with v = ω √(c L₁), the speed of a fall across the clearance; m_slider v²
  /// for energies.
  double tolerance = 1e-9;
  double sample_interval = 0;                 ///< 0: no samples [s]
  double first_step = 1e-7, max_step = 1e-2;  ///< [s]
  long max_evaluations = 2'000'000'000;
};

struct Stats {
  long steps = 0, rejected = 0, evaluations = 0, location_steps = 0;
  int impacts = 0;
  bool completed = false;
};

State start(const Params&);
Sample evaluate(const Params&, const State&);
/// dy/dt. @returns the torque of the drive [N m], 0 if free.
double rhs(const Params&, const State&, Y& dy);

/// Runs `state` to t_end; may be continued (a contact under way is then reported in both parts).
/// Instants at which contact begins and ends are solved for with steps of the method itself, to
/// rounding; contact forces act between them only. Samples come from quintic interpolation of q, q̇,
/// q̈ across steps. Allocates nothing. `rhs` above sets its constants up again at each call;
/// `simulate` does so once.
Stats simulate(const Params&, const Options&, double t_end, State& state, const std::function<void(const Impact&)>& on_impact = {},
               const std::function<void(const Sample&)>& on_sample = {});

/// The same mechanism without clearance: one dof.
struct Ideal {
  double angle, speed, acceleration;  ///< of the crank
  double phi, phi_rate, x, x_rate, x_acceleration;
  double pin_force[2];  ///< on the coupler at B [N]
  double torque;        ///< of the drive [N m]
  double energy;        ///< kinetic plus gravity [J]
};
Ideal evaluate_ideal(const Params&, double angle, double speed);
/// At t, from the start of `params`; driven or free as these say.
Ideal ideal_at(const Params&, double t, double tolerance = 1e-12);

}  // namespace pintle_oracle
