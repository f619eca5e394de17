#include "tests/verification/closed_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

namespace closed {
namespace {

const double pi = std::acos(-1.0);

double halved(const std::function<double(double)>& f, double a, double b) {
  const bool negative = f(a) < 0;
  for (int i = 0; i < 200 && b - a > 1e-15 * b; ++i) {
    const double m = (a + b) / 2;
    ((f(m) < 0) == negative ? a : b) = m;
  }
  return (a + b) / 2;
}

Values in_hertz(Values omega) {
  for (double& w : omega) w /= 2 * pi;
  return omega;
}

// Columns scaled, so that the determinant neither overflows nor vanishes.
double scaled_determinant(Eigen::MatrixXd A) {
  for (Eigen::Index j = 0; j < A.cols(); ++j) A.col(j) /= A.col(j).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < A.rows(); ++i) A.row(i) /= A.row(i).cwiseAbs().maxCoeff();
  return A.determinant();
}

}  // namespace

Values roots(const std::function<double(double)>& f, double from, double step, std::size_t count) {
  Values found;
  double a = from, fa = f(a);
  for (int i = 0; found.size() < count; ++i) {
    if (i > 1'000'000) throw std::runtime_error("too few roots");
    const double b = a + step, fb = f(b);
    if ((fa < 0) != (fb < 0)) found.push_back(halved(f, a, b));
    a = b, fa = fb;
  }
  return found;
}

Values beam(const Beam& b, End first, End second, std::size_t count, double mass, double inertia) {
  // State over x/L: w/L, θ, ML/EI, QL²/EI with Q = κGA (w′ − θ), M = EI θ′.
  const double L = b.length, time2 = b.rhoA * L * L * L * L / b.EI;
  const auto determinant = [&](double omega) {
    const double w2 = omega * omega * time2;
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 1) = 1, A(0, 3) = b.GA > 0 ? b.EI / (b.GA * L * L) : 0;
    A(1, 2) = 1;
    A(2, 1) = -b.rhoI / (b.rhoA * L * L) * w2, A(2, 3) = -1;
    A(3, 0) = -w2;
    const Eigen::Matrix4d E = A.exp();
    Eigen::Matrix<double, 2, 4> R = Eigen::Matrix<double, 2, 4>::Zero();
    if (second == End::clamped) R(0, 0) = R(1, 1) = 1;
    if (second == End::pinned) R(0, 0) = R(1, 2) = 1;
    if (second == End::free) {
      R(0, 2) = R(1, 3) = 1;
      R(0, 1) = -w2 * inertia / (b.rhoA * L * L * L), R(1, 0) = -w2 * mass / (b.rhoA * L);
    }
    const std::array<int, 2> open = first == End::clamped  ? std::array<int, 2>{2, 3}
                                    : first == End::pinned ? std::array<int, 2>{1, 3}
                                                           : std::array<int, 2>{0, 1};
    Eigen::Matrix2d D;
    for (int j = 0; j < 2; ++j) D.col(j) = R * E.col(open[static_cast<std::size_t>(j)]);
    return D.determinant();
  };
  const double scale = 1 / std::sqrt(time2);
  return in_hertz(roots(determinant, 0.02 * scale, 0.05 * scale, count));
}

Values wedge(double length, double root, double tip, double E, double rho, std::size_t count) {
  const double slope = (root - tip) / length, far = root / slope, near = tip / slope;
  const auto determinant = [&](double omega) {
    const double p = omega * std::sqrt(12 * rho / E) / slope;
    Eigen::Matrix4d D;
    // w = Z₁(z)/z and its slope over 2p, Z₂ with a sign, z = 2√(px); w″ ∝ ∓pw − 2w′, shear ∝ w′.
    const auto fill = [&](double x, int row, bool clamped) {
      const double z = 2 * std::sqrt(p * x);
      const double one[4] = {std::cyl_bessel_j(1, z), std::cyl_neumann(1, z), std::cyl_bessel_i(1, z), std::cyl_bessel_k(1, z)};
      const double two[4] = {-std::cyl_bessel_j(2, z), -std::cyl_neumann(2, z), std::cyl_bessel_i(2, z), -std::cyl_bessel_k(2, z)};
      for (int k = 0; k < 4; ++k) {
        const double w = one[k] / z, slope_w = 2 * p * two[k] / (z * z), sign = k < 2 ? -1 : 1;
        D(row, k) = clamped ? w : sign * p * w - 2 * slope_w;
        D(row + 1, k) = clamped ? slope_w : sign * slope_w;
      }
    };
    fill(far, 0, true);
    fill(near, 2, false);
    return scaled_determinant(D);
  };
  const double scale = std::sqrt(E / (12 * rho)) * root / (length * length);
  return in_hertz(roots(determinant, 0.5 * scale, 0.1 * scale, count));
}

