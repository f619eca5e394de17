// Converged values of the cases of Ebrahimi, Salahshoor, Moradi (2017), from the minimal-coordinate
// model: each case at four tolerances, and which of its results agree between the tightest two.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "slider_crank_clearance.h"

using namespace pintle_oracle;

namespace {

constexpr double tolerances[] = {1e-9, 1e-10, 1e-11, 1e-12};
constexpr double permanent = 1e-3;  // a contact longer than this is called continuous [s]

struct Result {
  double tolerance, energy_start, energy, stored, hysteresis, friction, shown, drive, ledger;
  double seconds;
  int settled;  // contacts ended before the first lasting one; −1 if there is none
  Stats stats;
  std::vector<Impact> impacts;
  int ended() const { return stats.impacts - (impacts.empty() || impacts.back().finished ? 0 : 1); }
};

Result run(const Params& p, double t_end, double tolerance, Method method = Method::dopri54) {
  Result r{};
  r.impacts.reserve(100000);
  Options o;
  o.method = method;
  o.tolerance = tolerance;
  State s = start(p);
  const Sample before = evaluate(p, s);
  const auto clock = std::chrono::steady_clock::now();
  r.stats = simulate(p, o, t_end, s, [&](const Impact& i) { r.impacts.push_back(i); });
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  const Sample after = evaluate(p, s);
  r.tolerance = tolerance;
  r.energy_start = before.energy;
  r.energy = after.energy, r.stored = after.stored;
  r.hysteresis = s.y[6], r.friction = s.y[7], r.shown = s.y[8], r.drive = s.y[9];
  r.ledger = after.ledger - before.ledger;
  r.settled = -1;
  for (std::size_t i = 0; i < r.impacts.size() && r.settled < 0; ++i)
    if (r.impacts[i].end - r.impacts[i].begin > permanent) r.settled = static_cast<int>(i);
  return r;
}

double relative(double a, double b) { return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-300}); }

/// Impacts whose times and speeds agree to 1e-6.
std::size_t agreeing(const Result& a, const Result& b) {
  std::size_t n = 0;
  while (n < a.impacts.size() && n < b.impacts.size() && relative(a.impacts[n].begin, b.impacts[n].begin) < 1e-6 &&
         relative(a.impacts[n].approach, b.impacts[n].approach) < 1e-6)
    ++n;
  return n;
}

