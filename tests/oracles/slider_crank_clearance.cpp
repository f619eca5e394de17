#include "slider_crank_clearance.h"

#include <algorithm>
#include <cmath>

#include "runge_kutta.h"

namespace pintle_oracle {
namespace {

constexpr double latch_floor = 1e-6;  // [m/s]

/// Params with all products of constants taken.
struct Model {
  explicit Model(const Params& p)
      : l1(p.crank),
        l2(p.coupler),
        c(p.clearance),
        K(p.stiffness),
        chi(p.chi),
        mu(p.mu),
        v0(p.v0),
        per_dv(1 / (p.v1 - p.v0)),
        side(p.bearing_on_slider ? 1 : -1),
        lever(p.bearing_on_slider ? p.bearing_radius - p.clearance : p.bearing_radius),
        material(p.slip == Slip::material),
        driven(p.driven),
        m11(p.crank_inertia + (p.crank_mass / 4 + p.coupler_mass) * l1 * l1),
        m22(p.coupler_inertia + p.coupler_mass * l2 * l2 / 4),
        m33(p.slider_mass),
        coupling(p.coupler_mass * l1 * l2 / 2),
        weight1((p.crank_mass / 2 + p.coupler_mass) * p.gravity * l1),
        weight2(p.coupler_mass * p.gravity * l2 / 2) {}
  double l1, l2, c, K, chi, mu, v0, per_dv;
  double side, lever;  // e = side (B − S); lever: of the coupler's surface about B
  bool material, driven;
  double m11, m22, m33, coupling, weight1, weight2;
};

struct Geometry {
  double s1, c1, s2, c2;  // sine and cosine of θ and φ
  double ex, ey, ux, uy;  // e and ė
};

inline Geometry geometry(const Model& m, const Y& y) {
  Geometry g;
  g.s1 = std::sin(y[0]), g.c1 = std::cos(y[0]);
  g.s2 = std::sin(y[1]), g.c2 = std::cos(y[1]);
  g.ex = m.side * (m.l1 * g.c1 + m.l2 * g.c2 - y[2]);
  g.ey = m.side * (m.l1 * g.s1 + m.l2 * g.s2);
  g.ux = -m.side * (m.l1 * g.s1 * y[3] + m.l2 * g.s2 * y[4] + y[5]);
  g.uy = m.side * (m.l1 * g.c1 * y[3] + m.l2 * g.c2 * y[4]);
  return g;
}

struct Contact {
  double px = 0, py = 0, moment = 0;  // on the coupler at B
  double nx = 1, ny = 0, depth = 0, rate = 0;
  double elastic = 0, normal = 0, friction = 0, slip = 0, geometric_slip = 0;
};

inline Contact contact(const Model& m, const Geometry& g, double spin, double latch) {
  Contact f;
  const double r = std::sqrt(g.ex * g.ex + g.ey * g.ey), per_r = r > 0 ? 1 / r : 0;
  if (r > 0) f.nx = g.ex * per_r, f.ny = g.ey * per_r;
  f.depth = r - m.c;
  f.rate = g.ux * f.nx + g.uy * f.ny;
  const double across = g.uy * f.nx - g.ux * f.ny;
  f.slip = across + m.side * m.lever * spin;
  f.geometric_slip = across * f.depth * per_r;
  if (f.depth <= 0 || latch <= 0) return f;
  f.elastic = m.K * f.depth * std::sqrt(f.depth);
  f.normal = std::max(0.0, f.elastic * (1 + m.chi * f.rate / latch));
  if (m.mu > 0) {
    const double v = m.material ? f.slip : f.geometric_slip;
    const double factor = std::clamp((std::abs(v) - m.v0) * m.per_dv, 0.0, 1.0);
    f.friction = -std::copysign(m.mu * factor * f.normal, v);
  }
  f.px = m.side * (-f.normal * f.nx - f.friction * f.ny);
  f.py = m.side * (-f.normal * f.ny + f.friction * f.nx);
  f.moment = m.side * f.friction * m.lever;
  return f;
}

/// @returns the torque of the drive
inline double derivative(const Model& m, const Y& y, bool touching, double latch, Y& dy) {
  Contact f;
  double s1, c1, s2, c2;
  if (touching) {
    const Geometry g = geometry(m, y);
    f = contact(m, g, y[4], latch);
    s1 = g.s1, c1 = g.c1, s2 = g.s2, c2 = g.c2;
  } else {
    s1 = std::sin(y[0]), c1 = std::cos(y[0]), s2 = std::sin(y[1]), c2 = std::cos(y[1]);
  }
  const double m12 = m.coupling * (c1 * c2 + s1 * s2);   // cos(θ − φ)
  const double turn = m.coupling * (s1 * c2 - c1 * s2);  // sin(θ − φ)
  const double f1 = -turn * y[4] * y[4] - m.weight1 * c1 + m.l1 * (f.py * c1 - f.px * s1);
  const double f2 = turn * y[3] * y[3] - m.weight2 * c2 + m.l2 * (f.py * c2 - f.px * s2) + f.moment;
  double torque = 0;
  if (m.driven) {
    dy[3] = 0;
    dy[4] = f2 / m.m22;
    torque = m12 * dy[4] - f1;
  } else {
    const double per_det = 1 / (m.m11 * m.m22 - m12 * m12);
    dy[3] = (m.m22 * f1 - m12 * f2) * per_det;
    dy[4] = (m.m11 * f2 - m12 * f1) * per_det;
  }
  dy[5] = -f.px / m.m33;
  dy[0] = y[3], dy[1] = y[4], dy[2] = y[5];
  dy[6] = (f.normal - f.elastic) * f.rate;
  dy[7] = -f.friction * f.slip;
  dy[8] = -f.friction * (m.material ? f.slip : f.geometric_slip);
  dy[9] = torque * y[3];
  return torque;
}

Sample evaluate(const Model& m, const State& s) {
  Sample out{};
  out.state = s;
  Y dy;
  out.torque = derivative(m, s.y, s.touching, s.latch, dy);
  for (int i = 0; i < 3; ++i) out.acceleration[i] = dy[3 + i];
  const Geometry g = geometry(m, s.y);
  const Contact f = contact(m, g, s.y[4], s.touching ? s.latch : 0);
  out.e[0] = g.ex, out.e[1] = g.ey;
  out.depth = f.depth, out.rate = f.rate;
  out.normal = f.normal, out.friction = f.friction;
  out.slip = f.slip, out.geometric_slip = f.geometric_slip;
  const Y& y = s.y;
  const double m12 = m.coupling * (g.c1 * g.c2 + g.s1 * g.s2);
  out.energy =
      0.5 * (m.m11 * y[3] * y[3] + m.m22 * y[4] * y[4] + m.m33 * y[5] * y[5]) + m12 * y[3] * y[4] + m.weight1 * g.s1 + m.weight2 * g.s2;
  out.stored = 0.4 * f.elastic * std::max(0.0, f.depth);
  out.ledger = out.energy + out.stored + y[6] + y[7] - y[9];
  return out;
}

/// q as quintic in u = (t − t₀)/h through q, q̇, q̈ at both ends; integrals as cubics.
Y interpolate(const Y& a, const Y& da, const Y& b, const Y& db, double h, double u) {
  Y y;
  for (int i = 0; i < 3; ++i) {
    const double v = h * a[3 + i], w = 0.5 * h * h * da[3 + i], w1 = 0.5 * h * h * db[3 + i];
    const double d = b[i] - a[i] - v - w, dv = h * b[3 + i] - v - 2 * w, dw = w1 - w;
    const double k3 = 10 * d - 4 * dv + dw, k4 = -15 * d + 7 * dv - 2 * dw, k5 = 6 * d - 3 * dv + dw;
    y[i] = a[i] + u * (v + u * (w + u * (k3 + u * (k4 + u * k5))));
    y[3 + i] = (v + u * (2 * w + u * (3 * k3 + u * (4 * k4 + u * 5 * k5)))) / h;
  }
  for (int i = dynamic; i < size; ++i) {
    const double d = b[i] - a[i], k2 = 3 * d - h * (2 * da[i] + db[i]), k3 = h * (da[i] + db[i]) - 2 * d;
    y[i] = a[i] + u * (h * da[i] + u * (k2 + u * k3));
  }
  return y;
}

/// One run: the mode (touching or not) is constant within a step and changes at located events.
template <class Pair>
struct Runner {
  const Model m;
  const Options& o;
  State& s;
  const std::function<void(const Impact&)>& on_impact;
  const std::function<void(const Sample&)>& on_sample;
  Vec<size> scale{};
  Stats stats{};
  Impact impact{};
  double loss_before = 0, friction_before = 0, next_sample = 0;
  Y k{}, y_new{}, k_new{}, error{};
  Geometry before{}, after{};  // at both ends of the step

