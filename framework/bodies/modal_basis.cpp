#include "framework/bodies/modal_basis.h"

#include <algorithm>
#include <iomanip>
#include <numbers>
#include <set>
#include <sstream>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/in_body.h"
#include "framework/common/nearest.h"
#include "framework/component/fe/assembly.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

int named_port(const Scene& scene, const ElasticBody& e, const std::string& name, const Place& place) {
  if (const int port = port_of(e, name); port >= 0) return port;
  std::vector<std::string> known;
  for (const Port& p : e.model.ports) known.push_back(p.name);
  throw SceneError(scene.file, place, "\"" + e.scene->name + "\" has no point \"" + name + "\"." + did_you_mean(name, known));
}

Keep keep_of(const SceneKeep& k, const std::optional<int>& chosen) {
  if (k.automatic && chosen) return {*chosen, {}, {}, false};
  return {k.count, k.below, k.effective_mass, !k.count && !k.below && !k.effective_mass};
}

/// Reports errors of the reduction at the scene's `modes`.
template <class Work>
auto in_modes(const Scene& scene, const SceneModes& modes, Work work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw SceneError(scene.file, modes.place, error.what());
  } catch (const SceneError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw SceneError(scene.file, modes.place, error.what());
  }
}

void validate(const Scene& scene, const ElasticBody& e, const ReferenceConditions& conditions) {
  const SceneModes& modes = *e.scene->elastic->modes;
  const Port& a = e.model.ports[static_cast<std::size_t>(conditions.a)];
  if (conditions.kind == ReferenceConditions::tangent && a.dof[2] < 0)
    throw SceneError(scene.file, modes.place,
                     "the frame is tangent at " + a.name + ", a point of " + (e.plate() ? "a plate" : "a bar") +
                         ", which has no direction; use " + (e.plate() ? "the centre of a hole, " : "") +
                         "a chord through two points, or mean axes");
  if (conditions.kind == ReferenceConditions::tangent) return;
  const Port& b = e.model.ports[static_cast<std::size_t>(conditions.b)];
  const double size = (e.mesh.x.rowwise().maxCoeff() - e.mesh.x.rowwise().minCoeff()).norm();
  if ((b.x - a.x).norm() <= 1e-9 * size)
    throw SceneError(scene.file, modes.place,
                     "the frame's chord runs from " + a.name + " to " + b.name + ", which lie at the same place, " + shown(a.x) +
                         "; name two different positions, or tangent: " + a.name);
}

std::string hertz(double omega) {
  std::ostringstream s;
  s << std::setprecision(4) << omega / (2 * std::numbers::pi);
  return s.str();
}

}  // namespace

Component component_of(const ElasticBody& e) { return {e.model, independent(e.model, e.K), independent(e.model, e.M)}; }

int port_of(const ElasticBody& e, const std::string& point) {
  const double size = (e.mesh.x.rowwise().maxCoeff() - e.mesh.x.rowwise().minCoeff()).norm();
  for (std::size_t i = 0; i < e.model.ports.size(); ++i)
    if (point.empty() ? e.model.ports[i].x.norm() <= 1e-7 * size : e.model.ports[i].name == point) return static_cast<int>(i);
  return -1;
}

std::set<int> loaded_ports(const Scene& scene, const ElasticBody& e) {
  std::set<int> used;
  const auto note = [&](const PointRef& ref) {
    if (ref.body == e.scene->name) used.insert(port_of(e, ref.point));
  };
  for (const SceneJoint& j : scene.joints)
    for (const PointRef* point : points_of(j)) note(*point);
  for (const SceneContact& c : scene.contacts) note(carrier_of(scene, c.a)), note(carrier_of(scene, c.b));
  for (const SceneDriver& d : scene.drivers) note(d.a), note(d.b);
  for (const SceneLoad& l : scene.loads)
    std::visit(
        [&](const auto& w) {
          if constexpr (requires { w.at; })
            note(w.at);
          else if constexpr (requires { w.pulleys; })
            std::ranges::for_each(w.pulleys, note);
          else
            note(w.a), note(w.b);
        },
        l.what);
  return used;
}

std::vector<int> interface_of(const Scene& scene, const ElasticBody& e) {
  const std::set<int> used = loaded_ports(scene, e);
  std::vector<int> ports;
  for (int i = 0; i < static_cast<int>(e.model.ports.size()); ++i)
    if (used.empty() || used.contains(i)) ports.push_back(i);
  return ports;
}

std::vector<int> massless_ports(const Scene& scene, const ElasticBody& e) {
  std::vector<int> ports;
  if (!e.scene->elastic->modes || !e.scene->elastic->modes->massless) return ports;
  for (const SceneJoint& j : scene.joints)
    if (presses_elastically(j))
      for (const PointRef* point : {&j.a, &j.b})
        if (point->body == e.scene->name) ports.push_back(port_of(e, point->point));
  return ports;
}

std::vector<int> shaped_ports(const Scene& scene, const ElasticBody& e) {
  std::vector<int> ports = interface_of(scene, e);
  const std::vector<int> massless = massless_ports(scene, e);
  std::erase_if(ports, [&](int port) { return std::ranges::find(massless, port) != massless.end(); });
  return ports;
}

ModalModel lowest_of(const ModalModel& m, Eigen::Index count) {
  return {m.shapes.leftCols(count), m.ports.leftCols(count), m.omega.head(count), m.residual.head(count), {}};
}

