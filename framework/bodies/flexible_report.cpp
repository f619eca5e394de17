#include "framework/bodies/flexible_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/modal_basis.h"
#include "framework/common/dense.h"
#include "framework/common/text.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index responding = 40;            ///< number of lowest shapes used in estimates
constexpr double rounding_of_force = 1e-9;  ///< of a modal force, relative to its terms

/// Largest rotation of sections and ports in a nodal displacement field.
double greatest_turn(const ElasticBody& e, const VectorXd& nodal, const VectorXd& ports) {
  double turn = 0;
  for (std::size_t i = 0; i + 1 < e.model.begin.size(); ++i)
    if (e.model.begin[i + 1] - e.model.begin[i] == 3) turn = std::max(turn, std::abs(nodal[e.model.begin[i] + 2]));
  for (Index p = 2; p < ports.size(); p += 3) turn = std::max(turn, std::abs(ports[p]));
  return turn;
}

double greatest_displacement(const ElasticBody& e, const VectorXd& nodal) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < e.model.begin.size(); ++i) most = std::max(most, nodal.segment<2>(e.model.begin[i]).norm());
  return most;
}

double size_of(const ElasticBody& e) { return (e.mesh.x.rowwise().maxCoeff() - e.mesh.x.rowwise().minCoeff()).norm(); }

/// Relative change of the first frequency when −F is added to the stiffness; −1: it falls to zero.
double change(const VectorXd& omega, const MatrixXd& F) {
  MatrixXd K = -F;
  K.diagonal() += omega.cwiseAbs2();
  const double least = Eigen::SelfAdjointEigenSolver<MatrixXd>(K, Eigen::EigenvaluesOnly).eigenvalues()[0];
  return std::sqrt(std::max(0.0, least)) / omega[0] - 1;
}

/// The same for a history, at its largest magnitude: the time is found from the first shape alone, then the change is computed exactly.
double greatest_change(const VectorXd& omega, const std::vector<MatrixXd>& F, const MatrixXd& factor) {
  VectorXd first(factor.rows());
  for (Index k = 0; k < factor.rows(); ++k) first[k] = F[static_cast<std::size_t>(k)](0, 0);
  const Eigen::RowVectorXd on_first = first.transpose() * factor;
  Index ends[2];
  on_first.minCoeff(&ends[0]);
  on_first.maxCoeff(&ends[1]);
  double greatest = 0;
  for (const Index t : ends) {
    MatrixXd sum = MatrixXd::Zero(omega.size(), omega.size());
    for (Index k = 0; k < factor.rows(); ++k) sum += factor(k, t) * F[static_cast<std::size_t>(k)];
    if (const double c = change(omega, sum); std::abs(c) > std::abs(greatest)) greatest = c;
  }
  return greatest;
}

/// The port that a joint pins or welds to the ground, −1 if none does.
int pivot(const Scene& scene, const ElasticBody& e) {
  for (const SceneJoint& j : scene.joints) {
    if (!word_of(j).pins) continue;
    const PointRef* own = j.a.body == e.scene->name && j.b.body == "ground"   ? &j.a
                          : j.b.body == e.scene->name && j.a.body == "ground" ? &j.b
                                                                              : nullptr;
    if (own) return port_of(e, own->point);
  }
  return -1;
}

std::string percent(double part) { return number_text(std::round(1000 * part) / 10) + " %"; }

std::string changed(double change) {
  if (change <= -1) return "cancel all its stiffness, so it would buckle; the linear body does not represent this";
  return std::string(change > 0 ? "raise" : "lower") + " its first frequency by " + percent(std::abs(change));
}

void warn_of_frequency(const FlexibleReport& r, const std::vector<Imposed>& imposed, std::vector<std::string>& out) {
  for (const Imposed& i : imposed)
    if (i.frequency > r.highest)
      out.push_back("modes of \"" + r.body + "\" reach " + number_text(r.highest) + " Hz, but driver \"" + i.driver + "\" " +
                    (i.turns ? "turns at " : "moves with ") + number_text(i.frequency) + " Hz; keep more");
}

void warn_of_linearity(const Scene& scene, const FlexibleReport& r, std::vector<std::string>& out) {
  const auto body = std::find_if(scene.bodies.begin(), scene.bodies.end(), [&](const SceneBody& b) { return b.name == r.body; });
  const Stiffening now = body->elastic->stiffening;
  const MotionEstimate& m = *r.motion;
  if (const std::string warning = stiffening_warning(r.body, now, {m.spin, m.by_rotation, m.by_all_loads}); !warning.empty())
    out.push_back(warning);
  const std::string warning = deflection_warning(r.body, m.deflection, m.slope, "would bend");
  if (!warning.empty())
    out.push_back(warning + (now == Stiffening::none ? "" : " (estimated without its stiffening; a run gives the actual value)"));
}

}  // namespace

