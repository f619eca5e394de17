#include "framework/dynamics/equations/tangent.h"

#include <algorithm>
#include <map>
#include <utility>

#include "framework/common/index.h"
#include "framework/dynamics/equations/internal.h"

namespace pintle {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Block = Eigen::Map<Eigen::MatrixXd>;

namespace {

// Friction in a joint, with its load held constant.
bool answers_to_speed(const FrictionLaw& law) {
  const auto* dry = std::get_if<Coulomb>(&law);
  return !dry || dry->stribeck > 0;
}

}  // namespace

Tangent::Tangent(const System& system) : ends_(most_ends, MarkerJacobian(system)), laws_(system) {
  for (std::size_t i = 0; i < system.joints.size(); ++i)
    add(system, Interaction::joint, i, ends_of(system.joints[i]), properties_of(system.joints[i]).curvature);
  for (std::size_t i = 0; i < system.forces.size(); ++i)
    add(system, Interaction::force, i, {{marker_a(system.forces[i]), marker_b(system.forces[i])}, 2}, wrench_pattern(system.forces[i]));
  for (std::size_t i = 0; i < system.contacts.size(); ++i)
    add(system, Interaction::contact, i, {{system.contacts[i].a, system.contacts[i].b}, 2}, contact_pattern);
  for (std::size_t i = 0; i < system.frictions.size(); ++i)
    if (answers_to_speed(system.frictions[i].law))
      add(system, Interaction::friction, i, ends_of(system.joints[at(system.frictions[i].joint)]), contact_pattern);
  lay_out(system);

  for (const Body& body : system.bodies)
    if (body.modes() > 0) flexible_.emplace_back(body.modes());
}

// Records the interaction with 0 for each block that it has; lay_out replaces these by positions.
void Tangent::add(const System& system, Interaction::Kind kind, std::size_t index, const JointEnds& ends, const WrenchPattern& pattern) {
  const auto moves = [&](std::size_t end) { return system.markers[at(ends.marker[end])].body != ground; };
  const auto owner = kind == Interaction::force     ? InternalStates::force
                     : kind == Interaction::contact ? InternalStates::contact
                                                    : InternalStates::friction;
  const auto states = std::ranges::find_if(
      system.internal, [&](const InternalStates& s) { return kind != Interaction::joint && s.owner == owner && at(s.index) == index; });
  const int place = states == system.internal.end() ? -1 : static_cast<int>(states - system.internal.begin());
  Interaction x{kind, index, at(ends.n), ends.marker, {}, pattern.rate, place};
  bool any = false;
  for (std::size_t i = 0; i < x.n; ++i)
    for (std::size_t j = 0; j < x.n; ++j) {
      const bool there = pattern.block[i][j] && moves(i) && moves(j);
      x.block[i][j] = there ? 0 : -1;
      any = any || there;
    }
  if (any) interactions_.push_back(x);
}

void Tangent::lay_out(const System& system) {
  const auto body_of = [&](const Interaction& x, std::size_t end) { return system.markers[at(x.marker[end])].body; };
  const auto put_block = [&](int row_body, int column_body) {
    const int begin = static_cast<int>(places_.size());
    for (int j = 0; j < coordinates_of(system, column_body); ++j)
      for (int i = 0; i < coordinates_of(system, row_body); ++i)
        places_.push_back({coordinate(system, row_body, i), coordinate(system, column_body, j)});
    return begin;
  };
  const auto each_block = [&](auto does) {
    for (Interaction& x : interactions_)
      for (std::size_t i = 0; i < x.n; ++i)
        for (std::size_t j = 0; j < x.n; ++j)
          if (x.block[i][j] >= 0) does(x.block[i][j], body_of(x, i), body_of(x, j));
    for (LawTangent::Sized& x : laws_.sized)
      for (std::size_t i = 0; i < x.on.size(); ++i)
        for (std::size_t j = 0; j < x.by.size(); ++j) does(x.block[i][j], x.on[i], x.by[j]);
  };

  std::vector<bool> full;
  for (const Body& body : system.bodies) full.push_back(body.modes() > 0);
  each_block([&](int, int row, int column) {
    if (row == column) full[at(row)] = true;
  });

  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) {
    const int begin = static_cast<int>(places_.size());
    own_.push_back({begin, full[at(b)] ? coordinates_of(system, b) : 0});
    if (full[at(b)])
      put_block(b, b);
    else
      for (int i = 0; i < 3; ++i) places_.push_back({3 * b + i, 3 * b + i});
  }
  std::map<std::pair<int, int>, int> known;
  each_block([&](int& block, int row, int column) {
    if (row == column) {
      block = own_[at(row)].begin;
      return;
    }
    const auto [place, is_new] = known.try_emplace({row, column});
    if (is_new) place->second = put_block(row, column);
    block = place->second;
  });
}