namespace {

struct Stiffness {
  Eigen::Matrix<double, 6, 6> K;
  int clamped;  ///< frequencies below ω of the member with both ends held
};

Stiffness member(const Frame& f, double L, double omega) {
  const double l = L * std::pow(f.rhoA * omega * omega / f.EI, 0.25);
  const double m = omega * L * std::sqrt(f.rhoA / f.EA);
  const double s = std::sin(l), c = std::cos(l), S = std::sinh(l), C = std::cosh(l);
  const double e = f.EI / (L * L * L) / (1 - c * C), a = f.EA / L * m;
  const double ww = e * l * l * l * (s * C + c * S), wt = e * l * l * s * S * L, wv = -e * l * l * l * (s + S),
               wu = e * l * l * (C - c) * L, tt = e * l * (s * C - c * S) * L * L, tu = e * l * (S - s) * L * L;
  Stiffness k;
  k.K << a / std::tan(m), 0, 0, -a / std::sin(m), 0, 0,  //
      0, ww, wt, 0, wv, wu,                              //
      0, wt, tt, 0, -wu, tu,                             //
      -a / std::sin(m), 0, 0, a / std::tan(m), 0, 0,     //
      0, wv, -wu, 0, ww, -wt,                            //
      0, wu, tu, 0, -wt, tt;
  const int i = static_cast<int>(l / pi);
  const bool even = i % 2 == 0, positive = 1 - c * C > 0;
  k.clamped = static_cast<int>(m / pi) + i - (even == positive ? 0 : 1);
  return k;
}

// How many frequencies lie below ω.
int below(const Frame& f, double omega) {
  const auto n = static_cast<Eigen::Index>(3 * f.nodes.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  int count = 0;
  for (const auto& [a, b] : f.members) {
    const auto &p = f.nodes[static_cast<std::size_t>(a)], &q = f.nodes[static_cast<std::size_t>(b)];
    const double dx = q[0] - p[0], dy = q[1] - p[1], L = std::hypot(dx, dy);
    Eigen::Matrix<double, 6, 6> T = Eigen::Matrix<double, 6, 6>::Zero();
    for (int k : {0, 3}) {
      T.block<2, 2>(k, k) << dx / L, dy / L, -dy / L, dx / L;
      T(k + 2, k + 2) = 1;
    }
    const Stiffness k = member(f, L, omega);
    count += k.clamped;
    const Eigen::Matrix<double, 6, 6> G = T.transpose() * k.K * T;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) K.block<3, 3>(3 * (i ? b : a), 3 * (j ? b : a)) += G.block<3, 3>(3 * i, 3 * j);
  }
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < n; ++i)
    if (i % 3 == 2 || std::ranges::find(f.pinned, static_cast<int>(i / 3)) == f.pinned.end()) free.push_back(i);
  const Eigen::VectorXd lambda = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K(free, free)).eigenvalues();
  return count + static_cast<int>((lambda.array() < 0).count());
}

}  // namespace

Values frame(const Frame& f, std::size_t count) {
  Values omega;
  double low = 1e-3;
  const int rigid = below(f, low);
  double high = 1;
  while (below(f, high) - rigid < static_cast<int>(count)) high *= 2;
  for (std::size_t k = 0; k < count; ++k) {
    double a = low, b = high;
    for (int i = 0; i < 100 && b - a > 1e-13 * b; ++i) {
      const double m = (a + b) / 2;
      (below(f, m) - rigid > static_cast<int>(k) ? b : a) = m;
    }
    omega.push_back((a + b) / 2);
  }
  return in_hertz(omega);
}