FlexibleReport flexible_report(const MechanismBody& b) {
  FlexibleReport r;
  const FlexInertia& flex = *b.body.flex;
  r.body = b.body.name;
  r.basis = title_of(*b.elastic.scene->elastic->modes);
  r.shapes = b.body.modes();
  r.lowest = flex.omega.minCoeff() / (2 * std::numbers::pi);
  r.highest = flex.omega.maxCoeff() / (2 * std::numbers::pi);
  r.least_damping = flex.zeta.minCoeff();
  r.most_damping = flex.zeta.maxCoeff();
  for (Index i = 0; i < flex.omega.size(); ++i)
    r.frequencies.push_back(flex.omega[i] / (2 * std::numbers::pi)), r.damping.push_back(flex.zeta[i]);
  if (b.conditions.kind != ReferenceConditions::mean_axes) {
    const Eigen::Vector3d sum = effective_mass(b.elastic.model, b.elastic.M, b.modes).rowwise().sum();
    r.mass = Eigen::Vector3d(sum[0] / b.body.m, sum[1] / b.body.m, sum[2] / b.body.J);
  }
  r.compliance = b.compliance.share;
  r.compliance_at = b.compliance.at;
  return r;
}

MotionEstimate motion_estimate(const MechanismBody& b, const LoadHistory& history) {
  MotionEstimate out;
  const ModalModel modes = lowest_of(b.modes, std::min(responding, b.modes.omega.size()));
  const MatrixXd work = work_of_loads(b.elastic, modes);
  MatrixXd Q = work * history.factor;
  const MatrixXd terms = work.cwiseAbs() * history.factor.cwiseAbs();
  for (Index i = 0; i < Q.rows(); ++i)  // modal forces that are only the rounding of loads in equilibrium
    if (Q.row(i).lpNorm<Eigen::Infinity>() <= rounding_of_force * terms.row(i).maxCoeff()) Q.row(i).setZero();
  const MatrixXd eta = oscillator_response(modes.omega, b.body.flex->zeta, history.t, Q);
  out.spin = std::sqrt(history.factor.row(3).maxCoeff());
  out.excited_up_to = excited_up_to(history.t, Q, modes.omega);
  // The field at the largest amplitude of each of the first three modes and at the largest mean square displacement.
  std::vector<Index> times(1);
  eta.colwise().squaredNorm().maxCoeff(&times[0]);
  for (Index i = 0; i < std::min<Index>(3, eta.rows()); ++i) eta.row(i).cwiseAbs().maxCoeff(&times.emplace_back());
  for (const Index t : times) {
    const VectorXd u = modes.shapes * eta.col(t);
    out.deflection = std::max(out.deflection, greatest_displacement(b.elastic, u) / size_of(b.elastic));
    out.slope = std::max(out.slope, greatest_turn(b.elastic, u, modes.ports * eta.col(t)));
  }
  const FrequencyChange change = frequency_change(b.modes.omega, b.by_load, history.factor);
  out.by_rotation = change.by_rotation, out.by_all_loads = change.by_all_loads;
  return out;
}

double stiffened_by_spin(const Scene& scene, const MechanismBody& b, double spin) {
  MatrixXd F = b.by_load[3];
  if (const int port = pivot(scene, b.elastic); port >= 0) {
    const Eigen::Vector2d arm = b.centre - b.elastic.model.ports[static_cast<std::size_t>(port)].x;
    for (std::size_t k = 0; k < 2; ++k)
      F += arm[static_cast<Index>(k)] * (b.by_load[k] - b.body.m * b.by_load[inertia_loads + 3 * static_cast<std::size_t>(port) + k]);
  }
  return change(b.modes.omega.head(F.rows()), spin * spin * F);
}

StiffeningProbe stiffening_probe(const MechanismBody& b, int index) {
  const Stiffening now = b.elastic.scene->elastic->stiffening;
  StiffeningProbe probe{b.body.name, index, now, now == Stiffening::axial, b.modes.omega.head(b.by_load.front().rows()), {}};
  if (!probe.judged) probe.F = b.by_load;
  return probe;
}

