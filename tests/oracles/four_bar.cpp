#include "four_bar.h"

#include <cmath>

namespace pintle_oracle {
namespace {

/// Rates and accelerations of coupler and rocker at known angles.
/// Loop differentiated, dotted with the rocker's and the coupler's direction; Z U(α)·U(β) =
/// sin(β−α).
void differentiate(const FourBar& f, const Turn& crank, Turn& coupler, Turn& rocker) {
  const double a = f.crank, b = f.coupler, c = f.rocker;
  const double s_rc = std::sin(rocker.angle - crank.angle), c_rc = std::cos(rocker.angle - crank.angle);
  const double s_pc = std::sin(coupler.angle - crank.angle), c_pc = std::cos(coupler.angle - crank.angle);
  const double s_rp = std::sin(rocker.angle - coupler.angle), c_rp = std::cos(rocker.angle - coupler.angle);
  coupler.rate = -a * crank.rate * s_rc / (b * s_rp);
  rocker.rate = -a * crank.rate * s_pc / (c * s_rp);
  const double w2 = crank.rate * crank.rate, p2 = coupler.rate * coupler.rate, r2 = rocker.rate * rocker.rate;
  coupler.acceleration = (-a * (crank.acceleration * s_rc - w2 * c_rc) + b * p2 * c_rp - c * r2) / (b * s_rp);
  rocker.acceleration = -(a * (crank.acceleration * s_pc - w2 * c_pc) - b * p2 + c * r2 * c_rp) / (c * s_rp);
}

/// A point at distance r along a link that starts at a moving point: velocity and acceleration.
struct Motion {
  double x, y, u, v, ax, ay;
};
Motion along(const Motion& from, const Turn& link, double r) {
  const double s = r * std::sin(link.angle), c = r * std::cos(link.angle), w2 = link.rate * link.rate;
  return {from.x + c,
          from.y + s,
          from.u - s * link.rate,
          from.v + c * link.rate,
          from.ax - s * link.acceleration - c * w2,
          from.ay + c * link.acceleration - s * w2};
}

void centres(const FourBar& f, const Turn& crank, const FourBarMotion& m, const LinkMass (&links)[3], Motion (&out)[3]) {
  const Motion fixed{}, pivot{f.ground, 0, 0, 0, 0, 0};
  out[0] = along(fixed, crank, links[0].fraction * f.crank);
  out[1] = along(along(fixed, crank, f.crank), m.coupler, links[1].fraction * f.coupler);
  out[2] = along(pivot, m.rocker, links[2].fraction * f.rocker);
}

}  // namespace

FourBarMotion evaluate(const FourBar& f, const Turn& crank) {
  FourBarMotion m{};
  const double bx = f.crank * std::cos(crank.angle), by = f.crank * std::sin(crank.angle);
  const double dx = f.ground - bx, dy = -by, d2 = dx * dx + dy * dy;
  // Meeting point of the circles about the crank's end and the rocker's pivot.
  const double share = 0.5 * (1 + (f.coupler * f.coupler - f.rocker * f.rocker) / d2);
  const double rise2 = f.coupler * f.coupler / d2 - share * share;
  m.closes = rise2 >= 0;
  const double rise = (f.open ? 1 : -1) * std::sqrt(std::fmax(0, rise2));
  const double cx = bx + share * dx - rise * dy, cy = by + share * dy + rise * dx;
  m.coupler.angle = std::atan2(cy - by, cx - bx);
  m.rocker.angle = std::atan2(cy, cx - f.ground);
  differentiate(f, crank, m.coupler, m.rocker);
  return m;
}

double crank_torque(const FourBar& f, const Turn& crank, const LinkMass (&links)[3], double gravity) {
  // Virtual rates: those of a crank turning at 1 rad/s.
  const Turn unit{crank.angle, 1, 0};
  const FourBarMotion real = evaluate(f, crank), virt = evaluate(f, unit);
  Motion at[3], by[3];
  centres(f, crank, real, links, at);
  centres(f, unit, virt, links, by);
  const double alpha[3] = {crank.acceleration, real.coupler.acceleration, real.rocker.acceleration};
  const double rate[3] = {1, virt.coupler.rate, virt.rocker.rate};
  double torque = 0;
  for (int i = 0; i < 3; ++i)
    torque += links[i].mass * (at[i].ax * by[i].u + (at[i].ay + gravity) * by[i].v) + links[i].inertia * alpha[i] * rate[i];
  return torque;
}

double energy(const FourBar& f, const Turn& crank, const LinkMass (&links)[3], double gravity) {
  const FourBarMotion m = evaluate(f, crank);
  Motion at[3];
  centres(f, crank, m, links, at);
  const double rate[3] = {crank.rate, m.coupler.rate, m.rocker.rate};
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += 0.5 * links[i].mass * (at[i].u * at[i].u + at[i].v * at[i].v) + 0.5 * links[i].inertia * rate[i] * rate[i] +
           links[i].mass * gravity * at[i].y;
  return sum;
}

SliderCrankMotion evaluate(const SliderCrank& k, const Turn& crank) {
  const double s1 = std::sin(crank.angle), c1 = std::cos(crank.angle);
  const double s2 = (k.offset - k.crank * s1) / k.coupler;
  const double c2 = (k.forward ? 1 : -1) * std::sqrt(1 - s2 * s2);
  SliderCrankMotion m;
  m.coupler.angle = std::atan2(s2, c2);
  m.coupler.rate = -k.crank * c1 * crank.rate / (k.coupler * c2);
  const double w2 = crank.rate * crank.rate, p2 = m.coupler.rate * m.coupler.rate;
  m.coupler.acceleration = (-k.crank * (c1 * crank.acceleration - s1 * w2) + k.coupler * s2 * p2) / (k.coupler * c2);
  m.x = k.crank * c1 + k.coupler * c2;
  m.x_rate = -k.crank * s1 * crank.rate - k.coupler * s2 * m.coupler.rate;
  m.x_acceleration = -k.crank * (s1 * crank.acceleration + c1 * w2) - k.coupler * (s2 * m.coupler.acceleration + c2 * p2);
  return m;
}

}  // namespace pintle_oracle
