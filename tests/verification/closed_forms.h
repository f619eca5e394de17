#pragma once

#include <array>
#include <functional>
#include <vector>

/// What the problems' answers are by theory: exact equations solved by other means than elements.
/// Includes nothing of ours. Frequencies are in Hz, ascending, without rigid motions.
namespace closed {

using Values = std::vector<double>;

/// The lowest `count` sign changes of f above `from`, found in steps and halved to rounding.
Values roots(const std::function<double(double)>& f, double from, double step, std::size_t count);

/// A uniform beam; `GA` is κGA, 0: no shear; `rhoI` rotary inertia per length, may be 0.
struct Beam {
  double length, EI, GA, rhoA, rhoI;
};
enum class End { clamped, pinned, free };
/// Exact frequencies from the transfer matrix of Timoshenko's equations (Euler's: GA = 0, rhoI =
/// 0); a lump of `mass` and `inertia` at a free second end.
Values beam(const Beam&, End first, End second, std::size_t count, double mass = 0, double inertia = 0);

/// Height from `root` (clamped) to `tip` (free) over `length`, even width: Kirchhoff's wedge, cut
/// off.
Values wedge(double length, double root, double tip, double E, double rho, std::size_t count);

/// Plane frame of straight Euler members with stretch: exact dynamic stiffness, roots counted by
/// Wittrick and Williams (1971). Nodes (x, y); `pinned` nodes do not move, but turn.
struct Frame {
  std::vector<std::array<double, 2>> nodes;
  std::vector<std::array<int, 2>> members;
  std::vector<int> pinned;
  double EA, EI, rhoA;
};
Values frame(const Frame&, std::size_t count);

/// Plane stress throughout below.
struct Solid {
  double E, nu, rho;
};
/// In-plane modes of a free ring, radii a < b: Bessel's functions at both edges; each of two or
/// more waves stands twice in the list.
Values ring(const Solid&, double a, double b, std::size_t count);
/// In-plane modes of a square of side a by Ritz with products of Legendre polynomials up to a
/// power.
Values square(const Solid&, double a, bool clamped, int power, std::size_t count);
/// Radial displacement per unit radial force at the free end of a quarter ring, radii a < b:
/// Golovin's stress function (1881), clamped at the middle of the other end.
double quarter_ring(double E, double thickness, double a, double b);

/// Largest stress at a hole of radius a in a strip 2b wide and 2l long under unit tension at its
/// ends: Kolosov's potentials with poles in the hole and in its two nearest images beyond the
/// edges, fitted to the tractions of all edges (which are met to 1e-4 at l = 4b, a = b/2).
double strip_with_hole(double a, double b, double l);

}  // namespace closed
