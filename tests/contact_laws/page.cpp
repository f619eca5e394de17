// Laws of contact against meshed bodies that touch: writes docs/contact_laws.md and docs/contact_laws/*.svg.
//   contact_laws_page            the page; minutes
//   contact_laws_page --check    the closed forms alone: 1 where one is missed
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "contact/cylinder_law.h"
#include "framework/plots/plot.h"
#include "tests/contact_laws/disc_in_eye.h"

namespace {

using namespace pintle;
using pintle_test::DiscInEye;
using pintle_test::Pressed;
using pintle_test::PressedDisc;
using std::numbers::pi;

constexpr double young = 207e9, poisson = 0.3, radius = 10e-3, length = 10e-3;  // of contact.md's tables
constexpr double modulus = young / (2 * (1 - poisson * poisson));
constexpr double force_unit = modulus * length * radius;
const std::vector<double> clearances{1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}, loads{1, 10, 100, 1e3, 1e4, 1e5};
constexpr double finest = 2e-4, growth = 0.15;

template <class... T>
std::string printed(const char* format, T... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// A law's force at a depth, and whether its author's assumptions hold there.
struct Law {
  std::string name;
  std::function<std::optional<DampedLaw>(double clearance)> of;
};
std::vector<Law> laws() {
  std::vector<Law> out{{"K δ^1.5", [](double c) {
                          const double R = (radius - c) * radius / c;
                          return std::optional(DampedLaw{.elastic = PowerForce{4.0 / 3 * modulus * std::sqrt(R), 1.5}});
                        }}};
  for (const CylinderLaw& law : cylinder_laws())
    out.push_back({std::string(law.name), [&law](double c) -> std::optional<DampedLaw> {
                     if (c < law.least_clearance * (1 - 1e-9) || c > law.most_clearance) return std::nullopt;
                     return law.law({radius - c, -radius, length, modulus});
                   }});
  return out;
}

struct Case {
  double clearance, force;  ///< [m], [N]
  Pressed found;
  double depth() const { return found.depth * radius; }
  double degrees() const { return found.half_angle * 180 / pi; }
};

std::vector<Case> measured() {
  std::vector<Case> out;
  for (const double c : clearances) {
    const PressedDisc disc({.clearance = c / radius, .finest = finest, .growth = growth});
    for (const double f : loads) out.push_back({c, f, disc.press(f / force_unit)});
    std::cerr << "clearance " << c << " m: " << disc.dofs() << " degrees of freedom\n";
  }
  return out;
}

/// Relative error of a law's force at the depth found; none where it gives no constants.
std::optional<double> error(const Law& law, const Case& c) {
  const auto of = law.of(c.clearance);
  if (!of) return std::nullopt;
  return evaluate(of->elastic, c.depth()).force / c.force - 1;
}
bool beyond(const Law& law, const Case& c) {
  const auto of = law.of(c.clearance);
  return of && c.depth() > of->deepest;
}
std::string percent(double e) { return std::abs(e) < 9.995 ? printed("%+.0f", 100 * e) : printed("%+.1g", 100 * e); }

std::string errors_table(const std::vector<Case>& cases, const std::vector<Law>& all) {
  std::string out = "| ΔR | F [N] | F/(E\\*LΔR) | half-angle | depth |", rule = "|---|---|---|---|---|";
  for (const Law& l : all) out += " " + l.name + " |", rule += "---|";
  out += "\n" + rule + "\n";
  for (const Case& c : cases) {
    out += printed("| %g µm | %g | %.1e | %.2f° | %.3g µm |", c.clearance * 1e6, c.force, c.force / (modulus * length * c.clearance),
                   c.degrees(), c.depth() * 1e6);
    for (const Law& l : all) {
      const auto e = error(l, c);
      out += !e ? " – |" : beyond(l, c) ? " (" + percent(*e) + ") |" : " " + percent(*e) + " |";
    }
    out += "\n";
  }
  return out;
}

std::string summary_table(const std::vector<Case>& cases, const std::vector<Law>& all) {
  constexpr double edges[] = {0, 1, 5, 15, 30, 60, 180};
  std::string out = "| half-angle | cases |", rule = "|---|---|";
  for (const Law& l : all) out += " " + l.name + " |", rule += "---|";
  out += "\n" + rule + "\n";
  for (int i = 0; i < 6; ++i) {
    std::vector<const Case*> in;
    for (const Case& c : cases)
      if (c.degrees() >= edges[i] && c.degrees() < edges[i + 1]) in.push_back(&c);
    if (in.empty()) continue;
    out += printed("| %g° to %g° | %zu |", edges[i], edges[i + 1], in.size());
    for (const Law& l : all) {
      double least = 1e300, most = -1e300;
      for (const Case* c : in)
        if (const auto e = error(l, *c)) least = std::min(least, *e), most = std::max(most, *e);
      out += least > most ? " – |" : " " + percent(least) + " to " + percent(most) + " |";
    }
    out += "\n";
  }
  return out;
}

/// What the place of the reference adds, over F/(E*L).
std::string reference_table() {
  struct Row {
    const char* words;
    DiscInEye disc;
  };
  std::vector<Row> rows;
  for (const double outer : {1.5, 2.0, 3.0, 5.0, 10.0, 20.0}) {
    static std::vector<std::string> words;
    words.reserve(8);
    words.push_back(printed("eye held at %g R_j, disc loaded evenly", outer));
    rows.push_back({words.back().c_str(), {.outer = outer}});
  }
  rows.push_back({"eye held at 2 R_j, disc loaded and measured at a rigid core of 0.5 R_i", {.core = 0.5, .load_in_the_middle = true}});
  rows.push_back({"the same, core of 0.1 R_i", {.core = 0.1, .load_in_the_middle = true}});
  const std::vector<double> forces{1e-6, 1e-5, 1e-4};
  std::string out = "| reference | (δ − johnson)/(F/(E\\*L)) at F/(E\\*LR_j) = 1e-6 | 1e-5 | 1e-4 |\n|---|---|---|---|\n";
  for (Row& r : rows) {
    r.disc.clearance = 1e-2, r.disc.finest = 5e-4, r.disc.growth = growth;
    const PressedDisc disc(r.disc);
    out += printed("| %s |", r.words);
    for (const double f : forces) {
      const double johnson = f / pi * (std::log(4 * pi * r.disc.clearance / f) - 1);
      out += printed(" %+.3f |", (disc.press(f).depth - johnson) / f);
    }
    out += "\n";
  }
  return out;
}

std::string refinement_table() {
  std::string out =
      "| finest side, growth | degrees of freedom | ΔR = 1 mm, 1 N | 0.1 mm, 1 kN | 10 µm, 10 kN | 0.01 µm, 100 kN "
      "|\n|---|---|---|---|---|---|\n";
  const double at[][2] = {{1e-3, 1}, {1e-4, 1e3}, {1e-5, 1e4}, {1e-8, 1e5}};
  for (const double part : {2.0, 1.0, 0.5}) {
    out += printed("| %g, %g |", part * finest, part * growth);
    std::string rest;
    for (const auto& [clearance, force] : at) {
      const PressedDisc disc({.clearance = clearance / radius, .finest = part * finest, .growth = part * growth});
      if (rest.empty()) out += printed(" %d |", disc.dofs());
      const Pressed p = disc.press(force / force_unit);
      rest += printed(" %.6g µm |", p.depth * radius * 1e6);
    }
    out += rest + "\n";
  }
  return out;
}

/// Half-width and greatest pressure by Hertz, half-angle by Persson. `missed` counts what is farther off than it may be.
std::string closed_forms_table(int& missed) {
  std::string out = "| | closed form | meshed | off |\n|---|---|---|---|\n";
  const auto row = [&](const std::string& what, double expected, double got, double may) {
    const double off = got / expected - 1;
    if (!(std::abs(off) < may)) ++missed;
    out += printed("| %s | %.5g | %.5g | %+.2g %% |\n", what.c_str(), expected, got, 100 * off);
  };
  const DiscInEye narrow{.clearance = 0.05, .finest = 2e-4, .growth = 0.1};
  const PressedDisc hertz(narrow);
  for (const double f : {1e-6, 1e-5}) {
    const double a = 2 * std::sqrt(f * (1 - narrow.clearance) / narrow.clearance / pi);
    const Pressed p = hertz.press(f);
    // Half a side of the mesh there; the curvature of the bodies, of order a.
    row(printed("Hertz, F/(E\\*LR_j) = %.0e, ΔR = 0.05 R_j: half-width/R_j", f), a, p.half_angle * (1 - narrow.clearance),
        std::max(narrow.finest / a, narrow.growth));
    row("— greatest pressure/E\\*", 2 * f / (pi * a), p.greatest_pressure, a + 0.01);
  }
  const DiscInEye wide{.clearance = 1e-4, .outer = 20, .finest = 5e-3, .growth = 0.05, .load_in_the_middle = true};
  const PressedDisc persson(wide);
  for (const double degrees : {10.0, 20.0, 30.0, 45.0, 60.0, 75.0}) {
    const double angle = degrees * pi / 180, b = std::pow(std::tan(angle / 2), 2);
    const double f = 2 * pi * b * (1 + b) / (2 - std::log1p(b) - 2 * b * b) * wide.clearance;
    row(printed("Persson, F/(E\\*LΔR) = %.3g, eye held at 20 R_j: half-angle [°]", f / wide.clearance), degrees,
        persson.press(f).half_angle * 180 / pi, wide.growth);
  }
  return out;
}

std::string picture(const std::vector<Case>& cases, const std::vector<Law>& all) {
  std::vector<Panel> panels;
  for (const double clearance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    Panel p;
    p.title = printed("clearance %g um", clearance * 1e6), p.x_label = "depth [um]", p.y_label = "force [N]";
    p.log = true;
    Curve meshed;
    meshed.label = "meshed";
    for (const Case& c : cases)
      if (c.clearance == clearance) meshed.x.push_back(std::log10(c.depth() * 1e6)), meshed.y.push_back(std::log10(c.force));
    p.curves.push_back(meshed);
    for (const Law& l : all) {
      const auto of = l.of(clearance);
      if (!of) continue;
      Curve curve;
      curve.label = l.name == "K δ^1.5" ? "hertz" : l.name, curve.dashed = true;
      for (const double x : meshed.x) {
        curve.x.push_back(x);
        curve.y.push_back(std::log10(evaluate(of->elastic, std::pow(10, x) * 1e-6).force));
      }
      p.curves.push_back(curve);
    }
    panels.push_back(p);
  }
  return svg(panels);
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

constexpr const char* head = R"(# Laws of contact against meshed bodies

Written by `contact_laws_page` (tests/contact_laws/). A disc in the hole of a round eye, both meshed, pressed together without friction by the solver of
`pintle static` ([theory](theory/static_contact.md)); what [each law](theory/contact.md#laws-of-cylinders) says of the same depth beside it. Which law to take:
[there](theory/contact.md#measured-against-meshed-bodies).

**The bodies.** Plane strain, E = 207 GPa, ν = 0.3, L = 10 mm, R_j = 10 mm, R_i = R_j − ΔR, 1/E\* = 2(1 − ν²)/E. The eye reaches to 2 R_j and is held all round there. The disc is loaded
evenly over its area, as by its own inertia, and its place is the mean over its area, which that load works on. It begins where it touches; **depth is how far it then moves towards the wall**. Small
displacements. Everything over R_j, E\* and ΔR: with ΔR ≪ R_j depth/ΔR and half-angle are functions of F/(E\*LΔR) alone.

**The reference point.** The displacement of a plane body has a logarithm in the distance from the load, so a depth means nothing without the places that it is measured between. Two half-spaces, measured
R_i and R_j under their surfaces, give `johnson`. The table says what other places add; it is nearly proportional to the force, so it is a compliance of the bodies that a mechanism with elastic bodies has already.

)";

}  // namespace

int main(int argc, char** argv) {
  int missed = 0;
  const std::string forms = closed_forms_table(missed);
  if (argc > 1 && std::string(argv[1]) == "--check") {
    std::cout << forms;
    return missed > 0 ? 1 : 0;
  }
  const std::filesystem::path docs = std::filesystem::path(PINTLE_SOURCE_DIR) / "docs";
  const std::vector<Law> all = laws();
  const std::vector<Case> cases = measured();
  write(docs / "contact_laws" / "force_over_depth.svg", picture(cases, all));
  write(docs / "contact_laws.md", head + reference_table() +
                                      "\n## Error of the force, by half-angle\n\nA law's force at the depth found, less the force, over "
                                      "it, in percent: least to greatest of the cases.\n\n" +
                                      summary_table(cases, all) + "\n## Error of the force, case by case\n\n" +
                                      "In percent. In parentheses: deeper than the law says of itself that it may go; –: beyond the "
                                      "clearances that it has constants for.\n\n" +
                                      errors_table(cases, all) + "\n![force over depth](contact_laws/force_over_depth.svg)\n\n" +
                                      "## Are the meshes fine enough?\n\nDepth, for sides twice as long, as in the tables, and half as "
                                      "long. `finest` is the side at the place of contact over R_j, `growth` a "
                                      "side over its distance from there.\n\n" +
                                      refinement_table() + "\n## Does the solver meet closed forms?\n\n" + forms);
  return missed > 0 ? 1 : 0;
}
