#include "framework/component/fe/contact_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "contact/plane.h"
#include "meshes/rim_shape.h"

namespace pintle {

namespace {

using Eigen::Vector2d;
using std::numbers::pi;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr double round_enough = 1e-5;  // distance of corners from their circle, relative to its radius

/// Distance from the first to the second of two places along a curve, the short way round on a circle.
double apart(const ContactCurve& c, double from, double to) { return c.straight ? to - from : std::remainder(to - from, 2 * pi); }

Vector2d radial(double angle) { return {std::cos(angle), std::sin(angle)}; }

double place_of(const ContactCurve& c, const Vector2d& x) {
  const Vector2d d = x - c.center;
  return c.straight ? c.along.dot(d) : std::atan2(d.y(), d.x());
}
Vector2d point_at(const ContactCurve& c, double s) {
  return c.straight ? Vector2d(c.center + s * c.along) : Vector2d(c.center + std::abs(c.radius) * radial(s));
}
/// Outward normal of the body.
Vector2d normal_at(const ContactCurve& c, double s) {
  if (c.straight) return {c.along.y(), -c.along.x()};
  return c.radius > 0 ? radial(s) : Vector2d(-radial(s));
}
/// Distance of a point from the surface, positive outside the body.
double distance(const ContactCurve& c, const Vector2d& x) {
  if (c.straight) return normal_at(c, 0).dot(x - c.center);
  const double r = (x - c.center).norm();
  return c.radius > 0 ? r - c.radius : -c.radius - r;
}
double length_per_place(const ContactCurve& c) { return c.straight ? 1 : std::abs(c.radius); }

/// Position along the curve as a function of ξ from −1 to 1, interpolated from the side's nodes; its derivative; and ξ for a given
/// position.
double bend(const ContactSide& side) { return side.middle - (side.from + side.to) / 2; }
double place_at(const ContactSide& side, double xi) {
  return side.from + (1 + xi) / 2 * (side.to - side.from) + bend(side) * (1 - xi * xi);
}
double place_rate(const ContactSide& side, double xi) { return (side.to - side.from) / 2 - 2 * bend(side) * xi; }
double xi_at(const ContactSide& side, double from_start) {
  double xi = 2 * from_start / (side.to - side.from) - 1;
  for (int k = 0; k < 6 && bend(side) != 0; ++k) xi -= (place_at(side, xi) - side.from - from_start) / place_rate(side, xi);
  return xi;
}

/// Shape functions N of a side's nodes.
std::array<double, 3> side_shape(const ContactSide& side, double xi) {
  if (side.nodes == 2) return {(1 - xi) / 2, (1 + xi) / 2, 0};
  return {xi * (xi - 1) / 2, xi * (xi + 1) / 2, 1 - xi * xi};
}

/// Two surfaces, as seen from the sides of the first.
class Facing {
 public:
  Facing(const ContactSurface& first, const ContactSurface& second, const Vector2d& shift)
      : first_(first), second_(second), shift_(shift) {}

  double place_on_first(const ContactSide& side, double xi) const { return place_at(side, xi); }
  Vector2d point(const ContactSide& side, double xi) const { return point_at(first_.curve, place_on_first(side, xi)) + shift_; }
  double place_on_second(const ContactSide& side, double xi) const { return place_of(second_.curve, point(side, xi)); }
  bool faces(const ContactSide& side, double xi) const {
    return normal_at(first_.curve, place_on_first(side, xi)).dot(normal_at(second_.curve, place_on_second(side, xi))) < 0;
  }

  /// The side of the second surface at a position along it.
  const ContactSide* opposite(double place) const {
    for (const ContactSide& s : second_.sides) {
      const double whole = apart(second_.curve, s.from, s.to), there = apart(second_.curve, s.from, place);
      if (there / whole >= 0 && there / whole <= 1) return &s;
    }
    return nullptr;
  }

