#include "framework/dynamics/model/system.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace pintle {

namespace {

void number_internal(System& system) {
  std::vector<double> x_scale;
  system.internal.clear();
  const auto all = [&](InternalStates::Owner owner, const auto& of, auto has, std::vector<int>& first) {
    first.clear();
    for (const auto& one : of) {
      const int begin = static_cast<int>(x_scale.size());
      first.push_back(begin);
      if (!has(one)) continue;
      InternalStates& added = system.internal.emplace_back(InternalStates{owner, static_cast<int>(first.size()) - 1, begin, 0});
      for (const InternalState& s : states_of(system, added)) x_scale.push_back(s.scale), ++added.n;
    }
  };
  all(
      InternalStates::force, system.forces, [](const Force& f) { return !internal_states(f).empty(); }, system.force_x);
  all(InternalStates::contact, system.contacts, has_bristles, system.contact_x);
  all(
      InternalStates::friction, system.frictions, [](const JointFriction& f) { return bristle_states(f.law) > 0; }, system.friction_x);
  system.own_x = static_cast<int>(x_scale.size());
  for (const OwnState& state : system.states) x_scale.push_back(state.scale);
  system.x_scale = Eigen::Map<const Eigen::VectorXd>(x_scale.data(), static_cast<Eigen::Index>(x_scale.size()));
}

void number_switches(System& system) {
  for (std::vector<int>* places : {&system.joint_switch, &system.force_switch, &system.contact_switch}) places->clear();
  if (system.switches.empty()) return;
  system.joint_switch.assign(system.joints.size(), -1);
  system.force_switch.assign(system.forces.size(), -1);
  system.contact_switch.assign(system.contacts.size(), -1);
  for (std::size_t k = 0; k < system.switches.size(); ++k) {
    const Switch& s = system.switches[k];
    std::vector<int>& places = s.of == Switch::joint   ? system.joint_switch
                               : s.of == Switch::force ? system.force_switch
                                                       : system.contact_switch;
    const auto first = places.begin() + s.index;
    std::fill(first, first + (s.of == Switch::contact ? system.contacts[static_cast<std::size_t>(s.index)].pairs : 1), static_cast<int>(k));
  }
}

void number_coordinates(System& system) {
  system.eta_begin.assign(1, system.n_rigid());
  for (const Body& b : system.bodies) system.eta_begin.push_back(system.eta_begin.back() + b.modes());
  system.scale.setConstant(system.n(), system.length);
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    system.scale[3 * static_cast<Eigen::Index>(b) + 2] = 1;
    system.scale.segment(system.eta_begin[b], system.bodies[b].modes()) *= std::sqrt(system.bodies[b].m);
  }
}

void number_rows(System& system) {
  system.row_begin.assign(1, 0);
  system.end_begin.assign(1, 0);
  system.end_marker.clear();
  for (const Joint& j : system.joints) {
    const JointEnds ends = ends_of(j);
    system.row_begin.push_back(system.row_begin.back() + rows(j));
    system.end_begin.push_back(system.end_begin.back() + ends.n);
    system.end_marker.insert(system.end_marker.end(), ends.begin(), ends.end());
  }

  system.row_scale.resize(system.n_rows());
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    for (int row = system.row_begin[k]; row < system.row_begin[k + 1]; ++row)
      system.row_scale[row] = is_angle_row(system.joints[k], row - system.row_begin[k]) ? 1 : 1 / system.length;
}

