#include "framework/configuration/redundancy.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/configuration/least_step.h"

namespace pintle {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Index = Eigen::Index;
using SparseRows = Eigen::SparseMatrix<double>;

int joint_of(const System& system, int row) {
  const auto next = std::upper_bound(system.row_begin.begin(), system.row_begin.end(), row);
  return static_cast<int>(next - system.row_begin.begin()) - 1;
}

constexpr int along_speeds = 2;  ///< the last attempt

/// A configuration near y that the joints allow with drivers released; none where nothing can move.
std::optional<VectorXd> moved(const System& system, double t, const VectorXd& y, int attempt) {
  constexpr double far = 1e-2;  // relative to the mechanism's length, and radians
  Equations eq(system);
  const VectorXd W = system.scale.cwiseAbs2();
  const auto held = [&](const VectorXd& at_y, SparseRows* J) {
    pose(system, t, at_y, eq);
    VectorXd C = eq.C.cwiseProduct(system.row_scale);
    std::vector<Eigen::Triplet<double>> entries;
    const auto free = [&](int row) { return is_driver(system.joints[at(joint_of(system, row))]); };
    visit_jacobian(eq, [&](int row, int column, double value) {
      if (!free(row)) entries.emplace_back(row, column, system.row_scale[row] * value);
    });
    for (std::size_t k = 0; k < system.joints.size(); ++k)
      if (is_driver(system.joints[k])) C[system.row_begin[k]] = 0;
    if (J) {
      J->resize(system.n_rows(), system.n());
      J->setFromTriplets(entries.begin(), entries.end());
    }
    return C;
  };
  SparseRows J;
  held(y, &J);
  VectorXd way = y.segment(system.n(), system.n());                 // along a branch, where the configuration is singular
  for (Index i = 0; i < way.size() && attempt < along_speeds; ++i)  // a direction without any symmetry
    way[i] = system.scale[i] * std::sin(1.7 + 12.9898 * static_cast<double>(i + 1) + 4.1414 * attempt);
  way += least_step(J, W, -(J * way), 1e-13, 4);
  const double reach = way.cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>();
  if (!(reach > 1e-6)) return std::nullopt;
  for (int halvings = 0; halvings < 4; ++halvings) {
    const double step = std::ldexp(far / reach, -halvings);
    VectorXd to = y;
    to.head(system.n()) += step * way;
    VectorXd C = held(to, &J);
    for (int i = 0; i < 40 && C.lpNorm<Eigen::Infinity>() > 1e-12; ++i) {  // near a branch each step leaves a quarter of C
      to.head(system.n()) += least_step(J, W, -C, 1e-13, 2);
      C = held(to, &J);
    }
    const double gone = (to - y).head(system.n()).cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>();
    if (C.lpNorm<Eigen::Infinity>() <= 1e-10 && gone > 0.1 * far && gone < 5 * far) return to;
  }
  return std::nullopt;
}

RowSpace row_space_at(const System& system, double t, const VectorXd& y, double tolerance = 1e-7) {
  Equations eq(system);
  pose(system, t, y, eq);
  return row_space(system, eq, tolerance);
}

/// Whether one of them ends with the same row as d.
bool ends_among(const std::vector<Dependence>& all, const Dependence& d) {
  return std::any_of(all.begin(), all.end(), [&](const Dependence& e) { return e.N.back().first == d.N.back().first; });
}

/// Orthonormal basis of the span of the weights.
MatrixXd basis(const std::vector<Dependence>& all, Index rows) {
  MatrixXd N = MatrixXd::Zero(rows, static_cast<Index>(all.size()));
  for (Index k = 0; k < N.cols(); ++k) {
    for (const auto& [row, weight] : all[static_cast<std::size_t>(k)].N) N(row, k) = weight;
    N.col(k).normalize();
  }
  return Eigen::HouseholderQR<MatrixXd>(N).householderQ() * MatrixXd::Identity(N.rows(), N.cols());
}

/// Marks the dependences in `all` in excess of `permanent`, chosen such that the others span the space nearest to `permanent`: null spaces
/// are compared, since rows and weights change with the configuration.
std::vector<bool> left_out(const std::vector<Dependence>& all, const std::vector<Dependence>& permanent, Index rows) {
  std::vector<bool> out(all.size(), permanent.empty());
  if (permanent.empty() || permanent.size() >= all.size()) return out;
  const MatrixXd Q = basis(all, rows);
  const Eigen::JacobiSVD<MatrixXd> svd(Q.transpose() * basis(permanent, rows), Eigen::ComputeFullU);
  const auto more = static_cast<Index>(all.size() - permanent.size());
  MatrixXd apart(more, Q.cols());
  for (Index k = 0; k < Q.cols(); ++k) {
    VectorXd N = VectorXd::Zero(rows);
    for (const auto& [row, weight] : all[static_cast<std::size_t>(k)].N) N[row] = weight;
    apart.col(k) = svd.matrixU().rightCols(more).transpose() * (Q.transpose() * N.normalized());
  }
  const Eigen::ColPivHouseholderQR<MatrixXd> chosen(apart);
  for (Index i = 0; i < more; ++i) out[static_cast<std::size_t>(chosen.colsPermutation().indices()[i])] = true;
  return out;
}

/// The dependences of a configuration: permanent ones, which also hold near it, and singular ones, which hold only there.
struct Permanence {
  std::vector<Dependence> permanent, singular;
  std::vector<std::vector<Dependence>> near;  ///< all dependences in configurations nearby
};

Permanence permanence(const System& system, double t, const VectorXd& y, const std::vector<Dependence>& here) {
  Permanence out;
  for (int attempt = 0; attempt <= along_speeds && out.near.size() < 2 && !here.empty(); ++attempt)
    if (const auto there = moved(system, t, y, attempt)) out.near.push_back(row_space_at(system, t, *there).dependences);
  const auto fewest = std::min_element(out.near.begin(), out.near.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<bool> alone(here.size(), false);
  if (fewest != out.near.end()) alone = left_out(here, *fewest, system.n_rows());
  for (std::size_t k = 0; k < here.size(); ++k) (alone[k] ? out.singular : out.permanent).push_back(here[k]);
  return out;
}

/// Names of the joints of a dependence, drivers or the others.
std::vector<std::string> names_in(const System& system, const Dependence& d, bool drivers) {
  std::vector<std::string> out;
  for (const auto& [row, weight] : d.N) {
    const int k = joint_of(system, row);
    if (is_driver(system.joints[at(k)]) == drivers && (out.empty() || out.back() != system.joint_names[at(k)]))
      out.push_back(system.joint_names[at(k)]);
  }
  return out;
}

struct Driven {
  const TimeLaw* law;
  double weight;  ///< of its row, with row_scale
};

/// The drivers of a dependence, with their weights relative to the last one's.
std::vector<Driven> driven_by(const System& system, const Dependence& d) {
  std::vector<Driven> out;
  for (const auto& [row, weight] : d.N)
    if (const TimeLaw* law = driver_law(system.joints[at(joint_of(system, row))])) out.push_back({law, weight * system.row_scale[row]});
  if (!out.empty())
    for (const double last = out.back().weight; Driven & one : out) one.weight /= last;
  return out;
}

bool alike(const std::vector<Driven>& a, const std::vector<Driven>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Driven& x, const Driven& y) {
    return x.law == y.law && std::abs(x.weight - y.weight) <= 1e-6 * std::abs(x.weight);
  });
}

