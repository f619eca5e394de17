// Storage for the equations of a system: tables of markers, ends and rows, built once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/common/index.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

using Eigen::VectorXd;
using Index = Eigen::Index;

namespace {

void lay_out_markers(const System& system, Equations& eq) {
  for (std::size_t i = 0; i < eq.motion.size(); ++i) {
    const Marker& marker = system.markers[i];
    MarkerMotion& motion = eq.motion[i];
    eq.points.push_back({marker.body, marker.x_BP.x(), marker.x_BP.y(), marker.angle});
    if (marker.body != ground) {
      motion.flex.setZero(2, system.bodies[at(marker.body)].modes());
      continue;
    }
    motion.r = motion.d = marker.x_BP;
    motion.angle = marker.angle;
    motion.u = {std::cos(marker.angle), std::sin(marker.angle)};
  }
  eq.directed.assign(eq.motion.size(), false);
  for (const Joint& j : system.joints) {
    const JointEnds joined = ends_of(j);
    for (std::size_t i = 0; i < at(joined.n); ++i)
      if (properties_of(j).directions[i]) eq.directed[at(joined.marker[i])] = true;
  }
  for (const Force& acting : system.forces)
    if (turns_with_b(acting)) eq.directed[at(marker_b(acting))] = true;
}

void lay_out_bodies(const System& system, Equations& eq) {
  eq.W.resize(system.n_rigid());
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Body& body = system.bodies[b];
    eq.W.segment<3>(static_cast<Index>(3 * b)) << 1 / body.m, 1 / body.m, 1 / body.J;
    eq.flexible_of.push_back(body.modes() > 0 ? static_cast<int>(eq.flexible.size()) : -1);
    if (body.modes() > 0) eq.flexible.emplace_back(system, static_cast<int>(b));
  }
}

// After lay_out_bodies.
void lay_out_rows(const System& system, Equations& eq) {
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const int row = system.row_begin[k], m = system.row_begin[k + 1] - row;
    for (int i = 0; i < m; ++i) eq.joint_rows.push_back({static_cast<int>(k), i});
    for (int e = system.end_begin[k]; e < system.end_begin[k + 1]; ++e) {
      const int marker = system.end_marker[at(e)], body = system.markers[at(marker)].body;
      if (body == ground) continue;
      eq.ends.push_back({k, at(e), marker, 3 * body, row, m, eq.flexible_of[at(body)], feels_shapes(system, system.joints[k], marker)});
      for (int i = 0; i < m; ++i) eq.end_rows.push_back({row + i, 3 * body, 9 * e + 3 * i, marker});
      eq.B_eta[at(e)].setZero(3, system.bodies[at(body)].modes());
    }
  }
  if (!eq.flexible.empty()) eq.B_hat = eq.B;
  eq.B_eta_hat = eq.B_eta;
  for (const Equations::End& end : eq.ends)
    if (end.flexible >= 0 && eq.flexible[at(end.flexible)].stiffens) eq.B_eta_hat[end.at].setZero(3, eq.flexible[at(end.flexible)].n + 3);
}

// Whether inverse inertias differ so much that rounding loses more than two digits.
bool is_uneven(const System& system) {
  constexpr double alike = 100;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const auto include = [&](double w) { least = std::min(least, w), most = std::max(most, w); };
  for (const Body& body : system.bodies) include(1 / body.m);
  for (const Marker& m : system.markers)
    if (m.body != ground) include(1 / system.bodies[at(m.body)].m + m.x_BP.squaredNorm() / system.bodies[at(m.body)].J);
  return most > alike * least;
}

}  // namespace

Equations::Equations(const System& system)
    : motion(system.markers.size()),
      rows(system.joints.size()),
      L(system.end_marker.size(), ConstraintRows::Block::Zero()),
      B(L.size(), Schur::Block::Zero()),
      B_eta(B.size()),
      schur(system),
      C(VectorXd::Zero(system.n_rows())),
      Cdot(C),
      f(VectorXd::Zero(system.n())),
      a(f),
      lambda(C),
      contact(system.contacts.size()),
      force(system.forces.size()),
      signals(system.signals.size()),
      laws(system.laws.size()),
      friction(system.frictions.size()),
      gamma(C),
      mu(C),
      g(f),
      cos_(VectorXd::Zero(static_cast<Index>(system.bodies.size()))),
      sin_(cos_) {
  lay_out_markers(system, *this);
  lay_out_bodies(system, *this);
  lay_out_rows(system, *this);
  if (!system.states.empty()) {
    const auto n = static_cast<Index>(system.states.size());
    own.slopes.setZero(static_cast<Index>(laws.size()), static_cast<Index>(signals.size()));
    own.A.setZero(n, n);
    own.left = own.change = VectorXd::Zero(n);
  }
  uneven = !flexible.empty() || is_uneven(system);
}

}  // namespace pintle
