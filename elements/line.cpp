#include "elements/line.h"

#include <array>
#include <cassert>

namespace pintle {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

template <class E>
using Row = Eigen::Matrix<double, 1, E::dofs>;

double length(const Matrix2d& x) {
  const double L = (x.col(1) - x.col(0)).norm();
  assert(L > 0);
  return L;
}

/// Body dofs = turn · element dofs.
template <class E>
Square<E> turn(const Matrix2d& x) {
  const Vector2d t = (x.col(1) - x.col(0)) / length(x);
  Square<E> Q = Square<E>::Identity();
  for (int i = 0; i < E::dofs; i += E::dofs_per_node) Q.template block<2, 2>(i, i) << t.x(), -t.y(), t.y(), t.x();
  return Q;
}

/// Contribution of each dof, in element axes, at one point: displacement along and across the axis, rotation of the section, and the
/// slopes of the first two along the axis.
template <class E>
struct Field {
  Row<E> u, w, theta, du, dw;
};

/// Ratio of shear to bending flexibility of the element, 12 EI/(κGA L²).
double shear_ratio(const BeamEuler&, double) { return 0; }
double shear_ratio(const BeamTimoshenko& e, double L) { return 12 * e.EI / (e.kGA * L * L); }

Field<Bar> field(const Bar&, double L, double xi) {
  Field<Bar> f;
  f.u << 1 - xi, 0, xi, 0;
  f.w << 0, 1 - xi, 0, xi;
  f.theta.setZero();
  f.du << -1 / L, 0, 1 / L, 0;
  f.dw << 0, -1 / L, 0, 1 / L;
  return f;
}

// Sum of the chord, a parabola due to the relative rotation, and a cubic due to the difference between the chord's rotation and the mean
// rotation: the static solution for end loads, Φ = shear_ratio.
template <BeamElement E>
Field<E> field(const E& e, double L, double xi) {
  const double phi = shear_ratio(e, L), a = 1 / (1 + phi);
  const double eta = 1 - xi;
  const double cubic = a * xi * eta * (xi - eta), cubic_slope = a * (6 * xi * eta - 1);
  const double bow = xi * eta / 2, bow_slope = (eta - xi) / 2;
  Row<E> stretch, chord, bend, mean;  // u₂ − u₁, (w₂ − w₁)/L, θ₂ − θ₁, (θ₁ + θ₂)/2
  stretch << -1, 0, 0, 1, 0, 0;
  chord << 0, -1 / L, 0, 0, 1 / L, 0;
  bend << 0, 0, -1, 0, 0, 1;
  mean << 0, 0, 0.5, 0, 0, 0.5;
  const Row<E> shear = chord - mean;

  Field<E> f;
  f.u << eta, 0, 0, xi, 0, 0;
  f.w << 0, eta, 0, 0, xi, 0;
  f.w += L * (cubic * shear - bow * bend);
  f.theta = mean - bow_slope * bend + 6 * a * xi * eta * shear;
  f.du = stretch / L;
  f.dw = chord + cubic_slope * shear - bow_slope * bend;
  return f;
}

double rotary_inertia(const Bar&) { return 0; }
template <BeamElement E>
double rotary_inertia(const E& e) {
  return e.rhoI;
}

/// ∫ integrand(field, ξ) ds, rotated into body axes. Exact to degree 7; M needs 6.
template <class E, class F>
Square<E> integrate(const E& e, const Matrix2d& x, F integrand) {
  struct Point {
    double xi, weight;
  };
  constexpr std::array points{Point{0.06943184420297371, 0.17392742256872693}, Point{0.33000947820757187, 0.32607257743127307},
                              Point{0.66999052179242813, 0.32607257743127307}, Point{0.93056815579702629, 0.17392742256872693}};
  const double L = length(x);
  Square<E> sum = Square<E>::Zero();
  for (const Point& p : points) sum += p.weight * L * integrand(field(e, L, p.xi), p.xi);
  const Square<E> Q = turn<E>(x);
  return Q * sum * Q.transpose();
}

/// The three deformation modes, in body dofs: elongation, relative rotation of the ends, and the distance of the far end from a chord
/// in the direction of the mean rotation.
template <class E>
struct Natural {
  Row<E> stretch, bend, shear;
};

template <class E>
Natural<E> natural(const Matrix2d& x) {
  const double L = length(x);
  Natural<E> d{Row<E>::Zero(), Row<E>::Zero(), Row<E>::Zero()};
  constexpr int second = E::dofs_per_node;
  d.stretch[0] = -1;
  d.stretch[second] = 1;
  if constexpr (BeamElement<E>) {
    d.bend << 0, 0, -1, 0, 0, 1;
    d.shear << 0, -1, -L / 2, 0, 1, -L / 2;
  }
  const Square<E> Q = turn<E>(x);
  return {d.stretch * Q.transpose(), d.bend * Q.transpose(), d.shear * Q.transpose()};
}

/// Stiffness of the deformation modes: N per elongation, mean M per relative rotation, V per distance from the chord.
struct Springs {
  double stretch, bend, shear;
};

Springs springs(const Bar& e, double L) { return {e.EA / L, 0, 0}; }
template <BeamElement E>
Springs springs(const E& e, double L) {
  return {e.EA / L, e.EI / L, 12 * e.EI / (L * L * L * (1 + shear_ratio(e, L)))};
}

}  // namespace