/// The time at which laws combined with constant weights deviate from their value at t, and by how much.
std::optional<std::pair<double, double>> first_contradiction(const std::vector<Driven>& drivers, double t, double until) {
  constexpr int samples = 2000;
  constexpr double position = 1e-9, speed = 1e-7;
  double fastest = 0;
  for (int k = 0; k <= samples; ++k)
    for (const Driven& d : drivers) fastest = std::max(fastest, std::abs(d.weight * (*d.law)(t + (until - t) * k / samples).rate));
  for (int k = 0; k <= samples; ++k) {
    const double when = t + (until - t) * k / samples;
    double gap = 0, rate = 0, size = 1;
    for (const Driven& d : drivers) {
      const Jet now = (*d.law)(when), first = (*d.law)(t);
      gap += d.weight * (now.value - first.value);
      rate += d.weight * now.rate;
      size = std::max(size, std::abs(d.weight * now.value));
    }
    if (std::abs(gap) > position * size || std::abs(rate) > speed * fastest) return std::pair(when, std::abs(gap));
  }
  return std::nullopt;
}

/// Nᵀ applied to the accelerations that the rows require at the present speeds; 0 if they agree, scaled.
double contradiction_of_accelerations(const System& system, double t, const VectorXd& y, const Dependence& d) {
  const Index n = system.n();
  const VectorXd s = y.segment(n, n);
  double rate = s.cwiseQuotient(system.scale).lpNorm<Eigen::Infinity>();
  for (const auto& [row, weight] : d.N)
    if (const TimeLaw* law = driver_law(system.joints[at(joint_of(system, row))]))
      rate = std::max(rate, std::sqrt(std::abs((*law)(t).accel) * system.row_scale[row]));
  if (rate == 0) return 0;
  const double step = 1e-4 / rate;
  Equations eq(system);
  VectorXd change = VectorXd::Zero(system.n_rows());
  for (double sign : {-1.0, 1.0}) {
    VectorXd to = y;
    to.head(n) += sign * step * s;
    pose(system, t + sign * step, to, eq);
    speed(system, t + sign * step, to, eq);
    change += sign / (2 * step) * eq.Cdot.cwiseProduct(system.row_scale);
  }
  double sum = 0, size = 0;
  for (const auto& [row, weight] : d.N) sum += weight * change[row], size += std::abs(weight);
  return std::abs(sum) / (size * rate * rate);
}