  /// Values of ξ opposite the ends of the second surface's sides, ascending, with −1 and 1.
  std::vector<double> cuts(const ContactSide& side) const {
    const double begin = place_on_second(side, -1), width = apart(second_.curve, begin, place_on_second(side, 1));
    std::vector<double> out{-1, 1};
    for (const ContactSide& s : second_.sides)
      for (const double end : {s.from, s.to})
        if (const double part = apart(second_.curve, begin, end) / width; part > 0 && part < 1) out.push_back(opposite_end(side, end));
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  double opposite_end(const ContactSide& side, double end) const {
    double low = -1, high = 1;
    const bool rises = apart(second_.curve, place_on_second(side, -1), end) > 0;
    while (high - low > 1e-15) {
      const double middle = (low + high) / 2;
      ((apart(second_.curve, place_on_second(side, middle), end) > 0) == rises ? low : high) = middle;
      if (middle == (low + high) / 2) break;
    }
    return (low + high) / 2;
  }

  const ContactSurface &first_, &second_;
  Vector2d shift_;
};

ContactCurve curve_of(const Mesh& mesh, const std::vector<Cells>& sides) {
  const RimShape rim = rim_shape(mesh, sides);
  const Cells& some = sides.front();
  const Vector2d a = mesh.x.col(some.nodes[0]), b = mesh.x.col(some.nodes[1]);
  if (std::isinf(rim.radius)) return {.straight = true, .center = a, .along = (b - a).normalized()};
  if (rim.misfit > round_enough) throw std::invalid_argument("lies neither on one circle nor on one straight line");
  const double sense = cross(a - rim.center, b - rim.center) > 0 ? 1 : -1;
  return {.center = rim.center, .radius = sense * rim.radius};
}

}  // namespace

ContactSurface contact_surface(const Mesh& mesh, const std::vector<Cells>& sides, double thickness) {
  ContactSurface out;
  out.thickness = thickness;
  if (sides.empty() || sides.front().size() == 0) throw std::invalid_argument("has no side of the mesh along it");
  out.curve = curve_of(mesh, sides);
  for (const Cells& cells : sides) {
    const int n = nodes_of(cells.shape);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const int* node = &cells.nodes[i * static_cast<std::size_t>(n)];
      ContactSide side{{node[0], node[1], n == 3 ? node[2] : -1}, n, place_of(out.curve, mesh.x.col(node[0])), 0, 0};
      const auto on_from = [&](int other) { return side.from + apart(out.curve, side.from, place_of(out.curve, mesh.x.col(other))); };
      side.to = on_from(node[1]);
      side.middle = n == 3 ? on_from(node[2]) : (side.from + side.to) / 2;
      out.sides.push_back(side);
    }
  }
  return out;
}

namespace {

/// Adds the integrals over the part of one side that is opposite another side.
class RowSums {
 public:
  RowSums(const FeModel& first, const FeModel& second, std::size_t rows)
      : model_{&first, &second}, gap(rows, 0), area(rows, 0), pushed(2, static_cast<Eigen::Index>(rows)) {
    pushed.setZero();
  }

  void add(std::size_t row, double weight, double distance, const Vector2d& n) {
    area[row] += weight;
    gap[row] += weight * distance;
    pushed.col(static_cast<Eigen::Index>(row)) += weight * n;
  }
  void add(int body, std::size_t row, const ContactSide& side, double xi, const Vector2d& weighted) {
    const auto N = side_shape(side, xi);
    for (int k = 0; k < side.nodes; ++k)
      for (int d = 0; d < 2; ++d)
        part[body].emplace_back(static_cast<int>(row), model_[body]->begin[static_cast<std::size_t>(side.node[k])] + d,
                                N[static_cast<std::size_t>(k)] * weighted[d]);
  }

 private:
  const FeModel* model_[2];