template <LineElement E>
Square<E> stiffness(const E& e, const Coords<E>& x) {
  const Natural<E> d = natural<E>(x);
  const Springs k = springs(e, length(x));
  return k.stretch * d.stretch.transpose() * d.stretch + k.bend * d.bend.transpose() * d.bend + k.shear * d.shear.transpose() * d.shear;
}

template <LineElement E>
Square<E> mass(const E& e, const Coords<E>& x) {
  return integrate(e, x, [&](const Field<E>& f, double) -> Square<E> {
    return e.rhoA * (f.u.transpose() * f.u + f.w.transpose() * f.w) + rotary_inertia(e) * f.theta.transpose() * f.theta;
  });
}

template <LineElement E>
NodalVector<E> lumped_mass(const E& e, const Coords<E>& x) {
  const double half = length(x) / 2;
  NodalVector<E> m;
  for (int i = 0; i < E::dofs; ++i) m[i] = half * (i % E::dofs_per_node < 2 ? e.rhoA : rotary_inertia(e));
  return m;
}

template <LineElement E>
Square<E> skew_mass(const E& e, const Coords<E>& x) {
  return integrate(e, x, [&](const Field<E>& f, double) -> Square<E> { return e.rhoA * (f.u.transpose() * f.w - f.w.transpose() * f.u); });
}

template <LineElement E>
ShapeMatrix<E> shape(const E& e, const Coords<E>& x, const Vector2d& xi) {
  const Field<E> f = field(e, length(x), xi.x());
  const Square<E> Q = turn<E>(x);
  ShapeMatrix<E> N;
  N << f.u, f.w;
  return Q.template topLeftCorner<2, 2>() * N * Q.transpose();
}

template <LineElement E>
Stress<E> stress(const E& e, const Coords<E>& x, const NodalVector<E>& u) {
  const double L = length(x);
  const Natural<E> d = natural<E>(x);
  const Springs k = springs(e, L);
  const double N = k.stretch * d.stretch.dot(u), V = k.shear * d.shear.dot(u);
  const double M = k.bend * d.bend.dot(u);
  Stress<E> s;
  s << N, N, V, V, M + V * L / 2, M - V * L / 2;
  return s;
}

