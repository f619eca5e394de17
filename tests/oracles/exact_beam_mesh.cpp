#include "exact_beam_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace pintle_oracle {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;

/// Gauss' rule of 1 to 4 points.
std::vector<ShapeValues> rule(int degree, int points) {
  const double near = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)), far = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2)),
               part = std::sqrt(30.0) / 36;
  const std::vector<std::pair<double, double>> rules[] = {{{0, 2}},
                                                          {{-std::sqrt(1.0 / 3), 1}, {std::sqrt(1.0 / 3), 1}},
                                                          {{-std::sqrt(0.6), 5.0 / 9}, {0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}},
                                                          {{-far, 0.5 - part}, {-near, 0.5 + part}, {near, 0.5 + part}, {far, 0.5 - part}}};
  std::vector<ShapeValues> result;
  for (const auto& [x, w] : rules[points - 1]) result.push_back(shape_at(degree, 0.5 * (1 + x), 0.5 * w));
  return result;
}

/// Internal force, tangent and energy of an element of length `l` at its coordinates u.
struct Strained {
  ElementVector force;
  ElementMatrix tangent;
  double energy = 0;
};
Strained strained(const ExactBeam& beam, const std::vector<ShapeValues>& points, double l, const Eigen::Ref<const BeamVector>& u) {
  const int nodes = beam.degree + 1, n = 3 * nodes;
  Strained sum{ElementVector::Zero(n), ElementMatrix::Zero(n, n)};
  Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 12> B(3, n), DB(3, n);
  for (const ShapeValues& at : points) {
    Vector3d slope = Vector3d::Zero();
    double theta = 0;
    for (int i = 0; i < nodes; ++i) {
      slope += at.slope[std::size_t(i)] / l * u.segment<3>(3 * i);
      theta += at.value[std::size_t(i)] * u[3 * i + 2];
    }
    const Vector2d e1(std::cos(theta), std::sin(theta)), e2(-e1[1], e1[0]);
    const double stretch = e1.dot(slope.head<2>()), shear = e2.dot(slope.head<2>());
    const double N = beam.EA * (stretch - 1), Q = beam.GA * shear, m = beam.EI * slope[2];
    const double w = at.weight * l;
    for (int i = 0; i < nodes; ++i) {
      const double d = at.slope[std::size_t(i)] / l, v = at.value[std::size_t(i)];
      B.col(3 * i) << d * e1[0], d * e2[0], 0;
      B.col(3 * i + 1) << d * e1[1], d * e2[1], 0;
      B.col(3 * i + 2) << v * shear, -v * stretch, d;
    }
    DB = Vector3d(beam.EA, beam.GA, beam.EI).asDiagonal() * B;
    sum.force += w * B.transpose() * Vector3d(N, Q, m);
    sum.tangent += w * B.transpose() * DB;
    sum.energy += 0.5 * w * (N * (stretch - 1) + Q * shear + m * slope[2]);

    // N δ²ε + Q δ²γ
    const Vector2d turning = N * e2 - Q * e1;
    const double centring = -(N * stretch + Q * shear);
    for (int i = 0; i < nodes; ++i)
      for (int j = 0; j < nodes; ++j) {
        const double vj = w * at.value[std::size_t(j)];
        const Vector2d mixed = vj * at.slope[std::size_t(i)] / l * turning;
        sum.tangent.block<2, 1>(3 * i, 3 * j + 2) += mixed;
        sum.tangent.block<1, 2>(3 * j + 2, 3 * i) += mixed.transpose();
        sum.tangent(3 * i + 2, 3 * j + 2) += vj * at.value[std::size_t(i)] * centring;
      }
  }
  return sum;
}

SectionMotion prescribed(const BeamMesh& m, int end, double t) {
  const BeamEnd& e = end == 0 ? m.beam.a : m.beam.b;
  return e.law ? e.law(t) : SectionMotion{.place = m.rest[end].place};
}

