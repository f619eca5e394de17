#include "framework/mechanism/result_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>

#include "elements/plane.h"
#include "framework/common/index.h"
#include "framework/dynamics/model/signal_values.h"
#include "framework/mechanism/columns.h"
#include "framework/mechanism/profile_contact.h"

namespace pintle {

namespace {

std::string body_name(const System& system, int marker) {
  const int body = system.markers[at(marker)].body;
  return body == ground ? "ground" : system.bodies[at(body)].name;
}
/// The end whose wrench is written: b, or a if b is the ground.
std::size_t written_end(const System& system, int joint) {
  const int b = system.end_marker[at(system.end_begin[at(joint)] + 1)];
  return system.markers[at(b)].body == ground ? 0 : 1;
}
int written_marker(const System& system, int joint) {
  return system.end_marker[at(system.end_begin[at(joint)]) + written_end(system, joint)];
}
bool is_flexible(const System& system) { return system.n() > system.n_rigid(); }

/// Motion of a marker that no joint uses; for a point of a flexible body also its displacement by deformation.
struct PointMotion {
  Eigen::Vector2d r, v, a, u;  ///< position, velocity, acceleration in world axes; displacement in body axes
  double turn = 0;             ///< rotation by deformation [rad]
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
  const auto* sized = std::get_if<SizedForce>(&f);
  return std::holds_alternative<Torque>(f) || std::holds_alternative<TorsionSpring>(f) ||
         (sized && sized->way != SizedForce::pull && sized->way > SizedForce::follows);
}

struct Now {
  const State& state;
  const Equations& eq;
};

// Motion of body b's origin and its modal coordinates.
template <class Out>
void body_columns(const System& system, std::size_t b, Out& out) {
  const Body& body = system.bodies[b];
  const auto arm = [&body, b](const Now& now) -> Eigen::Vector2d {
    return Eigen::Rotation2Dd(now.state.y[static_cast<Eigen::Index>(3 * b) + 2]) * body.x_BO;
  };
  const auto speeds = [&system, b](const Now& now) { return now.state.y.data() + system.n() + 3 * b; };
  out(body.name, column::body_pose, [&](const Now& now) {
    const double* q = now.state.y.data() + 3 * b;
    const Eigen::Vector2d d = arm(now);
    return std::array{q[0] + d.x(), q[1] + d.y(), q[2]};
  });
  out(body.name, column::body_speed, [&](const Now& now) {
    const double* s = speeds(now);
    const Eigen::Vector2d turned = perp(arm(now));
    return std::array{s[0] + s[2] * turned.x(), s[1] + s[2] * turned.y(), s[2]};
  });
  out(body.name, column::body_acceleration, [&](const Now& now) {
    const double *s = speeds(now), *a = now.eq.a.data() + 3 * b;
    const Eigen::Vector2d d = arm(now), turned = perp(d);
    return std::array{a[0] + a[2] * turned.x() - s[2] * s[2] * d.x(), a[1] + a[2] * turned.y() - s[2] * s[2] * d.y(), a[2]};
  });
  for (int i = 0; i < body.modes(); ++i)
    out(
        body.name, column::mode, [&](const Now& now) { return std::array{now.state.y[system.eta_begin[b] + i]}; },
        [i] { return std::to_string(i + 1); });
}

// The force and the couple of a wrench on the body of a marker, if it has them.
template <class Out, class OfNow>
void wrench_columns(const System& system, const std::string& name, bool force, bool couple, int marker, const OfNow& wrench, Out& out) {
  const auto on = [&] { return " on " + body_name(system, marker); };
  if (force)
    out(
        name, column::force,
        [&](const Now& now) {
          const Wrench w = wrench(now);
          return std::array{w[0], w[1]};
        },
        on);
  if (couple)
    out(
        name, column::couple, [&](const Now& now) { return std::array{wrench(now)[2]}; }, on);
}

// Contact pressure between cylinders, if a theory gives it.
template <class Out, class Force>
void pressure_columns(const std::string& name, const std::optional<PressureTheory>& theory, const Force& force, Out& out) {
  if (!theory) return;
  out(name, column::pressure, [&](const Now& now) {
    const Pressure p = pressure_under(*theory, force(now));
    return std::array{p.greatest, p.half_angle};
  });
}

template <class Out>
void contact_columns(const System& system, std::size_t k, Out& out) {
  const ContactPair& pair = system.contacts[k];
  out(system.contact_names[k], column::journal, [&](const Now& now) {
    const ContactEffect c = clearance_effect(system, now.eq, k);
    const double slip = pair.sliding == Sliding::geometric ? c.gap.geometric_slip : c.gap.material_slip;
    return std::array{c.gap.e.x(), c.gap.e.y(), c.gap.depth, c.gap.rate, slip, c.normal.force, c.friction};
  });
  wrench_columns(
      system, system.contact_names[k], true, false, written_marker(pair),
      [&](const Now& now) { return written_force(pair, clearance_effect(system, now.eq, k)); }, out);
  pressure_columns(
      system.contact_names[k], pair.pressure, [&](const Now& now) { return clearance_effect(system, now.eq, k).normal.force; }, out);
}

template <class Out>
void profile_columns(const System& system, std::size_t first, Out& out) {
  std::optional<ProfileContact> found;  // evaluated once per row
  const auto contact = [&](const Now& now) -> const ProfileContact& {
    if (!found) found = profile_contact(system, first, now.state, now.eq);
    return *found;
  };
  const ContactPair& pair = system.contacts[first];
  const std::string& name = system.contact_names[first];
  out(name, pair.journal ? column::journal : column::profiles, [&](const Now& now) {
    const ProfileContact& c = contact(now);
    const double slip = pair.sliding == Sliding::geometric ? c.gap.geometric_slip : c.gap.material_slip;
    return std::array{c.at.x(), c.at.y(), c.gap.depth, c.gap.rate, slip, c.normal, c.friction};
  });
  wrench_columns(
      system, name, true, false, written_marker(pair), [&](const Now& now) { return written_force(pair, contact(now)); }, out);
  pressure_columns(
      name, pair.pressure, [&](const Now& now) { return contact(now).pressed; }, out);
  if (pair.flank) out(name, column::flank, [&](const Now& now) { return std::array{contact(now).teeth, contact(now).travel}; });
}

// For a contact of several pairs, the states of the pair with the largest normal force. The states of its pairs are stored one after another.
const InternalStates& shown(const System& system, const InternalStates& owner, const Equations& eq) {
  if (owner.owner != InternalStates::contact) return owner;
  const InternalStates* out = &owner;
  for (int i = 1; i < system.contacts[at(owner.index)].pairs; ++i) {
    const InternalStates* other = &owner + i;
    if (eq.contact[at(other->index)].normal.force > eq.contact[at(out->index)].normal.force) out = other;
  }
  return *out;
}

template <class Out>
void internal_columns(const System& system, const InternalStates& owner, Out& out) {
  if (owner.owner == InternalStates::contact && system.contacts[at(owner.index)].pair > 0) return;
  const auto states = states_of(system, owner);
  for (int i = 0; i < owner.n; ++i)
    out(owner_name(system, owner), {{states[at(i)].name, states[at(i)].unit}},
        [&, i](const Now& now) { return std::array{now.state.y[system.x_begin() + shown(system, owner, now.eq).begin + i]}; });
}

template <class Out>
void point_columns(const System& system, const RecordedPoint& p, Out& out) {
  const auto motion = [&](const Now& now) { return motion_of(system, p.marker, now.state, now.eq); };
  out(p.name, column::point, [&](const Now& now) {
    const PointMotion m = motion(now);
    return std::array{m.r.x(), m.r.y(), m.v.x(), m.v.y(), m.a.x(), m.a.y()};
  });
  if (p.marker.shape.size() > 0)
    out(p.name, column::deformation, [&](const Now& now) {
      const PointMotion m = motion(now);
      return std::array{m.u.x(), m.u.y(), m.turn};
    });
}

template <class Out>
void stress_columns(const System& system, const RecordedStress& s, Out& out) {
  const auto at_side = [&](const StressProbe::Side& side, const Now& now) -> Eigen::VectorXd {
    return side.rows * now.state.y.segment(system.eta_begin[at(s.body)], side.rows.cols());
  };
  if (s.probe.beam)
    out(s.name, column::beam_stress, [&](const Now& now) {
      std::array<double, 4> most{};  // of the side and the fibre with the largest stress
      for (const StressProbe::Side& side : s.probe.sides) {
        const Eigen::VectorXd v = at_side(side, now);
        const double stress = std::abs(v[0]) / side.A + std::abs(v[2]) * side.distance / side.I;
        if (!(stress < most[3])) most = {v[0], v[1], v[2], stress};
      }
      return most;
    });
  else
    out(s.name, column::plane_stress, [&](const Now& now) {
      const Eigen::VectorXd v = at_side(s.probe.sides.front(), now);
      return std::array{v[0], v[1], v[2], von_mises(v)};
    });
}

/// Unit of a state of the scene or of an output, as written in column headings.
std::string written_unit(const std::string& unit) {
  std::string out = unit.empty() ? "1" : unit;
  std::ranges::replace(out, '*', ' ');
  return out;
}

/// Appends the outputs of a row, from its columns and the state.
void append_outputs(const Model& model, const State& state, std::size_t row, std::vector<double>& data) {
  const std::size_t first = data.size();
  std::array<double, most_law_inputs> in;
  for (const WrittenOutput& o : model.outputs) {
    for (std::size_t k = 0; k < o.in.size(); ++k) in[k] = input_value(model, o.in[k], state, data.data() + row, data.data() + first);
    data.push_back(o.of(state.t, in.data(), nullptr));
  }
}

template <class Out>
void trajectory_columns(const Model& model, Out out) {
  const System& system = model.system;
  out("", {{"t", "s"}}, [](const Now& now) { return std::array{now.state.t}; });
  for (std::size_t b = 0; b < system.bodies.size(); ++b) body_columns(system, b, out);
  for (int k = 0; k < static_cast<int>(system.joints.size()); ++k) {
    if (is_link(system, k)) continue;  // its force is among the columns of its clearance
    const JointProperties& of = properties_of(system.joints[at(k)]);
    wrench_columns(
        system, system.joint_names[at(k)], of.force, of.couple, written_marker(system, k),
        [&](const Now& now) { return joint_wrench(system, now.eq, k); }, out);
    for (int row = 0; row < of.rows(); ++row)
      if (const char* effort = of.efforts[at(row)])
        out(system.joint_names[at(k)], {{effort, "N"}},
            [&](const Now& now) { return std::array{-now.eq.lambda[system.row_begin[at(k)] + row]}; });
  }
  for (std::size_t k = 0; k < system.frictions.size(); ++k)
    out(system.joint_names[at(system.frictions[k].joint)], column::joint_friction, [&, k](const Now& now) {
      const JointFrictionEffect& f = now.eq.friction[k];
      return std::array{f.slip, f.load, f.force};
    });
  for (std::size_t k = 0; k < system.contacts.size(); ++k) {
    if (!system.contacts[k].profiles)
      contact_columns(system, k, out);
    else if (system.contacts[k].pair == 0)
      profile_columns(system, k, out);
  }
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const bool turns = is_turning(system.forces[k]);
    const auto* span = std::get_if<BeltSpan>(&system.forces[k]);
    wrench_columns(
        system, system.force_names[k], !turns, turns || span, marker_b(system.forces[k]),
        [&](const Now& now) { return now.eq.force[k].on_b; }, out);
    if (span)
      out(system.force_names[k], column::tension,
          [&](const Now& now) { return std::array{tension(*span, now.eq.motion[at(span->a)], now.eq.motion[at(span->b)])}; });
  }
  for (const InternalStates& owner : system.internal) internal_columns(system, owner, out);
  for (std::size_t i = 0; i < system.states.size(); ++i)
    out(system.states[i].name, {{"", written_unit(system.states[i].unit).c_str()}},
        [&, i](const Now& now) { return std::array{now.state.y[own_state(system, static_cast<int>(i))]}; });
  for (const RecordedPoint& p : model.points) point_columns(system, p, out);
  for (const RecordedStress& s : model.stresses) stress_columns(system, s, out);
}

struct Books {
  const State& state;
  const Energies& energies;
  double unexplained;
};

template <class Out>
void ledger_columns(const System& system, Out out) {
  out("", {{"t", "s"}}, [](const Books& now) { return std::array{now.state.t}; });
  out("", column::energies, [](const Books& now) {
    const Energies& e = now.energies;
    return std::array{e.kinetic, e.gravity, e.springs, e.contacts};
  });
  if (is_flexible(system)) out("", column::strain, [](const Books& now) { return std::array{now.energies.strain}; });
  out("", column::stored, [](const Books& now) { return std::array{now.energies.stored()}; });
  for (std::size_t i = 0; i < system.integrals.size(); ++i)
    out(
        "", {{"", "J"}}, [&](const Books& now) { return std::array{now.state.y[system.z_begin() + static_cast<Eigen::Index>(i)]}; },
        [&] { return integral_name(system, system.integrals[i]); });
  out("", column::unexplained, [](const Books& now) { return std::array{now.unexplained}; });
}

}  // namespace