void Tangent::evaluate(const System& system, const State& state, const Equations& eq, const VectorXd& a, const VectorXd& lambda,
                       const Weights& w, std::vector<double>& values) {
  std::fill(values.begin(), values.end(), 0.0);
  add_inertia(system, state, eq, a, w, values.data());
  if (w.q != 0) add_geometric_stiffness_of_forces(system, eq, lambda, w.q, values.data());
  if (w.q != 0 || w.s != 0) add_interactions(system, state, eq, lambda, w, values.data()), laws_.add(system, state, eq, w, values.data());
}

void Tangent::add_inertia(const System& system, const State& state, const Equations& eq, const VectorXd& a, const Weights& w,
                          double* values) {
  for (std::size_t b = 0; b < own_.size(); ++b) {
    if (eq.flexible_of[b] >= 0) continue;
    const int begin = own_[b].begin, next = own_[b].stride + 1;
    values[begin] += w.a * system.bodies[b].m;
    values[begin + next] += w.a * system.bodies[b].m;
    values[begin + 2 * next] += w.a * system.bodies[b].J;
  }
  for (std::size_t i = 0; i < eq.flexible.size(); ++i) {
    const FlexibleInertia& e = eq.flexible[i];
    Block K(values + own_[at(e.body)].begin, 3 + e.n, 3 + e.n);
    add_inertia_tangent(system, e, state.y, a, w, flexible_[i], K);
  }
}

// −Σ f·∂²p/∂q²: forces stay at their points on bodies that turn and bend.
void Tangent::add_geometric_stiffness_of_forces(const System& system, const Equations& eq, const VectorXd& lambda, double weight,
                                                double* values) const {
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    const int row = system.row_begin[k], m = system.row_begin[k + 1] - row;
    for (int e = system.end_begin[k]; e < system.end_begin[k + 1]; ++e) {
      const ConstraintRows::Block& L = eq.L[at(e)];
      double fx = 0, fy = 0;
      for (int i = 0; i < m; ++i) {
        const double l = weight * lambda[row + i];
        fx -= L(i, 0) * l;
        fy -= L(i, 1) * l;
      }
      add_geometric_stiffness(system, eq, system.end_marker[at(e)], fx, fy, values);
    }
  }
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const ForceEffect& now = eq.force[k];
    add_geometric_stiffness(system, eq, marker_a(system.forces[k]), weight * now.on_a[0], weight * now.on_a[1], values);
    add_geometric_stiffness(system, eq, marker_b(system.forces[k]), weight * now.on_b[0], weight * now.on_b[1], values);
  }
  for (std::size_t k = 0; k < system.contacts.size(); ++k) {
    const ContactEffect& now = eq.contact[k];
    if (now.normal.force == 0) continue;
    add_geometric_stiffness(system, eq, system.contacts[k].a, weight * now.on_a[0], weight * now.on_a[1], values);
    add_geometric_stiffness(system, eq, system.contacts[k].b, weight * now.on_b[0], weight * now.on_b[1], values);
  }
}

void Tangent::add_geometric_stiffness(const System& system, const Equations& eq, int marker, double fx, double fy, double* values) const {
  const Marker& m = system.markers[at(marker)];
  if (m.body == ground) return;
  const MarkerMotion& motion = eq.motion[at(marker)];
  const Own& own = own_[at(m.body)];
  values[own.begin + 2 + 2 * own.stride] += fx * motion.d.x() + fy * motion.d.y();
  const Index n = motion.flex.cols();
  if (n == 0) return;
  Block K(values + own.begin, 3 + n, 3 + n);
  for (Index i = 0; i < n; ++i) {
    const double turned = fy * motion.flex(0, i) - fx * motion.flex(1, i);  // f·ZF
    K(2, 3 + i) -= turned;
    K(3 + i, 2) -= turned;
  }
  if (m.second[0].size() == 0) return;
  const double c = eq.cos_[m.body], s = eq.sin_[m.body];
  K.bottomRightCorner(n, n) -= (c * fx + s * fy) * m.second[0] + (c * fy - s * fx) * m.second[1];
}

WrenchTangent Tangent::wrenches(const System& system, const Equations& eq, const VectorXd& lambda, const Interaction& x) {
  const MarkerMotion &a = eq.motion[at(x.marker[0])], &b = eq.motion[at(x.marker[1])];
  switch (x.kind) {
    case Interaction::joint: break;
    case Interaction::force: return wrench_tangent(system.forces[x.index], eq.force[x.index], a, b);
    case Interaction::contact: return wrench_tangent(system.contacts[x.index], eq.contact[x.index], a, b);
    case Interaction::friction: {
      const JointFriction& rub = system.frictions[x.index];
      return wrench_tangent(unit_friction(system.joints[at(rub.joint)], rub, a, b), eq.friction[x.index]);
    }
  }
  return wrench_tangent(system.joints[x.index], eq.motion.data(), lambda.data() + system.row_begin[x.index]);
}