void judge(const ExactBeam& b) {
  const auto want = [](bool good, const std::string& what) {
    if (!good) throw std::invalid_argument("exact beam: " + what);
  };
  want(b.length > 0 && b.EA > 0 && b.EI > 0 && b.GA > 0 && b.rhoA > 0 && b.rhoI > 0, "length, EA, EI, GA, rhoA and rhoI must be > 0");
  want(b.degree >= 1 && b.degree <= 3, "degree = " + std::to_string(b.degree) + ", must be 1, 2 or 3");
  want(b.elements * b.degree >= 2, "elements = " + std::to_string(b.elements) + ", must give two spans of nodes or more");
  for (const BeamEnd* e : {&b.a, &b.b}) {
    want(e->mass >= 0, "an end's mass = " + text(e->mass) + ", must be ≥ 0");
    want(e->hold != Hold::slide || e->line.norm() > 0, "the line of a slide must have a direction");
    want(!e->law || e->hold == Hold::hinge || e->hold == Hold::clamp, "an end with a law must be a hinge or a clamp");
  }
}

/// The start must move with what holds the ends.
void validate_start(const BeamMesh& m) {
  for (int end = 0; end < 2; ++end) {
    const BeamEnd& e = end == 0 ? m.beam.a : m.beam.b;
    if (e.hold == Hold::free) continue;
    const SectionMotion held_at = prescribed(m, end, 0), is = m.rest[end];
    Place off = held_at.place - is.place, slip = held_at.rate - is.rate;
    if (e.hold != Hold::clamp) off[2] = slip[2] = 0;
    if (e.hold == Hold::slide) {
      const Vector2d n = Vector2d(-e.line[1], e.line[0]).normalized();
      slip.head<2>() = n * n.dot(slip.head<2>());
    }
    if (off.norm() > 1e-9 * m.beam.length || slip.norm() > 1e-9 * (is.rate.norm() + held_at.rate.norm()))
      throw std::invalid_argument(std::string("exact beam: end ") + (end == 0 ? "A" : "B") + " starts off its support by " +
                                  text(off.norm()) + " m, " + text(slip.norm()) + " m/s; start it with the support");
  }
}

/// T, Te and first. Columns of T come node by node: an element's free coordinates are neighbours.
void add_dofs(BeamMesh& m) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<int> begin;  // column of a node's first coordinate
  int free = 0;
  for (int i = 0; i < m.nodes; ++i) {
    const BeamEnd* end = i == 0 ? &m.beam.a : i == m.nodes - 1 ? &m.beam.b : nullptr;
    const Hold hold = end ? end->hold : Hold::free;
    begin.push_back(free);
    if (hold == Hold::free) {
      entries.emplace_back(3 * i, free++, 1);
      entries.emplace_back(3 * i + 1, free++, 1);
    } else if (hold == Hold::slide) {
      const Vector2d along = end->line.normalized();
      entries.emplace_back(3 * i, free, along[0]);
      entries.emplace_back(3 * i + 1, free++, along[1]);
    }
    if (hold != Hold::clamp) entries.emplace_back(3 * i + 2, free++, 1);
  }
  begin.push_back(free);
  m.free = free;
  m.T.resize(3 * m.nodes, free);
  m.T.setFromTriplets(entries.begin(), entries.end());
  const MatrixXd full = MatrixXd(m.T);
  for (int e = 0; e < m.beam.elements; ++e) {
    const int node = e * m.beam.degree;
    const int from = begin[std::size_t(node)], to = begin[std::size_t(node + m.beam.degree + 1)];
    m.first.push_back(from);
    m.Te.push_back(full.block(3 * node, from, 3 * (m.beam.degree + 1), to - from));
  }
}

