#include "framework/build/build.h"
#include "tests/paper/cases.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace paper {

Run run(const std::string& name, const Change& change, const Overrides& set) {
  Scene scene = read_scene(source / "examples/paper" / (name + ".yaml"), set);
  if (change) change(scene);
  const Model model = build(scene);
  return simulate(scene, model, assemble(scene, model));
}

SceneClearance& clearance(Scene& s) {
  for (SceneJoint& j : s.joints)
    if (j.clearance) return *j.clearance;
  throw std::runtime_error("a scene without clearance");
}

Change tolerance(double value) {
  return [value](Scene& s) { s.run.tolerance = value; };
}
Change output(double every, double until, double tol) {
  return [=](Scene& s) {
    s.output.every = every;
    s.run.tolerance = tol;
    if (until > 0) s.run.until = until;
  };
}

double energy(const Energies& e) { return e.kinetic + e.gravity + e.strain; }
double loss(const Run& r) { return energy(r.first) - energy(r.last); }
int ended(const Run& r) {
  return static_cast<int>(std::ranges::count_if(r.impacts, [](const Impact& i) { return std::isfinite(i.end); }));
}

Vector scaled(Vector v, double by) {
  for (double& x : v) x *= by;
  return v;
}
Vector column(const Run& r, const std::string& name, double by) { return scaled(r.trajectory.column(name), by); }
Vector ms(const Run& r) { return column(r, "t [s]", 1e3); }
Vector energies(const Run& r) {
  Vector e = r.ledger.column("kinetic [J]");
  for (const char* other : {"gravity [J]", "strain [J]"})
    if (std::ranges::find(r.ledger.header, other) != r.ledger.header.end()) {
      const Vector more = r.ledger.column(other);
      for (std::size_t i = 0; i < e.size(); ++i) e[i] += more[i];
    }
  return e;
}
double loss_at(const Run& r, double t) {
  const Vector time = r.ledger.column("t [s]"), e = energies(r);
  const auto at = std::ranges::lower_bound(time, t - 1e-9) - time.begin();
  return e.front() - e[static_cast<std::size_t>(at)];
}
/// Zero if the run keeps no such account.
double ledger_at(const Run& r, const std::string& name, double t) {
  if (std::ranges::find(r.ledger.header, name) == r.ledger.header.end()) return 0;
  const Vector time = r.ledger.column("t [s]"), e = r.ledger.column(name);
  return e[static_cast<std::size_t>(std::ranges::lower_bound(time, t - 1e-9) - time.begin())];
}
double largest(const Vector& v) {
  double m = 0;
  for (const double x : v) m = std::max(m, std::abs(x));
  return m;
}

Vector magnitude(const Run& r, const std::string& x, const std::string& y) {
  Vector a = column(r, x);
  const Vector b = column(r, y);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::hypot(a[i], b[i]);
  return a;
}
/// Where the joint is open: zero.
Vector while_touching(const Run& r, const std::string& name, double by) {
  Vector v = column(r, name, by);
  const Vector d = column(r, pin + "depth [m]");
  for (std::size_t i = 0; i < v.size(); ++i)
    if (d[i] <= 0) v[i] = 0;
  return v;
}
Curve circle(const std::string& label, double radius) {
  Curve c{label, {}, {}, true};
  for (int i = 0; i <= 360; ++i) c.x.push_back(radius * std::cos(i * pi / 180)), c.y.push_back(radius * std::sin(i * pi / 180));
  return c;
}
Curve orbit(const std::string& label, const Run& r, double by) {
  return {label, column(r, pin + "ex [m]", by), column(r, pin + "ey [m]", by)};
}

std::string six_headers(const std::string& first) {
  std::string s = "| " + first + " |", line = "\n|---|";
  for (const Printed& p : in_print) s += std::string(" ") + p.what + " |", line += "---|";
  return s + line + "\n";
}
std::string printed_row() {
  std::string s = "| *printed* |";
  for (const Printed& p : in_print)
    s += p.loss > 0 ? printed(" *%d; %.1f mJ* |", p.collisions, 1e3 * p.loss) : printed(" *%d* |", p.collisions);
  return s + "\n";
}
/// One row: contacts that ended and loss, of the six cases under one change.
std::string six_row(const std::string& first, const Change& change, bool judge) {
  constexpr std::array<double, 4> after{0.5775, 2.3100, 5.1973, 9.2393};  // printed energies at 50 ms
  std::string s = "| " + first + " |";
  int inside = 0;
  std::size_t k = 0;
  for (const Printed& p : in_print) {
    const Run r = run(p.scene, [&](Scene& scene) {
      scene.output.every = 0.05;
      change(scene);
    });
    s += r.status == Status::failed ? std::string(" fails |") : printed(" %d; %.3g mJ |", ended(r), 1e3 * loss(r));
    if (k < 4) inside += std::abs(r.first.kinetic - loss(r) - after[k]) <= 5e-5;
    ++k;
  }
  if (judge) s += printed(" %d |", inside);
  return s + "\n";
}

}  // namespace paper
