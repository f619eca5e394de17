#include "framework/build/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "contact/cylinder_law.h"
#include "framework/bodies/modal_basis.h"
#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/configuration/ideal_pin.h"
#include "framework/mechanism/model.h"
#include "framework/scene/error.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

std::string text(double x) {
  std::ostringstream out;
  out << x;
  return out.str();
}

bool has_normal(const SceneClearance& c) { return c.normal.stiffness || c.normal.bearing.young > 0 || !c.normal.points.empty(); }

std::array<double, 2> radii_in(const SceneClearance& c) { return {c.journal_radius(), -c.bearing_radius}; }

/// The contact law described in the scene.
NormalLaw law_of(const Scene& scene, const SceneClearance& c) { return normal_law(scene, c.normal, contact_stiffness(c), radii_in(c)); }

bool rubs(const SceneClearance& c) { return c.friction && rubs(*c.friction); }

/// Entries of the scene that the model does not use.
std::string left_out(const SceneClearance& c) {
  std::vector<std::string> unused;
  const bool given = c.stiffness && c.damping;
  if (has_normal(c) && (c.model == ClearanceModel::massless_link || c.model == ClearanceModel::impact ||
                        (c.model == ClearanceModel::spring_damper && given)))
    unused.emplace_back("normal");
  if (rubs(c) && c.model == ClearanceModel::massless_link) unused.emplace_back("friction");
  if (c.stiffness && c.model != ClearanceModel::spring_damper) unused.emplace_back("stiffness");
  if (c.damping && c.model != ClearanceModel::spring_damper) unused.emplace_back("damping");
  std::string out;
  for (const std::string& word : unused) out += (out.empty() ? "; not used: " : ", ") + word;
  return out;
}

/// Completes the spring and damper. E = F c is the energy of the ideal joint's force F over the clearance c. The spring stores it at the
/// same depth as the contact does; the damper dissipates the same energy. @returns this, in words
std::string match(const Scene& scene, const SceneClearance& c, const IdealPin& pin, ContactPair& pair) {
  const NormalLaw law = law_of(scene, c);
  ImpactLaw& spring = *std::get_if<ImpactLaw>(&pair.normal);
  const double radial = pair.gap.clearance();
  std::string words;
  if (!c.stiffness) {
    const double energy = pin.force * radial;
    const double depth = energy > 0 ? depth_storing(law, energy) : 0.01 * radial;
    spring.k = stiffness_of_equal_energy(law, depth);
    words += "; the stiffness stores as much energy as the contact law at a depth of " + text(depth) + " m" +
             (energy > 0 ? ", reached with the work that the ideal joint's force, " + text(pin.force) + " N, does over the clearance" : "");
  }
  if (!c.damping) {
    const double e = restitution_of(law, pin.mass);
    spring.d = 2 * damping_ratio(e) * std::sqrt(spring.k * pin.mass);
    words += "; the damping gives the restitution " + text(e) + " of the contact law for the effective mass of " + text(pin.mass) + " kg";
  }
  return words;
}

/// The factor of that name for the scene's restitution.
double hysteresis_factor(const Scene& scene, const SceneNormal& n, const std::string& name, const std::vector<std::string>& others) {
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, n.place, message); };
  const ImpactFactor* factor = find_impact_factor(name);
  if (!factor) {
    std::vector<std::string> known = others;
    for (const ImpactFactor& f : impact_factors()) known.emplace_back(f.name);
    wrong("there is no impact law \"" + name + "\"." + did_you_mean(name, known));
  }
  if (n.restitution < 0 || n.restitution > 1 || (n.restitution == 0 && !factor->zero_allowed))
    wrong("restitution must lie in " + std::string(factor->zero_allowed ? "[0, 1]" : "(0, 1]") + " for " + name);
  return factor->chi(n.restitution);
}