 public:
  std::vector<double> gap, area;
  Eigen::Matrix2Xd pushed;
  Triplets part[2];
};

void integrate(const Facing& facing, const ContactSurface& first, const ContactSurface& second, const ContactSide& side,
               const std::array<std::size_t, 2>& rows, RowSums& sums) {
  static constexpr std::array<double, 4> at{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526},
      share{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  const double per_place = length_per_place(first.curve) * std::min(first.thickness, second.thickness);
  const std::vector<double> cuts = facing.cuts(side);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double half = (cuts[i] - cuts[i - 1]) / 2, middle = (cuts[i] + cuts[i - 1]) / 2;
    if (!(half > 1e-12) || !facing.faces(side, middle)) continue;
    const ContactSide* other = facing.opposite(facing.place_on_second(side, middle));
    if (!other) continue;
    for (std::size_t g = 0; g < at.size(); ++g) {
      const double xi = middle + half * at[g], place = facing.place_on_second(side, xi);
      const double eta = xi_at(*other, apart(second.curve, other->from, place));
      const Vector2d n = normal_at(second.curve, place);
      const double dA = share[g] * half * std::abs(place_rate(side, xi)) * per_place;
      for (int end = 0; end < 2; ++end) {
        const double weight = dA * (end == 0 ? 1 - xi : 1 + xi) / 2;
        const std::size_t row = rows[static_cast<std::size_t>(end)];
        sums.add(row, weight, distance(second.curve, facing.point(side, xi)), n);
        sums.add(0, row, side, xi, weight * n);
        sums.add(1, row, *other, eta, -weight * n);
      }
    }
  }
}

}  // namespace

ContactRows contact_rows(const FeModel& first_body, const ContactSurface& first, const FeModel& second_body, const ContactSurface& second,
                         const Vector2d& shift) {
  std::map<int, std::size_t> row_of;
  std::vector<double> along, whole;
  std::vector<int> node;
  const auto row = [&](int corner, double place) {
    const auto [at, is_new] = row_of.try_emplace(corner, row_of.size());
    if (is_new) along.push_back(place), node.push_back(corner);
    return at->second;
  };
  std::vector<std::array<std::size_t, 2>> rows;
  for (const ContactSide& s : first.sides) rows.push_back({row(s.node[0], s.from), row(s.node[1], s.to)});
  whole.assign(along.size(), 0);
  RowSums sums(first_body, second_body, along.size());
  const Facing facing(first, second, shift);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    integrate(facing, first, second, first.sides[i], rows[i], sums);
    for (const std::size_t r : rows[i])
      whole[r] += std::abs(first.sides[i].to - first.sides[i].from) / 2 * length_per_place(first.curve) * first.thickness;
  }

  // Hat functions with almost no opposite surface are left out.
  std::vector<int> kept(along.size(), -1);
  int count = 0;
  for (std::size_t r = 0; r < along.size(); ++r)
    if (sums.area[r] > 1e-6 * whole[r]) kept[r] = count++;
  if (count == 0) throw std::invalid_argument("the two surfaces do not face each other anywhere");
  ContactRows out{.gap = Eigen::VectorXd(count),
                  .area = Eigen::VectorXd(count),
                  .along = Eigen::VectorXd(count),
                  .at = Eigen::Matrix2Xd(2, count),
                  .pushed = Eigen::Matrix2Xd(2, count),
                  .first = Sparse(count, first_body.N()),
                  .second = Sparse(count, second_body.N())};
  for (std::size_t r = 0; r < along.size(); ++r)
    if (const int k = kept[r]; k >= 0) {
      out.gap[k] = sums.gap[r] / sums.area[r];
      out.area[k] = sums.area[r];
      out.along[k] = along[r];
      out.at.col(k) = first_body.x.col(node[r]);
      out.pushed.col(k) = sums.pushed.col(static_cast<Eigen::Index>(r)) / sums.area[r];
    }
  for (int b = 0; b < 2; ++b) {
    Triplets part;
    for (const auto& t : sums.part[b])
      if (const auto r = static_cast<std::size_t>(t.row()); kept[r] >= 0) part.emplace_back(kept[r], t.col(), t.value() / sums.area[r]);
    (b == 0 ? out.first : out.second).setFromTriplets(part.begin(), part.end());
  }
  return out;
}

}  // namespace pintle
