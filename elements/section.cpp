#include "elements/section.h"

#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace pintle {
namespace {

constexpr double five_sixths = 5.0 / 6;
constexpr double pi = std::numbers::pi;

void require(bool holds, const char* kind, const char* name, double value, const char* rule) {
  if (holds && std::isfinite(value)) return;
  std::ostringstream text;
  text << kind << " section: " << name << " = " << value << ", must be " << rule;
  throw std::invalid_argument(text.str());
}
void require_size(const char* kind, const char* name, double value) { require(value > 0, kind, name, value, "positive [m]"); }

double square(double x) { return x * x; }

Section measure(const RectangleSection& s, double nu) {
  require_size("rectangle", "height", s.height);
  require_size("rectangle", "width", s.width);
  const double A = s.height * s.width;
  return {A, A * s.height * s.height / 12, 10 * (1 + nu) / (12 + 11 * nu), s.height / 2};
}

Section measure(const CircleSection& s, double nu) {
  require_size("circle", "diameter", s.diameter);
  const double A = pi * square(s.diameter) / 4;
  return {A, A * square(s.diameter) / 16, 6 * (1 + nu) / (7 + 6 * nu), s.diameter / 2};
}

Section measure(const TubeSection& s, double nu) {
  require_size("tube", "outer", s.outer);
  require_size("tube", "inner", s.inner);
  require(s.inner < s.outer, "tube", "inner", s.inner, "below outer; both are diameters");
  const double A = pi * (s.outer - s.inner) * (s.outer + s.inner) / 4;
  const double mm = square(s.inner / s.outer);
  const double kappa = 6 * (1 + nu) * square(1 + mm) / ((7 + 6 * nu) * square(1 + mm) + (20 + 12 * nu) * mm);
  return {A, A * square(s.outer) * (1 + mm) / 16, kappa, s.outer / 2};
}

// κ of the thin-walled section: h is the distance between the middle lines of the flanges.
Section measure(const ISection& s, double nu) {
  require_size("I", "height", s.height);
  require_size("I", "width", s.width);
  require_size("I", "web", s.web);
  require_size("I", "flange", s.flange);
  require(s.web <= s.width, "I", "web", s.web, "no thicker than the flanges are wide");
  require(2 * s.flange < s.height, "I", "flange", s.flange, "below half the height");
  const double b = s.width, clear = s.height - 2 * s.flange, h = s.height - s.flange;
  const double A = 2 * b * s.flange + clear * s.web;
  const double I = (s.web * clear * clear * clear + 2 * b * s.flange * s.flange * s.flange) / 12 + b * s.flange * h * h / 2;
  const double m = 2 * b * s.flange / (h * s.web), n = b / h;
  const double lower = 12 + m * (72 + m * (150 + 90 * m)) + nu * (11 + m * (66 + m * (135 + 90 * m))) + 30 * n * n * m * (1 + m) +
                       5 * nu * n * n * m * (8 + 9 * m);
  return {A, I, 10 * (1 + nu) * square(1 + 3 * m) / lower, s.height / 2};
}

Section measure(const GivenSection& s, double) {
  require(s.area > 0, "given", "area", s.area, "positive [m²]");
  require(s.second_moment > 0, "given", "second_moment", s.second_moment, "positive [m⁴]");
  require(s.fibre >= 0, "given", "fibre", s.fibre, "positive, or 0 if it is not known [m]");
  require(s.fibre == 0 || s.second_moment <= s.area * s.fibre * s.fibre, "given", "second_moment", s.second_moment,
          "at most area·fibre²: no part of the section lies further out");
  const double kappa = s.shear_factor.value_or(five_sixths);
  require(kappa > 0, "given", "shear_factor", kappa, "positive");
  return {s.area, s.second_moment, kappa, s.fibre};
}

double mix(double a, double b, double t) { return (1 - t) * a + t * b; }
RectangleSection mix(const RectangleSection& a, const RectangleSection& b, double t) {
  return {mix(a.height, b.height, t), mix(a.width, b.width, t)};
}
CircleSection mix(const CircleSection& a, const CircleSection& b, double t) { return {mix(a.diameter, b.diameter, t)}; }
TubeSection mix(const TubeSection& a, const TubeSection& b, double t) { return {mix(a.outer, b.outer, t), mix(a.inner, b.inner, t)}; }
ISection mix(const ISection& a, const ISection& b, double t) {
  return {mix(a.height, b.height, t), mix(a.width, b.width, t), mix(a.web, b.web, t), mix(a.flange, b.flange, t)};
}
GivenSection mix(const GivenSection& a, const GivenSection& b, double t) {
  GivenSection s{mix(a.area, b.area, t), mix(a.second_moment, b.second_moment, t), mix(a.fibre, b.fibre, t), std::nullopt};
  if (a.shear_factor || b.shear_factor) s.shear_factor = mix(a.shear_factor.value_or(five_sixths), b.shear_factor.value_or(five_sixths), t);
  return s;
}

const char* name(const SectionShape& s) {
  constexpr const char* names[] = {"rectangle", "circle", "tube", "I", "given"};
  static_assert(std::size(names) == std::variant_size_v<SectionShape>);
  return names[s.index()];
}

}  // namespace

Section section(const SectionShape& shape, ShearFactor factor, double poisson) {
  Section s = std::visit([&](const auto& kind) { return measure(kind, poisson); }, shape);
  if (std::holds_alternative<GivenSection>(shape)) return s;
  if (factor == ShearFactor::five_sixths) {
    s.kappa = five_sixths;
    return s;
  }
  require(poisson > -1, name(shape), "poisson", poisson, "above −1 for Cowper's shear factor");
  return s;
}

SectionShape between(const SectionShape& a, const SectionShape& b, double t) {
  assert(t >= 0 && t <= 1);
  if (a.index() != b.index())
    throw std::invalid_argument(std::string("tapered section: from ") + name(a) + " to " + name(b) + "; both ends must be of one kind");
  return std::visit([&](const auto& from) -> SectionShape { return mix(from, std::get<std::decay_t<decltype(from)>>(b), t); }, a);
}

}  // namespace pintle
