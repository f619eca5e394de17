#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include "eigen_layout.h"
#include "framework/common/index.h"
#include "framework/configuration/row_space.h"
#include "framework/scene/scene.h"

namespace pintle {

/// A coordinate of a body's origin, or its rate, given by the scene.
struct Pin {
  int body, axis;
  double value;  ///< [m] or [m/s]
};

/// The rows to be closed at the start: the joints, two rows for each clearance joint, and the origins of bodies that the scene fixes: first
/// their positions, then, for the speeds, their rates. For a massless link the scene's eccentricity gives only the direction, and its rate
/// only the part across.
class Closure {
  using VectorXd = Eigen::VectorXd;
  using Index = Eigen::Index;
  using Sparse = Eigen::SparseMatrix<double>;

 public:
  /// @param pressed  unit vectors along massless links for which the scene gives no eccentricity
  /// @param drawn    drawn positions of journals in their bearings, for those without an eccentricity; empty: in the middle
  Closure(const Scene& scene, const System& system, const std::vector<Eigen::Vector2d>& pressed,
          const std::vector<Eigen::Vector2d>& drawn = {})
      : system_(system), eq_(system), offset_(at(n_clearances(system))), drift_(offset_.size()) {
    for (std::size_t c = 0; c < offset_.size(); ++c) {
      offset_[c] = drawn.empty() ? Eigen::Vector2d::Zero() : drawn[c];
      drift_[c].setZero();
      for (const StartJournal& s : scene.start_journals)
        if (s.joint == system.contact_names[c]) {
          offset_[c] << s.eccentricity[0], s.eccentricity[1];
          drift_[c] << s.speed[0], s.speed[1];
        }
      if (!is_held(system.contacts[c])) continue;
      const Eigen::Vector2d n = offset_[c].norm() > 0 ? Eigen::Vector2d(offset_[c].normalized()) : pressed[c];
      offset_[c] = system.contacts[c].gap.clearance() * n;
      drift_[c] -= n.dot(drift_[c]) * n;
    }
  }

  void pin(std::vector<Pin> pins) { pins_ = std::move(pins); }
  Index rows() const { return first_pin() + static_cast<Index>(pins_.size()); }

  /// C and, if requested, its Jacobian; lengths relative to the mechanism's length.
  VectorXd violation(const VectorXd& y, Sparse* J = nullptr) {
    pose(system_, 0, y, eq_);
    VectorXd C(rows());
    C.head(system_.n_rows()) = eq_.C.cwiseProduct(system_.row_scale);
    for (std::size_t c = 0; c < offset_.size(); ++c) {
      const ContactPair& pair = system_.contacts[c];
      C.segment<2>(first(c)) = (eq_.motion[at(pair.a)].r - eq_.motion[at(pair.b)].r - offset_[c]) / system_.length;
    }
    for (std::size_t p = 0; p < pins_.size(); ++p) {
      const Pin& pin = pins_[p];
      C[first_pin() + static_cast<Index>(p)] = (y[3 * pin.body + pin.axis] + arm(y, pin)[pin.axis] - pin.value) / system_.length;
    }
    if (J) jacobian(y, *J);
    return C;
  }

  /// Ċ at speeds s, scaled in the same way.
  VectorXd drift(const VectorXd& y) {
    pose(system_, 0, y, eq_);
    speed(system_, 0, y, eq_);
    VectorXd D(rows());
    D.head(system_.n_rows()) = eq_.Cdot.cwiseProduct(system_.row_scale);
    for (std::size_t c = 0; c < offset_.size(); ++c) {
      const ContactPair& pair = system_.contacts[c];
      D.segment<2>(first(c)) = (eq_.motion[at(pair.a)].v - eq_.motion[at(pair.b)].v - drift_[c]) / system_.length;
    }
    for (std::size_t p = 0; p < pins_.size(); ++p) {
      const Pin& pin = pins_[p];
      const double* s = y.data() + system_.n() + 3 * pin.body;
      D[first_pin() + static_cast<Index>(p)] = (s[pin.axis] + s[2] * perp(arm(y, pin))[pin.axis] - pin.value) / system_.length;
    }
    return D;
  }