ImpactLaw impact_law(const Scene& scene, const SceneNormal& n, double k) {
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, n.place, message); };
  std::vector<std::string> others{"table"};
  for (const CylinderLaw& law : cylinder_laws()) others.emplace_back(law.name);
  const double chi = hysteresis_factor(scene, n, n.law, others);
  if (!n.stiffness && n.exponent != 1.5)
    wrong("`young` and `poisson` give the stiffness for the exponent 1.5 only; for another exponent give `stiffness`");
  if (!(k > 0) || !std::isfinite(k)) wrong("no stiffness: give `young` and `poisson`, or `stiffness`");
  return {k, n.exponent, chi};
}

Cylinders cylinders_of(const Scene& scene, const SceneNormal& n, const std::array<double, 2>& radii) {
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, n.place, message); };
  const bool layered = find_cylinder_law(n.law)->of_a_layer;
  if (!(n.length > 0)) wrong(n.law + " needs a length above 0: that of the contact along the axes of the cylinders");
  Cylinders out{radii[0], radii[1], n.length, 0};
  if (layered && n.stiffness) {
    if (!(*n.stiffness > 0)) wrong(n.law + " needs a stiffness above 0");
    out.foundation = *n.stiffness;
    return out;
  }
  if (!(n.bearing.young > 0)) wrong(n.law + " needs `young` and `poisson`");
  if (layered) {
    if (!(n.layer > 0)) wrong(n.law + " needs a layer with a thickness above 0");
    if (!(n.bearing.poisson < 0.5)) wrong("a layer with Poisson's ratio 0.5 is incompressible; give `stiffness` instead");
    out.layer = n.layer;
    out.foundation = foundation_modulus(n.bearing.young, n.bearing.poisson, n.layer);
    return out;
  }
  const Elasticity& j = n.journal.young > 0 ? n.journal : n.bearing;
  const auto softness = [](const Elasticity& e) { return (1 - e.poisson * e.poisson) / e.young; };
  out.modulus = 1 / (softness(n.bearing) + softness(j));
  return out;
}

DampedLaw cylinder_law(const Scene& scene, const SceneNormal& n, const std::array<double, 2>& radii) {
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, n.place, message); };
  const CylinderLaw& law = *find_cylinder_law(n.law);
  const Cylinders c = cylinders_of(scene, n, radii);
  const double clearance = std::abs(c.a + c.b);
  if (!c.internal() && !law.external) wrong(n.law + " is a law for a pin in a hole; for two convex bodies use johnson, or a table");
  constexpr double rounding = 1e-9;
  if (c.internal() && (clearance < (1 - rounding) * law.least_clearance || clearance > (1 + rounding) * law.most_clearance))
    wrong(n.law + " has constants for radial clearances from " + text(law.least_clearance) + " to " + text(law.most_clearance) +
          " m, not for " + text(clearance) + " m; use johnson");
  DampedLaw out = law.law(c);
  out.name = law.name;
  return out;
}

DampedLaw table_law(const Scene& scene, const SceneNormal& n) {
  try {
    return {.elastic = force_table(n.points),
            .deepest = n.points.back()[0],
            .name = "table",
            .limit = "the law continues with its last slope there; add points"};
  } catch (const std::invalid_argument& error) {
    throw SceneError(scene.file, n.place, std::string("its table ") + error.what());
  }
}

}  // namespace

bool is_of_cylinders(const SceneNormal& n) { return find_cylinder_law(n.law) != nullptr; }

NormalLaw normal_law(const Scene& scene, const SceneNormal& n, double stiffness, const std::array<double, 2>& radii) {
  if (!is_of_cylinders(n) && n.law != "table") return impact_law(scene, n, stiffness);
  DampedLaw out = is_of_cylinders(n) ? cylinder_law(scene, n, radii) : table_law(scene, n);
  out.chi = hysteresis_factor(scene, n, n.hysteresis, {});
  return out;
}

std::optional<PressureTheory> pressure_of(const Scene& scene, const SceneNormal& n, const std::array<double, 2>& radii) {
  if (!is_of_cylinders(n)) return std::nullopt;
  return pressure_theory(*find_cylinder_law(n.law), cylinders_of(scene, n, radii));
}