/// Joints that repeat each other but do not quite fit: C = 0 is violated by more than rounding.
std::string misfit(const System& system, double t, const VectorXd& y, const std::vector<Dependence>& permanent) {
  constexpr double rounding = 2e-12;
  Equations eq(system);
  pose(system, t, y, eq);
  for (const Dependence& d : permanent) {
    int worst = d.N.front().first;
    for (const auto& [row, weight] : d.N)
      if (std::abs(eq.C[row]) * system.row_scale[row] > std::abs(eq.C[worst]) * system.row_scale[worst]) worst = row;
    if (!(std::abs(eq.C[worst]) * system.row_scale[worst] > std::max(rounding, 2 * angle_rounding(system, y)))) continue;
    const int k = joint_of(system, worst);
    std::ostringstream s;
    s.precision(3);
    s << "the redundant joints " << some_of(names_in(system, d, false))
      << " do not agree with each other: " << quoted(system.joint_names[at(k)]) << " stays open by " << std::abs(eq.C[worst])
      << (is_angle_row(system.joints[at(k)], worst - system.row_begin[at(k)]) ? " rad" : " m")
      << ", but at most 1e-11 of the mechanism's size is allowed; write lengths, points and angles with more digits, or remove a joint";
    return s.str();
  }
  return "";
}

}  // namespace

RowReport validate_rows(const System& system, double t, const VectorXd& y) {
  RowReport out;
  const RowSpace space = row_space_at(system, t, y);
  out.rank = space.rank;
  out.shared.assign(at(system.n_rows()), false);
  const Permanence all = permanence(system, t, y, space.dependences);
  const auto share = [&](const Dependence& d) {
    for (const auto& [row, weight] : d.N) out.shared[at(row)] = true;
  };
  for (const auto& there : all.near) std::for_each(there.begin(), there.end(), share);
  for (const Dependence& d : space.dependences) {
    const int last = d.N.back().first, joint = joint_of(system, last);
    Redundancy r{joint, last - system.row_begin[at(joint)], {}};
    r.permanent = ends_among(all.permanent, d);
    share(d);
    for (const auto& [row, weight] : d.N) {
      const int k = joint_of(system, row);
      if (row != last && (r.implied_by.empty() || r.implied_by.back() != k)) r.implied_by.push_back(k);
    }
    out.redundant.push_back(std::move(r));
  }
  return out;
}

std::vector<Dependence> singular_dependences(const System& system, double t, const VectorXd& y) {
  return permanence(system, t, y, row_space_at(system, t, y).dependences).singular;
}

std::string row_text(const System& system, int joint, int row) {
  return quoted(system.joint_names[at(joint)]) + " (" + row_name(system.joints[at(joint)], row) + ")";
}