Values ring(const Solid& s, double a, double b, std::size_t count) {
  const double G = s.E / (2 * (1 + s.nu)), lame = s.E * s.nu / (1 - s.nu * s.nu);
  const double fast = std::sqrt(s.E / (1 - s.nu * s.nu) / s.rho), slow = std::sqrt(G / s.rho);
  const auto determinant = [&](int n, double omega) {
    Eigen::Matrix4d D;
    for (int row = 0; row < 2; ++row) {
      const double r = row == 0 ? a : b;
      for (int k = 0; k < 4; ++k) {
        const double q = omega / (k < 2 ? fast : slow), z = q * r;
        const auto Z = [&](int m) { return k % 2 == 0 ? std::cyl_bessel_j(m, z) : std::cyl_neumann(m, z); };
        const double f = Z(n), d = q * (n == 0 ? -Z(1) : Z(n - 1) - n * f / z);
        const double dd = -d / r - (q * q - n * n / (r * r)) * f;
        if (k < 2) {  // gradient of f cos nθ
          D(2 * row, k) = 2 * G * dd - lame * q * q * f;
          D(2 * row + 1, k) = G * (2 * n * f / (r * r) - 2 * n * d / r);
        } else {  // curl of f sin nθ
          D(2 * row, k) = 2 * G * n * (d / r - f / (r * r));
          D(2 * row + 1, k) = G * (d / r - dd - n * n * f / (r * r));
        }
      }
    }
    return scaled_determinant(D);
  };
  Values all;
  const double step = 0.01 * slow / b;
  for (int n = 0; n <= static_cast<int>(count) / 2 + 2; ++n)
    for (const double w : roots([&](double x) { return determinant(n, x); }, step, step, 4)) all.insert(all.end(), n == 0 ? 1 : 2, w);
  std::ranges::sort(all);
  all.resize(count);
  return in_hertz(all);
}

Values square(const Solid& s, double a, bool clamped, int power, std::size_t count) {
  const int m = power + 1, points = m + 4;
  // Gauss's points from the eigenvalues of Legendre's recurrence.
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(points, points);
  for (int i = 1; i < points; ++i) T(i, i - 1) = T(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gauss(T);
  Eigen::MatrixXd F(points, m), D(points, m);
  for (int g = 0; g < points; ++g) {
    const double x = gauss.eigenvalues()[g];
    Eigen::VectorXd P(m), d(m);
    for (int i = 0; i < m; ++i) {
      P[i] = i == 0 ? 1 : i == 1 ? x : ((2 * i - 1) * x * P[i - 1] - (i - 1) * P[i - 2]) / i;
      d[i] = i == 0 ? 0 : i == 1 ? 1 : d[i - 2] + (2 * i - 1) * P[i - 1];
    }
    const double weight = std::sqrt(2 * std::pow(gauss.eigenvectors()(0, g), 2));
    const double edge = clamped ? 1 - x * x : 1, slope = clamped ? -2 * x : 0;
    F.row(g) = weight * edge * P;
    D.row(g) = weight * (edge * d + slope * P);
  }
  const Eigen::MatrixXd A = F.transpose() * F, B = D.transpose() * D, C = D.transpose() * F;
  const auto product = [&](const Eigen::MatrixXd& X, const Eigen::MatrixXd& Y) {
    Eigen::MatrixXd Z(m * m, m * m);
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j) Z.block(i * m, j * m, m, m) = X(i, j) * Y;
    return Z;
  };
  const double d1 = s.E / (1 - s.nu * s.nu), d12 = s.nu * d1, d3 = s.E / (2 * (1 + s.nu));
  const int n = m * m;
  Eigen::MatrixXd K(2 * n, 2 * n), M = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  K.topLeftCorner(n, n) = d1 * product(B, A) + d3 * product(A, B);
  K.bottomRightCorner(n, n) = d3 * product(B, A) + d1 * product(A, B);
  K.topRightCorner(n, n) = d12 * product(C, C.transpose()) + d3 * product(C.transpose(), C);
  K.bottomLeftCorner(n, n) = K.topRightCorner(n, n).transpose();
  M.topLeftCorner(n, n) = M.bottomRightCorner(n, n) = s.rho * a * a / 4 * product(A, A);
  const Eigen::VectorXd lambda = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M, Eigen::EigenvaluesOnly).eigenvalues();
  Values omega;
  for (Eigen::Index i = clamped ? 0 : 3; omega.size() < count; ++i) omega.push_back(std::sqrt(lambda[i]));
  return in_hertz(omega);
}