void number_integrals(System& system, bool scheme_loses) {
  auto account = [&](Account what, std::size_t i) {
    system.integrals.push_back({what, static_cast<int>(i)});
    return static_cast<int>(system.integrals.size()) - 1;
  };
  system.integrals.clear();
  system.contact_z.clear();
  system.force_z.clear();
  system.joint_z.clear();
  for (std::size_t i = 0; i < system.contacts.size(); ++i) {
    if (system.contacts[i].pair > 0) {  // for two profiles, their pairs share these
      system.contact_z.push_back(system.contact_z.back());
      continue;
    }
    system.contact_z.push_back(account(Account::hysteresis, i));
    if (system.contacts[i].friction) account(Account::friction, i);
  }
  for (std::size_t i = 0; i < system.forces.size(); ++i) {
    const Force& f = system.forces[i];
    const auto* spring = std::get_if<Spring>(&f);
    const auto* torsion = std::get_if<TorsionSpring>(&f);
    const auto* maxwell = std::get_if<Maxwell>(&f);
    const auto* belt = std::get_if<BeltSpan>(&f);
    const bool passive = spring || torsion || maxwell || belt;
    const double c = spring ? spring->c : torsion ? torsion->c : maxwell ? maxwell->c : belt ? belt->c : 0;
    system.force_z.push_back(!passive ? account(Account::load, i) : c > 0 ? account(Account::damper, i) : -1);
  }
  for (std::size_t i = 0; i < system.joints.size(); ++i)
    system.joint_z.push_back(is_driver(system.joints[i]) ? account(Account::driver, i) : -1);
  for (std::size_t i = 0; i < system.frictions.size(); ++i) account(Account::joint_friction, i);
  for (std::size_t i = 0; i < system.bodies.size(); ++i)
    if (system.bodies[i].modes() > 0 && !system.bodies[i].flex->zeta.isZero()) account(Account::damping, i);
  for (std::size_t i = 0; i < system.switches.size(); ++i) account(Account::switching, i);
  if (scheme_loses) account(Account::scheme, 0);
}

}  // namespace

void number(System& system, bool scheme_loses) {
  number_coordinates(system);
  number_rows(system);
  number_integrals(system, scheme_loses);
  number_internal(system);
  number_switches(system);
}

std::vector<InternalState> states_of(const System& system, const InternalStates& of) {
  const auto k = static_cast<std::size_t>(of.index);
  if (of.owner == InternalStates::contact) return internal_states(*system.contacts[k].friction);
  if (of.owner == InternalStates::friction) return internal_states(system.frictions[k].law);
  const auto states = internal_states(system.forces[k]);
  return {states.begin(), states.end()};
}

std::string owner_name(const System& system, const InternalStates& of) {
  const auto k = static_cast<std::size_t>(of.index);
  if (of.owner == InternalStates::force) return system.force_names[k];
  if (of.owner == InternalStates::friction) return system.joint_names[static_cast<std::size_t>(system.frictions[k].joint)];
  return system.contact_names[k];
}

int n_clearances(const System& system) {
  return static_cast<int>(std::ranges::find(system.contacts, true, &ContactPair::profiles) - system.contacts.begin());
}

std::size_t dry_states(const System& system) {
  const bool any = !system.frictions.empty() ||
                   std::ranges::any_of(system.contacts, [](const ContactPair& c) { return is_rigid(c) || dry_friction(c); });
  return any ? system.contacts.size() + system.frictions.size() : 0;
}

double tooth_mobility(const System& system, const ContactPair& pair) {
  if (!pair.flank) return 0;
  const std::array<double, 2> radius = pitch_radii(*pair.flank);
  double out = 0;
  for (const auto& [marker, r] : {std::pair(pair.a, radius[0]), std::pair(pair.b, radius[1])})
    if (const int body = system.markers[static_cast<std::size_t>(marker)].body; body != ground)
      out += r * r / system.bodies[static_cast<std::size_t>(body)].J;
  return out;
}

double lightness(const System& system, const ContactPair& pair) {
  double out = 0;
  for (const int marker : {pair.a, pair.b})
    if (const int body = system.markers[static_cast<std::size_t>(marker)].body; body != ground)
      out += 1 / system.bodies[static_cast<std::size_t>(body)].m;
  return out + tooth_mobility(system, pair);
}

double latched_at(const System& system, const ContactPair& pair, double depth) {
  return std::max(speed_to_reach(pair.normal, lightness(system, pair), depth), pair.slowest_impact);
}

bool feels_shapes(const System& system, const Joint& joint, int marker) {
  const Marker& m = system.markers[static_cast<std::size_t>(marker)];
  if (m.body == ground) return false;
  const Body& body = system.bodies[static_cast<std::size_t>(m.body)];
  if (body.modes() == 0) return false;
  return body.flex->second || !m.shape.isZero(0) || (properties_of(joint).angles && !m.slope.isZero(0));
}

bool is_link(const System& system, int joint) {
  return std::any_of(system.contacts.begin(), system.contacts.end(), [joint](const ContactPair& c) { return c.link == joint; });
}

}  // namespace pintle
