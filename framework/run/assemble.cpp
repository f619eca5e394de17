#include "framework/run/assemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SPQRSupport>
#include <Eigen/SparseCore>

namespace pintle {

namespace {

using Eigen::VectorXd;
using Index = Eigen::Index;
using Sparse = Eigen::SparseMatrix<double>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// A coordinate of a body's origin, or its rate, that the scene gives.
struct Pin {
  int body, axis;
  double value;  ///< [m] or [m/s]
};

/// Where the scene says something of this name.
Place place_of(const Scene& scene, const std::string& name) {
  for (const SceneJoint& j : scene.joints)
    if (j.name == name) return j.place;
  for (const SceneDriver& d : scene.drivers)
    if (d.name == name) return d.place;
  for (const StartBody& s : scene.start_bodies)
    if (s.body == name) return s.place;
  return {};
}
/// The same, naming the thing itself where the scene was not read from a file.
Place named_place(const Scene& scene, const std::string& name) {
  Place place = place_of(scene, name);
  if (place.key.empty()) place.key = "\"" + name + "\"";
  return place;
}

/// The rows to be closed at the start: the joints, two for each clearance joint, and what the scene
/// pins of the origins of bodies: their places first, then, for the speeds, their rates.
class Closure {
 public:
  Closure(const Scene& scene, const System& system)
      : system_(system), eq_(system), offset_(system.contacts.size()), drift_(system.contacts.size()) {
    for (std::size_t c = 0; c < system.contacts.size(); ++c) {
      offset_[c].setZero();
      drift_[c].setZero();
      for (const StartJournal& s : scene.start_journals)
        if (s.joint == system.contact_names[c]) {
          offset_[c] << s.eccentricity[0], s.eccentricity[1];
          drift_[c] << s.speed[0], s.speed[1];
        }
    }
  }

  void pin(std::vector<Pin> pins) { pins_ = std::move(pins); }
  Index rows() const { return first_pin() + static_cast<Index>(pins_.size()); }

  /// C and, if asked, its Jacobian; lengths over the mechanism's length.
  VectorXd violation(const VectorXd& y, Sparse* J = nullptr) {
    pose(system_, 0, y, eq_);
    VectorXd C(rows());
    C.head(system_.n_rows()) = eq_.C.cwiseProduct(system_.row_scale);
    for (std::size_t c = 0; c < offset_.size(); ++c) {
      const ContactPair& pair = system_.contacts[c];
      C.segment<2>(first(c)) = (eq_.motion[at(pair.journal)].r - eq_.motion[at(pair.bearing)].r - offset_[c]) /
                               system_.length;
    }
    for (std::size_t p = 0; p < pins_.size(); ++p) {
      const Pin& pin = pins_[p];
      C[first_pin() + static_cast<Index>(p)] = (y[3 * pin.body + pin.axis] + arm(y, pin)[pin.axis] - pin.value) / system_.length;
    }
    if (J) jacobian(y, *J);
    return C;
  }