RigidImpact rigid_impact(const Scene& scene, const SceneImpact& impact, const Place& place) {
  for (const double e : {impact.restitution, impact.tangential})
    if (!(e >= 0 && e <= 1)) throw SceneError(scene.file, place, "restitution must lie in [0, 1]");
  return {impact.restitution, impact.tangential, impact.poisson};
}

std::string impact_text(const RigidImpact& impact) {
  return "impact, restitution " + text(impact.restitution) + (impact.poisson ? " of impulses" : " of speeds") +
         (impact.tangential > 0 ? ", tangential " + text(impact.tangential) : "");
}

void check_rigid_friction(const Scene& scene, const SceneFriction& f) {
  if (f.law != "coulomb" && rubs(f)) throw SceneError(scene.file, f.place, "friction of rigid bodies is dry; use the law coulomb");
}

bool rubs(const SceneFriction& f) { return f.coefficient != 0 || f.holds.value_or(0) != 0; }

namespace {

FrictionLaw bristles(const Scene& scene, const SceneFriction& f, double holds) {
  constexpr double slow = 1e-3;  // [m/s]
  const double stribeck = f.stribeck > 0 ? f.stribeck : slow, damping = f.bristle_damping.value_or(critical_damping(f.bristle_stiffness));
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, f.place, message); };
  if (!(f.coefficient > 0)) wrong(f.law + " needs a coefficient above 0, at which its bristles slip");
  if (!(f.bristle_stiffness > 0)) wrong(f.law + " needs a bristle stiffness above 0");
  if (!(f.viscous >= 0)) wrong("viscous friction must not be negative");
  if (f.law == "lugre") {
    if (!(damping >= 0)) wrong("bristle damping must not be negative");
    const double fades = f.damping_speed.value_or(gentle_damping_speed(f.coefficient, damping));
    if (!(fades > 0)) wrong("the damping speed must be above 0");
    return LuGre{f.coefficient, holds, stribeck, f.bristle_stiffness, damping, f.viscous, fades};
  }
  if (!(damping > 0)) wrong("gonthier needs a bristle damping above 0");
  if (!(f.dwell > 0)) wrong("gonthier needs a dwell time above 0");
  return Gonthier{f.coefficient, holds, stribeck, f.bristle_stiffness, damping, f.viscous, f.dwell};
}

}  // namespace

FrictionLaw friction_law(const Scene& scene, const SceneFriction& f) {
  const double holds = f.holds.value_or(f.coefficient);
  if (holds < f.coefficient) throw SceneError(scene.file, f.place, "the static coefficient of friction must not be below the sliding one");
  if (f.law == "ambrosio") return Ambrosio{f.coefficient, f.v0, f.v1};
  if (f.law == "threlfall") return Threlfall{f.coefficient, f.v1};
  if (f.law == "tanh") return HyperbolicTangent{f.coefficient, f.v1};
  if (f.law == "bengisu-akay") return BengisuAkay{f.coefficient, holds, f.v0, f.v1};
  if (f.law == "coulomb") return Coulomb{f.coefficient, holds, f.stribeck};
  if (f.law == "lugre" || f.law == "gonthier") return bristles(scene, f, holds);
  throw SceneError(
      scene.file, f.place,
      "there is no friction law " + quoted(f.law) + "; write coulomb, lugre, gonthier, ambrosio, threlfall, tanh or bengisu-akay");
}

std::string friction_text(const ContactPair& pair) {
  if (!pair.friction) return ", no friction";
  const auto* coulomb = std::get_if<Coulomb>(&*pair.friction);
  const std::string slides = text(coefficient_of(*pair.friction));
  if (bristle_states(*pair.friction) > 0)
    return ", friction " + slides + " by bristles of " + text(bristle_constants(*pair.friction).stiffness) + " 1/m, damping " +
           text(bristle_constants(*pair.friction).damping) + " s/m";
  return coulomb ? ", dry friction " + slides + (coulomb->mu_static > coulomb->mu ? ", static " + text(coulomb->mu_static) : "")
                 : ", friction " + slides;
}