std::string joint_subject(const System& system, int joint) { return body_name(system, written_marker(system, joint)); }

Wrench joint_wrench(const System& system, const Equations& eq, int joint) {
  return reaction(system, eq, at(joint), written_end(system, joint));
}

std::string integral_name(const System& system, const Integral& i) {
  switch (i.account) {
    case Account::hysteresis: return system.contact_names[at(i.index)] + column::to_hysteresis.name;
    case Account::friction: return system.contact_names[at(i.index)] + column::to_friction.name;
    case Account::joint_friction: return system.joint_names[at(system.frictions[at(i.index)].joint)] + column::to_friction.name;
    case Account::damper: return system.force_names[at(i.index)] + column::to_damper.name;
    case Account::load: return system.force_names[at(i.index)] + column::work_in.name;
    case Account::driver: return system.joint_names[at(i.index)] + column::work_in.name;
    case Account::damping: return system.bodies[at(i.index)].name + column::to_damping.name;
    case Account::switching: {
      const Switch& s = system.switches[at(i.index)];
      return switch_name(system, s) + (s.of == Switch::joint ? column::to_engaging : column::to_switching).name;
    }
    case Account::scheme: return "scheme.lost to numerical dissipation";
  }
  return "";
}

Table trajectory_table(const Model& model) {
  Table t;
  trajectory_columns(model, Heading{t.header});
  for (const WrittenOutput& o : model.outputs) t.header.push_back(o.name + " [" + written_unit(o.unit) + "]");
  return t;
}
void record(const Model& model, const State& state, const Equations& eq, Table& t) {
  const std::size_t row = t.data.size();
  trajectory_columns(model, ValueRow<Now>{{state, eq}, t.data});
  append_outputs(model, state, row, t.data);
}

double input_value(const Model& model, const WrittenOutput::Input& input, const State& state, const double* columns,
                   const double* outputs) {
  switch (input.from) {
    case WrittenOutput::Input::signal: return signal_at(model.system, model.system.signals[at(input.index)], state.y);
    case WrittenOutput::Input::column: return columns[input.index];
    case WrittenOutput::Input::output: return outputs[input.index];
  }
  return 0;
}

Table ledger_table(const System& system) {
  Table t;
  ledger_columns(system, Heading{t.header});
  return t;
}
void record_ledger(const System& system, const State& state, const Energies& e, double unexplained, Table& t) {
  ledger_columns(system, ValueRow<Books>{{state, e, unexplained}, t.data});
}

std::size_t first_integral(const System& system) { return is_flexible(system) ? 7 : 6; }

}  // namespace pintle
