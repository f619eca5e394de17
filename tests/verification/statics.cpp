#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "tests/verification/closed_forms.h"
#include "tests/verification/page.h"

namespace verification {

using namespace pintle;

namespace {

const std::vector<std::string> four_and_eight{"quadrilateral4-plain", "quadrilateral4", "quadrilateral8", "quadrilateral8-reduced"};
constexpr double rounding = 1e-9;

// Nodes of the rim move by ε; where do the others go? Displacements of the four inner corners.
Values imposed(const Rest& r) {
  const Eigen::Matrix2Xd& x = r.body.mesh.x;
  std::vector<int> inner, outer;
  Eigen::VectorXd u(2 * x.cols());
  for (int i = 0; i < x.cols(); ++i) {
    const double p = x(0, i), q = x(1, i);
    u.segment<2>(2 * i) << 1e-3 * (p + q / 2), 1e-3 * (q + p / 2);
    const bool rim = std::min({p, q, 0.24 - p, 0.12 - q}) < 1e-9;
    for (int k : {2 * i, 2 * i + 1}) (rim ? outer : inner).push_back(k);
  }
  const Eigen::MatrixXd K = r.body.K;
  const Eigen::VectorXd f = -K(inner, outer) * u(outer);
  const Eigen::MatrixXd inside = K(inner, inner);
  const Eigen::VectorXd found = inside.ldlt().solve(f);
  for (std::size_t i = 0; i < inner.size(); ++i) u[inner[i]] = found[static_cast<Eigen::Index>(i)];
  Values out;
  for (const Eigen::Vector2d& at :
       {Eigen::Vector2d(0.04, 0.02), Eigen::Vector2d(0.18, 0.03), Eigen::Vector2d(0.16, 0.08), Eigen::Vector2d(0.08, 0.08)}) {
    const int node = nearest_node(r.body.mesh, at, 1e-6);
    for (int k = 0; k < 2; ++k) out.push_back(1e5 * u[2 * node + k]);
  }
  return out;
}

Problem patch_test() {
  Problem p{"Patch test", "1e-5 m; Pa",
            "MacNeal and Harder (1985): 0.24 m × 0.12 m × 1 mm, E = 1 MPa, ν = 0.25, five distorted "
            "quadrilaterals (cut in two for triangles). First the rim moves by u = 1e-3 (x + y/2), "
            "v = 1e-3 (y + x/2): where the four inner corners go. Then tractions on the rim instead "
            "([patch_test.yaml](../examples/verification/patch_test.yaml)): σx, σy, τ, of all nodes "
            "that which errs most.",
            "an element that passes is exact: only rounding is left."};
  for (const std::string& element : plane_elements()) {
    if (element == "quadrilateral9") continue;  // input files have none
    Scene s = scene("verification/patch_test");
    take(s, element);
    const Rest r = rest(s);
    p.rows.push_back(
        {element, "5 cells", "inner displacements", imposed(r), {5, 4, 19.5, 12, 20, 16, 12, 12}, rounding, element == "quadrilateral4"});
    Values stress(3);
    const double target[3] = {4000.0 / 3, 4000.0 / 3, 400};
    for (const auto& at : r.report.stress.nodal.colwise())
      for (int k = 0; k < 3; ++k) {
        const double now = at[k == 0 ? 0 : k == 1 ? 1 : 2];
        double& kept = stress[static_cast<std::size_t>(k)];
        if (kept == 0 || std::abs(now - target[k]) > std::abs(kept - target[k])) kept = now;
      }
    p.rows.push_back({element, "5 cells", "stress under tractions", stress, {target[0], target[1], target[2]}, rounding});
  }
  return p;
}

double tip(const Rest& r, int direction) { return (r.moved("below")[direction] + r.moved("above")[direction]) / 2; }

Problem straight_cantilever() {
  Problem p{"Straight cantilever", "1e-5 m; 1e-2 m",
            "MacNeal and Harder (1985): 6 m × 0.2 m × 0.1 m, E = 10 MPa, ν = 0.3, in six cells whose "
            "inner sides are upright or lean by 45° to alternating sides (trapezoids) or to one side "
            "(parallelograms); triangles halve the rectangles. 1 N along or across at the tip, root "
            "wholly held. Targets: FL/EA and FL³/3EI + 6FL/5GA, published as 3.0e-5 and 0.1081 m. Scenes "
            "[cantilever_regular](../examples/verification/cantilever_regular.yaml), "
            "[_trapezoid](../examples/verification/cantilever_trapezoid.yaml), "
            "[_parallelogram](../examples/verification/cantilever_parallelogram.yaml).",
            "extension 1 %: the root is held across also, which theory does not know (Poisson's "
            "effect over about one depth of 0.2 m in 6 m). Shear on rectangles 3 % for elements that "
            "bend, among them the 8-node ones in parallelograms, whose fields are complete quadratics. "
            "The "
            "plain quadrilateral must fall short by the factor that its parasitic shear gives "
            "in pure bending, (1/(1−ν) + (a/b)²/2)/(1+ν) = 10.71 at a/b = 5, to 3 %. In trapezoids no "
            "element of four or eight nodes holds a quadratic displacement, leaning cells of four nodes "
            "and constant-strain triangles lock: shown, not judged."};
  const double E = 10e6, G = E / 2.6, A = 0.02, I = 0.1 * 0.008 / 12;
  const double stretch = 1e5 * 6 / (E * A), bend = 1e2 * (72 / (E * I) + 7.2 / (G * A));
  const double locked = (1 / 0.7 + 12.5) / 1.3;
  for (const char* mesh : {"regular", "trapezoid", "parallelogram"})
    for (const std::string& element : mesh[0] == 'r' ? plane_elements() : four_and_eight) {
      const auto answer = [&](const char* pull, const char* push, int direction) {
        Scene s = scene(std::string("verification/cantilever_") + mesh, {{"pull", pull}, {"push", push}});
        take(s, element);
        return tip(rest(s), direction);
      };
      const bool regular = mesh[0] == 'r', plain = element == "quadrilateral4-plain";
      const std::string cells = printed("6 × 1 %s", mesh);
      p.rows.push_back(
          {element, cells, "extension", {1e5 * answer("50 Pa", "0 Pa", 0)}, {stretch}, 0.01, regular && element == "quadrilateral4"});
      Row shear{element, cells, "shear", {1e2 * answer("0 Pa", "50 Pa", 1)}, {bend}};
      if (is_linear(element) ? regular && element == "quadrilateral4" : mesh[0] != 't') shear.allowed = 0.03;
      shear.headline = element == "quadrilateral4" || element == "quadrilateral8";
      p.rows.push_back(shear);
      if (regular && plain) p.rows.push_back({element, cells, "shear × 10.71", {shear.ours[0] * locked}, {bend}, 0.03});
    }
  return p;
}

Problem curved_cantilever() {
  Problem p{"Curved cantilever", "m",
            "MacNeal and Harder (1985): a quarter of a ring, radii 4.12 m and 4.32 m, 0.1 m thick, "
            "E = 10 MPa, ν = 0.25, in six cells; 1 N at the free end along its radius. They print "
            "0.08734; "
            "the stress function of Golovin (1881) gives π(a² + b²)/(Et((a² + b²) ln(b/a) − b² + a²)) = "
            "0.088566, and Castigliano's thin beam πR³/4EI = 0.08854. The target is Golovin's: "
            "converged meshes meet it, and none the printed value. Scene "
            "[curved_beam](../examples/verification/curved_beam.yaml).",
            "24 quadratic cells: 0.3 %. The clamp stops Poisson's contraction over some 0.3 of the depth "
            "at "
            "the root, where bending is then stiffer by 1/(1−ν²): 0.12 % of the deflection; the mesh "
            "errs "
            "by as much. Six cells of 15° are the published test of distortion, where straight low-order "
            "cells with an aspect ratio of 5.5 are expected to be too stiff: shown."};
  const double target = closed::quarter_ring(10e6, 0.1, 4.12, 4.32);
  const auto answer = [&](const std::string& element, const char* file) {
    Scene s = scene("verification/curved_beam");
    std::get<SceneFile>(plate(s).shape).path = file;
    plate(s).element = element;
    const Rest r = rest(s);
    return (r.moved("inside")[0] + r.moved("outside")[0]) / 2;
  };
  for (const std::string& element : four_and_eight) {
    const bool linear = is_linear(element);
    p.rows.push_back({element,
                      "6 × 1",
                      "tip, radial",
                      {answer(element, linear ? "curved_beam_4.inp" : "curved_beam_8.inp")},
                      {target},
                      0,
                      element == "quadrilateral8"});
    if (!linear)
      p.rows.push_back(
          {element, "24 × 1", "tip, radial", {answer(element, "curved_beam_fine_8.inp")}, {target}, 3e-3, element == "quadrilateral8"});
  }
  return p;
}

Problem cook() {
  Problem p{"Cook's membrane", "m",
            "Cook (1974): trapezium (0, 0), (48, 44), (48, 60), (0, 44), thickness 1, E = 1, ν = 1/3, "
            "clamped at the left, shear of total 1 at the right; deflection of the middle of the right "
            "edge, 23.96. Scene [cook](../examples/verification/cook.yaml).",
            "at 32 × 32 quadratic cells 0.05 %: half of the last digit of the target and as much "
            "again for the singular corner. Linear cells converge as h², from 24 % at 4 × 4 where they "
            "lock "
            "(4 % with incompatible modes): 64 times less at 32 × 32 is 0.4 % (0.06 %), allowed twice "
            "that."};
  for (const std::string& element : plane_elements())
    for (const char* n : {"4", "8", "32"}) {
      Scene s = scene("verification/cook", {{"cells", n}});
      take(s, element);
      Row row{element, printed("%s × %s", n, n), "deflection of C", {rest(s).moved("C")[1]}, {23.96}};
      if (n[0] == '3') row.allowed = element == "quadrilateral4" ? 1.2e-3 : is_linear(element) ? 8e-3 : 5e-4;
      row.headline = n[0] == '8' && (element == "quadrilateral4" || element == "quadrilateral8");
      p.rows.push_back(row);
    }
  return p;
}

Problem thick_cylinder() {
  Problem p{"Thick cylinder, nearly incompressible", "1e-3 m",
            "MacNeal and Harder (1985): radii 3 m and 9 m, plane strain, E = 1000 Pa, one pascal inside; "
            "five cells from 3 to 3.5, 4.2, 5.2, 6.75 and 9 m, 10° each. Lamé (1852): "
            "u(a) = (1+ν) p a²/(E (b²−a²)) (b²/a + (1−2ν) a), published as 5.0399, 5.0602 and 5.0623e-3. "
            "Scene [thick_cylinder](../examples/verification/thick_cylinder.yaml).",
            "incompatible modes and reduced integration are not to lock, whatever ν: 2 % and 0.1 %. "
            "Chords "
            "of 10° lie up to 0.4 % inside the circle, and straight cells of a third of the radius miss "
            "as much again of "
            "the gradient 1/r² on either side; quadratic sides leave (5°)⁴/24 of it. The others stiffen "
            "as ν nears ½: "
            "shown."};
  for (const std::string& element : four_and_eight)
    for (const char* nu : {"0.49", "0.499", "0.4999"}) {
      const double v = std::stod(nu), target = (1 + v) * 9 / (1000.0 * 72) * (27 + (1 - 2 * v) * 3);
      Scene s = scene("verification/thick_cylinder", {{"nu", nu}});
      take(s, element);
      const bool judged = element == "quadrilateral4" || element == "quadrilateral8-reduced";
      p.rows.push_back({element,
                        "9 × 5",
                        printed("ν = %s", nu),
                        {1e3 * rest(s).moved("bore")[0]},
                        {1e3 * target},
                        !judged              ? 0
                        : is_linear(element) ? 0.02
                                             : 1e-3,
                        judged && v > 0.4995});
    }
  return p;
}

Problem spinning_ring() {
  Problem p{"Spinning ring", "1e-6 m",
            "Radii 3 m and 9 m, steel, 30 rad/s, plane stress: radial displacement of bore and rim. "
            "u(r) = ρω²/8E ((3+ν)(1−ν)(a²+b²) r + (3+ν)(1+ν) a²b²/r − (1−ν²) r³) (Timoshenko and "
            "Goodier 1970). Scene [spinning_ring](../examples/verification/spinning_ring.yaml).",
            "linear cells 2 %: chords of 10° lose 0.5 % of the radius and of the mass at the rim, "
            "and five cells over the depth as much again; quadratic cells 0.1 %."};
  const double E = 200e9, nu = 0.3, rho = 8000, w = 30, a = 3, b = 9;
  const auto u = [&](double r) {
    return 1e6 * rho * w * w / (8 * E) *
           ((3 + nu) * (1 - nu) * (a * a + b * b) * r + (3 + nu) * (1 + nu) * a * a * b * b / r - (1 - nu * nu) * r * r * r);
  };
  for (const std::string& element : four_and_eight) {
    Scene s = scene("verification/spinning_ring");
    take(s, element);
    const Rest r = rest(s);
    p.rows.push_back({element,
                      "9 × 5",
                      "bore, rim",
                      {1e6 * r.moved("bore")[0], 1e6 * r.moved("rim")[0]},
                      {u(a), u(b)},
                      is_linear(element) ? 0.02 : 1e-3,
                      element == "quadrilateral8"});
  }
  return p;
}

Problem off_axis() {
  Problem p{"Off-axis tension", "1e-3 m",
            "A strip 0.4 m × 0.1 m with fibres at 30° (E₁ = 140, E₂ = 10, G₁₂ = 5 GPa, ν₁₂ = 0.3) under "
            "100 MPa: it stretches by S₁₁(30°) σ L, thins and shears evenly. Displacements u_x, u_y of "
            "the far upper corner with the near side kept upright. Scene "
            "[off_axis_tension](../examples/verification/off_axis_tension.yaml).",
            "the field is linear, so every element is exact: rounding."};
  const double E1 = 140e9, E2 = 10e9, G = 5e9, nu = 0.3, s = 0.5, c = std::sqrt(0.75);
  const double stretch = c * c * c * c / E1 + (1 / G - 2 * nu / E1) * s * s * c * c + s * s * s * s / E2;
  const double across = (1 / E1 + 1 / E2 - 1 / G) * s * s * c * c - nu / E1 * (s * s * s * s + c * c * c * c);
  const double shear = (2 / E1 + 2 * nu / E1 - 1 / G) * s * c * c * c - (2 / E2 + 2 * nu / E1 - 1 / G) * s * s * s * c;
  for (const std::string& element : plane_elements()) {
    Scene scene_ = scene("verification/off_axis_tension");
    take(scene_, element);
    const Eigen::Vector3d at = rest(scene_).moved("C");
    // u = εx x, v = εy y + γ x: A and D stay on x = 0.
    p.rows.push_back({element,
                      "4 × 2",
                      "corner C",
                      {1e3 * at.x(), 1e3 * at.y()},
                      {1e3 * 1e8 * stretch * 0.4, 1e3 * 1e8 * (across * 0.1 + shear * 0.4)},
                      rounding,
                      element == "quadrilateral4"});
  }
  return p;
}

Problem beams() {
  Problem p{"Beams at rest", "1e-6 m, 1e-6 rad; 1e-9 m",
            "A cantilever of depth 0.4 m and length 1 m under 1 kN at the tip and 500 N/m: deflection "
            "FL³/3EI + qL⁴/8EI + (FL + qL²/2)/κGA and slope FL²/2EI + qL³/6EI, with κ = 10(1+ν)/(12+11ν) "
            "(Cowper 1966). A rod spinning at 300 rad/s about its end: extension ρω²L³/3E. Scene "
            "[beams_static](../examples/verification/beams_static.yaml).",
            "beam elements are exact at their nodes: rounding. The rod's load is linear and its shape "
            "functions along the axis too, so its nodes are exact as well."};
  Scene s = scene("verification/beams_static");
  const Eigen::Vector3d tip = rest(s).moved("tip");
  const double E = 200e9, nu = 0.3, EI = E * 0.1 * 0.064 / 12, GA = 10 * (1 + nu) / (12 + 11 * nu) * E / (2 * (1 + nu)) * 0.04;
  p.rows.push_back({"BeamTimoshenko",
                    "3",
                    "deflection, slope",
                    {-1e6 * tip[1], -1e6 * tip[2]},
                    {1e6 * (1000 / (3 * EI) + 500 / (8 * EI) + 1250 / GA), 1e6 * (1000 / (2 * EI) + 500 / (6 * EI))},
                    rounding,
                    true});
  s.statics->body = "rod";
  SceneStaticLoad spin;
  spin.kind = SceneStaticLoad::Kind::spin;
  spin.value = 300;
  s.statics->loads = {spin};
  p.rows.push_back({"BeamEuler", "32", "extension", {1e9 * rest(s).moved("end")[0]}, {1e9 * 8000 * 300 * 300 / (3 * E)}, rounding, true});
  return p;
}

// A stress at a place on meshes of halving size from a drawing.
void drawing(Problem& p, const std::string& name, const Eigen::Vector2d& at, int component, double target, double allowed,
             const std::vector<double>& sizes) {
  for (const std::string& element : plane_elements())
    for (const double size : sizes) {
      Scene s = scene("verification/" + name);
      take(s, element);
      plate(s).size = size;
      const Rest r = rest(s);
      Row row{element, shown_mesh(r.body), printed("size %g m", size), {1e-6 * r.stress_at(at)[component]}, {target}};
      const bool last = size == sizes.back();
      if (last && !is_linear(element)) row.allowed = allowed;
      row.headline = last && element == "triangle6";
      p.rows.push_back(row);
    }
}

Problem elliptic_membrane() {
  Problem p{"NAFEMS LE1, elliptic membrane", "MPa",
            "A quarter between the ellipses 2 m × 1 m and 3.25 m × 2.75 m, 0.1 m thick, E = 210 GPa, "
            "ν = 0.3, pulled outwards by 10 MPa on the outer edge; σ_y at D = (2, 0): 92.7 MPa "
            "(NAFEMS 1990). Meshed by Gmsh from [le1.geo](../examples/verification/le1.geo). Scene "
            "[le1](../examples/verification/le1.yaml).",
            "0.5 % for quadratic elements at the finest size: stress at a node converges as h² with "
            "24 cells and more along the inner ellipse, and the target has three digits. Linear "
            "elements give a mean of constant stresses at an edge of steep gradient: shown."};
  drawing(p, "le1", {2, 0}, 1, 92.7, 5e-3, {0.2, 0.1, 0.05});
  return p;
}

Problem strip_with_hole() {
  Problem p{"Strip with a hole", "σ/σ∞",
            "A strip twice as wide as its hole under tension: the largest stress over the far one. A "
            "quarter from [plate_with_hole.geo](../examples/verification/plate_with_hole.geo), eight "
            "hole diameters long. Target: Kolosov's potentials fitted to the tractions of all edges, "
            "4.3476, the same for a strip twice as long. Howland's series (1930) and the charts drawn "
            "from it give 4.32, 0.6 % less, which converged meshes do not confirm. Scene "
            "[plate_with_hole](../examples/verification/plate_with_hole.yaml).",
            "stress at a node of quadratic elements converges as h²: 0.3 % with 30 cells along the "
            "quarter of the hole, (0.025/0.5)² = 0.25 %."};
  const double target = closed::strip_with_hole(0.5, 1, 4);
  drawing(p, "plate_with_hole", {0, 0.5}, 0, target, 3e-3, {0.2, 0.1, 0.025});
  return p;
}

}  // namespace

void static_problems(Problems& out) {
  for (const auto problem : {patch_test, straight_cantilever, curved_cantilever, cook, thick_cylinder, spinning_ring, off_axis, beams,
                             elliptic_membrane, strip_with_hole})
    out.push_back(problem());
}

}  // namespace verification