std::string rows_text(const System& system, const std::vector<bool>& marked, bool which) {
  constexpr std::size_t most = 6;
  std::vector<std::string> joints;
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    std::string rows;
    for (int row = system.row_begin[k]; row < system.row_begin[k + 1]; ++row)
      if (marked[at(row)] == which)
        rows += (rows.empty() ? " " : ", ") + std::string(row_name(system.joints[k], row - system.row_begin[k]));
    if (!rows.empty()) joints.push_back(quoted(system.joint_names[k]) + rows);
  }
  std::string out;
  for (std::size_t k = 0; k < std::min(joints.size(), most); ++k) out += (k > 0 ? "; " : "") + joints[k];
  return out + (joints.size() > most ? "; and of " + std::to_string(joints.size() - most) + " more joints" : "");
}

std::string contradiction(const System& system, double t, const VectorXd& y, double until) {
  const std::vector<Dependence> here = row_space_at(system, t, y).dependences;
  if (std::none_of(here.begin(), here.end(), [&](const Dependence& d) { return !names_in(system, d, true).empty(); })) return "";
  const Permanence all = permanence(system, t, y, here);
  for (const Dependence& d : all.permanent) {
    const std::vector<std::string> names = names_in(system, d, true);
    if (names.empty()) continue;
    const std::string who = names.size() > 1
                                ? "the drivers " + some_of(names) + " contradict each other"
                                : "the driver " + some_of(names) + " moves what " + some_of(names_in(system, d, false)) + " hold";
    if (contradiction_of_accelerations(system, t, y, d) > 1e-5)
      return who + ": at t = " + number_text(t) + " s they prescribe different accelerations for one degree of freedom";
    const std::vector<Driven> drivers = driven_by(system, d);
    const bool constant = std::all_of(all.near.begin(), all.near.end(), [&](const std::vector<Dependence>& there) {
      return std::any_of(there.begin(), there.end(),
                         [&](const Dependence& e) { return e.N.back().first == d.N.back().first && alike(drivers, driven_by(system, e)); });
    });
    if (constant)
      if (const auto conflict = first_contradiction(drivers, t, until))
        return who + ": from t = " + number_text(conflict->first) + " s on; they differ by " + number_text(conflict->second) + " there";
  }
  return "";
}

std::string explain_pose(const System& system, double t, const VectorXd& y) {
  constexpr double close = 1e-3;  // remainder of a row: nearer to a dead centre, no step can continue
  const RowSpace space = row_space_at(system, t, y);
  std::string conflict = contradiction(system, t, y, t + 1e-2 * std::max(t, 1.0));
  if (!conflict.empty()) return conflict;
  const std::vector<Dependence> permanent = permanence(system, t, y, space.dependences).permanent;
  if (std::string open = misfit(system, t, y, permanent); !open.empty()) return open;
  const std::vector<Dependence> nearly = row_space_at(system, t, y, close).dependences;
  std::vector<Dependence> undriven = nearly;
  std::erase_if(undriven, [&](const Dependence& d) { return !names_in(system, d, true).empty(); });
  if (std::string open = misfit(system, t, y, undriven); !open.empty()) return open;
  const std::vector<bool> alone = left_out(nearly, permanent, system.n_rows());
  for (std::size_t k = 0; k < nearly.size(); ++k) {
    if (!alone[k]) continue;
    const Dependence& d = nearly[k];
    const std::vector<std::string> drivers = names_in(system, d, true);
    const std::string others = some_of(names_in(system, d, false));
    if (drivers.empty()) return "a singular configuration: the constraint equations of " + others + " have become linearly dependent there";
    const auto driver = std::find(system.joint_names.begin(), system.joint_names.end(), drivers.front()) - system.joint_names.begin();
    const Joint& joint = system.joints[static_cast<std::size_t>(driver)];
    return "a dead centre: the driver " + some_of(drivers) + " cannot move past " + number_text((*driver_law(joint))(t).value) +
           (is_angle_row(joint, 0) ? " rad" : " m") + (others.empty() ? "" : ", because " + others + " hold it there");
  }
  for (const Dependence& d : permanent)
    if (const auto drivers = names_in(system, d, true); drivers.size() > 1)
      return "the drivers " + some_of(drivers) + " act on the same degree of freedom and contradict each other";
  return "";
}

}  // namespace pintle
