#include "framework/mechanism/trajectory.h"

#include <stdexcept>

#include <Eigen/Geometry>

#include "elements/plane.h"
#include "framework/common/index.h"

namespace pintle {

namespace {

std::string body_name(const System& system, int marker) {
  const int body = system.markers[at(marker)].body;
  return body == ground ? "ground" : system.bodies[at(body)].name;
}
bool acts_on_b(const System& system, int joint) {
  return system.markers[at(marker_b(system.joints[at(joint)]))].body != ground;
}
bool has_force(const Joint& j) { return !std::holds_alternative<AngleDriver>(j); }
bool has_couple(const Joint& j) {
  return std::holds_alternative<AngleDriver>(j) || std::holds_alternative<Weld>(j) ||
         std::holds_alternative<Prismatic>(j);
}
bool is_flexible(const System& system) { return system.n() > system.n_rigid(); }

/// Motion of a marker that no joint uses; of a point of a flexible body also what deformation moves it.
struct PointMotion {
  Eigen::Vector2d r, v, a, u;  ///< place, velocity, acceleration in the world; displacement in body axes
  double turn = 0;
};
PointMotion motion_of(const System& system, const Marker& m, const State& state, const Equations& eq) {
  if (m.body == ground) return {m.x_BP, {0, 0}, {0, 0}, {0, 0}};
  const double *q = state.y.data() + 3 * m.body, *s = q + system.n(), *a = eq.a.data() + 3 * m.body;
  const Eigen::Rotation2Dd A(q[2]);
  Eigen::Vector2d u(0, 0), du(0, 0), ddu(0, 0);
  double turn = 0;
  if (const Eigen::Index n = m.shape.cols(); n > 0) {
    const int begin = system.eta_begin[at(m.body)];
    const Eigen::VectorXd eta = state.y.segment(begin, n), rate = state.y.segment(system.n() + begin, n), acc = eq.a.segment(begin, n);
    for (int k = 0; k < 2; ++k) {
      u[k] = m.shape.row(k).dot(eta), du[k] = m.shape.row(k).dot(rate), ddu[k] = m.shape.row(k).dot(acc);
      if (const Eigen::MatrixXd& F = m.second[at(k)]; F.size() > 0) {
        u[k] += eta.dot(F * eta) / 2, du[k] += eta.dot(F * rate), ddu[k] += eta.dot(F * acc) + rate.dot(F * rate);
      }
    }
    turn = m.slope.dot(eta);
  }
  const Eigen::Vector2d d = A * (m.x_BP + u), drift = A * du;
  return {Eigen::Vector2d(q[0], q[1]) + d, Eigen::Vector2d(s[0], s[1]) + s[2] * perp(d) + drift,
          Eigen::Vector2d(a[0], a[1]) + a[2] * perp(d) - s[2] * s[2] * d + 2 * s[2] * perp(drift) + A * ddu, u, turn};
}

bool is_turning(const Force& f) {
  return std::holds_alternative<Torque>(f) || std::holds_alternative<TorsionSpring>(f);
}
}  // namespace

std::string joint_subject(const System& system, int joint) {
  const Joint& j = system.joints[at(joint)];
  return body_name(system, acts_on_b(system, joint) ? marker_b(j) : marker_a(j));
}

Wrench joint_wrench(const System& system, const Equations& eq, int joint) {
  const int row = system.row_begin[at(joint)], m = system.row_begin[at(joint) + 1] - row;
  const auto& L = acts_on_b(system, joint) ? eq.rows[at(joint)].Lb : eq.rows[at(joint)].La;
  return -L.topRows(m).transpose() * eq.lambda.segment(row, m);
}

Table trajectory_table(const Model& model) {
  const System& system = model.system;
  Table t;
  auto add = [&](const std::string& name, const char* unit) { t.header.push_back(name + " [" + unit + "]"); };
  add("t", "s");
  for (const Body& b : system.bodies) {
    add(b.name + ".x", "m"), add(b.name + ".y", "m"), add(b.name + ".angle", "rad");
    add(b.name + ".vx", "m/s"), add(b.name + ".vy", "m/s"), add(b.name + ".speed", "rad/s");
    add(b.name + ".ax", "m/s^2"), add(b.name + ".ay", "m/s^2"), add(b.name + ".alpha", "rad/s^2");
    for (int i = 1; i <= b.modes(); ++i) add(b.name + ".mode " + std::to_string(i), "m kg^0.5");
  }
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    if (is_link(system, static_cast<int>(k))) continue;  // its force stands with its clearance
    const std::string on = " on " + joint_subject(system, static_cast<int>(k));
    if (has_force(system.joints[k])) {
      add(system.joint_names[k] + ".fx" + on, "N");
      add(system.joint_names[k] + ".fy" + on, "N");
    }
    if (has_couple(system.joints[k])) add(system.joint_names[k] + ".torque" + on, "N m");
  }
  for (std::size_t k = 0; k < system.contacts.size(); ++k) {
    const std::string& name = system.contact_names[k];
    const std::string on = " on " + body_name(system, system.contacts[k].journal);
    add(name + ".ex", "m"), add(name + ".ey", "m"), add(name + ".depth", "m"), add(name + ".rate", "m/s");
    add(name + ".sliding", "m/s"), add(name + ".normal", "N"), add(name + ".friction", "N");
    add(name + ".fx" + on, "N"), add(name + ".fy" + on, "N");
  }
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const std::string on = " on " + body_name(system, marker_b(system.forces[k]));
    if (is_turning(system.forces[k])) {
      add(system.force_names[k] + ".torque" + on, "N m");
    } else {
      add(system.force_names[k] + ".fx" + on, "N");
      add(system.force_names[k] + ".fy" + on, "N");
    }
  }
  for (const RecordedPoint& p : model.points) {
    add(p.name + ".x", "m"), add(p.name + ".y", "m"), add(p.name + ".vx", "m/s"), add(p.name + ".vy", "m/s");
    add(p.name + ".ax", "m/s^2"), add(p.name + ".ay", "m/s^2");
    if (p.marker.shape.size() > 0) add(p.name + ".ux", "m"), add(p.name + ".uy", "m"), add(p.name + ".turn", "rad");
  }
  for (const RecordedStress& s : model.stresses) {
    if (s.probe.beam) {
      add(s.name + ".N", "N"), add(s.name + ".V", "N"), add(s.name + ".M", "N m"), add(s.name + ".stress", "Pa");
    } else {
      add(s.name + ".sx", "Pa"), add(s.name + ".sy", "Pa"), add(s.name + ".txy", "Pa"), add(s.name + ".von Mises", "Pa");
    }
  }
  return t;
}