  /// The joint, clearance or body that a row belongs to.
  std::string owner(Index row) const {
    if (const int k = joint(row); k >= 0) return system_.joint_names[at(k)];
    if (row < first_pin()) return system_.contact_names[at(static_cast<int>((row - system_.n_rows()) / 2))];
    return system_.bodies[at(pins_[at(static_cast<int>(row - first_pin()))].body)].name;
  }
  std::string amount(Index row, double scaled) const {
    std::ostringstream s;
    s.precision(3);
    const int k = joint(row);
    if (k >= 0 && is_angle_row(system_.joints[at(k)], static_cast<int>(row) - system_.row_begin[at(k)]))
      s << std::abs(scaled) << " rad";
    else
      s << std::abs(scaled) * system_.length << " m";
    return s.str();
  }
  int joint(Index row) const {
    if (row >= system_.n_rows()) return -1;
    const auto next = std::upper_bound(system_.row_begin.begin(), system_.row_begin.end(), static_cast<int>(row));
    return static_cast<int>(next - system_.row_begin.begin()) - 1;
  }
  /// 1 for rows in angles, 0 for rows in lengths.
  VectorXd angle_rows() const {
    VectorXd out = VectorXd::Zero(rows());
    for (std::size_t k = 0; k < system_.joints.size(); ++k)
      for (int row = system_.row_begin[k]; row < system_.row_begin[k + 1]; ++row)
        out[row] = is_angle_row(system_.joints[k], row - system_.row_begin[k]) ? 1 : 0;
    return out;
  }
  /// Joints with rows that are exactly or nearly dependent together with this row, drivers first.
  std::vector<std::string> opponents(Index row, const VectorXd& left) const {
    std::vector<std::string> drivers, names;
    const auto add = [&](Index other) {
      const int k = joint(other);
      std::vector<std::string>& to = k >= 0 && is_driver(system_.joints[at(k)]) ? drivers : names;
      if (const std::string name = owner(other); name != owner(row) && (to.empty() || to.back() != name)) to.push_back(name);
    };
    bool found = false;
    for (const Dependence& d : row_space(system_, eq_, 1e-4).dependences) {
      if (std::none_of(d.N.begin(), d.N.end(), [&](const auto& entry) { return entry.first == row; })) continue;
      for (const auto& entry : d.N) add(entry.first);
      found = true;
      break;
    }
    for (Index other = 0; other < left.size() && !found; ++other)  // least squares spread the residual over all conflicting rows
      if (std::abs(left[other]) > 0.1 * std::abs(left[row])) add(other);
    drivers.insert(drivers.end(), names.begin(), names.end());
    return drivers;
  }

 private:
  Index first(std::size_t contact) const { return system_.n_rows() + 2 * static_cast<Index>(contact); }
  Index first_pin() const { return first(offset_.size()); }
  Eigen::Vector2d arm(const VectorXd& y, const Pin& pin) const {
    return Eigen::Rotation2Dd(y[3 * pin.body + 2]) * system_.bodies[at(pin.body)].x_BO;
  }

  void jacobian(const VectorXd& y, Sparse& J) const {
    std::vector<Eigen::Triplet<double>> entries;
    visit_jacobian(eq_, [&](int row, int column, double value) { entries.emplace_back(row, column, system_.row_scale[row] * value); });
    for (std::size_t c = 0; c < offset_.size(); ++c) {
      const auto row = static_cast<int>(first(c));
      const auto add = [&](int marker, double sign) {
        visit_motion(system_, eq_, marker, [&](int column, const Eigen::Vector3d& dp) {
          for (int i = 0; i < 2; ++i) entries.emplace_back(row + i, column, sign * dp[i] / system_.length);
        });
      };
      add(system_.contacts[c].a, 1);
      add(system_.contacts[c].b, -1);
    }
    for (std::size_t p = 0; p < pins_.size(); ++p) {
      const Pin& pin = pins_[p];
      const auto row = static_cast<int>(first_pin() + static_cast<Index>(p));
      entries.emplace_back(row, 3 * pin.body + pin.axis, 1 / system_.length);
      entries.emplace_back(row, 3 * pin.body + 2, perp(arm(y, pin))[pin.axis] / system_.length);
    }
    J.resize(rows(), system_.n());
    J.setFromTriplets(entries.begin(), entries.end());
  }

  const System& system_;
  Equations eq_;
  std::vector<Eigen::Vector2d> offset_, drift_;
  std::vector<Pin> pins_;
};

}  // namespace pintle