template <LineElement E>
Square<E> geometric_stiffness(const E& e, const Coords<E>& x, const Stress<E>& s) {
  return integrate(e, x, [&](const Field<E>& f, double xi) -> Square<E> {
    const double N = (1 - xi) * s(0, 0) + xi * s(0, 1), V = (1 - xi) * s(1, 0) + xi * s(1, 1);
    return N * f.dw.transpose() * f.dw - V * (f.du.transpose() * f.theta + f.theta.transpose() * f.du);
  });
}

template <BeamElement E>
Eigen::Matrix<double, 1, 6> rotation(const E& e, const Coords<E>& x, double xi) {
  return field(e, length(x), xi).theta * turn<E>(x).transpose();
}

template <LineElement E>
NodalVector<E> line_load(const E&, const Coords<E>& x, const Vector2d& q) {
  const double L = length(x);
  NodalVector<E> f = NodalVector<E>::Zero();
  f.template head<2>() = f.template segment<2>(E::dofs_per_node) = q * L / 2;
  if constexpr (BeamElement<E>) {
    const Vector2d t = (x.col(1) - x.col(0)) / L;
    const double across = t.x() * q.y() - t.y() * q.x();
    f[2] = across * L * L / 12;
    f[5] = -f[2];
  }
  return f;
}

// Instantiates all functions for all elements.

template Square<Bar> stiffness(const Bar&, const Coords<Bar>&);
template Square<Bar> mass(const Bar&, const Coords<Bar>&);
template NodalVector<Bar> lumped_mass(const Bar&, const Coords<Bar>&);
template Square<Bar> skew_mass(const Bar&, const Coords<Bar>&);
template ShapeMatrix<Bar> shape(const Bar&, const Coords<Bar>&, const Vector2d&);
template Stress<Bar> stress(const Bar&, const Coords<Bar>&, const NodalVector<Bar>&);
template Square<Bar> geometric_stiffness(const Bar&, const Coords<Bar>&, const Stress<Bar>&);
template NodalVector<Bar> line_load(const Bar&, const Coords<Bar>&, const Vector2d&);

template Square<BeamEuler> stiffness(const BeamEuler&, const Coords<BeamEuler>&);
template Square<BeamEuler> mass(const BeamEuler&, const Coords<BeamEuler>&);
template NodalVector<BeamEuler> lumped_mass(const BeamEuler&, const Coords<BeamEuler>&);
template Square<BeamEuler> skew_mass(const BeamEuler&, const Coords<BeamEuler>&);
template ShapeMatrix<BeamEuler> shape(const BeamEuler&, const Coords<BeamEuler>&, const Vector2d&);
template Stress<BeamEuler> stress(const BeamEuler&, const Coords<BeamEuler>&, const NodalVector<BeamEuler>&);
template Square<BeamEuler> geometric_stiffness(const BeamEuler&, const Coords<BeamEuler>&, const Stress<BeamEuler>&);
template NodalVector<BeamEuler> line_load(const BeamEuler&, const Coords<BeamEuler>&, const Vector2d&);
template Eigen::Matrix<double, 1, 6> rotation(const BeamEuler&, const Coords<BeamEuler>&, double);

template Square<BeamTimoshenko> stiffness(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
template Square<BeamTimoshenko> mass(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
template NodalVector<BeamTimoshenko> lumped_mass(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
template Square<BeamTimoshenko> skew_mass(const BeamTimoshenko&, const Coords<BeamTimoshenko>&);
template ShapeMatrix<BeamTimoshenko> shape(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const Vector2d&);
template Stress<BeamTimoshenko> stress(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const NodalVector<BeamTimoshenko>&);
template Square<BeamTimoshenko> geometric_stiffness(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const Stress<BeamTimoshenko>&);
template NodalVector<BeamTimoshenko> line_load(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, const Vector2d&);
template Eigen::Matrix<double, 1, 6> rotation(const BeamTimoshenko&, const Coords<BeamTimoshenko>&, double);

static_assert(Element<Bar> && Element<BeamEuler> && Element<BeamTimoshenko>);

}  // namespace pintle