ContactPair contact_of(const Scene& scene, const SceneJoint& j) {
  const auto wrong = [&](const Place& place, const std::string& message) { throw SceneError(scene.file, place, message); };
  const SceneClearance& c = *j.clearance;
  if (j.kind != JointKind::revolute) wrong(c.place, "only a revolute joint can have this clearance");
  if (c.bearing != j.a.body && c.bearing != j.b.body)
    wrong(c.place, "bearing: \"" + c.bearing + "\" is neither \"" + j.a.body + "\" nor \"" + j.b.body + "\"." +
                       did_you_mean(c.bearing, std::vector{j.a.body, j.b.body}));
  if (!(c.radial > 0)) wrong(c.place, "radial must be above 0; leave out `clearance` for an ideal joint");
  if (!(c.radial < c.bearing_radius))
    wrong(c.place, "radial clearance must be below the bearing radius: the journal radius is their difference");
  if (!(c.journal_radius() < c.bearing_radius))
    wrong(c.place, "radial clearance is less than the last digit of the bearing radius; leave out `clearance` for an ideal joint");

  ContactPair pair{};
  pair.gap = JournalBearing{c.journal_radius(), c.bearing_radius};
  pair.slowest_impact = c.normal.slowest_impact;
  pair.follows = c.normal.follows;
  if (c.model == ClearanceModel::massless_link) return pair;
  if (c.model == ClearanceModel::impact) {
    pair.rigid = rigid_impact(scene, c.impact, c.place);
    if (c.friction) check_rigid_friction(scene, *c.friction);
  } else if (c.model == ClearanceModel::contact) {
    pair.normal = law_of(scene, c);
    pair.pressure = pressure_of(scene, c.normal, radii_in(c));
  } else {
    if (!(c.stiffness && c.damping)) law_of(scene, c);  // checked now, because complete_clearances needs it for what is missing
    if ((c.stiffness && !(*c.stiffness > 0)) || (c.damping && !(*c.damping >= 0)))
      wrong(c.place, "stiffness must be above 0, and damping must not be negative");
    pair.normal = ImpactLaw{.k = c.stiffness.value_or(0), .n = 1, .chi = 0, .d = c.damping.value_or(0)};
  }
  if (rubs(c)) {
    pair.friction = friction_law(scene, *c.friction);
    pair.sliding = c.friction->sliding == SlidingSpeed::material ? Sliding::material : Sliding::geometric;
  }
  return pair;
}

std::optional<ResidualFlexibility> residual_flexibility(const Scene& scene, const SceneJoint& j, const MechanismBody* a,
                                                        const MechanismBody* b) {
  const auto of = [&](const MechanismBody* made, const PointRef& at) -> std::optional<Eigen::Matrix2d> {
    if (!made || made->when_free.empty() || !made->elastic.scene->elastic->modes->massless) return {};
    const SceneModes& modes = *made->elastic.scene->elastic->modes;
    const int port = port_of(made->elastic, at.point);
    if (modes.method == SceneModes::Method::normal && (made->conditions.a == port || made->conditions.b == port))
      throw SceneError(
          scene.file, modes.place,
          "boundary: massless lets the body move at \"" + at.point + "\", where its frame holds its modes; use mean axes or another point");
    return made->when_free[static_cast<std::size_t>(port)].massless;
  };
  const std::optional<Eigen::Matrix2d> at_a = of(a, j.a), at_b = of(b, j.b);
  if (!presses_elastically(j) || (!at_a && !at_b)) return {};
  const SceneClearance& c = *j.clearance;
  const auto wrong = [&](const Place& place, const std::string& message) {
    throw SceneError(scene.file, place, "a body has boundary: massless, which " + message);
  };
  if (c.normal.follows) wrong(c.normal.place, "needs the approach speed at the onset: write approach speed: onset");
  if (rubs(c) && (c.friction->sliding == SlidingSpeed::geometric || c.friction->law == "coulomb" || c.friction->law == "lugre" ||
                  c.friction->law == "gonthier"))
    wrong(c.friction->place,
          "serves only friction that is a function of the material sliding speed: ambrosio, threlfall, tanh or bengisu-akay");
  const Eigen::Matrix2d none = Eigen::Matrix2d::Zero();
  const bool b_bears = c.bearing == j.b.body;
  return ResidualFlexibility{(b_bears ? at_a : at_b).value_or(none), (b_bears ? at_b : at_a).value_or(none)};
}