// −Jᵀ(P J + D V) for q and −JᵀD J for s, where P and D are the derivatives of the wrenches with respect to poses and their rates.
void Tangent::add_interactions(const System& system, const State& state, const Equations& eq, const VectorXd& lambda, const Weights& w,
                               double* values) {
  for (const Interaction& x : interactions_) {
    const bool follows = w.x != 0 && x.owner >= 0;
    const bool rate = x.rate || follows;
    if (w.q == 0 && !rate) continue;
    if (x.kind == Interaction::contact && eq.contact[x.index].normal.force == 0) continue;
    if (x.kind == Interaction::force && is_released(system, Switch::force, static_cast<int>(x.index), state.y)) continue;
    WrenchTangent tangent = wrenches(system, eq, lambda, x);
    if (follows) condense(internal_tangent(system, state, eq, system.internal[at(x.owner)]), w.x, tangent);
    for (std::size_t i = 0; i < x.n; ++i) move(system, state, eq, x.marker[i], ends_[i]);

    for (std::size_t i = 0; i < x.n; ++i)
      for (std::size_t j = 0; j < x.n; ++j) {
        if (x.block[i][j] < 0) continue;
        const MarkerJacobian &on = ends_[i], &by = ends_[j];
        const Index row = static_cast<Index>(3 * i), column = static_cast<Index>(3 * j);
        Matrix3d K = w.q * tangent.pose.block<3, 3>(row, column);
        Matrix3d D = Matrix3d::Zero();
        if (rate) {
          D = tangent.rate.block<3, 3>(row, column);
          K += w.s * D;
          D *= w.q;
        }
        Matrix3d in_frame = K;  // (K J + D V) on [x y θ], J being [1 J_θ J_η]
        in_frame.col(2) = K * by.J_theta + D * by.V_theta;
        Eigen::Map<Matrix3d, 0, Eigen::OuterStride<>> frame(values + x.block[i][j], Eigen::OuterStride<>(3 + on.n));
        frame.topRows<2>() -= in_frame.topRows<2>();
        frame.row(2) -= on.J_theta.transpose() * in_frame;
        if (on.n == 0 && by.n == 0) continue;
        Block block(values + x.block[i][j], 3 + on.n, 3 + by.n);
        const auto from_shapes = on.J_eta.topRows(on.n);
        for (Index c = 0; c < 3; ++c) block.col(c).tail(on.n).noalias() -= from_shapes.lazyProduct(in_frame.col(c));
        for (Index c = 0; c < by.n; ++c) {
          const Vector3d in_shape = K * by.J_eta.row(c).transpose() + D * by.V_eta.row(c).transpose();
          auto by_shape = block.col(3 + c);
          by_shape.head<2>() -= in_shape.head<2>();
          by_shape[2] -= on.J_theta.dot(in_shape);
          by_shape.tail(on.n).noalias() -= from_shapes.lazyProduct(in_shape);
        }
      }
  }
}

Tangent::Internal Tangent::internal(const System& system, const State& state, const Equations& eq) {
  const Index n = system.n(), n_x = system.n_x();
  Internal out{MatrixXd::Zero(n, n_x), MatrixXd::Zero(n_x, n), MatrixXd::Zero(n_x, n), MatrixXd::Zero(n_x, n_x)};
  for (const InternalStates& owner : system.internal) {
    const std::array<int, 2> markers = markers_of(system, owner);
    const InternalTangent of = internal_tangent(system, state, eq, owner);
    out.g_x.block(owner.begin, owner.begin, owner.n, owner.n) = of.g_x;
    for (std::size_t i = 0; i < markers.size(); ++i) {
      const int body = system.markers[at(markers[i])].body;
      if (body == ground) continue;
      MarkerJacobian& end = ends_[i];
      move(system, state, eq, markers[i], end);
      Eigen::Matrix3Xd J(3, 3 + end.n), V = Eigen::Matrix3Xd::Zero(3, 3 + end.n);
      J << Eigen::Matrix<double, 3, 2>::Identity(), end.J_theta, end.J_eta.topRows(end.n).transpose();
      V.rightCols(1 + end.n) << end.V_theta, end.V_eta.topRows(end.n).transpose();
      const Index part = 3 * static_cast<Index>(i);
      const MatrixXd f_x = J.transpose() * of.wrench.middleRows(part, 3), g_s = of.g_rate.middleCols(part, 3) * J,
                     g_q = of.g_pose.middleCols(part, 3) * J + of.g_rate.middleCols(part, 3) * V;
      for (Index c = 0; c < J.cols(); ++c) {
        const int q = coordinate(system, body, static_cast<int>(c));
        out.f_x.row(q).segment(owner.begin, owner.n) += f_x.row(c);
        out.g_q.col(q).segment(owner.begin, owner.n) += g_q.col(c);
        out.g_s.col(q).segment(owner.begin, owner.n) += g_s.col(c);
      }
    }
  }
  laws_.couple(system, state, eq, out.f_x, out.g_q, out.g_s, out.g_x);
  return out;
}

Eigen::MatrixXd dense(const System& system, const Tangent& tangent, const std::vector<double>& values) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(system.n(), system.n());
  for (std::size_t i = 0; i < values.size(); ++i) A(tangent.places()[i].row, tangent.places()[i].column) += values[i];
  return A;
}

}  // namespace pintle