  /// Ċ at speeds s, scaled alike.
  VectorXd drift(const VectorXd& y) {
    pose(system_, 0, y, eq_);
    speed(system_, 0, y, eq_);
    VectorXd D(rows());
    D.head(system_.n_rows()) = eq_.Cdot.cwiseProduct(system_.row_scale);
    for (std::size_t c = 0; c < offset_.size(); ++c) {
      const ContactPair& pair = system_.contacts[c];
      D.segment<2>(first(c)) = (eq_.motion[at(pair.journal)].v - eq_.motion[at(pair.bearing)].v - drift_[c]) /
                               system_.length;
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
    for (std::size_t k = 0; k < system_.joints.size(); ++k)
      if (row < system_.row_begin[k + 1]) return static_cast<int>(k);
    return -1;
  }
  const Equations& equations() const { return eq_; }

 private:
  Index first(std::size_t contact) const { return system_.n_rows() + 2 * static_cast<Index>(contact); }
  Index first_pin() const { return first(offset_.size()); }
  Eigen::Vector2d arm(const VectorXd& y, const Pin& pin) const {
    return Eigen::Rotation2Dd(y[3 * pin.body + 2]) * system_.bodies[at(pin.body)].x_BO;
  }

  void jacobian(const VectorXd& y, Sparse& J) const {
    std::vector<Eigen::Triplet<double>> entries;
    visit_jacobian(eq_, [&](int row, int column, double value) {
      entries.emplace_back(row, column, system_.row_scale[row] * value);
    });
    for (std::size_t c = 0; c < offset_.size(); ++c) {
      const auto row = static_cast<int>(first(c));
      const auto add = [&](int marker, double sign) {
        visit_motion(system_, eq_, marker, [&](int column, const Eigen::Vector3d& dp) {
          for (int i = 0; i < 2; ++i) entries.emplace_back(row + i, column, sign * dp[i] / system_.length);
        });
      };
      add(system_.contacts[c].journal, 1);
      add(system_.contacts[c].bearing, -1);
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

/// x = W Jᵀ (J W Jᵀ + μ)⁻¹ r, the step of least |x| in the metric W⁻¹; pinned coordinates have W = 0.
VectorXd least_step(const Sparse& J, const VectorXd& W, const VectorXd& r, double mu, int sweeps) {
  Sparse S = J * W.asDiagonal() * J.transpose();
  double trace = 0;
  for (Index i = 0; i < S.rows(); ++i) trace += S.coeff(i, i);
  const double shift = std::max(mu * trace / static_cast<double>(std::max<Index>(S.rows(), 1)), 1e-300);
  Sparse I(S.rows(), S.cols());
  I.setIdentity();
  S += shift * I;
  Eigen::CholmodDecomposition<Sparse> solver(S);
  VectorXd y = VectorXd::Zero(r.size()), x = VectorXd::Zero(J.cols());
  for (int i = 0; i < sweeps; ++i) {  // undoes the shift where the rows are consistent
    y += solver.solve(r - J * x);
    x = W.asDiagonal() * (J.transpose() * y);
  }
  return x;
}

/// Rough pose, angles and spins that the scene pins in place (their W is 0), and its pins of origins.
struct Rough {
  VectorXd y, W_pose, W_speed;
  std::vector<Pin> places, rates;
};

Rough rough_state(const Scene& scene, const System& system) {
  Rough r;
  r.y.setZero(system.n_y());
  r.W_pose.resize(system.n());
  r.W_speed.resize(system.n());
  r.W_pose.tail(system.n() - system.n_rigid()).setZero();  // undeformed if that closes
  r.W_speed.tail(system.n() - system.n_rigid()).setZero();
  std::map<std::string, const StartBody*> starts;
  for (const StartBody& s : scene.start_bodies) starts[s.body] = &s;
  const double area = system.length * system.length;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const SceneBody& body = scene.bodies[b];
    const auto i = static_cast<Index>(3 * b);
    const int index = static_cast<int>(b);
    r.W_pose.segment<3>(i) << area, area, 1;
    r.W_speed.segment<3>(i) << 1 / system.bodies[b].m, 1 / system.bodies[b].m, 1 / system.bodies[b].J;
    double x = body.at[0], y = body.at[1], angle = body.angle;
    if (const auto found = starts.find(body.name); found != starts.end()) {
      const StartBody& s = *found->second;
      if (s.angle) angle = *s.angle, r.W_pose[i + 2] = 0;
      if (s.speed) r.y[system.n() + i + 2] = *s.speed, r.W_speed[i + 2] = 0;
      if (s.x) x = *s.x, r.places.push_back({index, 0, *s.x});
      if (s.y) y = *s.y, r.places.push_back({index, 1, *s.y});
      if (s.vx) r.rates.push_back({index, 0, *s.vx});
      if (s.vy) r.rates.push_back({index, 1, *s.vy});
    }
    const Eigen::Vector2d arm = Eigen::Rotation2Dd(angle) * system.bodies[b].x_BO;
    r.y.segment<3>(i) << x - arm.x(), y - arm.y(), angle;
  }
  return r;
}

[[noreturn]] void cannot(const Scene& scene, const std::string& what, const Closure& closure, const System& system,
                         const VectorXd& left, const char* per, const char* remedy) {
  Index worst = 0;
  left.cwiseAbs().maxCoeff(&worst);
  std::string message = what + ": " + closure.amount(worst, left[worst]) + per + " remains";
  const int joint = closure.joint(worst);
  if (joint >= 0)
    for (const Redundancy& r : redundant_rows(system, closure.equations())) {
      std::vector<int> group = r.implied_by;
      group.push_back(r.joint);
      if (std::find(group.begin(), group.end(), joint) == group.end()) continue;
      std::string others;
      for (int k : group)
        if (k != joint) others += (others.empty() ? "\"" : ", \"") + system.joint_names[at(k)] + "\"";
      if (!others.empty()) message += "; it contradicts " + others;
      break;
    }
  throw AssemblyError(scene.file, named_place(scene, closure.owner(worst)), message + "; " + remedy);
}

// Levenberg–Marquardt on C = 0, from the rough pose.
int close_joints(const Scene& scene, Closure& closure, const System& system, Rough& r) {
  constexpr double closed = 1e-12, acceptable = 1e-10;
  closure.pin(r.places);
  Sparse J;
  double mu = 1e-9;
  VectorXd C = closure.violation(r.y, &J);
  int i = 0;
  for (; i < 300 && C.size() > 0 && C.lpNorm<Eigen::Infinity>() > closed; ++i) {
    VectorXd step = least_step(J, r.W_pose, -C, mu, 1);
    const double reach = std::max((step.array() / r.W_pose.array().max(1e-300).sqrt()).abs().maxCoeff(), 1e-300);
    if (reach > 0.5) step *= 0.5 / reach;
    VectorXd trial = r.y;
    trial.head(system.n()) += step;
    const VectorXd C_trial = closure.violation(trial);
    if (C_trial.norm() < C.norm()) {
      r.y = trial;
      C = closure.violation(r.y, &J);
      mu = std::max(mu / 10, 1e-15);
    } else if (mu < 1e3) {
      mu *= 10;
    } else {
      break;
    }
  }
  if (C.size() > 0 && !(C.lpNorm<Eigen::Infinity>() <= acceptable)) {
    closure.violation(r.y);
    const bool pinned = !scene.start_bodies.empty();
    cannot(scene, pinned ? "cannot close with what `start` pins down" : "cannot close", closure, system, C, "",
           "check lengths and points, or give the bodies rough poses (`pose`) nearer to the wanted one");
  }
  return i;
}

int match_speeds(const Scene& scene, Closure& closure, const System& system, Rough& r) {
  closure.pin(r.rates);
  Sparse J;
  closure.violation(r.y, &J);
  if (J.rows() == 0) return 0;
  const VectorXd D = closure.drift(r.y);
  r.y.segment(system.n(), system.n()) += least_step(J, r.W_speed, -D, 1e-13, 8);
  const VectorXd left = closure.drift(r.y);
  const double scale = std::max({D.lpNorm<Eigen::Infinity>(), r.y.tail(r.y.size() - system.n()).lpNorm<Eigen::Infinity>(), 1e-12});
  if (left.lpNorm<Eigen::Infinity>() > 1e-8 * scale)
    cannot(scene, "cannot move as `start` and the drivers ask", closure, system, left, "/s",
           "leave out a speed in `start`, or a driver");
  return 1;
}

// Flexible bodies start undeformed and move as rigid ones; only where that cannot close they bend, soft
// shapes before stiff ones.
template <class Close>
int undeformed_first(const System& system, Rough& r, VectorXd Rough::*weight, Close close) {
  if (system.n() == system.n_rigid()) return close(r);
  Rough bent = r;
  try {
    return close(r);
  } catch (const AssemblyError&) {
  }
  for (std::size_t b = 0; b < system.bodies.size(); ++b)
    if (const int n = system.bodies[b].modes(); n > 0) {
      const VectorXd& omega = system.bodies[b].flex->omega;
      const bool pose = weight == &Rough::W_pose;
      (bent.*weight).segment(system.eta_begin[b], n) =
          pose ? VectorXd((system.scale.segment(system.eta_begin[b], n) * omega.minCoeff()).cwiseQuotient(omega).cwiseAbs2()) : VectorXd::Ones(n);
    }
  r = bent;
  return close(r);
}

int rank_of(const System& system, const Equations& eq) {
  if (system.n_rows() == 0) return 0;
  std::vector<Eigen::Triplet<double>> entries;
  visit_jacobian(eq, [&](int row, int column, double value) {
    entries.emplace_back(row, column, system.row_scale[row] * system.scale[column] * value);
  });
  Sparse Cq(system.n_rows(), system.n());
  Cq.setFromTriplets(entries.begin(), entries.end());
  const Sparse transposed = Cq.transpose();
  Eigen::SPQR<Sparse> qr;
  qr.setPivotThreshold(1e-9);
  qr.compute(transposed);
  return static_cast<int>(qr.rank());
}

}  // namespace

std::string row_text(const System& system, int joint, int row) {
  return "\"" + system.joint_names[at(joint)] + "\" (" + row_name(system.joints[at(joint)], row) + ")";
}

void refuse_redundancy(const Scene& scene, const Model& model, const Assembly& assembly) {
  if (assembly.redundant.empty()) return;
  const Redundancy& r = assembly.redundant.front();
  const System& system = model.system;
  std::string others;
  for (int k : r.implied_by)
    if (k != r.joint) others += (others.empty() ? "\"" : ", \"") + system.joint_names[at(k)] + "\"";
  const std::string& name = system.joint_names[at(r.joint)];
  throw AssemblyError(scene.file, named_place(scene, name),
                      std::string("redundant: its row \"") + row_name(system.joints[at(r.joint)], r.row) +
                          "\" repeats, at the starting pose, what " + (others.empty() ? "nothing moves" : others) +
                          " already hold; remove it, or make one of them looser (slot, clearance); if it is "
                          "redundant at this pose only (a dead centre, a folded linkage), start elsewhere");
}

std::vector<Redundancy> redundant_rows(const System& system, const Equations& eq) {
  std::vector<Redundancy> out;
  if (system.n_rows() == 0 || system.n_rows() > 3000) return out;
  Eigen::MatrixXd Cq = system.row_scale.asDiagonal() * dense_jacobian(system, eq);
  Cq *= system.scale.asDiagonal();
  // Gram–Schmidt, twice, row after row: what is left of a dependent row is rounding.
  Eigen::MatrixXd Q(Cq.cols(), Cq.rows());
  std::vector<int> independent;
  Index used = 0;
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    for (int row = system.row_begin[k]; row < system.row_begin[k + 1]; ++row) {
      VectorXd v = Cq.row(row).transpose();
      const double before = v.norm();
      for (int pass = 0; pass < 2; ++pass) v -= Q.leftCols(used) * (Q.leftCols(used).transpose() * v);
      if (v.norm() > 1e-9 * before) {
        Q.col(used++) = v.normalized();
        independent.push_back(row);
        continue;
      }
      Redundancy r{static_cast<int>(k), row - system.row_begin[k], {}};
      Eigen::MatrixXd basis(Cq.cols(), static_cast<Index>(independent.size()));
      for (std::size_t i = 0; i < independent.size(); ++i)
        basis.col(static_cast<Index>(i)) = Cq.row(independent[i]).transpose();
      const VectorXd x = basis.colPivHouseholderQr().solve(VectorXd(Cq.row(row).transpose()));
      for (std::size_t j = 0; j < system.joints.size(); ++j)
        for (std::size_t i = 0; i < independent.size(); ++i)
          if (independent[i] >= system.row_begin[j] && independent[i] < system.row_begin[j + 1] &&
              std::abs(x[static_cast<Index>(i)]) > 1e-6 &&
              (r.implied_by.empty() || r.implied_by.back() != static_cast<int>(j)))
            r.implied_by.push_back(static_cast<int>(j));
      out.push_back(r);
    }
  return out;
}

Assembly assemble(const Scene& scene, const Model& model) {
  const System& system = model.system;
  Closure closure(scene, system);
  Rough r = rough_state(scene, system);
  const VectorXd before = r.y.head(system.n());
  Assembly out;
  out.iterations = undeformed_first(system, r, &Rough::W_pose, [&](Rough& from) { return close_joints(scene, closure, system, from); });
  out.moved = (r.y.head(system.n()) - before).lpNorm<Eigen::Infinity>();
  undeformed_first(system, r, &Rough::W_speed, [&](Rough& from) { return match_speeds(scene, closure, system, from); });
  out.start.t = 0;
  out.start.y = r.y;
  out.start.impact_rate.assign(system.contacts.size(), 0.0);
  closure.violation(r.y);
  out.rank = rank_of(system, closure.equations());
  if (out.rank < system.n_rows()) out.redundant = redundant_rows(system, closure.equations());
  return out;
}

}  // namespace pintle
