#include "framework/configuration/moved_by_hand.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>

#include "framework/configuration/row_space.h"

namespace pintle {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Only the joints of the system, without forces.
System joints_alone(const System& system) {
  System out = system;
  out.joints.clear(), out.joint_names.clear();
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    if (is_driver(system.joints[k]) || is_link(system, static_cast<int>(k))) continue;
    out.joints.push_back(system.joints[k]);
    out.joint_names.push_back(system.joint_names[k]);
  }
  out.joints.insert(out.joints.end(), system.loose.begin(), system.loose.end());
  out.joint_names.insert(out.joint_names.end(), system.loose_names.begin(), system.loose_names.end());
  for (std::size_t c = 0; c < static_cast<std::size_t>(n_clearances(system)); ++c) {
    out.joints.emplace_back(Revolute{system.contacts[c].a, system.contacts[c].b});
    out.joint_names.push_back(system.contact_names[c]);
  }
  out.frictions.clear(), out.forces.clear(), out.force_names.clear(), out.contacts.clear(), out.contact_names.clear();
  out.signals.clear(), out.laws.clear(), out.states.clear(), out.switches.clear(), out.loose.clear(), out.loose_names.clear();
  out.joint_switch.clear(), out.force_switch.clear(), out.contact_switch.clear();
  number(out);
  return out;
}

}  // namespace

MovedByHand::MovedByHand(const System& system, const VectorXd& y) : system_(joints_alone(system)), eq_(system_), q_(y.head(system_.n())) {
  VectorXd q = q_;
  if (close(q)) q_ = q;
  stand(q_);
}

void MovedByHand::stand(const VectorXd& q) {
  VectorXd y = VectorXd::Zero(system_.n_y());
  y.head(system_.n()) = q;
  pose(system_, 0, y, eq_);
  rows_.factor(system_, eq_);
}

/// Newton's method on C = 0, with steps of least norm.
bool MovedByHand::close(VectorXd& q) {
  constexpr double closed = 1e-11;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 20; ++i) {
    stand(q);
    const double left = system_.n_rows() == 0 ? 0 : eq_.C.cwiseProduct(system_.row_scale).lpNorm<Eigen::Infinity>();
    if (left < closed) return true;
    constexpr double enough_to_see = 1e-8;
    if (!(left < before)) return left < enough_to_see;
    before = left;
    q += rows_.solve(system_, -eq_.C);
  }
  return false;
}

/// The part of a motion that the joints allow.
VectorXd MovedByHand::allowed(const VectorXd& motion) const {
  return system_.n_rows() == 0 ? motion : VectorXd(motion - rows_.solve(system_, rows_.times(system_, motion)));
}

// Levenberg–Marquardt for the position of the point over the motions that the joints allow: G = P S² Jᵀ, S being the scale of coordinates.
bool MovedByHand::pull(int body, const Vector2d& point, const Vector2d& to) {
  const Eigen::Index at = 3 * static_cast<Eigen::Index>(body);
  const VectorXd metric = system_.scale.cwiseAbs2();
  const auto arm = [&](const VectorXd& q) -> Vector2d { return Eigen::Rotation2Dd(q[at + 2]) * point; };
  const auto missing = [&](const VectorXd& q) -> Vector2d { return to - q.segment<2>(at) - arm(q); };
  double damping = 1e-6;
  for (int i = 0; i < 60 && damping < 1e3; ++i) {
    constexpr double there = 1e-9;
    const Vector2d d = missing(q_), r = arm(q_);
    if (d.norm() < there * system_.length) break;
    Eigen::Matrix<double, 2, 3> J;
    J << 1, 0, -r.y(), 0, 1, r.x();
    MatrixXd G = MatrixXd::Zero(q_.size(), 2);
    for (int k = 0; k < 2; ++k) {
      G.col(k).segment<3>(at) = metric.segment<3>(at).cwiseProduct(J.row(k).transpose());
      G.col(k) = allowed(G.col(k));
    }
    const Eigen::Matrix2d M = J * G.middleRows<3>(at);
    const double size = metric[at] + metric[at + 1];
    VectorXd step = G * (M + damping * size * Eigen::Matrix2d::Identity()).inverse() * d;
    constexpr double longest = 0.2;  // relative to the mechanism's length, or radians
    step *= std::min(1.0, longest / std::max(step.cwiseQuotient(system_.scale).lpNorm<Eigen::Infinity>(), 1e-300));
    VectorXd q = q_ + step;
    if (close(q) && missing(q).norm() < d.norm()) {
      const bool crawls = missing(q).norm() > (1 - 1e-10) * d.norm();
      q_ = q, damping = std::max(damping / 10, 1e-9);
      if (crawls) break;
    } else {
      damping *= 10;
      stand(q_);
    }
  }
  stand(q_);
  return q_.allFinite();
}

int MovedByHand::mobility() const { return system_.n() - row_space(system_, eq_).rank; }

MatrixXd MovedByHand::dofs(int most) const {
  const Eigen::Index n = system_.n(), wanted = std::min<Eigen::Index>(most, mobility());
  MatrixXd basis(n, 0), out(n, 0);  // the first scaled and orthogonal, the second as returned
  for (int turn = 0; turn < 2 && out.cols() < wanted; ++turn)
    for (Eigen::Index k = 0; k < system_.n_rigid() && out.cols() < wanted; ++k) {
      if ((k % 3 == 2) != (turn == 0)) continue;  // angles first, which users drag most
      VectorXd unit = VectorXd::Zero(n);
      unit[k] = system_.scale[k];
      VectorXd v = allowed(unit).cwiseQuotient(system_.scale);
      const double all = v.norm();
      v -= basis * (basis.transpose() * v);
      constexpr double worth = 1e-3;  // share of a motion that must be new
      if (all < worth || v.norm() < worth) continue;
      basis.conservativeResize(n, basis.cols() + 1), out.conservativeResize(n, out.cols() + 1);
      basis.rightCols(1) = v.normalized();
      out.rightCols(1) = v.cwiseProduct(system_.scale) / v.lpNorm<Eigen::Infinity>();
    }
  return out;
}

}  // namespace pintle