double quarter_ring(double E, double thickness, double a, double b) {
  const double sum = a * a + b * b;
  return pi * sum / (E * thickness * (sum * std::log(b / a) - (b * b - a * a)));
}

namespace {

using Complex = std::complex<double>;

// A term (z − pole)ᵏ of either potential and its stress σx, σy, τ.
struct Term {
  Complex pole;
  int power;
  double scale;
  bool second;
  Complex factor;
  Eigen::Vector3d stress(Complex z) const {
    const Complex w = (z - pole) / scale, d = factor * double(power) * std::pow(w, power - 1) / scale,
                  dd = factor * double(power * (power - 1)) * std::pow(w, power - 2) / (scale * scale);
    const double sum = second ? 0 : 4 * d.real();
    const Complex difference = second ? 2.0 * d : 2.0 * std::conj(z) * dd;
    return {(sum - difference.real()) / 2, (sum + difference.real()) / 2, difference.imag() / 2};
  }
};

std::vector<Term> terms(double a, double b, double l) {
  std::vector<Term> out;
  const auto add = [&](Complex pole, int power, double scale) {
    for (const bool second : {false, true})
      for (const Complex factor : {Complex(1, 0), Complex(0, 1)}) out.push_back({pole, power, scale, second, factor});
  };
  for (int k = 1; k <= 16; ++k) add(0, -k, a);
  for (int k = 1; k <= 24; ++k) add(0, k, l);
  for (const double y : {-2 * b, 2 * b})
    for (int k = 1; k <= 12; ++k) add({0, y}, -k, b);
  return out;
}

struct EdgePoint {
  Complex z, normal;
  double pull;
};

std::vector<EdgePoint> edge_points(double a, double b, double l) {
  std::vector<EdgePoint> out;
  const auto side = [&](Complex p, Complex q, Complex normal, int n, double pull) {
    for (int i = 0; i < n; ++i) out.push_back({p + (q - p) * (1 - std::cos(pi * (i + 0.5) / n)) / 2.0, normal, pull});
  };
  for (int i = 0; i < 200; ++i) {
    const Complex e = std::polar(1.0, 2 * pi * (i + 0.5) / 200);
    out.push_back({a * e, -e, 0});
  }
  for (const double s : {-1, 1}) {
    side({-l, s * b}, {l, s * b}, {0, s}, 300, 0);
    side({s * l, -b}, {s * l, b}, {s, 0}, 100, s);
  }
  return out;
}

}  // namespace

double strip_with_hole(double a, double b, double l) {
  const std::vector<Term> basis = terms(a, b, l);
  const std::vector<EdgePoint> points = edge_points(a, b, l);
  const auto n = static_cast<Eigen::Index>(basis.size()), m = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd A(2 * m, n);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(2 * m), at_hole(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const Term& term = basis[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < m; ++i) {
      const EdgePoint& p = points[static_cast<std::size_t>(i)];
      const Eigen::Vector3d s = term.stress(p.z);
      A(2 * i, j) = s[0] * p.normal.real() + s[2] * p.normal.imag();
      A(2 * i + 1, j) = s[2] * p.normal.real() + s[1] * p.normal.imag();
      pull[2 * i] = p.pull;
    }
    const double size = std::max(A.col(j).norm(), 1e-300);
    A.col(j) /= size;
    at_hole[j] = term.stress({0, a})[0] / size;
  }
  return at_hole.dot(A.completeOrthogonalDecomposition().solve(pull));
}

}  // namespace closed
