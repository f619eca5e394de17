#include "framework/dynamics/newton/elimination.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "framework/common/index.h"
#include "framework/dynamics/solvers/sparse_ldl.h"

namespace pintle {

namespace {

// Body of each coordinate.
std::vector<int> bodies_of(const System& system) {
  std::vector<int> body(at(system.n()));
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) {
    for (int c = 0; c < 3; ++c) body[at(3 * b + c)] = b;
    for (int i = system.eta_begin[at(b)]; i < system.eta_begin[at(b) + 1]; ++i) body[at(i)] = b;
  }
  return body;
}

// Joints on each body.
std::vector<std::vector<int>> joints_on(const System& system, const Equations& eq) {
  std::vector<std::vector<int>> joints(system.bodies.size());
  for (const Equations::End& end : eq.ends) {
    std::vector<int>& on = joints[at(end.q / 3)];
    const int joint = static_cast<int>(end.joint);
    if (on.empty() || on.back() != joint) on.push_back(joint);
  }
  return joints;
}

void append_rows(const System& system, int joint, std::vector<int>& order) {
  for (int row = system.row_begin[at(joint)]; row < system.row_begin[at(joint) + 1]; ++row) order.push_back(system.n() + row);
}

std::vector<int> rows_last(const System& system, const std::vector<std::vector<int>>& joints) {
  std::vector<int> order(at(system.n()));
  std::iota(order.begin(), order.end(), 0);
  std::vector<Pattern::Place> meet;
  for (const std::vector<int>& on : joints)
    for (int a : on)
      for (int b : on) meet.push_back({std::max(a, b), std::min(a, b)});
  for (int joint : fill_reducing_order(static_cast<int>(system.joints.size()), meet)) append_rows(system, joint, order);
  return order;
}

std::vector<int> body_by_body(const System& system, const std::vector<std::vector<int>>& joints, std::vector<Pattern::Place> meet) {
  std::vector<std::vector<int>> bodies(system.joints.size());  // connected by each joint
  for (std::size_t b = 0; b < joints.size(); ++b)
    for (int joint : joints[b]) bodies[at(joint)].push_back(static_cast<int>(b));
  for (const std::vector<int>& joined : bodies)
    for (std::size_t i = 0; i < joined.size(); ++i)
      for (std::size_t j = i + 1; j < joined.size(); ++j) meet.push_back({joined[i], joined[j]});
  std::vector<int> order, waiting(system.joints.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) waiting[k] = static_cast<int>(bodies[k].size());
  for (int b : fill_reducing_order(static_cast<int>(system.bodies.size()), meet)) {
    for (int c = 0; c < 3; ++c) order.push_back(3 * b + c);
    for (int i = system.eta_begin[at(b)]; i < system.eta_begin[at(b) + 1]; ++i) order.push_back(i);
    int room = 3 + system.bodies[at(b)].modes();
    for (bool last_body : {true, false})
      for (int joint : joints[at(b)]) {
        int& left = waiting[at(joint)];
        const int height = system.row_begin[at(joint) + 1] - system.row_begin[at(joint)];
        if (last_body && left > 0) --left;  // the present body has been reached
        if (left < 0 || (last_body ? left > 0 : height > room)) continue;
        append_rows(system, joint, order);
        room -= height;
        left = -1;
      }
  }
  for (std::size_t k = 0; k < bodies.size(); ++k)  // joints between ground and ground
    if (bodies[k].empty()) append_rows(system, static_cast<int>(k), order);
  return order;
}

}  // namespace

std::vector<int> elimination_order(const System& system, const Equations& eq, const std::vector<Pattern::Place>& J) {
  const std::vector<int> body = bodies_of(system);
  const std::vector<std::vector<int>> joints = joints_on(system, eq);
  std::vector<Pattern::Place> meet;
  for (const Pattern::Place& p : J)
    if (body[at(p.row)] != body[at(p.column)]) meet.push_back({body[at(p.row)], body[at(p.column)]});
  double pairs = 0;  // entries of S, counted in joints: a hub with many joints makes it dense
  for (const std::vector<int>& on : joints) pairs += static_cast<double>(on.size() * on.size());
  constexpr double much = 20;  // per joint; 4 in a chain
  const bool hub = pairs > much * static_cast<double>(system.joints.size());
  return meet.empty() && !hub ? rows_last(system, joints) : body_by_body(system, joints, std::move(meet));
}

}  // namespace pintle