/// M and load.
void add_mass(BeamMesh& m) {
  std::vector<Eigen::Triplet<double>> entries;
  const Vector3d density(m.beam.rhoA, m.beam.rhoA, m.beam.rhoI);
  const Vector3d g(m.beam.gravity[0], m.beam.gravity[1], 0);
  m.load = BeamVector::Zero(3 * m.nodes);
  for (int e = 0; e < m.beam.elements; ++e)
    for (const ShapeValues& at : rule(m.beam.degree, m.beam.degree + 1))
      for (int i = 0; i <= m.beam.degree; ++i) {
        const int row = 3 * (e * m.beam.degree + i);
        const double v = m.l * at.weight * at.value[std::size_t(i)];
        m.load.segment<3>(row) += v * m.beam.rhoA * g;
        for (int j = 0; j <= m.beam.degree; ++j)
          for (int k = 0; k < 3; ++k)
            entries.emplace_back(row + k, 3 * (e * m.beam.degree + j) + k, v * at.value[std::size_t(j)] * density[k]);
      }
  for (int end = 0; end < 2; ++end) {
    const BeamEnd& e = end == 0 ? m.beam.a : m.beam.b;
    const int row = end * (3 * m.nodes - 3);
    m.load.segment<3>(row) += e.mass * g + e.load;
    for (int k = 0; k < 2; ++k) entries.emplace_back(row + k, row + k, e.mass);
  }
  m.M.resize(3 * m.nodes, 3 * m.nodes);
  m.M.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

ShapeValues shape_at(int degree, double xi, double weight) {
  ShapeValues result{.weight = weight};
  for (int i = 0; i <= degree; ++i) {
    double value = 1, slope = 0;
    for (int j = 0; j <= degree; ++j) {
      if (j == i) continue;
      const double span = double(i - j) / degree;
      slope = (slope * (xi - double(j) / degree) + value) / span;
      value *= (xi - double(j) / degree) / span;
    }
    result.value[std::size_t(i)] = value;
    result.slope[std::size_t(i)] = slope;
  }
  return result;
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

BeamMesh build(const ExactBeam& beam, const BeamStart& start) {
  judge(beam);
  BeamMesh m{.beam = beam,
             .nodes = beam.elements * beam.degree + 1,
             .free = 0,
             .width = 3 * beam.degree + 2,
             .l = beam.length / beam.elements,
             .points = rule(beam.degree, beam.degree),
             .T = {},
             .M = {},
             .Mz = {},
             .load = {},
             .Te = {},
             .first = {},
             .rest = {start(0), start(beam.length)}};
  validate_start(m);
  add_dofs(m);
  add_mass(m);
  m.Mz = m.T.transpose() * m.M * m.T;
  return m;
}

BeamVector held(const BeamMesh& m, double t, Place SectionMotion::*part) {
  BeamVector g = BeamVector::Zero(3 * m.nodes);
  for (int end = 0; end < 2; ++end) {
    const Hold hold = (end == 0 ? m.beam.a : m.beam.b).hold;
    if (hold == Hold::free) continue;
    g.segment(end * (3 * m.nodes - 3), hold == Hold::clamp ? 3 : 2) = (prescribed(m, end, t).*part).head(hold == Hold::clamp ? 3 : 2);
  }
  return g;
}

Internal internal(const BeamMesh& m, const BeamVector& u, bool with_tangents) {
  Internal sum{.force = BeamVector::Zero(u.size()), .energy = 0, .tangents = {}};
  const int rows = 3 * (m.beam.degree + 1);
  for (int e = 0; e < m.beam.elements; ++e) {
    const int row = 3 * e * m.beam.degree;
    const Strained is = strained(m.beam, m.points, m.l, u.segment(row, rows));
    sum.force.segment(row, rows) += is.force;
    sum.energy += is.energy;
    const ElementMatrix& Te = m.Te[std::size_t(e)];
    if (with_tangents) sum.tangents.push_back(Te.transpose() * (is.tangent * Te).eval());
  }
  return sum;
}

double size_of_step(const BeamMesh& m, const BeamVector& dz) {
  if (!dz.allFinite()) return std::numeric_limits<double>::infinity();
  const BeamVector du = m.T * dz;
  const auto places = Eigen::Map<const Places>(du.data(), 3, m.nodes);
  return std::max(places.topRows<2>().cwiseAbs().maxCoeff() / m.beam.length, places.row(2).cwiseAbs().maxCoeff());
}

StartCoordinates initial(const BeamMesh& m, const BeamStart& start) {
  BeamVector u(3 * m.nodes), rate(3 * m.nodes);
  for (int i = 0; i < m.nodes; ++i) {
    const SectionMotion at = start(m.beam.length * i / (m.nodes - 1));
    u.segment<3>(3 * i) = at.place;
    rate.segment<3>(3 * i) = at.rate;
  }
  return {m.T.transpose() * (u - held(m, 0, &SectionMotion::place)), m.T.transpose() * (rate - held(m, 0, &SectionMotion::rate))};
}

}  // namespace pintle_oracle