  Y slope(const Y& y) {
    Y dy;
    derivative(m, y, s.touching, s.latch, dy);
    ++stats.evaluations;
    return dy;
  }

  void step(double h) {
    const auto f = [&](const Y& y, Y& dy) { derivative(m, y, s.touching, s.latch, dy); };
    stats.evaluations += embedded_step<Pair, dynamic, size>(f, s.y, k, h, y_new, k_new, error);
  }

  /// Depth and rate towards the next event: into contact if open, out of it if touching.
  std::array<double, 2> margin(const Y& y) const {
    const Geometry g = geometry(m, y);
    const double r = std::hypot(g.ex, g.ey), sign = s.touching ? -1 : 1;
    return {sign * (r - m.c), sign * (g.ux * g.ex + g.uy * g.ey) / r};
  }

  /// First eighth of the step at whose end the margin is crossed, by cubics in e; 0 if none is.
  int crossing(double h) {
    after = geometry(m, y_new);
    const Geometry &a = before, &b = after;
    const double dx = b.ex - a.ex, dy = b.ey - a.ey;
    for (int i = 1; i <= 8; ++i) {
      const double u = i / 8.0, w = u * u * (3 - 2 * u), p = u * (1 - u) * (1 - u), q = u * u * (u - 1);
      const double x = i == 8 ? b.ex : a.ex + w * dx + h * (p * a.ux + q * b.ux);
      const double z = i == 8 ? b.ey : a.ey + w * dy + h * (p * a.uy + q * b.uy);
      if ((x * x + z * z > m.c * m.c) != s.touching) return i;
    }
    return 0;
  }