std::vector<std::string> complete_clearances(const Scene& scene, System& system, std::vector<std::string>& warnings) {
  std::vector<const SceneJoint*> joints;
  bool open = false;
  for (const SceneJoint& j : scene.joints)
    if (j.clearance && !is_open(j)) {
      joints.push_back(&j);
      open = open || (j.clearance->model == ClearanceModel::spring_damper && !(j.clearance->stiffness && j.clearance->damping));
    }
  const std::vector<IdealPin> pins = open ? ideal_pins(scene, system) : std::vector<IdealPin>(joints.size());
  std::vector<std::string> out;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const SceneClearance& c = *joints[i]->clearance;
    ContactPair& pair = system.contacts[i];
    std::string words = model_name(c.model);
    if (c.model == ClearanceModel::impact) {
      words = impact_text(*pair.rigid) + friction_text(pair);
    } else if (c.model == ClearanceModel::contact) {
      words += ", stiffness " + stiffness_text(pair.normal) + ", restitution delivered " + text(restitution_of(pair.normal, 1)) +
               friction_text(pair);
    } else if (c.model == ClearanceModel::spring_damper) {
      const std::string how = c.stiffness && c.damping ? "" : match(scene, c, pins[i], pair);
      words += ", stiffness " + stiffness_text(pair.normal) + ", damping " + text(viscous_damping(pair.normal)) + " N s/m" +
               friction_text(pair) + how;
    } else if (rubs(c)) {
      warnings.push_back("\"" + joints[i]->name + "\": a massless link has no wall to slide on; its friction is ignored");
    }
    out.push_back(words + left_out(c));
  }
  return out;
}

void validate_start_journals(const Scene& scene, const System& system) {
  const std::vector<std::string> known(system.contact_names.begin(), system.contact_names.begin() + n_clearances(system));
  for (const StartJournal& s : scene.start_journals) {
    const auto found = std::find(known.begin(), known.end(), s.joint);
    if (found == known.end())
      throw SceneError(scene.file, s.place, quoted(s.joint) + " is not a joint with clearance." + did_you_mean(s.joint, known));
    const ContactPair& pair = system.contacts[static_cast<std::size_t>(found - known.begin())];
    if (!is_held(pair) &&
        std::hypot(s.eccentricity[0], s.eccentricity[1]) > pair.gap.clearance() + deepest_valid * journal_radius(pair.gap))
      throw SceneError(scene.file, s.place,
                       "the eccentricity puts the journal into the wall by more than a tenth of its radius, where no contact law is valid; "
                       "the clearance is " +
                           std::to_string(1e3 * pair.gap.clearance()) + " mm");
  }
}

double contact_stiffness(const SceneClearance& c) {
  if (c.normal.stiffness) return *c.normal.stiffness;
  const Elasticity& j = c.normal.journal.young > 0 ? c.normal.journal : c.normal.bearing;
  if (!(c.normal.bearing.young > 0)) return 0;
  return hertz_stiffness(c.journal_radius(), c.bearing_radius, j.young, j.poisson, c.normal.bearing.young, c.normal.bearing.poisson,
                         c.normal.radii == RadiusConvention::internal);
}

std::string rounding_warning(const Scene& scene, const SceneJoint& j, double length) {
  constexpr double few = 1e-6, most = 1e-3;
  const double lost = std::numeric_limits<double>::epsilon() * length / j.clearance->radial;
  if (lost <= few) return "";
  std::ostringstream s;
  s.precision(3);
  s << "radial clearance " << j.clearance->radial << " m: positions in a mechanism of " << length << " m are rounded to " << 100 * lost
    << " % of it";
  if (lost > most) throw SceneError(scene.file, j.clearance->place, s.str() + "; leave out `clearance` for an ideal joint");
  return "\"" + j.name + "\": " + s.str();
}

}  // namespace pintle