void record(const Model& model, const State& state, const Equations& eq, Table& t) {
  const System& system = model.system;
  auto add = [&](std::initializer_list<double> values) { t.data.insert(t.data.end(), values); };
  add({state.t});
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const double* q = state.y.data() + 3 * b;
    const double* s = q + system.n();
    const double* a = eq.a.data() + 3 * b;
    const Eigen::Vector2d arm = Eigen::Rotation2Dd(q[2]) * system.bodies[b].x_BO, turned = perp(arm);
    add({q[0] + arm.x(), q[1] + arm.y(), q[2]});
    add({s[0] + s[2] * turned.x(), s[1] + s[2] * turned.y(), s[2]});
    add({a[0] + a[2] * turned.x() - s[2] * s[2] * arm.x(), a[1] + a[2] * turned.y() - s[2] * s[2] * arm.y(), a[2]});
    for (int i = system.eta_begin[b]; i < system.eta_begin[b + 1]; ++i) add({state.y[i]});
  }
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    if (is_link(system, static_cast<int>(k))) continue;
    const Wrench w = joint_wrench(system, eq, static_cast<int>(k));
    if (has_force(system.joints[k])) add({w[0], w[1]});
    if (has_couple(system.joints[k])) add({w[2]});
  }
  for (std::size_t k = 0; k < system.contacts.size(); ++k) {
    const ContactEffect c = clearance_effect(system, eq, k);
    const double slip = system.contacts[k].sliding == Sliding::geometric ? c.gap.geometric_slip : c.gap.material_slip;
    add({c.gap.e.x(), c.gap.e.y(), c.gap.depth, c.gap.rate, slip, c.normal.force, c.friction});
    add({c.on_journal[0], c.on_journal[1]});
  }
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const Wrench& w = eq.force[k].on_b;
    if (is_turning(system.forces[k]))
      add({w[2]});
    else
      add({w[0], w[1]});
  }
  for (const RecordedPoint& p : model.points) {
    const PointMotion m = motion_of(system, p.marker, state, eq);
    add({m.r.x(), m.r.y(), m.v.x(), m.v.y(), m.a.x(), m.a.y()});
    if (p.marker.shape.size() > 0) add({m.u.x(), m.u.y(), m.turn});
  }
  for (const RecordedStress& s : model.stresses) {
    const Eigen::VectorXd v = s.probe.rows * state.y.segment(system.eta_begin[at(s.body)], s.probe.rows.cols());
    if (s.probe.beam)  // the larger of the two fibres
      add({v[0], v[1], v[2], std::abs(v[0]) / s.probe.A + std::abs(v[2]) * s.probe.distance / s.probe.I});
    else
      add({v[0], v[1], v[2], von_mises(v)});
  }
}

std::string integral_name(const System& system, const Integral& i) {
  switch (i.account) {
    case Account::hysteresis: return system.contact_names[at(i.index)] + ".lost to hysteresis";
    case Account::friction: return system.contact_names[at(i.index)] + ".lost to friction";
    case Account::damper: return system.force_names[at(i.index)] + ".lost to damper";
    case Account::load: return system.force_names[at(i.index)] + ".work in";
    case Account::driver: return system.joint_names[at(i.index)] + ".work in";
    case Account::damping: return system.bodies[at(i.index)].name + ".lost to damping";
    case Account::scheme: return "scheme.lost to numerical dissipation";
  }
  return "";
}

Table ledger_table(const System& system) {
  Table t;
  t.header = {"t [s]", "kinetic [J]", "gravity [J]", "springs [J]", "contacts [J]"};
  if (is_flexible(system)) t.header.push_back("strain [J]");
  t.header.push_back("stored [J]");
  for (const Integral& i : system.integrals) t.header.push_back(integral_name(system, i) + " [J]");
  t.header.push_back("unexplained [J]");
  return t;
}

std::size_t first_integral(const System& system) { return is_flexible(system) ? 7 : 6; }

void record_ledger(const System& system, const State& state, const Energies& e, double unexplained, Table& t) {
  t.data.insert(t.data.end(), {state.t, e.kinetic, e.gravity, e.springs, e.contacts});
  if (is_flexible(system)) t.data.push_back(e.strain);
  t.data.push_back(e.stored());
  for (int i = 0; i < system.n_z(); ++i) t.data.push_back(state.y[2 * system.n() + i]);
  t.data.push_back(unexplained);
}

}  // namespace pintle