  /// Shortens the step to end on the event; y_new, k_new and h follow. @returns false if the motion
  /// at `upper` turns out not to have crossed: then that is the step.
  bool locate(double upper, double& h) {
    double low = 0, high = upper, t = upper;
    for (int i = 0; i < 60; ++i) {
      step(h = t);
      ++stats.location_steps;
      const auto [g, rate] = margin(y_new);
      if (i == 0 && g <= 0) return false;
      if (std::abs(g) <= 2e-16 * (m.l1 + m.l2) && rate > 0) break;
      (g > 0 ? high : low) = t;
      if (high - low <= 1e-17) break;
      const double guess = rate > 0 ? t - g / rate : low;
      t = guess > low && guess < high ? guess : 0.5 * (low + high);
    }
    return true;
  }

  void begin_contact() {
    const Contact f = contact(m, geometry(m, s.y), s.y[4], 0);
    if (!s.touching) s.latch = std::max(f.rate, latch_floor);  // a continued run keeps its own
    s.touching = true;
    impact = {};
    impact.begin = s.t;
    impact.approach = f.rate;
    loss_before = s.y[6], friction_before = s.y[7];
    ++stats.impacts;
  }

  void end_contact(bool finished) {
    impact.end = s.t;
    impact.finished = finished;
    if (finished) impact.separation = -contact(m, geometry(m, s.y), s.y[4], 0).rate;
    impact.loss = s.y[6] - loss_before;
    impact.friction_loss = s.y[7] - friction_before;
    if (on_impact) on_impact(impact);
    if (finished) s.touching = false;
  }

  /// Depth, depth's rate, force and force's rate (without the factor K) of a touching state.
  std::array<double, 4> watch(const Y& y, const Y& dy) const {
    const Geometry g = geometry(m, y);
    const Contact f = contact(m, g, y[4], s.latch);
    const double r = std::hypot(g.ex, g.ey), across = g.uy * f.nx - g.ux * f.ny;
    const double ax = m.side * (-m.l1 * (g.s1 * dy[3] + g.c1 * y[3] * y[3]) - m.l2 * (g.s2 * dy[4] + g.c2 * y[4] * y[4]) - dy[5]);
    const double ay = m.side * (m.l1 * (g.c1 * dy[3] - g.s1 * y[3] * y[3]) + m.l2 * (g.c2 * dy[4] - g.s2 * y[4] * y[4]));
    const double rate2 = ax * f.nx + ay * f.ny + across * across / r;
    return {f.depth, f.rate, f.normal, 1.5 * f.rate * (1 + m.chi * f.rate / s.latch) + f.depth * m.chi * rate2 / s.latch};
  }

  /// Deepest point and greatest force, refined inside the step by interpolation.
  void track_peaks(double h) {
    const auto a = watch(s.y, k), b = watch(y_new, k_new);
    impact.deepest = std::max(impact.deepest, b[0]);
    impact.peak_force = std::max(impact.peak_force, b[2]);
    for (const int which : {1, 3}) {
      if (a[which] <= 0 || b[which] > 0) continue;
      double low = 0, high = 1;
      for (int i = 0; i < 30; ++i) {
        const double u = 0.5 * (low + high);
        const Y y = interpolate(s.y, k, y_new, k_new, h, u);
        Y dy;
        derivative(m, y, true, s.latch, dy);
        const auto w = watch(y, dy);
        (w[which] > 0 ? low : high) = u;
        impact.deepest = std::max(impact.deepest, w[0]);
        impact.peak_force = std::max(impact.peak_force, w[2]);
      }
    }
  }