void report(const std::string& name, const Params& p, double t_end, int shown_impacts = 6) {
  std::printf("\n### %s, %g s\n\nK = %.6e N/m^1.5, chi = %.6f\n\n", name.c_str(), t_end, p.stiffness, p.chi);
  std::printf(
      "| tol | E(0) | E(end) | stored | hysteresis | friction | shown by slip in use | drive "
      "| contacts | of these ended | before the first over 1 ms | ledger | steps | evaluations | "
      "ms | ns/eval |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<Result> all;
  for (const double tolerance : tolerances) {
    all.push_back(run(p, t_end, tolerance));
    const Result& r = all.back();
    std::printf(
        "| %.0e | %.9f | %.9f | %.3e | %.9e | %.9e | %.9e | %.7g | %d | %d | %d | %.1e | %ld | %ld "
        "| %.2f | %.0f |\n",
        tolerance, r.energy_start, r.energy, r.stored, r.hysteresis, r.friction, r.shown, r.drive, r.stats.impacts, r.ended(), r.settled,
        r.ledger, r.stats.steps, r.stats.evaluations, r.seconds * 1e3, r.seconds * 1e9 / static_cast<double>(r.stats.evaluations));
    std::fflush(stdout);
  }
  const Result &a = all[2], &b = all[3];
  const Result other = run(p, t_end, 1e-11, Method::rkf45);
  const double change = std::max(relative(a.hysteresis, b.hysteresis), relative(other.hysteresis, b.hysteresis));
  std::printf("\nRKF45 at 1e-11: E(end) %.9f, hysteresis %.9e, %d impacts, %ld evaluations.\n", other.energy, other.hysteresis,
              other.stats.impacts, other.stats.evaluations);
  std::printf(
      "Agreeing impacts (1e-11 | 1e-12, and RKF45): %zu and %zu of %d. Hysteresis changes by "
      "%.1e: %s. Count %s.\n\n",
      agreeing(a, b), agreeing(other, b), b.stats.impacts, change, change < 1e-4 ? "converged" : "NOT converged",
      a.stats.impacts == b.stats.impacts && other.stats.impacts == b.stats.impacts ? "converged" : "NOT converged");
  std::printf(
      "| begin [s] | approach [m/s] | separation [m/s] | duration [s] | deepest [m] | peak "
      "[N] | hysteresis [J] | friction [J] |\n|---|---|---|---|---|---|---|---|\n");
  for (int i = 0; i < shown_impacts && i < static_cast<int>(b.impacts.size()); ++i) {
    const Impact& x = b.impacts[static_cast<std::size_t>(i)];
    std::printf("| %.12e | %.10e | %.10e | %.6e | %.8e | %.8e | %.8e | %.8e |%s\n", x.begin, x.approach, x.separation, x.end - x.begin,
                x.deepest, x.peak_force, x.loss, x.friction_loss, x.finished ? "" : " (unfinished)");
  }
}

Params slider_crank(double clearance, double speed, double e, bool internal = true) {
  Params p;
  p.clearance = clearance;
  p.speed = speed;
  p.stiffness = hertz_stiffness(p.bearing_radius - clearance, p.bearing_radius, 207e9, 0.3, internal);
  p.chi = lankarani_nikravesh(e);
  return p;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  const auto wanted = [&](const char* name) { return only.empty() || only == name; };
  char name[120];
  if (wanted("table2"))
    for (const bool internal : {true, false})
      for (const double speed : {50.0, 100.0, 150.0, 200.0}) {
        std::snprintf(name, sizeof name, "Table 2: %g rad/s, c = 0.01 mm, e = 0.8, %s radius", speed, internal ? "internal" : "external");
        report(name, slider_crank(1e-5, speed, 0.8, internal), 0.05);
      }
  if (wanted("clearance"))
    for (const bool internal : {true, false})
      for (const double c : {1e-5, 1e-4, 5e-4})
        for (const double t_end : {0.05, 1.0}) {
          if (!internal && t_end > 0.5) continue;
          std::snprintf(name, sizeof name, "Clearance size: c = %g mm, 150 rad/s, e = 0.8, %s radius", c * 1e3,
                        internal ? "internal" : "external");
          report(name, slider_crank(c, 150, 0.8, internal), t_end, t_end > 0.5 ? 0 : 12);
        }
  if (wanted("friction"))
    for (const double e : {0.9, 0.8})
      for (const Slip slip : {Slip::material, Slip::geometric})
        for (const double mu : {0.0, 0.01, 0.05, 0.1, 0.2, 0.3}) {
          if (slip == Slip::geometric && mu == 0) continue;
          for (const double t_end : {0.02, 0.1}) {
            Params p = slider_crank(2e-3, 300, e);
            p.mu = mu, p.slip = slip;
            std::snprintf(name, sizeof name, "Fig. 9: c = 2 mm, 300 rad/s, e = %g, mu = %g, %s slip", e, mu,
                          slip == Slip::material ? "material" : "geometric");
            report(name, p, t_end, t_end > 0.05 ? 0 : 6);
          }
        }
  if (wanted("start"))
    for (const double e : {0.9, 0.8})
      for (const bool near : {false, true})
        for (const double t_end : {0.02, 0.1}) {
          Params p = slider_crank(2e-3, 300, e);
          p.mu = 0.01;
          if (near) p.start_e[0] = -(p.clearance - 1e-8);
          std::snprintf(name, sizeof name, "Fig. 11: %s start, c = 2 mm, 300 rad/s, mu = 0.01, e = %g", near ? "near-wall" : "concentric",
                        e);
          report(name, p, t_end, t_end > 0.05 ? 0 : 6);
        }
  if (wanted("driven")) {
    const double speed = 5000 * 2 * 3.14159265358979323846 / 60;
    for (const double e : {0.9, 0.8})
      for (const bool first : {true, false})
        for (const double t_end : {0.012, 0.024}) {
          Params p = slider_crank(first ? 1e-5 : 5e-4, speed, e);
          p.driven = true;
          p.mu = first ? 0 : 0.1;
          std::snprintf(name, sizeof name, "Fig. 3: driven 5000 rpm, c = %g mm, mu = %g, e = %g", p.clearance * 1e3, p.mu, e);
          report(name, p, t_end, t_end > 0.02 ? 0 : 6);
        }
  }
  return 0;
}
