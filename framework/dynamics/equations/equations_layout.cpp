// Storage for the equations of a system: tables of markers, ends and rows, built once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/common/index.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

using Eigen::VectorXd;
using Index = Eigen::Index;

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
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Marker& marker = system.markers[i];
    points.push_back({marker.body, marker.x_BP.x(), marker.x_BP.y(), marker.angle});
    if (marker.body != ground) continue;
    motion[i].r = motion[i].d = marker.x_BP;
    motion[i].angle = marker.angle;
    motion[i].u = {std::cos(marker.angle), std::sin(marker.angle)};
  }
  if (!system.states.empty()) {
    const auto n = static_cast<Index>(system.states.size());
    own.slopes.setZero(static_cast<Index>(laws.size()), static_cast<Index>(signals.size()));
    own.A.setZero(n, n);
    own.left = own.change = VectorXd::Zero(n);
  }
  directed.assign(motion.size(), false);
  for (const Joint& j : system.joints) {
    const JointEnds joined = ends_of(j);
    for (std::size_t i = 0; i < at(joined.n); ++i)
      if (properties_of(j).directions[i]) directed[at(joined.marker[i])] = true;
  }
  for (const Force& acting : system.forces)
    if (turns_with_b(acting)) directed[at(marker_b(acting))] = true;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const int n = system.bodies[b].modes();
    flexible_of.push_back(n > 0 ? static_cast<int>(flexible.size()) : -1);
    if (n == 0) continue;
    flexible.emplace_back(system, static_cast<int>(b));
  }
  for (std::size_t i = 0; i < motion.size(); ++i)
    if (system.markers[i].body != ground) motion[i].flex.setZero(2, system.bodies[at(system.markers[i].body)].modes());
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const int row = system.row_begin[k], m = system.row_begin[k + 1] - row;
    for (int i = 0; i < m; ++i) joint_rows.push_back({static_cast<int>(k), i});
    for (int e = system.end_begin[k]; e < system.end_begin[k + 1]; ++e) {
      const int marker = system.end_marker[at(e)], body = system.markers[at(marker)].body;
      if (body == ground) continue;
      ends.push_back({k, at(e), marker, 3 * body, row, m, flexible_of[at(body)], feels_shapes(system, system.joints[k], marker)});
      for (int i = 0; i < m; ++i) end_rows.push_back({row + i, 3 * body, 9 * e + 3 * i, marker});
      B_eta[at(e)].setZero(3, system.bodies[at(body)].modes());
    }
  }
  if (!flexible.empty()) B_hat = B;
  B_eta_hat = B_eta;
  for (const End& end : ends)
    if (end.flexible >= 0 && flexible[at(end.flexible)].stiffens) B_eta_hat[end.at].setZero(3, flexible[at(end.flexible)].n + 3);
  W.resize(system.n_rigid());
  constexpr double alike = 100;  // inverse inertias within this ratio lose no more than two digits to rounding
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const auto include = [&](double w) { least = std::min(least, w), most = std::max(most, w); };
  for (const Body& body : system.bodies) include(1 / body.m);
  for (const Marker& m : system.markers)
    if (m.body != ground) include(1 / system.bodies[at(m.body)].m + m.x_BP.squaredNorm() / system.bodies[at(m.body)].J);
  uneven = !flexible.empty() || most > alike * least;
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    W.segment<3>(static_cast<Index>(3 * b)) << 1 / system.bodies[b].m, 1 / system.bodies[b].m, 1 / system.bodies[b].J;
}

}  // namespace pintle