Sparse skew_mass_of(const ElasticBody& e) {
  if (!e.scene->elastic->lumped) return Assembler(e.model).skew_mass();
  std::vector<Eigen::Triplet<double>> entries;  // point masses: m Zᵀ at each node
  for (std::size_t i = 0; i + 1 < e.model.begin.size(); ++i) {
    const int x = e.model.begin[i];
    const double m = e.M.coeff(x, x);
    entries.emplace_back(x, x + 1, m);
    entries.emplace_back(x + 1, x, -m);
  }
  Sparse G(e.model.N(), e.model.N());
  G.setFromTriplets(entries.begin(), entries.end());
  return G;
}

ReferenceConditions reference_conditions_of(const Scene& scene, const ElasticBody& e) {
  const SceneModes& modes = *e.scene->elastic->modes;
  using Frame = SceneModes::Frame;
  if (modes.frame == Frame::mean_axes) return {ReferenceConditions::mean_axes};
  const std::size_t needed = modes.frame == Frame::tangent ? 1 : 2;
  if (e.model.ports.size() < needed)
    throw SceneError(scene.file, modes.place,
                     "the frame needs " + std::string(needed == 1 ? "a point" : "two points") + " of the body; add " +
                         (needed == 1 ? "it" : "them") + " under points");
  std::string a = modes.a, b = modes.b;
  if (const auto* beam = std::get_if<SceneBeam>(&e.scene->elastic->shape); beam && a.empty()) a = beam->through.front();
  if (const auto* beam = std::get_if<SceneBeam>(&e.scene->elastic->shape); beam && b.empty()) b = beam->through.back();
  if (a.empty()) a = e.scene->points.front().name;
  if (b.empty()) b = e.scene->points.back().name;
  const int first = named_port(scene, e, a, modes.place);
  const ReferenceConditions conditions = modes.frame == Frame::tangent
                                             ? ReferenceConditions{ReferenceConditions::tangent, first}
                                             : ReferenceConditions{ReferenceConditions::chord, first, named_port(scene, e, b, modes.place)};
  validate(scene, e, conditions);
  return conditions;
}

std::string title_of(const SceneModes& m) {
  std::string frame = m.frame == SceneModes::Frame::tangent ? "tangent frame"
                      : m.frame == SceneModes::Frame::chord ? "chord frame"
                                                            : "mean axes";
  if (m.massless) frame += ", massless boundary";
  switch (m.method) {
    case SceneModes::Method::normal: return "normal modes, " + frame;
    case SceneModes::Method::craig_bampton: return "Craig-Bampton, " + frame;
    case SceneModes::Method::free: return "free modes with residual attachment, " + frame;
  }
  return frame;
}

Eigen::VectorXd damping_of(const Scene& scene, const SceneBody& body, const Eigen::VectorXd& omega, const Eigen::VectorXd& basis) {
  const auto& damping = body.elastic->damping;
  Eigen::VectorXd zeta = Eigen::VectorXd::Zero(omega.size());
  if (!damping) return zeta;
  if (!damping->ratios.empty()) {
    for (Eigen::Index i = 0; i < omega.size(); ++i)
      zeta[i] = damping->ratios[std::min(static_cast<std::size_t>(i), damping->ratios.size() - 1)];
    return zeta;
  }
  Rayleigh c;
  if (damping->rayleigh) {
    c = {(*damping->rayleigh)[0], (*damping->rayleigh)[1]};
  } else {
    const int first = damping->rayleigh_modes[0], second = damping->rayleigh_modes[1];
    const auto& z = *damping->rayleigh_ratios;
    if (basis.size() == 1 && z[0] == z[1]) return zeta.setConstant(z[0]);
    if (std::max(first, second) > basis.size())
      throw SceneError(scene.file, damping->place,
                       "Rayleigh damping is defined at modes " + std::to_string(first) + " and " + std::to_string(second) +
                           ", but there are " + std::to_string(basis.size()) + "; name two of these under modes, or keep more");
    c = in_body(scene, body, [&] { return rayleigh(basis[first - 1], z[0], basis[second - 1], z[1]); });
  }
  zeta = ratios(c, omega);
  Eigen::Index at = 0;
  if (zeta.size() > 0 && zeta.minCoeff(&at) < 0)
    throw SceneError(scene.file, damping->place,
                     "Rayleigh damping gives mode " + std::to_string(at + 1) + " at " + hertz(omega[at]) + " Hz the damping ratio " +
                         hertz(2 * std::numbers::pi * zeta[at]) +
                         ", which would add energy; choose two ratios that differ less, or give a ratio for each mode");
  return zeta;
}

ModalModel reduce(const Scene& scene, const ElasticBody& e, std::optional<int> chosen) {
  const SceneModes& m = *e.scene->elastic->modes;
  const ReferenceConditions conditions = reference_conditions_of(scene, e);
  const Keep keep = keep_of(m.keep, chosen);
  return in_modes(scene, m, [&] {
    const Component c = component_of(e);
    switch (m.method) {
      case SceneModes::Method::craig_bampton: return craig_bampton(c, shaped_ports(scene, e), conditions, keep);
      case SceneModes::Method::free: return free_modes(c, shaped_ports(scene, e), conditions, keep);
      case SceneModes::Method::normal: break;
    }
    return normal_modes(c, conditions, keep);
  });
}

}  // namespace pintle