FrequencyChange frequency_change(const VectorXd& omega, const std::vector<MatrixXd>& F, const MatrixXd& factor) {
  const VectorXd lowest = omega.head(F.front().rows());
  return {std::sqrt(factor.row(3).maxCoeff()), greatest_change(lowest, F, factor.topRows<inertia_loads>()),
          greatest_change(lowest, F, factor)};
}

BendingProbe bending_probe(const MechanismBody& b, int index) {
  constexpr Index most = 32;
  const FeModel& model = b.elastic.model;
  BendingProbe probe{b.body.name, index, size_of(b.elastic), {}, {}};
  std::vector<int> moved, turned;
  const Index nodes = model.x.cols(), count = std::min(most, nodes);
  for (Index k = 0; k < count; ++k) {
    const auto node = static_cast<std::size_t>(count > 1 ? k * (nodes - 1) / (count - 1) : 0);
    moved.insert(moved.end(), {model.begin[node], model.begin[node] + 1});
    if (model.begin[node + 1] - model.begin[node] == 3) turned.push_back(model.begin[node] + 2);
  }
  const Index ports = static_cast<Index>(model.ports.size()), n = b.modes.omega.size();
  probe.displacement.resize(static_cast<Index>(moved.size()) + 2 * ports, n);
  probe.slope.resize(static_cast<Index>(turned.size()) + ports, n);
  probe.displacement.topRows(static_cast<Index>(moved.size())) = b.modes.shapes(moved, Eigen::all);
  probe.slope.topRows(static_cast<Index>(turned.size())) = b.modes.shapes(turned, Eigen::all);
  for (Index p = 0; p < ports; ++p) {
    probe.displacement.middleRows<2>(static_cast<Index>(moved.size()) + 2 * p) = b.modes.ports.middleRows<2>(3 * p);
    probe.slope.row(static_cast<Index>(turned.size()) + p) = b.modes.ports.row(3 * p + 2);
  }
  return probe;
}

double given_spin(const Scene& scene, const std::string& body) {
  double spin = 0;
  for (const StartBody& s : scene.start_bodies)
    if (s.body == body && s.speed) spin = std::abs(*s.speed);
  for (const SceneDriver& d : scene.drivers) {
    if (d.kind != DriverKind::angle) continue;
    if (!(d.a.body == "ground" && d.b.body == body) && !(d.b.body == "ground" && d.a.body == body)) continue;
    constexpr int samples = 256;
    for (int i = 0; i <= samples; ++i) spin = std::max(spin, std::abs(d.law.at(scene.run.until * i / samples).rate));
  }
  return spin;
}

std::string spin_warning(const std::string& body, double spin, double change) {
  if (!(std::abs(change) > stiffening_matters)) return "";
  return "at " + number_text(spin) + " rad/s the loads of inertia on \"" + body + "\" " + changed(change) + "; add stiffening: rotation";
}

std::string stiffening_warning(const std::string& body, Stiffening now, const FrequencyChange& c) {
  const bool by_points = std::abs(c.by_all_loads - c.by_rotation) > stiffening_matters;
  if (now == Stiffening::none && !by_points) return spin_warning(body, c.spin, c.by_all_loads);
  if (now == Stiffening::axial || !by_points) return "";
  return "the loads on \"" + body + "\" and its points " + changed(c.by_all_loads) + "; add stiffening: axial";
}

std::string deflection_warning(const std::string& body, double deflection, double slope, const std::string& when) {
  if (!(deflection > large_deflection || slope > large_slope)) return "";
  constexpr double straight = 1e-3;  // a slope this small relative to the deflection: pure extension or compression
  if (slope > 0 && slope < straight * deflection)
    return "\"" + body + "\" is stretched or compressed by " + percent(deflection) +
           " of its size, but deformation is assumed small (up to " + percent(large_deflection) +
           "): valid for a straight spring, whose force is proportional to its elongation, but not for a solid bar";
  return "\"" + body + "\" " + when + " by " + percent(deflection) + " of its size, its slope " + number_text(slope) +
         " rad, within one body frame, but deformation is assumed small (up to " + percent(large_deflection) + " and " +
         number_text(large_slope) + " rad); cut a beam into pieces";
}

std::vector<std::string> warnings_of(const Scene& scene, const FlexibleReport& r, const std::vector<Imposed>& imposed) {
  std::vector<std::string> out;
  warn_of_frequency(r, imposed, out);
  if (r.motion) warn_of_linearity(scene, r, out);
  return out;
}

}  // namespace pintle