  void emit_samples(double h) {
    while (next_sample <= s.t + h) {
      State at = s;
      at.t = next_sample;
      at.y = interpolate(s.y, k, y_new, k_new, h, (next_sample - s.t) / h);
      on_sample(evaluate(m, at));
      next_sample += o.sample_interval;
    }
  }

  void run(double t_end) {
    if (s.touching) begin_contact();
    k = slope(s.y);
    before = geometry(m, s.y);
    next_sample = s.t;
    double h_next[2] = {o.first_step, o.first_step};  // one memory per mode
    while (s.t < t_end) {
      if (stats.evaluations > o.max_evaluations) return;
      const bool was = s.touching;
      double h = std::min({h_next[was], o.max_step, t_end - s.t});
      const bool cut = h < h_next[was];
      step(h);
      const double ratio = error_ratio<size>(error, scale, o.tolerance);
      if (!(ratio <= 1) && h > 1e-15) {
        ++stats.rejected;
        h_next[was] = h * std::min(1.0, std::isfinite(ratio) ? step_factor(ratio) : 0.1);
        continue;
      }
      const double factor = step_factor(ratio);
      if (!cut || factor < 1) h_next[was] = h * factor;
      bool event = false;
      int eighth = crossing(h);
      while (eighth == 1 && h > 1e-13) {  // just left the last event: separate the two first
        step(h /= 8);
        ++stats.location_steps;
        eighth = crossing(h);
      }
      if (eighth > 0) event = locate(h * eighth / 8, h);
      if (!Pair::fsal) k_new = slope(y_new);
      if (was && on_impact) track_peaks(h);
      if (o.sample_interval > 0 && on_sample) emit_samples(h);
      ++stats.steps;
      s.t = !event && s.t + h >= t_end ? t_end : s.t + h;
      s.y = y_new;
      k = k_new;
      before = eighth > 0 ? geometry(m, s.y) : after;
      if (!event) continue;
      was ? end_contact(true) : begin_contact();
      k = slope(s.y);
    }
    if (s.touching) end_contact(false);
    stats.completed = true;
  }
};

template <class Pair>
Stats run(const Params& p, const Options& o, double t_end, State& s, const std::function<void(const Impact&)>& on_impact,
          const std::function<void(const Sample&)>& on_sample) {
  Runner<Pair> runner{.m = Model(p), .o = o, .s = s, .on_impact = on_impact, .on_sample = on_sample};
  const double c = p.clearance, w = std::max(std::abs(p.speed), std::sqrt(p.gravity / p.crank));
  const double v = w * std::sqrt(c * p.crank), energy = p.slider_mass * v * v;
  runner.scale = {c / p.crank, c / p.coupler, c, v / p.crank, v / p.coupler, v, energy, energy, energy, energy};
  runner.run(t_end);
  return runner.stats;
}

}  // namespace

double hertz_stiffness(double journal_radius, double bearing_radius, double young, double nu, bool internal) {
  const double sum = internal ? bearing_radius - journal_radius : bearing_radius + journal_radius;
  return 4 * young / (6 * (1 - nu * nu)) * std::sqrt(journal_radius * bearing_radius / sum);
}

double lankarani_nikravesh(double e) { return 0.75 * (1 - e * e); }

State start(const Params& p) {
  const double side = p.bearing_on_slider ? 1 : -1;
  const double s1 = std::sin(p.start_angle), c1 = std::cos(p.start_angle);
  const double s2 = (side * p.start_e[1] - p.crank * s1) / p.coupler, c2 = std::sqrt(1 - s2 * s2);
  State s;
  s.y[0] = p.start_angle;
  s.y[1] = std::asin(s2);
  s.y[2] = p.crank * c1 + p.coupler * c2 - side * p.start_e[0];
  s.y[3] = p.speed;
  s.y[4] = -p.crank * c1 * p.speed / (p.coupler * c2);
  s.y[5] = -p.crank * s1 * p.speed - p.coupler * s2 * s.y[4];
  s.touching = std::hypot(p.start_e[0], p.start_e[1]) > p.clearance;
  s.latch = latch_floor;
  return s;
}

Sample evaluate(const Params& p, const State& s) { return evaluate(Model(p), s); }

double rhs(const Params& p, const State& s, Y& dy) { return derivative(Model(p), s.y, s.touching, s.latch, dy); }

Stats simulate(const Params& p, const Options& o, double t_end, State& state, const std::function<void(const Impact&)>& on_impact,
               const std::function<void(const Sample&)>& on_sample) {
  return o.method == Method::rkf45 ? run<Rkf45>(p, o, t_end, state, on_impact, on_sample)
                                   : run<Dopri54>(p, o, t_end, state, on_impact, on_sample);
}

}  // namespace pintle_oracle
