#include <array>
#include <cmath>
#include <numbers>

#include "tests/verification/closed_forms.h"
#include "tests/verification/page.h"

namespace verification {

using namespace pintle;

namespace {

constexpr closed::Solid steel{200e9, 0.3, 8000};

Problem squares() {
  Problem p{"Square plate in its plane", "Hz",
            "1 m × 1 m, steel, plane stress; free and clamped on all edges. Target: Ritz's method with "
            "products of Legendre polynomials to the power 12, whose first eight values stand still in "
            "six "
            "digits from power 10 on (free) and 12 on (clamped). As 2πfa√(ρ(1−ν²)/E) they are 2.3206, "
            "2.4716 (twice), 2.6284, 2.9874, "
            "3.4522 (free; the fourth is Lamé's mode, exactly π√(1−ν)) and 3.5552 (twice), 4.2350, "
            "5.1857, "
            "5.8586, 5.8944 (clamped), the problem of Bardell, Langley and Dunsdon (1996). Scenes "
            "[square_free](../examples/verification/square_free.yaml), "
            "[square_clamped](../examples/verification/square_clamped.yaml).",
            "with k the wave number of shear at the sixth frequency and h a cell's side, a wave's "
            "frequency "
            "errs by (kh)²/24 in linear cells and (kh)⁴/1440 in quadratic ones; quadrilaterals twice "
            "that, as fields at edges "
            "and corners vary faster than waves; triangles ten times that, since their longest sides are "
            "√2 h and "
            "their strains of lower order."};
  for (const bool clamped : {false, true}) {
    const Values target = closed::square(steel, 1, clamped, 12, 6);
    for (const std::string& element : plane_elements()) {
      Scene s = scene(clamped ? "verification/square_clamped" : "verification/square_free");
      take(s, element);
      const double kh = 2 * std::numbers::pi * target.back() / std::sqrt(steel.E / 2.6 / steel.rho) / 12;
      const double wave = is_linear(element) ? kh * kh / 24 : std::pow(kh, 4) / 1440;
      p.rows.push_back({element, "12 × 12", clamped ? "clamped" : "free", frequencies(s, 6), target,
                        (element.starts_with("triangle") ? 10 : 2) * wave, element == "quadrilateral8"});
    }
  }
  return p;
}

Problem ring() {
  Problem p{"Free ring in its plane", "Hz",
            "Outer diameter 1 m, bore 0.9 m, steel, plane stress. Target: the determinant of Bessel "
            "functions J and Y that makes both edges free; frequencies with two waves and more stand "
            "twice. Hoppe's thin ring (1871), n(n²−1)/√(n²+1) √(EI/ρA)/2πR², lies 1.5 % and more above. "
            "Scene "
            "[free_ring](../examples/verification/free_ring.yaml), meshed by Gmsh.",
            "quadratic sides follow the arc; two cells in the thickness of a bending ring: 0.1 %."};
  const Values target = closed::ring(steel, 0.45, 0.5, 6);
  for (const char* element : {"triangle6", "quadrilateral8", "quadrilateral9"}) {
    Scene s = scene("verification/free_ring");
    take(s, element);
    p.rows.push_back({element, shown_mesh(body(s)), "free", frequencies(s, 6), target, 1e-3, std::string(element) == "triangle6"});
  }
  return p;
}

}  // namespace

void plate_problems(Problems& out) {
  for (const auto problem : {squares, ring}) out.push_back(problem());
}

}  // namespace verification
